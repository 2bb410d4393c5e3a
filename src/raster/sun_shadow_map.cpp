#include "raster/sun_shadow_map.hpp"

#include <algorithm>
#include <cmath>
#include <optional>
#include <vector>

#include "base/parallel.hpp"
#include "base/smoothstep.hpp"

namespace wold {

namespace {

constexpr float nowhere = -1e9F;

/// Not more than `most` samples on the longer side, of heights that `height` gives.
template <class Height>
Heightfield resampled(DVec2 low, DVec2 size, double cell, int most, const Height& height) {
  Heightfield out;
  out.cell = std::max(cell, std::max(size.x, size.y) / (most - 1));
  // The last sample lies on the border or beyond it.
  const auto samples = [&](double length) {
    return std::max(2, static_cast<int>(std::ceil(length / out.cell - 1e-6)) + 1);
  };
  out.origin = low;
  out.height = Grid<float>(samples(size.x), samples(size.y));
  parallel_for(0, out.height.height(), [&](int j) {
    for (int i = 0; i < out.height.width(); ++i)
      out.height(i, j) = height(glm::min(low + out.cell * DVec2(i, j), low + size));
  });
  return out;
}

using Layer = SunShadowMap::Layer;

/// Linear between samples; nothing outside.
std::optional<Vec2> edges_at(const Layer& layer, DVec2 place) {
  if (layer.edges.empty()) return std::nullopt;
  const DVec2 at = (place - layer.origin) / layer.cell;
  const IVec2 last(layer.edges.width() - 1, layer.edges.height() - 1);
  if (at.x < 0 || at.y < 0 || at.x > last.x || at.y > last.y) return std::nullopt;
  const IVec2 p = glm::min(IVec2(at), last - IVec2(1));
  const Vec2 t(at - DVec2(p));
  const Vec2 south = glm::mix(layer.edges(p.x, p.y), layer.edges(p.x + 1, p.y), t.x);
  const Vec2 north = glm::mix(layer.edges(p.x, p.y + 1), layer.edges(p.x + 1, p.y + 1), t.x);
  return glm::mix(south, north, t.y);
}

/// The sweep away from the sun, line by line of samples: by rows where the sun stands more north or
/// south, else by columns. It goes along rays that run with the light, a sample apart on each line;
/// what the land hides is carried along them exactly, and looked up between two of them.
class Sweep {
 public:
  Sweep(const Heightfield& land, Vec3 towards_sun, float radius, const Heightfield* beyond_land,
        const Layer* beyond)
      : land_(land), beyond_land_(beyond_land), beyond_(beyond) {
    const Vec2 across = glm::normalize(Vec2(towards_sun));
    rows_ = std::abs(across.y) >= std::abs(across.x);
    const float along = rows_ ? across.y : across.x;
    forward_ = along > 0 ? 1 : -1;
    drift_ = (rows_ ? across.x : across.y) / std::abs(along);
    const float distance = static_cast<float>(land.cell) / std::abs(along);
    const float elevation = std::asin(std::clamp(towards_sun.z, -1.0F, 1.0F));
    const float most = 0.5F * pi - 1e-3F;
    drop_ = distance * Vec2(std::tan(std::min(elevation + radius, most)),
                            std::tan(std::min(elevation - radius, most)));
  }

  Layer run() {
    const Grid<float>& grid = land_.height;
    out_ = {Grid<Vec2>(grid.width(), grid.height()), land_.origin, land_.cell};
    lines_ = rows_ ? grid.height() : grid.width();
    length_ = rows_ ? grid.width() : grid.height();
    const float drift = drift_ * static_cast<float>(lines_ - 1);
    first_ = static_cast<int>(std::floor(std::min(0.0F, drift))) - 1;
    const int last = length_ + static_cast<int>(std::ceil(std::max(0.0F, drift))) + 1;
    const int rays = last - first_ + 1;
    parallel_for(0, (rays + block - 1) / block, [&](int b) {
      carry(first_ + b * block, std::min(first_ + (b + 1) * block, last));
    });
    return std::move(out_);
  }

 private:
  static constexpr int block = 64;  // of rays, that go together

  /// Along the rays [begin, end], for the samples between two of them. Ray r crosses the n-th line
  /// at r - drift n.
  void carry(int begin, int end) {
    const auto count = static_cast<std::size_t>(end - begin) + 1;
    std::vector<Vec2> hidden(count, Vec2(nowhere));
    std::vector<Vec2> edges(count, Vec2(nowhere));
    for (int n = -1; n < lines_; ++n) {
      const int line = forward_ > 0 ? lines_ - 1 - n : n;
      const float shift = drift_ * static_cast<float>(n);
      // Those on the line's samples, and those that come onto them with the next line.
      const int from =
          std::max(begin, static_cast<int>(std::max(shift - 2, static_cast<float>(first_))));
      const int to = std::min(end, static_cast<int>(shift) + length_ + 2);
      for (int r = from; r <= to; ++r) {
        const auto at = static_cast<std::size_t>(r - begin);
        const float k = static_cast<float>(r) - shift;
        const bool inside = n >= 0 && k > -1 && k < static_cast<float>(length_);
        edges[at] = inside ? glm::max(hidden[at] - drop_, crossed(line, k)) : beyond(line, k);
        hidden[at] = glm::max(edges[at], Vec2(inside ? height_on(line, k) : nowhere));
      }
      if (n < 0) continue;
      const int first = std::max(0, static_cast<int>(static_cast<float>(begin) - shift));
      for (int k = first; k < length_; ++k) {
        const float x = static_cast<float>(k) + shift;
        const float below = std::floor(x);
        const int r = static_cast<int>(below);
        if (r >= end) break;
        if (r < begin) continue;
        const auto at = static_cast<std::size_t>(r - begin);
        (rows_ ? out_.edges(k, line) : out_.edges(line, k)) =
            glm::mix(edges[at], edges[at + 1], x - below);
      }
    }
  }

  /// What hides the sun where a ray crosses from one column of samples to the next on its way from
  /// the line before: a narrow crest along the rays is highest there.
  Vec2 crossed(int line, float k) const {
    const int before = line + forward_;
    const float column = drift_ > 0 ? std::ceil(k) : std::floor(k);
    const float part = (column - k) / drift_;  // of the way back
    if (!(part > 0 && part < 1) || before < 0 || before >= lines_) return Vec2(nowhere);
    const auto at = static_cast<int>(column);
    if (at < 0 || at >= length_) return Vec2(nowhere);
    const Grid<float>& h = land_.height;
    const float height = rows_ ? std::lerp(h(at, line), h(at, before), part)
                               : std::lerp(h(line, at), h(before, at), part);
    return Vec2(height) - part * drop_;
  }
  /// Of the land, between two samples of a line.
  float height_on(int line, float k) const {
    const float inside = std::clamp(k, 0.0F, static_cast<float>(length_ - 1));
    const int at = std::min(static_cast<int>(inside), length_ - 2);
    const float t = inside - static_cast<float>(at);
    const Grid<float>& h = land_.height;
    return rows_ ? std::lerp(h(at, line), h(at + 1, line), t)
                 : std::lerp(h(line, at), h(line, at + 1), t);
  }
  /// What the land further out hides at a place on or outside the border.
  Vec2 beyond(int line, float k) const {
    if (beyond_ == nullptr) return Vec2(nowhere);
    const DVec2 place = land_.origin + land_.cell * (rows_ ? DVec2(k, line) : DVec2(line, k));
    const std::optional<Vec2> edges = edges_at(*beyond_, place);
    return edges ? glm::max(*edges, Vec2(height_at(*beyond_land_, place))) : Vec2(nowhere);
  }

  const Heightfield& land_;
  const Heightfield* beyond_land_;
  const Layer* beyond_;
  bool rows_ = true;
  int forward_ = 1;  // towards the sun
  float drift_ = 0;  // along the line, per line towards the sun
  Vec2 drop_{0};     // per line
  int lines_ = 0;
  int length_ = 0;  // samples of a line
  int first_ = 0;   // ray
  Layer out_;
};

/// Nothing hides a sun right overhead.
Layer no_shadow(const Heightfield& land) {
  return {Grid<Vec2>(land.height.width(), land.height.height(), Vec2(nowhere)), land.origin,
          land.cell};
}

}  // namespace

ShadeLand shade_land(const Ground& ground, int most_field, int most_around) {
  const Heightfield& field = ground.field();
  ShadeLand land;
  land.field = resampled(field.origin, field.size(), field.cell, most_field,
                         [&](DVec2 place) { return height_at(field, place); });
  if (!ground.surroundings().height.empty())
    land.around = resampled(ground.low(), ground.high() - ground.low(), ground.surroundings().cell,
                            most_around, [&](DVec2 place) { return ground.base(place).height; });
  return land;
}

SunShadowMap::SunShadowMap(const Ground& ground, int most_field, int most_around)
    : land_(shade_land(ground, most_field, most_around)) {
  set_sun({0, 0, 1});
}

void SunShadowMap::set_sun(Vec3 towards_sun, float radius) {
  around_ = {};
  const bool overhead = glm::length(Vec2(towards_sun)) < 1e-3F;
  const bool around = !land_.around.height.empty();
  if (overhead) {
    field_ = no_shadow(land_.field);
    if (around) around_ = no_shadow(land_.around);
    return;
  }
  if (around) around_ = Sweep(land_.around, towards_sun, radius, nullptr, nullptr).run();
  field_ = Sweep(land_.field, towards_sun, radius, around ? &land_.around : nullptr,
                 around ? &around_ : nullptr)
               .run();
}

float SunShadowMap::share(Vec3 place) const {
  std::optional<Vec2> edges = edges_at(field_, DVec2(place.x, place.y));
  if (!edges) edges = edges_at(around_, DVec2(place.x, place.y));
  return edges ? smoothstep(edges->x, edges->y, place.z) : 1.0F;
}

}  // namespace wold
