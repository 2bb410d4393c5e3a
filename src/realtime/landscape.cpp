#include "realtime/landscape.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <filesystem>

#include "realtime/land_function.hpp"
#include "realtime/light_tables.hpp"
#include "realtime/wood_kinds.hpp"
#include "scene/build.hpp"
#include "scene/dressing.hpp"

namespace wold {

namespace {

constexpr int survey_samples = 257;
constexpr float fair_coverage = 0.32F;

std::string num(double value) {
  return glsl_number(value);
}
std::string vec3_text(Vec3 v) {
  return fmt::format("vec3({}, {}, {})", num(double{v.x}), num(double{v.y}), num(double{v.z}));
}
std::string range_text(const Range& r) {
  return fmt::format("vec2({}, {})", num(double{r.low}), num(double{r.high}));
}

std::vector<TerrainStep> function_steps(const Scene& scene, const LandFunction& land) {
  std::vector<TerrainStep> steps;
  for (const TerrainStep& step : scene.steps) {
    const std::string& name = step.settings.name.empty() ? step.op : step.settings.name;
    const bool out =
        std::find(land.left_out.begin(), land.left_out.end(), name) != land.left_out.end();
    if (!out) steps.push_back(step);
  }
  return steps;
}

/// Heights that 1 % and 99 % of a land lie below, and all of it.
struct Relief {
  Range most;
  Range all;
};

Relief relief_of(const Grid<float>& height) {
  std::vector<float> sorted(height.values().begin(), height.values().end());
  std::sort(sorted.begin(), sorted.end());
  const std::size_t tail = sorted.size() / 100;
  return {{sorted[tail], sorted[sorted.size() - 1 - tail]}, {sorted.front(), sorted.back()}};
}

/// The steps over `factor` times the terrain, coarsely.
Relief survey(const Scene& scene, const std::vector<TerrainStep>& all, double factor,
              Progress& progress) {
  std::vector<TerrainStep> steps = all;
  for (TerrainStep& step : steps) step.settings.cell = 0;
  const TerrainDomain domain = domain_of(scene.terrain);
  const double size = factor * std::max(domain.size.x, domain.size.y);
  TerrainWindow window;
  window.width = window.height = survey_samples;
  window.cell = size / (survey_samples - 1);
  window.origin = domain.center() - DVec2(0.5 * size);
  const TerrainResult result = evaluate(scene.terrain, window, steps, scene_operators(),
                                        scene.header.seed, scene.folder, progress);
  return relief_of(result.field.height);
}

TerrainStep made_step(const char* op, const char* name,
                      std::initializer_list<std::pair<const char*, double>> values) {
  TerrainStep step = make_step(scene_operators(), op);
  step.settings.name = name;
  for (const auto& [key, value] : values) assign(step, key, Value{value});
  return step;
}

/// Ranges in the place of steps that raise mountains but cannot be told by a function: about as
/// high as the finished land is, with arêtes and gullies where they are mountains. Returns what was
/// done, or "".
std::string stand_in(const Scene& scene, std::vector<TerrainStep>& steps, Progress& progress) {
  const Relief finished = survey(scene, scene.steps, 1, progress);
  const Relief told = survey(scene, steps, 1, progress);
  const double missing =
      double{(finished.most.high - finished.most.low) - (told.most.high - told.most.low)};
  if (!(missing > 0.3 * double{finished.most.high - finished.most.low})) return "";
  // Between the first and the last hundredth of the land ridges span two thirds of their height.
  const double height = 1.5 * missing;
  const bool mountains = missing > 500;
  const double feature = (mountains ? 4 : 9) * height;
  const double base = double{finished.most.low - told.most.low} - 0.1 * height;
  TerrainStep ranges =
      made_step("ridged", "ranges",
                {{"height", height}, {"base", base}, {"feature_size", feature}, {"hurst", 1.1}});
  assign(ranges, "octaves", Value{std::int64_t{5}});
  steps.push_back(std::move(ranges));
  steps.push_back(
      made_step("warp", "bends", {{"distance", 0.05 * feature}, {"feature_size", 0.5 * feature}}));
  if (mountains)
    steps.push_back(
        made_step("ridged", "aretes",
                  {{"height", 0.13 * height}, {"feature_size", 0.12 * feature}, {"hurst", 0.95}}));
  return fmt::format("{} {:.0f} m high stand in for them", mountains ? "mountains" : "hills",
                     missing);
}

/// Stops that make up for land darker than most, as a photographer would.
float exposure_of(const Scene& scene, const Relief& relief, bool trees) {
  const GroundMaterial& g = scene.ground;
  const auto grey = [](Vec3 a, Vec3 b) {
    return 0.5F * glm::dot(a + b, Vec3(0.2126F, 0.7152F, 0.0722F));
  };
  const float middle = 0.5F * (relief.most.low + relief.most.high);
  float level = glm::mix(grey(g.soil_color1, g.soil_color2), grey(g.grass_color1, g.grass_color2),
                         g.grass_cover);
  if (trees) level = glm::mix(level, grey(g.canopy_color1, g.canopy_color2), 0.6F);
  if (middle > g.rock_height.low) level = grey(g.rock_color1, g.rock_color2);
  if (middle > g.snow_height.low) level = glm::mix(level, grey(g.snow_color, g.snow_color), 0.5F);
  return std::clamp(0.6F * std::log2(0.2F / std::max(level, 0.01F)), 0.0F, 1.0F);
}

bool has_trees(const Scene& scene) {
  return std::any_of(scene.scatter.begin(), scene.scatter.end(),
                     [&](const ScatterSettings& s) { return plants_trees(scene, s); });
}

/// Nobody wants to read 135.03426.
float rounded(float value, float step) {
  return step * std::round(value / step);
}

void set_camera(const Scene& scene, const std::string& name, const Relief& relief, Landscape& out) {
  const CameraSettings& camera = scene.camera(name);
  LandscapeSettings& s = out.settings;
  const DVec2 middle = domain_of(scene.terrain).center();
  if (camera.position.size() >= 2) {
    s.cam_east = static_cast<float>(camera.position[0] - middle.x);
    s.cam_north = static_cast<float>(camera.position[1] - middle.y);
  }
  const float height = relief.most.high - relief.most.low;
  s.cam_height = std::clamp(std::max(camera.look_height, 0.14F * height), 40.0F, 2000.0F);
  s.cam_height = rounded(s.cam_height, 5);
  s.cam_speed = std::clamp(0.35F * s.cam_height, 15.0F, 250.0F);
  s.cam_speed = rounded(s.cam_speed, 5);
  // Without a direction: with the sun at the side, where shapes show best.
  s.cam_direction = std::remainder(s.sun_azimuth + 115.0F, 360.0F);
  if (camera.look_direction.size() == 3) {
    const double azimuth = std::atan2(camera.look_direction[0], camera.look_direction[1]);
    s.cam_direction = static_cast<float>(degrees(azimuth));
  }
  s.cam_direction = rounded(s.cam_direction, 0.1F);
  s.field_of_view = camera.field_of_view;
}

void set_sky(const Scene& scene, const Relief& relief, Landscape& out) {
  LandscapeSettings& s = out.settings;
  SkySettings clear = scene.sky;
  clear.clouds.coverage = 0;
  const Vec3 sun = Sky(clear).sun_direction();
  s.sun_elevation = degrees(std::asin(std::clamp(sun.z, -1.0F, 1.0F)));
  s.sun_azimuth = degrees(std::atan2(sun.x, sun.y));
  if (s.sun_azimuth < 0) s.sun_azimuth += 360;
  s.sun_elevation = rounded(s.sun_elevation, 0.1F);
  s.sun_azimuth = rounded(s.sun_azimuth, 0.1F);
  const Clouds& c = scene.sky.clouds;
  const bool has_clouds = c.coverage > 0;
  s.cloud_coverage = has_clouds ? c.coverage : fair_coverage;
  s.clouds_height = has_clouds ? c.height : rounded(std::max(1500.0F, relief.all.high + 900), 50);
  s.clouds_thickness = c.thickness;
  s.cloud_size = c.feature_size;
  s.cloud_scattering = c.scattering;
  s.cloud_absorption = c.absorption;
  s.cloud_forward = c.forward;
  s.cloud_back = c.back;
  s.cloud_back_share = c.back_share;
}

std::string air_text(const Atmosphere& a) {
  return fmt::format("Atmosphere({}, {}, {}, {}, {}, {}, {}, {}, {}, {})", static_cast<int>(a.air),
                     num(a.air_height), vec3_text(a.aerosol_scattering), num(a.aerosol_height),
                     num(a.aerosol_albedo), num(a.aerosol_forward), num(a.ozone),
                     num(a.planet_radius), num(a.air_thickness), vec3_text(a.ground_albedo));
}

std::string kind_text(const CrownKind& kind) {
  // Crowns reach no further than into the next cell of the shader's trees.
  constexpr float widest = 5;
  const float slenderness = std::min(kind.slenderness, widest / kind.height.high);
  return vec3_text({kind.height.low, kind.height.high, slenderness});
}

void add_trees(const WoodKinds& kinds, Landscape& out) {
  out.values.push_back(
      {"CONIFERS", num(kinds.pointed.share), "share of trees with pointed crowns"});
  out.values.push_back(
      {"CONIFER_SIZE", kind_text(kinds.pointed), "height from, to (m); crown's radius over it"});
  out.values.push_back({"BROADLEAF_SIZE", kind_text(kinds.round)});
  const float highest = std::max(kinds.pointed.share > 0 ? kinds.pointed.height.high : 0.0F,
                                 kinds.round.share > 0 ? kinds.round.height.high : 0.0F);
  out.values.push_back({"TREE_TOP", num(highest), "m, none is higher"});
}

void set_values(const Scene& scene, const Relief& relief, float largest_feature, Landscape& out) {
  const GroundMaterial& g = scene.ground;
  const float margin = 0.06F * (relief.all.high - relief.all.low) + 20;
  const auto add = [&](const char* name, std::string value, const char* comment) {
    out.values.push_back({name, std::move(value), comment});
  };
  add("HIGHEST_LAND", num(relief.all.high + margin), "m, no land is higher");
  add("LARGEST_FEATURE", num(largest_feature), "m, distance of the largest hills");
  add("SOIL_COLOR_1", vec3_text(g.soil_color1), "colours: linear reflectance");
  add("SOIL_COLOR_2", vec3_text(g.soil_color2), "");
  add("GRASS_COLOR_1", vec3_text(g.grass_color1), "");
  add("GRASS_COLOR_2", vec3_text(g.grass_color2), "");
  add("ROCK_COLOR_1", vec3_text(g.rock_color1), "");
  add("ROCK_COLOR_2", vec3_text(g.rock_color2), "");
  add("SNOW_COLOR", vec3_text(g.snow_color), "");
  add("CANOPY_COLOR_1", vec3_text(g.canopy_color1), "trees from afar");
  add("CANOPY_COLOR_2", vec3_text(g.canopy_color2), "");
  add("GRASS_COVER", num(g.grass_cover), "share of the soil under grass");
  add("PATCH_SIZE", num(g.patch_size), "m, of grass on soil");
  add("ROCK_FEATURE_SIZE", num(g.rock_feature_size), "m");
  add("ROCK_SLOPE", range_text(g.rock_slope), "degrees: none below, all above");
  add("ROCK_HEIGHT", range_text(g.rock_height), "m: none below, all above");
  add("SNOW_HEIGHT", range_text(g.snow_height), "m: none below, all above");
  add("SNOW_SLOPE", range_text(g.snow_slope), "degrees: all below, none above");
  add("TREE_LINE", num(std::min({g.rock_height.low, g.snow_height.low, 1e5F})), "m");
  add("HAS_WOODS", has_trees(scene) ? "1" : "0", "");
  const bool has_water = out.map && out.map->water;
  add("HAS_WATER", has_water ? "1" : "0", "");
  add("HAS_COVERS", out.map && !out.map->covers.empty() ? "1" : "0", "");
  add("HAS_TREE_MAP", out.map && !out.map->trees.empty() ? "1" : "0", "");
  if (has_water) {
    add("WATER_COLOR", vec3_text(scene.water.color), "of deep water");
    add("WATER_CLARITY", num(scene.water.clarity), "m, where a third of the bed still shows");
    add("WATER_ROUGHNESS", num(scene.water.roughness), "of what it mirrors");
    add("WATER_RIPPLES", num(scene.water.ripples), "slope of small waves");
  }
  const Clouds& c = scene.sky.clouds;
  add("CLOUD_BILLOWS", num(c.billows), "depth of the notches in clouds");
  add("CLOUD_ORDERS", fmt::format("{}", c.orders), "how often clouds scatter light");
  add("CLOUD_SEED", fmt::format("{}u", c.seed), "where they stand");
  add("MAX_CLOUD_DISTANCE", "90000.0", "m");
  add("SUN_ILLUMINANCE", vec3_text(sun_outside(scene.sky)), "outside the air, klx");
  add("NIGHT_BRIGHTNESS", "1e-6", "kcd/m²");
  if (out.map) add("MAP_CELL", num(out.map->heights.cell), "m between samples of the height map");
}

/// Snow that a step laid on the land, where the ground's own snow lies higher than the land.
void add_snow(const Scene& scene, const Relief& relief, GroundMaterial& ground) {
  if (ground.snow_height.low < relief.all.high) return;
  for (const TerrainStep& step : scene.steps) {
    if (step.op != "snow") continue;
    const Value line = step.parameters.parameters().find("snow_line")->get(step.parameters.data());
    const auto height = static_cast<float>(std::get<double>(line));
    ground.snow_height = {height - 300, height + 300};
  }
}

}  // namespace

bool is_function(const Scene& scene) {
  return land_function(scene.terrain, scene.steps, scene_operators(), scene.header.seed)
      .left_out.empty();
}

Landscape landscape_of(const Scene& scene, const LandscapeOptions& options, Progress& progress) {
  Landscape out;
  out.title = std::filesystem::path(scene.source).filename().string();
  const OperatorList operators = scene_operators();
  LandFunction land = land_function(scene.terrain, scene.steps, operators, scene.header.seed);
  out.left_out = land.left_out;
  Relief relief;
  float largest = land.largest_feature;
  if (options.source == LandSource::map) {
    std::optional<TerrainResult> built;
    GroundDressing dressing;
    if (!options.finished) {
      built = build_terrain(scene, progress);
      dressing = dress_ground(scene, *built, {}, progress);
    }
    const FinishedLand land_there =
        options.finished ? *options.finished : FinishedLand{built->field, built->maps, dressing};
    const Heightfield& finished = land_there.field;
    out.left_out.clear();
    out.map = land_map(finished, land_there.dressing,
                       tree_density(scene, finished, land_there.maps, progress), options.map_size);
    out.land = "#include \"landscape/height_map.glsl\"\n";
    relief = relief_of(finished.height);
    largest = 0.25F * static_cast<float>(finished.size().x);
  } else {
    std::vector<TerrainStep> steps = function_steps(scene, land);
    if (!out.left_out.empty()) out.stand_in = stand_in(scene, steps, progress);
    if (!out.stand_in.empty())
      land = land_function(scene.terrain, steps, operators, scene.header.seed);
    largest = land.largest_feature;
    relief = survey(scene, steps, 4, progress);
    out.land = land.text;
  }
  Scene dressed = scene;
  // What a step laid on the land shows as a cover, where covers can be told.
  if (!out.map || out.map->covers.empty()) add_snow(scene, relief, dressed.ground);
  if (has_trees(scene)) out.settings.trees = out.map && !out.map->trees.empty() ? 1.0F : 0.62F;
  set_sky(scene, relief, out);
  out.settings.exposure = rounded(exposure_of(dressed, relief, out.settings.trees > 0), 0.05F);
  set_camera(scene, options.camera, relief, out);
  set_values(dressed, relief, largest, out);
  if (has_trees(scene)) add_trees(wood_kinds(scene, progress), out);
  out.tables = fmt::format("const Atmosphere AIR = {};\n{}", air_text(shader_air(scene.sky)),
                           light_tables(scene.sky));
  return out;
}

std::string landscape_body(const Landscape& landscape, const std::vector<std::string>& uniforms) {
  std::string text = "#define ZERO min(0, int(iTime))\n\n// Knobs\n\n" +
                     knob_text(landscape.settings, uniforms) + "\n// Values of the scene\n\n";
  for (const LandscapeValue& v : landscape.values)
    text += v.comment.empty()
                ? fmt::format("#define {} {}\n", v.name, v.value)
                : fmt::format("{:<44} // {}\n", fmt::format("#define {} {}", v.name, v.value),
                              v.comment);
  text += "\n// Noise\n\n#include \"landscape/patches.glsl\"\n#include \"noise/fractal3.glsl\"\n";
  text += "\n// The air and its light\n\n#include \"sky/air_march.glsl\"\n\n" + landscape.tables;
  text += "\n// Clouds\n\n#include \"sky/clouds.glsl\"\n";
  text += "\n// The land\n\n" + landscape.land;
  text += "\n// The picture\n\n#include \"landscape/landscape.glsl\"\n";
  return text;
}

}  // namespace wold
