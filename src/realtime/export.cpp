#include "realtime/export.hpp"

#include <fmt/format.h>

#include "realtime/shader_strip.hpp"
#include "shaders/assembly.hpp"

namespace wold {

namespace {

std::string head(const Landscape& landscape) {
  std::string text = fmt::format(
      "// A landscape in one pass, made by wold from {}.\n//\n"
      "// Land, colours, air and clouds are functions of the pixel's ray: nothing is stored. "
      "Change "
      "the\n// knobs below and look; LOW_QUALITY 1 is for slow devices.\n",
      landscape.title);
  if (!landscape.left_out.empty()) {
    text += "// The scene's steps that need the whole land are left out";
    text += landscape.stand_in.empty() ? ".\n" : fmt::format(": {}.\n", landscape.stand_in);
  }
  return text;
}

constexpr const char* glsl_head = R"(//
// How to use it: draw a triangle or a rectangle over the whole target, with any vertex shader, and
// set the uniforms
//
//   vec3  iResolution   width and height of the target in pixels; the third is not read
//   float iTime         seconds: how far the flight has come
//   vec4  iMouse        pixels from the bottom left: where to look; (0, 0, 0, 0) is straight on
//
// The colour that comes out is for the screen (sRGB encoded): draw into a target that does not
// encode it again.

uniform vec3 iResolution;
uniform float iTime;
uniform vec4 iMouse;

out vec4 shown;

)";

}  // namespace

std::string landscape_tab(const Landscape& landscape) {
  const std::string body = stripped_shader(flatten_shader(landscape_body(landscape)), "mainImage");
  return head(landscape) +
         "// On Shadertoy: paste it all into the tab Image. The mouse looks around.\n\n" + body;
}

std::string export_shader(const Landscape& landscape, ShaderTarget target) {
  if (target == ShaderTarget::html) return landscape_page(landscape);
  if (landscape.map)
    throw Error(ErrorKind::usage,
                "only --target html can carry the land as a map; others want --terrain function");
  if (target == ShaderTarget::shadertoy) return landscape_tab(landscape);
  const std::string body = stripped_shader(flatten_shader(landscape_body(landscape)), "mainImage");
  return "#version 330 core\n" + head(landscape) + glsl_head + body +
         "\nvoid main() {\n  mainImage(shown, gl_FragCoord.xy);\n}\n";
}

}  // namespace wold
