#include "raster/ground_textures.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <bit>
#include <cmath>
#include <cstdint>

namespace wold {

namespace {

// Features of the noises (render/ground.cpp), m, and rows of the table of octaves, as
// "render/ground_heights.glsl" has them.
constexpr double edge_size = 45;
constexpr double grain_size = 1.7;
constexpr double wood_size = 420;
constexpr double crown_size = 9;
constexpr double ripple_size = 1.2;
constexpr int texture_row = 36;
constexpr int texture_octaves = 5;
constexpr int octave_rows = texture_row + texture_octaves * (4 + most_drawn_covers);

const TextureSettings exact_floats{.format = PixelFormat::r32f, .filter = TextureFilter::nearest};

/// Heights with one sample more on each side, in a straight line from the last two.
Grid<float> padded(const Grid<float>& inner) {
  const int w = inner.width();
  const int h = inner.height();
  const auto beyond = [](float edge, float next) { return 2 * edge - next; };
  Grid<float> out(w + 2, h + 2);
  for (int j = 0; j < h; ++j) {
    const auto from = inner.row(j);
    const auto to = out.row(j + 1);
    std::copy(from.begin(), from.end(), to.begin() + 1);
    to.front() = beyond(inner(0, j), inner.clamped(1, j));
    to.back() = beyond(inner(w - 1, j), inner.clamped(w - 2, j));
  }
  for (int i = 0; i < w + 2; ++i) {
    out(i, 0) = beyond(out(i, 1), out(i, std::min(2, h)));
    out(i, h + 1) = beyond(out(i, h), out(i, std::max(1, h - 1)));
  }
  return out;
}

void put(GpuTexture& texture, const Grid<float>& values) {
  if (!texture || texture.width() != values.width() || texture.height() != values.height())
    texture = GpuTexture(values.width(), values.height(), exact_floats);
  texture.upload(values.values());
}

/// A texture that is read nowhere.
void put_nothing(GpuTexture& texture) {
  put(texture, Grid<float>(1, 1, 0.0F));
}

/// A lattice place as the cell, modulo 2^32, and what is left.
std::uint32_t cell_of(double x) {
  return static_cast<std::uint32_t>(static_cast<std::int64_t>(std::floor(x)));
}
std::uint32_t fraction_bits(double x) {
  return std::bit_cast<std::uint32_t>(static_cast<float>(x - std::floor(x)));
}

/// The rows of the table of octaves, eight numbers each.
class OctaveTable {
 public:
  OctaveTable() : bits_(std::size_t{octave_rows} * 8, 0) {}

  /// Puts a noise where the anchor lies at `p`, in its lattice units.
  void add(int row, const FractalSampler& noise, DVec3 p, bool plane) {
    for (int i = 0; i < noise.parameters().octaves; ++i) {
      const FractalSampler::Octave& o = noise.octave(i);
      const DVec3 at = plane ? DVec3(o.matrix2 * DVec2(p) + o.shift2, 0) : o.matrix3 * p + o.shift3;
      std::uint32_t* out = &bits_[static_cast<std::size_t>(row + i) * 8];
      out[0] = o.key;
      for (int c = 0; c < 3; ++c) {
        out[1 + c] = cell_of(at[c]);
        out[4 + c] = fraction_bits(at[c]);
      }
      out[7] = std::bit_cast<std::uint32_t>(o.amplitude);
    }
  }
  void add_plane(int row, const FractalSampler& noise, DVec2 anchor, double size) {
    add(row, noise, DVec3(anchor / size, 0), true);
  }
  void add_texture(int which, const TwoColorTexture& texture, DVec2 anchor) {
    const auto size = static_cast<double>(texture.colors().feature_size);
    add(texture_row + texture_octaves * which, texture.noise(), DVec3(anchor / size, 0), false);
  }

  std::span<const std::uint32_t> bits() const { return bits_; }

 private:
  std::vector<std::uint32_t> bits_;
};

Vec4 bands(Range a, Range b) {
  return {a.low, a.high, b.low, b.high};
}

int drawn_covers(const Ground& ground) {
  return std::min(most_drawn_covers, static_cast<int>(ground.dressing().covers.size()));
}

}  // namespace

GroundTextures::GroundTextures(const Ground& ground)
    : ground_(&ground),
      octaves_(2, octave_rows,
               {.format = PixelFormat::rgba32ui, .filter = TextureFilter::nearest}) {
  update(ground);
}

void GroundTextures::update(const Ground& ground) {
  ground_ = &ground;
  put(field_, padded(ground.field().height));
  const GroundDressing& d = ground.dressing();
  const bool around = !ground.surroundings().height.empty();
  around ? put(around_, padded(ground.surroundings().height)) : put_nothing(around_);
  d.inner_water.empty() ? put_nothing(inner_water_)
                        : put(inner_water_, d.inner_water.levels().height);
  d.outer_water.empty() ? put_nothing(outer_water_)
                        : put(outer_water_, d.outer_water.levels().height);
  inner_covers_ = cover_maps(true);
  outer_covers_ = cover_maps(false);
  const DVec2 anchor = anchor_;
  anchor_ = DVec2(std::nan(""));
  move_anchor(anchor);
}

GroundTextures::Maps GroundTextures::cover_maps(bool inner) const {
  const int count = drawn_covers(*ground_);
  const std::vector<CoverLayer>& covers = ground_->dressing().covers;
  const auto map_of = [&](int k) -> const Heightfield& {
    const CoverLayer& cover = covers[static_cast<std::size_t>(k)];
    return inner ? cover.inner() : cover.outer();
  };
  Maps maps;
  const Heightfield* largest = nullptr;
  for (int k = 0; k < count; ++k) {
    const Heightfield& map = map_of(k);
    maps.present.push_back(!map.height.empty());
    if (largest == nullptr || map.height.size() > largest->height.size()) largest = &map;
  }
  const bool none = largest == nullptr || largest->height.empty();
  const int width = none ? 1 : largest->height.width();
  const int height = none ? 1 : largest->height.height();
  TextureSettings settings = exact_floats;
  settings.layers = none ? 1 : count;
  maps.texture = GpuTexture(width, height, settings);
  if (none) return maps;
  maps.grid = {{width, height}, largest->origin, largest->cell};
  for (int k = 0; k < count; ++k) {
    const Heightfield& map = map_of(k);
    if (map.height.empty()) continue;
    if (map.height.same_shape(largest->height)) {
      maps.texture.upload(map.height.values(), k);
      continue;
    }
    Grid<float> same(width, height);
    for (int j = 0; j < height; ++j)
      for (int i = 0; i < width; ++i)
        same(i, j) = height_at(map, largest->origin + largest->cell * DVec2(i, j));
    maps.texture.upload(same.values(), k);
  }
  return maps;
}

void GroundTextures::move_anchor(DVec2 anchor) {
  if (anchor == anchor_) return;
  anchor_ = anchor;
  const Ground::Noises n = ground_->noises();
  OctaveTable table;
  table.add_plane(0, n.detail, anchor, static_cast<double>(ground_->widest_detail()));
  table.add_plane(9, n.edges, anchor, edge_size);
  table.add_plane(14, n.grains, anchor, grain_size);
  table.add_plane(18, n.patches, anchor, static_cast<double>(ground_->material().patch_size));
  table.add_plane(23, n.woods, anchor, wood_size);
  table.add_plane(29, n.crowns, anchor, crown_size);
  table.add_plane(32, n.ripples, anchor, ripple_size);
  int which = 0;
  for (const TwoColorTexture* t : {&n.soil, &n.grass, &n.rock, &n.canopy})
    table.add_texture(which++, *t, anchor);
  for (int k = 0; k < drawn_covers(*ground_); ++k)
    table.add_texture(which++, ground_->dressing().covers[static_cast<std::size_t>(k)].texture(),
                      anchor);
  octaves_.upload(table.bits());
}

void GroundTextures::set_grid(const GpuProgram& program, const char* name,
                              const Placed& grid) const {
  const DVec2 at = (anchor_ - grid.origin) / grid.cell;
  const DVec2 cell = glm::floor(at);
  const auto member = [name](const char* part) { return fmt::format("{}.{}", name, part); };
  program.set(member("size").c_str(), grid.size);
  program.set(member("cell").c_str(), IVec2(cell));
  program.set(member("fraction").c_str(), Vec2(at - cell));
  program.set(member("per_metre").c_str(), static_cast<float>(1 / grid.cell));
}

void GroundTextures::set_covers(const GpuProgram& program) const {
  const int count = drawn_covers(*ground_);
  std::vector<Vec4> ranges;
  std::vector<Vec4> kinds;
  std::vector<Vec4> looks;
  std::vector<Vec3> colors1;
  std::vector<Vec3> colors2;
  for (int k = 0; k < count; ++k) {
    const auto at = static_cast<std::size_t>(k);
    const GroundCover& c = ground_->dressing().covers[at].settings();
    ranges.emplace_back(c.range.low, c.range.high, c.feather, c.edge_noise * c.feather);
    kinds.emplace_back(c.detail, c.over_snow ? 1 : 0, inner_covers_.present[at] ? 1 : 0,
                       outer_covers_.present[at] ? 1 : 0);
    looks.emplace_back(c.feature_size, c.contrast, c.roughness, c.opacity);
    colors1.push_back(c.color1);
    colors2.push_back(c.color2);
  }
  program.set("cover_count", count);
  if (count == 0) return;
  program.set("cover_ranges", std::span<const Vec4>(ranges));
  program.set("cover_kinds", std::span<const Vec4>(kinds));
  program.set("cover_looks", std::span<const Vec4>(looks));
  program.set("cover_colors1", std::span<const Vec3>(colors1));
  program.set("cover_colors2", std::span<const Vec3>(colors2));
}

void GroundTextures::set_material(const GpuProgram& program) const {
  const GroundMaterial& m = ground_->material();
  const WaterSettings& water = ground_->dressing().water;
  const Ground::Noises n = ground_->noises();
  std::vector<Vec3> colors1;
  std::vector<Vec3> colors2;
  std::vector<Vec3> looks;
  for (const TwoColorTexture* t : {&n.soil, &n.grass, &n.rock, &n.canopy}) {
    const TwoColors& c = t->colors();
    colors1.push_back(c.color1);
    colors2.push_back(c.color2);
    looks.emplace_back(c.feature_size, c.contrast, t->stretch());
  }
  program.set("ground_colors1", std::span<const Vec3>(colors1));
  program.set("ground_colors2", std::span<const Vec3>(colors2));
  program.set("ground_textures", std::span<const Vec3>(looks));
  program.set("ground_shares", Vec4(m.grass_cover, m.patch_size, m.distant_forest, m.detail));
  program.set("ground_slopes", bands(m.rock_slope, m.snow_slope));
  program.set("height_bands", bands(m.rock_height, m.snow_height));
  program.set("snow_color", m.snow_color);
  program.set("widest_detail", ground_->widest_detail());
  program.set("water_body", Vec4(water.color, water.clarity));
  program.set("water_coat", Vec2(water.roughness, water.ripples));
}

void GroundTextures::apply(const GpuProgram& program) const {
  program.use();
  const std::array<std::pair<const char*, const GpuTexture*>, 7> textures{
      {{"field_heights", &field_},
       {"around_heights", &around_},
       {"inner_water", &inner_water_},
       {"outer_water", &outer_water_},
       {"inner_covers", &inner_covers_.texture},
       {"outer_covers", &outer_covers_.texture},
       {"ground_octaves", &octaves_}}};
  for (int unit = 0; unit < static_cast<int>(textures.size()); ++unit) {
    const auto& [name, texture] = textures[static_cast<std::size_t>(unit)];
    program.set(name, unit);
    texture->bind(unit);
  }
  const auto placed = [](const Heightfield& f) {
    return Placed{{f.height.width(), f.height.height()}, f.origin, f.cell};
  };
  const Heightfield& field = ground_->field();
  const bool around = !ground_->surroundings().height.empty();
  set_grid(program, "field_grid", placed(field));
  set_grid(program, "around_grid", around ? placed(ground_->surroundings()) : Placed{});
  set_grid(program, "inner_cover_grid", inner_covers_.grid);
  set_grid(program, "outer_cover_grid", outer_covers_.grid);
  program.set("has_around", around);
  program.set("field_low", Vec2(field.origin - anchor_));
  program.set("field_high", Vec2(field.origin + field.size() - anchor_));
  program.set("has_inner_water", !ground_->dressing().inner_water.empty());
  program.set("has_outer_water", !ground_->dressing().outer_water.empty());
  program.set("ground_anchor", Vec2(anchor_));
  program.set("ground_high", Vec2(ground_->high() - anchor_));
  set_covers(program);
  set_material(program);
}

}  // namespace wold
