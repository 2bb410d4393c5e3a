#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <nlohmann/json.hpp>

#include "realtime/export.hpp"
#include "realtime/packing.hpp"
#include "realtime/page.hpp"
#include "realtime/shader_strip.hpp"
#include "shaders/assembly.hpp"

namespace wold {

namespace {

using Json = nlohmann::ordered_json;

struct Slider {
  const char* knob;
  const char* label;
  double min, max, step;
  const char* unit;
};
constexpr std::array sliders{
    Slider{"SUN_ELEVATION", "Sun's height", -12, 90, 0.5, "°"},
    Slider{"SUN_AZIMUTH", "Sun's direction", 0, 360, 1, "°"},
    Slider{"DAY_SPEED", "Time of day", 0, 12, 0.1, "°/s"},
    Slider{"CLOUD_COVERAGE", "Clouds", 0, 0.95, 0.01, ""},
    Slider{"EXPOSURE", "Brightness", -3, 3, 0.05, "stops"},
    Slider{"CAM_SPEED", "Speed", 0, 600, 1, "m/s"},
    Slider{"FIELD_OF_VIEW", "Field of view", 15, 110, 1, "°"},
};

/// Speeds are the page's own; the others are uniforms of the shader.
bool is_uniform(const Slider& slider) {
  const std::string knob = slider.knob;
  return knob != "DAY_SPEED" && knob != "CAM_SPEED";
}

std::string small(std::string name) {
  std::transform(name.begin(), name.end(), name.begin(),
                 [](unsigned char c) { return static_cast<char>(std::tolower(c)); });
  return name;
}

double number(const Value& value) {
  if (const auto* whole = std::get_if<std::int64_t>(&value)) return static_cast<double>(*whole);
  return std::get<double>(value);
}

Json heights_json(const HeightMap& map) {
  return {{"low", map.heights.low},
          {"high", map.heights.high},
          {"data", packed(map.samples, map.width)}};
}

Json map_json(const LandMap& map) {
  const int width = map.heights.width;
  Json json{
      {"width", width}, {"height", map.heights.height}, {"heights", heights_json(map.heights)}};
  if (map.water) json["water"] = heights_json(*map.water);
  if (!map.covers.empty()) json["covers"] = packed(map.covers, width);
  if (!map.trees.empty()) json["trees"] = packed(map.trees, width);
  return json;
}

Json scene_json(const Landscape& landscape) {
  const LandscapeSettings& s = landscape.settings;
  const ParameterSet set = describe(s);
  Json knobs = Json::array();
  for (const Slider& slider : sliders) {
    const Parameter& p = *set.find(slider.knob);
    const double value = std::round(number(p.get(&s)) * 1000) / 1000;
    knobs.push_back({{"name", small(slider.knob)},
                     {"label", slider.label},
                     {"text", p.text},
                     {"unit", slider.unit},
                     {"min", std::min(slider.min, value)},
                     {"max", std::max(slider.max, value)},
                     {"step", slider.step},
                     {"value", value}});
  }
  Json scene{{"title", landscape.title},
             {"camera",
              {{"east", s.cam_east},
               {"north", s.cam_north},
               {"height", s.cam_height},
               {"direction", s.cam_direction},
               {"tilt", s.cam_tilt}}},
             {"knobs", knobs}};
  if (landscape.map) scene["map"] = map_json(*landscape.map);
  return scene;
}

void fill(std::string& page, const std::string& place, const std::string& text) {
  const std::size_t at = page.find(place);
  if (at == std::string::npos)
    throw Error(ErrorKind::internal, "page.html has no place for " + place);
  page.replace(at, place.size(), text);
}

/// What stands in a page's text, not in its marks.
std::string escaped(const std::string& text) {
  std::string out;
  for (const char c : text) {
    if (c == '&')
      out += "&amp;";
    else if (c == '<')
      out += "&lt;";
    else
      out += c;
  }
  return out;
}

/// In a script nothing may look like its end.
std::string in_script(std::string json) {
  for (std::size_t at = json.find("</"); at != std::string::npos; at = json.find("</", at + 3))
    json.replace(at, 2, "<\\/");
  return json;
}

}  // namespace

std::string landscape_page(const Landscape& landscape) {
  std::vector<std::string> uniforms;
  for (const Slider& slider : sliders)
    if (is_uniform(slider)) uniforms.emplace_back(slider.knob);
  Landscape still = landscape;
  still.settings.day_speed = 0;  // the page turns the sun
  const std::string body =
      "#version 300 es\nprecision highp float;\nprecision highp int;\n\n"
      "uniform vec3 iResolution;\nuniform float iTime;\nuniform vec4 iMouse;\n"
      "out vec4 shown;\n\n#define LANDSCAPE_CAMERA\n" +
      stripped_shader(flatten_shader(landscape_body(still, uniforms)), "mainImage") +
      "\nvoid main() {\n  mainImage(shown, gl_FragCoord.xy);\n}\n";
  std::string page(page_template());
  fill(page, "%%TITLE%%", escaped(landscape.title));
  fill(page, "%%FRAGMENT%%", body);
  fill(page, "%%SCENE%%", in_script(scene_json(landscape).dump()));
  return page;
}

}  // namespace wold
