#include "realtime/landscape_picture.hpp"

#include <epoxy/gl.h>

#include <algorithm>
#include <array>
#include <cmath>

#include "base/parallel.hpp"
#include "gpu/context.hpp"
#include "image/color.hpp"

namespace wold {

namespace {

constexpr const char* before =
    "uniform vec3 iResolution;\nuniform float iTime;\n"
    "uniform vec4 iMouse;\n";
constexpr const char* after =
    "\nout vec4 shown;\nvoid main() {\n  mainImage(shown, gl_FragCoord.xy);\n}\n";

GpuProgram program_of(const std::string& body) {
  const ShaderDialect dialect = gpu_info().dialect;
  return {assemble_shader("gpu/full_screen.vert.glsl", dialect),
          assemble_shader_text("landscape", before + body + after, dialect)};
}

}  // namespace

LandscapeDrawing::LandscapeDrawing(const Landscape& landscape)
    : body_(landscape_body(landscape)), free_body_(landscape_body(landscape, {"FIELD_OF_VIEW"})) {
  if (landscape.map) maps_ = LandTextures(*landscape.map);
}

LandscapeDrawing::LandscapeDrawing(const std::string& fragment, const std::optional<LandMap>& map)
    : body_(fragment), free_body_(fragment) {
  if (map) maps_ = LandTextures(*map);
}

void LandscapeDrawing::draw(const GpuProgram& program, int width, int height, float time) const {
  glDisable(GL_BLEND);
  glDisable(GL_DEPTH_TEST);
  program.set("iResolution", Vec3(width, height, 1));
  program.set("iTime", time);
  program.set("iMouse", Vec4(0));
  maps_.bind(program, 0);
  draw_full_screen();
}

void LandscapeDrawing::draw(int width, int height, float time) const {
  if (!flight_) flight_ = program_of(body_);
  draw(flight_, width, height, time);
}

void LandscapeDrawing::draw(int width, int height, float time, const Camera& camera) const {
  if (!free_) free_ = program_of("#define LANDSCAPE_CAMERA\n" + free_body_);
  const Vec3 forward = glm::normalize(camera.direction);
  free_.set("camera_place", Vec4(camera.position, 0));
  free_.set("field_of_view", camera.field_of_view);
  free_.set("camera_forward", forward);
  free_.set("camera_right", glm::normalize(glm::cross(forward, camera.up)));
  draw(free_, width, height, time);
}

namespace {

/// The inverse of what the shader shows, 1 - exp(-x) as sRGB.
float light_of(float shown) {
  return -std::log(1 - std::min(srgb_to_linear(std::clamp(shown, 0.0F, 1.0F)), 0.99999F));
}

/// R, G, B, A from the bottom up to an image of a factor fewer pixels each way.
Image averaged(const std::vector<float>& values, int width, int height, int factor) {
  const auto at = [&](int x, int y) {  // from the top
    const auto row = static_cast<std::size_t>(factor * height - 1 - y);
    return 4 * (row * static_cast<std::size_t>(factor * width) + static_cast<std::size_t>(x));
  };
  Image image(width, height, {"R", "G", "B"});
  parallel_for(0, height, [&](int y) {
    for (int x = 0; x < width; ++x)
      for (int c = 0; c < 3; ++c) {
        double sum = 0;
        for (int j = 0; j < factor; ++j)
          for (int i = 0; i < factor; ++i) {
            const float value =
                values[at(factor * x + i, factor * y + j) + static_cast<std::size_t>(c)];
            sum += static_cast<double>(light_of(value));
          }
        image.at(x, y, c) =
            linear_to_srgb(1 - std::exp(-static_cast<float>(sum / (factor * factor))));
      }
  });
  return image;
}

}  // namespace

Image shown_image(const GpuTarget& target) {
  const std::vector<float> values = target.read();
  Image image(target.width(), target.height(), {"R", "G", "B"});
  std::size_t k = 0;
  for (int y = image.height - 1; y >= 0; --y)
    for (int x = 0; x < image.width; ++x, k += 4)
      for (int c = 0; c < 3; ++c)
        image.at(x, y, c) = std::clamp(values[k + static_cast<std::size_t>(c)], 0.0F, 1.0F);
  return image;
}

Image landscape_picture(const LandscapeDrawing& drawing, int width, int height, float time,
                        const Camera* camera, int rays_across) {
  const GpuTarget target(rays_across * width, rays_across * height,
                         std::array{PixelFormat::rgba32f}, false);  // which ES can read, too
  target.bind();
  if (camera != nullptr)
    drawing.draw(target.width(), target.height(), time, *camera);
  else
    drawing.draw(target.width(), target.height(), time);
  if (rays_across == 1) return shown_image(target);
  return averaged(target.read(), width, height, rays_across);
}

}  // namespace wold
