#include "render/ground.hpp"

#include <algorithm>
#include <cmath>

#include "base/hash.hpp"
#include "base/smoothstep.hpp"
#include "noise/fractal.hpp"

namespace wold {

namespace {

// Soil and stone: features from this size down, m; an octave of size s has height detail_ratio · s.
constexpr float largest_detail = 6;
constexpr float detail_ratio_soil = 0.035F;
constexpr float detail_ratio_rock = 0.11F;
// Sizes of the noises that break up the edges of covers, m.
constexpr double edge_size = 45;
constexpr double grain_size = 1.7;
// Distant forest: its woods, and the crowns that are its surface, m.
constexpr double wood_size = 420;
constexpr float crown_size = 9;
constexpr float crown_height = 6;
constexpr float wood_height = 11;
constexpr float steepest_wood = 42;  // degrees
constexpr double ripple_size = 1.2;  // m
constexpr float least_footprint = 0.004F;

float slope_degrees(Vec2 gradient) {
  return degrees(std::atan(glm::length(gradient)));
}

Fractal texture(int octaves, float hurst = 0.75F) {
  return {.octaves = octaves, .hurst = hurst};
}

std::uint32_t ground_seed(std::uint64_t seed, int which) {
  return static_cast<std::uint32_t>(
      random_bits(seed, hash_text(std::string_view("ground")), which));
}

}  // namespace

Description<GroundMaterial> describe(const GroundMaterial&) {
  using G = GroundMaterial;
  const Limits color{.min = 0, .max = 1};
  const Limits height{.unit = "m", .min = -20000, .max = 20000};
  const Limits slope{.unit = "degrees", .min = 0, .max = 90};
  return Description<G>("ground", "Colours of the ground and where they lie.")
      .add("soil_color1", &G::soil_color1, color, "Darker soil, linear Rec. 709 reflectance.")
      .add("soil_color2", &G::soil_color2, color, "Lighter soil.")
      .add("grass_color1", &G::grass_color1, color, "Darker grass and moss.")
      .add("grass_color2", &G::grass_color2, color, "Lighter grass and moss.")
      .add("rock_color1", &G::rock_color1, color, "Darker rock.")
      .add("rock_color2", &G::rock_color2, color, "Lighter rock.")
      .add("snow_color", &G::snow_color, color, "Snow.")
      .add("grass_cover", &G::grass_cover, {.min = 0, .max = 1},
           "Share of the soil under grass and moss.")
      .add("patch_size", &G::patch_size, {.unit = "m", .min = 0.1, .max = 1e4},
           "Size of the patches of grass on soil.")
      .add("rock_feature_size", &G::rock_feature_size, {.unit = "m", .min = 0.1, .max = 1e4},
           "Size of the patches of the two rocks.")
      .add("rock_slope", &G::rock_slope, slope, "Slope where rock begins, and where all is rock.")
      .add("rock_height", &G::rock_height, height,
           "Height where rock begins, and where all is rock.")
      .add("snow_height", &G::snow_height, height,
           "Height where snow begins, and where all is snow.")
      .add("snow_slope", &G::snow_slope, slope,
           "Slope where snow begins to slide off, and where none stays.")
      .add("distant_forest", &G::distant_forest, {.min = 0, .max = 1},
           "Share of the surroundings under trees, if the scene plants any.")
      .add("canopy_color1", &G::canopy_color1, color, "Darker crowns of the distant forest.")
      .add("canopy_color2", &G::canopy_color2, color, "Lighter crowns of the distant forest.")
      .add("detail", &G::detail, {.min = 0, .max = 5},
           "Height of small features of soil and stone; 1 is natural, 0 smooth.");
}

Ground::Ground(Heightfield field, Heightfield surroundings, GroundMaterial material,
               std::uint64_t seed, GroundDressing dressing)
    : field_(std::move(field)),
      surroundings_(std::move(surroundings)),
      material_(material),
      dressing_(std::move(dressing)),
      widest_detail_(std::min(largest_detail, static_cast<float>(field_.cell) * 2)),
      detail_(texture(9, 0.95F), ground_seed(seed, 0)),
      edges_(texture(5), ground_seed(seed, 1)),
      grains_(texture(4), ground_seed(seed, 2)),
      patches_(texture(5), ground_seed(seed, 3)),
      woods_(texture(6, 0.8F), ground_seed(seed, 7)),
      crowns_(Fractal{.kind = FractalKind::turbulence, .octaves = 3, .hurst = 1},
              ground_seed(seed, 8)),
      ripples_(texture(4, 0.6F), ground_seed(seed, 10)),
      soil_({material.soil_color1, material.soil_color2, 0.35F, 1.1F}, ground_seed(seed, 4)),
      grass_({material.grass_color1, material.grass_color2, 0.8F, 0.9F}, ground_seed(seed, 5)),
      // Beds of rock: patches are wide and low.
      rock_({material.rock_color1, material.rock_color2, material.rock_feature_size, 0.9F},
            ground_seed(seed, 6), 0.5F),
      canopy_({material.canopy_color1, material.canopy_color2, 22, 1.3F}, ground_seed(seed, 9)) {
  const Heightfield& widest = surroundings_.height.empty() ? field_ : surroundings_;
  low_ = widest.origin;
  high_ = widest.origin + widest.size();
  heights_ = {std::numeric_limits<float>::max(), std::numeric_limits<float>::lowest()};
  for (const Heightfield* f : {&field_, &surroundings_}) {
    for (const float h : f->height.values()) {
      heights_.low = std::min(heights_.low, h);
      heights_.high = std::max(heights_.high, h);
    }
  }
}

bool Ground::inside_field(DVec2 place) const {
  return surroundings_.height.empty() || field_.contains(place);
}

float border_lift(const Heightfield& field, const Heightfield& surroundings, DVec2 place) {
  const DVec2 low = field.origin;
  const DVec2 high = low + field.size();
  const DVec2 border = glm::clamp(place, low, high);
  const float step = ground_at(field, border).height - ground_at(surroundings, border).height;
  const auto distance = static_cast<float>(glm::distance(border, place));
  const auto width = static_cast<float>(0.5 * std::max(high.x - low.x, high.y - low.y));
  return step * (1 - smoothstep(0, width, distance));
}

GroundSample Ground::base(DVec2 place) const {
  if (inside_field(place))
    return ground_at(field_, glm::clamp(place, field_.origin, field_.origin + field_.size()));
  // The lift's change along the border is small beside the slope of the surroundings and is left
  // out of the gradient.
  GroundSample s = ground_at(surroundings_, place);
  s.height += lift(place);
  return s;
}

float Ground::canopy_share(DVec2 place, float slope) const {
  if (material_.distant_forest <= 0 || surroundings_.height.empty() || field_.contains(place))
    return 0;
  const float wood = woods_(place / wood_size).value;
  const float threshold = 0.5F - material_.distant_forest;
  const float gentle = 1 - smoothstep(steepest_wood - 8, steepest_wood, slope);
  return gentle * smoothstep(threshold - 0.05F, threshold + 0.05F, wood);
}

float Ground::detail_share(DVec2 place, float edge_noise) const {
  float share = 1;
  for (const CoverLayer& cover : dressing_.covers)
    if (cover.settings().detail < 1)
      share *= 1 - cover.share(place, edge_noise) * (1 - cover.settings().detail);
  return share;
}

GroundSample Ground::with_detail(GroundSample s, DVec2 place, float spacing) const {
  const float canopy = canopy_share(place, slope_degrees(s.gradient));
  if (canopy > 0) {
    const Sample2 n = crowns_(place / static_cast<double>(crown_size), spacing / crown_size);
    s.height += canopy * (wood_height - crown_height * n.value);
    s.gradient -= canopy * crown_height / crown_size * n.derivative;
    return s;
  }
  if (material_.detail <= 0 || spacing > widest_detail_) return s;
  const float rock =
      smoothstep(material_.rock_slope.low, material_.rock_slope.high, slope_degrees(s.gradient));
  const Sample2 n = detail_(place / static_cast<double>(widest_detail_), spacing / widest_detail_);
  const float ratio = material_.detail * detail_share(place, 0) *
                      std::lerp(detail_ratio_soil, detail_ratio_rock, rock);
  s.height += ratio * widest_detail_ * n.value;
  s.gradient += ratio * n.derivative;
  return s;
}

std::optional<float> Ground::water_level(DVec2 place) const {
  if (inside_field(place)) return dressing_.inner_water.level_at(place);
  const std::optional<float> level = dressing_.outer_water.level_at(place);
  return level ? std::optional(*level + lift(place)) : std::nullopt;
}

float Ground::water_depth(DVec2 place) const {
  const std::optional<float> level = water_level(place);
  return level ? std::max(0.0F, *level - base(place).height) : 0.0F;
}

GroundSample Ground::detailed(DVec2 place, float spacing) const {
  const GroundSample land = with_detail(base(place), place, spacing);
  const std::optional<float> level = water_level(place);
  return level && *level > land.height ? GroundSample{*level, Vec2(0)} : land;
}

Vec3 Ground::water_normal(DVec2 place, float footprint) const {
  const Sample2 n = ripples_(place / ripple_size, footprint / static_cast<float>(ripple_size));
  return normal_of(dressing_.water.ripples * n.derivative);
}

Ground::Cover Ground::cover(DVec2 place, float footprint, const GroundSample& base,
                            const GroundSample& detailed) const {
  const GroundMaterial& m = material_;
  // One noise breaks up the edges of all covers, so that they do not follow contour lines.
  Cover c;
  c.canopy = canopy_share(place, slope_degrees(base.gradient));
  c.jitter = edges_(place / edge_size, footprint / static_cast<float>(edge_size)).value;
  c.grain = grains_(place / grain_size, footprint / static_cast<float>(grain_size)).value;
  const float base_slope = slope_degrees(base.gradient) + 6 * c.jitter;
  const float small_slope = slope_degrees(detailed.gradient) + 4 * c.grain;
  const float height = base.height + 60 * c.jitter;
  const float steep =
      smoothstep(m.rock_slope.low, m.rock_slope.high, std::max(base_slope, 0.75F * small_slope));
  c.rock = std::max(steep, smoothstep(m.rock_height.low, m.rock_height.high, height));
  c.snow = smoothstep(m.snow_height.low, m.snow_height.high, height) *
           (1 - smoothstep(m.snow_slope.low, m.snow_slope.high, 0.5F * (base_slope + small_slope)));
  return c;
}

Vec3 Ground::soil_and_grass(Vec3 p, float footprint, const Cover& c) const {
  const auto size = static_cast<double>(material_.patch_size);
  const float patch = patches_(DVec2(p.x, p.y) / size, footprint / material_.patch_size).value;
  // A share c of a value spread evenly over [-0.5, 0.5] lies above 0.5 - c.
  const float threshold = 0.5F - material_.grass_cover;
  const float grassy = smoothstep(threshold - 0.12F, threshold + 0.12F, patch + 0.35F * c.grain);
  Vec3 color(0);
  if (grassy < 1) color += (1 - grassy) * soil_.at(p, footprint);
  if (grassy > 0) color += grassy * grass_.at(p, footprint);
  return color * (1 + 0.25F * c.jitter);
}

Vec3 Ground::bare_ground(Vec3 p, float footprint, const Cover& c) const {
  Vec3 color(0);
  if (c.rock < 1) color += (1 - c.rock) * soil_and_grass(p, footprint, c);
  if (c.rock > 0) color += c.rock * (1 + 0.3F * c.grain) * rock_.at(p, footprint);
  if (c.canopy > 0) color = glm::mix(color, canopy_.at(p, footprint), c.canopy);
  return color;
}

GroundSurface Ground::land(DVec2 place, float width, const GroundSample& b,
                           const GroundSample& s) const {
  const Vec3 p(Vec2(place), s.height);
  const Cover c = cover(place, width, b, s);
  GroundSurface out;
  out.normal = normal_of(s.gradient);
  Vec3 color = c.snow < 1 ? bare_ground(p, width, c) : Vec3(0);
  const auto lay = [&](bool over_snow) {
    for (const CoverLayer& layer : dressing_.covers) {
      if (layer.settings().over_snow != over_snow) continue;
      const float share = layer.share(place, c.jitter + 0.5F * c.grain);
      if (share <= 0) continue;
      color = glm::mix(color, layer.color(p, width), share);
      out.roughness = share > 0.5F ? layer.settings().roughness : out.roughness;
    }
  };
  lay(false);
  color = glm::mix(color, material_.snow_color, c.snow);
  if (c.snow > 0.5F) out.roughness = 0;
  lay(true);
  // Noise may brighten what is bright already beyond what a surface can reflect.
  out.reflectance = glm::clamp(color, 0.0F, 0.95F);
  return out;
}

GroundSurface Ground::surface(DVec2 place, float footprint) const {
  const float width = std::max(footprint, least_footprint);
  const GroundSample b = base(place);
  const GroundSample s = with_detail(b, place, width);
  GroundSurface out = land(place, width, b, s);
  const std::optional<float> level = water_level(place);
  if (!level || *level <= s.height) return out;
  // Light goes down to the bed and up again.
  const float shown = std::exp(-(*level - s.height) / dressing_.water.clarity);
  out.reflectance = glm::mix(dressing_.water.color, out.reflectance, shown);
  out.roughness = dressing_.water.roughness;
  out.normal = water_normal(place, width);
  return out;
}

}  // namespace wold
