#include "gpu/evaluate.hpp"

#include <epoxy/gl.h>

#include <algorithm>
#include <array>
#include <string>

#include "gpu/context.hpp"
#include "gpu/objects.hpp"

namespace wold {

namespace {

constexpr int row_length = 1024;
constexpr int first_unit = 30;  // of the points' textures: out of the way of all others

GpuTexture texture_of(std::span<const Vec4> points, int width, int height) {
  std::vector<float> texels(static_cast<std::size_t>(width) * static_cast<std::size_t>(height) * 4);
  std::size_t k = 0;
  for (const Vec4& p : points)
    for (int c = 0; c < 4; ++c) texels[k++] = p[c];
  GpuTexture texture(width, height,
                     {.format = PixelFormat::rgba32f, .filter = TextureFilter::nearest});
  texture.upload(texels);
  return texture;
}

}  // namespace

std::vector<Vec4> evaluate_shader(std::string_view body, std::span<const Vec4> a,
                                  std::span<const Vec4> b, std::span<const ShaderDefine> defines,
                                  const std::function<void(const GpuProgram&)>& prepare) {
  if (a.empty()) return {};
  const ShaderDialect dialect = gpu_info().dialect;
  const std::string whole = "#include \"gpu/evaluate.frag.glsl\"\n" + std::string(body);
  const GpuProgram program =
      full_screen_program(assemble_shader_text("evaluate", whole, dialect, defines));
  const int count = static_cast<int>(a.size());
  const int width = std::min(count, row_length);
  const int height = (count + width - 1) / width;
  const GpuTexture first = texture_of(a, width, height);
  const GpuTexture second = texture_of(b, width, height);
  const GpuTarget target(width, height, std::array{PixelFormat::rgba32f}, false);
  target.bind();
  glDisable(GL_BLEND);
  glDisable(GL_DEPTH_TEST);
  program.use();
  if (prepare) prepare(program);
  program.set("points_a", first_unit);
  program.set("points_b", first_unit + 1);
  first.bind(first_unit);
  second.bind(first_unit + 1);
  draw_full_screen();
  const std::vector<float> values = target.read();
  std::vector<Vec4> out(a.size());
  for (std::size_t k = 0; k < out.size(); ++k)
    out[k] = {values[4 * k], values[4 * k + 1], values[4 * k + 2], values[4 * k + 3]};
  return out;
}

}  // namespace wold
