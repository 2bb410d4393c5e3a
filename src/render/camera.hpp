#pragma once
// A perspective camera with a thin lens.

#include "base/vec.hpp"

namespace wold {

struct Ray {
  Vec3 origin{0};           ///< m
  Vec3 direction{0, 1, 0};  ///< unit length
};

struct Camera {
  Vec3 position{0};          ///< m
  Vec3 direction{0, 1, 0};   ///< unit length
  Vec3 up{0, 0, 1};          ///< roughly; need not be perpendicular to direction
  float field_of_view = 55;  ///< degrees, across the picture's longer side
  float aperture = 0;        ///< m, diameter of the lens; 0 for a pinhole
  float focus = 50;          ///< m, distance in focus
};

/// A camera made ready for a picture of a given size.
class CameraRays {
 public:
  /// `width`, `height`: picture size in pixels.
  CameraRays(const Camera& camera, int width, int height);

  /// The ray through a point of the picture, in pixels from the top left; `lens` in [0, 1)² picks
  /// the point on the lens.
  Ray ray(Vec2 pixel, Vec2 lens) const;
  /// Angle between neighbouring pixels at the centre, radians.
  float pixel_angle() const { return pixel_angle_; }
  /// Where a place appears, in pixels, and its distance along the view; behind the camera z <= 0.
  Vec3 project(Vec3 place) const;

 private:
  Vec3 position_;
  Vec3 forward_;
  Vec3 right_;
  Vec3 down_;
  float half_width_ = 1;  // of the picture plane at distance 1
  float half_height_ = 1;
  int width_;
  int height_;
  float pixel_angle_ = 0;
  float lens_radius_ = 0;
  float focus_ = 1;
};

/// Uniform point on the unit disc from the unit square, low distortion (Shirley and Chiu 1997).
Vec2 disc_sample(Vec2 u);

}  // namespace wold
