#pragma once
// A camera that finds itself a view.
//
// Places and directions are proposed by hashes of the seed; each is tried with a few hundred rays
// and judged as a photographer would: even ground to stand on, the horizon in the frame, nothing at
// the lens, near, middle and far ground, plants where there are any, light from the side rather
// than from ahead or behind. The best proposal wins, so the same scene and seed give the same view.

#include <cstdint>
#include <string>
#include <vector>

#include "base/parameters.hpp"
#include "base/progress.hpp"
#include "render/camera.hpp"
#include "render/ray_scene.hpp"

namespace wold {

struct CameraSettings {
  std::string name = "main";
  std::vector<double> position;         ///< m; empty: chosen
  std::vector<double> target;           ///< m, a place to look at; empty: by look_direction
  std::vector<double> look_direction;   ///< east, north, up; empty: chosen
  float look_height = 1.8F;             ///< m above ground, where the height is not given
  float edge_min_offset = 100;          ///< m from the border of the terrain
  std::vector<double> expected_height;  ///< m; the place chosen is near this height; empty: any
  float field_of_view = 55;             ///< degrees
  float tilt = 0;                       ///< degrees, added to the view upwards
  float aperture = 0;                   ///< m
  float focus = 50;                     ///< m
};

Description<CameraSettings> describe(const CameraSettings&);

/// Throws Error(input) for lists of the wrong length and a direction of no length.
void check_camera(const CameraSettings& settings);

/// What a camera sees, from a few hundred rays; shares are of the picture.
struct ViewStatistics {
  float sky = 0;
  float ground = 0;
  float plants = 0;
  float near_share = 0;     ///< nearer than 4 m, plants only
  float middle_share = 0;   ///< surfaces from 30 to 400 m
  float wall = 0;           ///< near ground in the upper half
  float near_ground = 0;    ///< near ground in the lower half
  float far_share = 0;      ///< surfaces beyond 400 m
  float sky_above = 0;      ///< sky within the uppermost quarter
  float depth_variety = 0;  ///< entropy of the logarithm of depth, 0 to 1
  float skyline = 0;        ///< standard deviation of the sky's lower edge, share of the height
};
ViewStatistics look_around(const RayScene& scene, const Camera& camera, float aspect);

/// Whether a view shows ground and sky and, if `plants` are in the world, plants.
bool shows_landscape(const ViewStatistics& view, bool plants);

/// Whether the settings leave nothing to choose.
bool is_placed(const CameraSettings& settings);

/// The camera of settings that leave nothing to choose. Throws as `find_camera`.
Camera placed_camera(const Ground& ground, const CameraSettings& settings);

/// The camera of the settings: as given, or found. `scene` needs ground in even dicing and the
/// larger plants. Throws as `check_camera`.
Camera find_camera(const RayScene& scene, const CameraSettings& settings, float aspect,
                   std::uint64_t seed, Progress& progress);

}  // namespace wold
