#include "realtime/fast_passes.hpp"

#include <epoxy/gl.h>

#include <algorithm>

#include "gpu/context.hpp"

namespace wold {

namespace {

constexpr const char* before =
    "uniform vec3 iResolution;\nuniform float iTime;\nuniform vec4 iMouse;\n"
    "uniform vec3 sun_now;\n"
    "uniform ivec2 strip_low;\nuniform float strip_cell;\nuniform int strip_level;\n"
    "uniform int strip_slice;\n";

constexpr const char* includes =
    "\n#include \"landscape/fast_rings.glsl\"\n#include \"landscape/fast_view.glsl\"\n"
    "#include \"landscape/fast_resolve.glsl\"\n"
    "#include \"landscape/fast_air.glsl\"\n#include \"landscape/fast_shade.glsl\"\n"
    "#include \"landscape/fast_cloud_light.glsl\"\n#include \"landscape/fast_clouds.glsl\"\n"
    "#include \"landscape/fast_land.glsl\"\n#include \"landscape/fast_bake.glsl\"\n";

const char* main_of(FastPass pass) {
  switch (pass) {
    case FastPass::transmittances:
      return "out vec4 made;\nvoid main() {\n"
             "  made = transmittance_entry(table_place(gl_FragCoord.xy, vec2(256.0, 64.0)));\n}\n";
    case FastPass::multiples:
      return "out vec4 made;\nvoid main() {\n"
             "  made = multiple_entry(table_place(gl_FragCoord.xy, vec2(128.0, 32.0)));\n}\n";
    case FastPass::heights: return "out vec4 made;\nvoid main() {\n  made = height_texel();\n}\n";
    case FastPass::patches: return "out float made;\nvoid main() {\n  made = patch_maximum();\n}\n";
    case FastPass::maxima: return "out float made;\nvoid main() {\n  made = higher_maximum();\n}\n";
    case FastPass::horizons:
      return "out vec4 made;\nvoid main() {\n"
             "  made = baked_horizon(strip_place(textureSize(ring_horizons, 0).x), strip_cell,\n"
             "                       sun_now);\n}\n";
    case FastPass::shades:
      return "out vec2 made;\nvoid main() {\n"
             "  vec2 place = strip_place(textureSize(cloud_shades, 0).x);\n"
             "  made = vec2(baked_cloud_shade(place, sun_now), baked_cloud_cover(place));\n}\n";
    case FastPass::cloud_lights:
      return "out float made;\nvoid main() {\n"
             "  made = baked_cloud_light(strip_place(textureSize(cloud_lights, 0).x),\n"
             "                           slice_height(strip_slice), sun_now);\n}\n";
    case FastPass::flight_view:
    case FastPass::free_view:
      return "out vec4 made;\nvoid main() {\n"
             "  made = view_texel(int(gl_FragCoord.x), iResolution.xy, iTime);\n}\n";
    case FastPass::sky:
      return "layout(location = 0) out vec4 by_air;\nlayout(location = 1) out vec4 by_aerosol;\n"
             "layout(location = 2) out vec4 passed;\nvoid main() {\n"
             "  sky_texel(gl_FragCoord.xy, by_air, by_aerosol, passed);\n}\n";
    case FastPass::land:
      return "out vec4 made;\nvoid main() {\n"
             "  vec2 pixel = new_pixel(ivec2(gl_FragCoord.xy), iResolution.xy);\n"
             "  made = fast_landscape(pixel, iResolution.xy, iTime);\n}\n";
    case FastPass::clouds:
      return "out vec4 made;\nvoid main() {\n"
             "  ivec2 cell = ivec2(gl_FragCoord.xy);\n"
             "  made = behind_fast_clouds(texelFetch(land_picture, cell, 0),\n"
             "                            new_pixel(cell, iResolution.xy), iResolution.xy,\n"
             "                            iTime);\n}\n";
    case FastPass::resolve:
      return "out vec4 made;\nvoid main() {\n"
             "  made = resolved_picture(gl_FragCoord.xy, iResolution.xy, iTime);\n}\n";
    case FastPass::show:
      return "out vec4 made;\nvoid main() {\n"
             "  made = vec4(shown_landscape(gl_FragCoord.xy, iResolution.xy), 1.0);\n}\n";
  }
  return "";
}

}  // namespace

FastPasses::FastPasses(const Landscape& landscape)
    : body_(landscape_body(landscape,
                           {"SUN_ELEVATION", "SUN_AZIMUTH", "EXPOSURE", "FIELD_OF_VIEW"})) {}

std::string fast_pass_functions(const std::string& body) {
  return before + body + includes;
}

const GpuProgram& FastPasses::operator[](FastPass pass) {
  GpuProgram& program = programs_[static_cast<std::size_t>(pass)];
  if (!program) {
    const ShaderDialect dialect = gpu_info().dialect;
    const std::string text = (pass == FastPass::free_view ? "#define LANDSCAPE_CAMERA\n" : "") +
                             fast_pass_functions(body_) + main_of(pass);
    program = GpuProgram(assemble_shader("gpu/full_screen.vert.glsl", dialect),
                         assemble_shader_text("fast landscape", text, dialect));
  }
  return program;
}

int FastPasses::compile_next(bool camera) {
  const FastPass other = camera ? FastPass::flight_view : FastPass::free_view;
  int wanting = 0;
  for (std::size_t k = 0; k < count; ++k) {
    const auto pass = static_cast<FastPass>(k);
    if (programs_[k] || pass == other) continue;
    if (wanting++ == 0) (*this)[pass];
  }
  return std::max(wanting - 1, 0);
}

void draw_strips(const GpuProgram& program, const RingTarget& target, const RingSquares& squares,
                 const std::vector<RingStrip>& strips, const GpuTexture& texture, int layers,
                 int layer) {
  for (const RingStrip& s : strips) {
    program.set("strip_low", s.low);
    program.set("strip_cell", static_cast<float>(squares.cell(s.level)));
    target.draw(texture, layers * s.level + layer, 0, squares.rects(s));
  }
}

void bake_land(FastPasses& passes, const RingTarget& target, const RingSquares& squares,
               const std::vector<RingStrip>& strips, const GpuTexture& heights,
               const GpuTexture& maxima, const std::function<void(const GpuProgram&)>& bind) {
  if (strips.empty()) return;
  const GpuProgram& land = passes[FastPass::heights];
  bind(land);
  draw_strips(land, target, squares, strips, heights);
  // A patch reaches to the next texel: those before the strip are new as well.
  const GpuProgram& patches = passes[FastPass::patches];
  bind(patches);
  for (const RingStrip& s : strips) {
    patches.set("strip_level", s.level);
    patches.set("strip_cell", static_cast<float>(squares.cell(s.level)));
    target.draw(maxima, s.level, 0, squares.rects(s, 0, 1));
  }
  const GpuProgram& raise = passes[FastPass::maxima];
  bind(raise);
  maxima.bind(1);
  for (int level = 1; level < maxima.settings().levels; ++level) {
    // What is read must not be what is drawn into.
    glTexParameteri(GL_TEXTURE_2D_ARRAY, GL_TEXTURE_BASE_LEVEL, level - 1);
    glTexParameteri(GL_TEXTURE_2D_ARRAY, GL_TEXTURE_MAX_LEVEL, level - 1);
    for (const RingStrip& s : strips) {
      raise.set("strip_level", s.level);
      target.draw(maxima, s.level, level, squares.rects(s, level, 1));
    }
  }
  glTexParameteri(GL_TEXTURE_2D_ARRAY, GL_TEXTURE_BASE_LEVEL, 0);
  glTexParameteri(GL_TEXTURE_2D_ARRAY, GL_TEXTURE_MAX_LEVEL, maxima.settings().levels - 1);
}

}  // namespace wold
