#pragma once
// The landscape shader, drawn by OpenGL: into a picture, or into whatever target is bound.

#include <memory>
#include <optional>
#include <string>

#include "gpu/objects.hpp"
#include "image/image.hpp"
#include "realtime/land_textures.hpp"
#include "realtime/landscape.hpp"
#include "render/camera.hpp"

namespace wold {

/// A program for one landscape. Needs a current context, at its end too.
class LandscapeDrawing {
 public:
  /// Throws Error(internal) with the driver's log, in the names of our files and of "landscape".
  explicit LandscapeDrawing(const Landscape& landscape);
  /// `fragment` is a whole shader text that defines `mainImage` and needs nothing but Shadertoy's
  /// uniforms: what was exported. Its field of view is its own.
  LandscapeDrawing(const std::string& fragment, const std::optional<LandMap>& map);

  /// Draws over the whole of the bound target, width x height pixels, `time` seconds into the
  /// flight.
  void draw(int width, int height, float time) const;
  /// The same from a camera of the world's, whose place is measured from the terrain's middle.
  void draw(int width, int height, float time, const Camera& camera) const;

 private:
  void draw(const GpuProgram& program, int width, int height, float time) const;
  std::string body_;
  std::string free_body_;      // with the camera's field of view
  mutable GpuProgram flight_;  // each made when it is first wanted: drivers take seconds
  mutable GpuProgram free_;
  LandTextures maps_;
};

/// R, G, B of what was drawn into a target.
Image shown_image(const GpuTarget& target);

/// R, G, B as a display shows them: of each pixel the mean of the light of `rays_across` x
/// `rays_across` rays. Throws Error(limit) where the driver can't draw so many pixels.
Image landscape_picture(const LandscapeDrawing& drawing, int width, int height, float time,
                        const Camera* camera = nullptr, int rays_across = 1);

}  // namespace wold
