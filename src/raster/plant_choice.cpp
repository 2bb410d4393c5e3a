#include "raster/plant_choice.hpp"

#include <algorithm>
#include <cmath>
#include <glm/gtc/quaternion.hpp>
#include <map>

#include "base/hash.hpp"
#include "base/parallel.hpp"
#include "base/smoothstep.hpp"
#include "raster/plant_mesh.hpp"
#include "render/ray_scene.hpp"

namespace wold {

namespace {

constexpr float both_drawn = 1.35F;     // times card_height, from where cards come in
constexpr float least_triangles = 150;  // of a tree's mesh
constexpr float least_blades = 24;      // triangles of a small plant
constexpr float least_share = 0.04F;    // of leaves: with fewer they would grow too large
constexpr float most_growth = 12;       // in area, of small plants: then the ground takes over
constexpr float least_small_share = 0.12F;
constexpr float small_part = 0.4F;  // of the budget, for small plants
constexpr float hidden_from = 5;    // m: from here on small plants hide each other
constexpr int wish_bins = 96;       // four per octave, from 1 down
// Share of leaves in shadow maps, far away; all of them near by, where each shadow is seen.
constexpr float shadow_coarseness = 0.3F;
constexpr Vec2 shadow_fine_range(12, 40);   // m
constexpr float shadow_card_height = 0.7F;  // of what trees are seen as: pictures shade less

/// What one visible plant asks for.
struct Wish {
  std::uint32_t plant = 0;
  float leaves = 0;  ///< share of leaves for one per pixel, at q = 1; may be above 1
  float card = 0;    ///< part that the card draws
  float thin = 1;    ///< what is left at this distance of a small plant
  bool fine = false;
};

struct CellWishes {
  std::size_t field = 0;
  std::vector<Wish> list;
};

class Chooser {
 public:
  Chooser(std::span<const PlantField* const> fields, std::span<const PlantLevels> levels,
          std::span<const PlantSizes> sizes, const DrawView& view, const PlantDetail& detail)
      : fields_(fields), levels_(levels), sizes_(sizes), view_(view), detail_(detail) {
    budget_ = static_cast<double>(detail.triangle_budget);
    if (view.depth_only) budget_ *= static_cast<double>(detail.shadow_share);
    card_height_ = (view.depth_only ? shadow_card_height : 1.0F) * detail.card_height;
  }

  PlantChoice choose() {
    // Too many even at the coarsest: larger trees become cards.
    for (int attempt = 0; attempt < 8; ++attempt) {
      gather();
      if (triangles_at(1e-6F, false) <= budget_) break;
      card_height_ *= 1.5F;
    }
    PlantChoice choice;
    small_density_ = solve(true, static_cast<double>(small_part) * budget_);
    density_ = solve(false, budget_ - triangles_at(small_density_, true));
    choice.density = density_;
    assign(choice);
    return choice;
  }

 private:
  Vec3 centre(const DrawnPlant& p, const PlantSizes& size) const {
    const Vec3 q(p.turn);
    const Vec3 m = size.middle;
    const Vec3 t = 2.0F * glm::cross(q, m);
    return p.position + p.scale * (m + p.turn.w * t + glm::cross(q, t));
  }

  void gather() {
    std::vector<std::pair<std::size_t, const PlantField::Cell*>> cells;
    for (std::size_t f = 0; f < fields_.size(); ++f)
      for (const PlantField::Cell& cell : fields_[f]->cells())
        if (view_.sees(cell.low, cell.high)) cells.emplace_back(f, &cell);
    wishes_.assign(cells.size(), {});
    parallel_for(0, static_cast<int>(cells.size()), [&](int k) {
      const auto c = static_cast<std::size_t>(k);
      wishes_[c].field = cells[c].first;
      wish_for(*cells[c].second, wishes_[c]);
    });
    histogram_.assign(2 * sizes_.size() * wish_bins, 0.0);
    for (const CellWishes& cell : wishes_)
      for (const Wish& w : cell.list) {
        if (w.card >= 1) continue;
        const std::uint32_t model = fields_[cell.field]->plants()[w.plant].model;
        histogram_[bin(model, w.fine, w.leaves)] += 1;
      }
  }

  std::size_t bin(std::uint32_t model, bool fine, float leaves) const {
    const int b =
        std::clamp(static_cast<int>(24 - 4 * std::log2(std::max(leaves, 1e-9F))), 0, wish_bins - 1);
    return (2 * model + (fine ? 1 : 0)) * std::size_t{wish_bins} + static_cast<std::size_t>(b);
  }

  void wish_for(const PlantField::Cell& cell, CellWishes& out) const {
    const std::vector<PlantField::Plant>& plants = fields_[out.field]->plants();
    for (std::uint32_t k = cell.first; k < cell.first + cell.count; ++k) {
      const PlantField::Plant& p = plants[k];
      const PlantSizes& size = sizes_[p.model];
      const Vec3 middle = centre(p.drawn, size);
      const float distance = std::max(glm::distance(middle, view_.eye), 0.1F);
      const bool small = is_small(size);
      if (small && distance >= detail_.small_distance) continue;
      if (!view_.sees_sphere(middle, p.drawn.scale * size.radius)) continue;
      const float pixel = view_.pixel_angle * distance / p.drawn.scale;
      Wish w;
      w.plant = k;
      w.fine = pixel < levels_[p.model].fine_pixel && !view_.depth_only;
      const float leaves = 0.5F * full_triangles(p.model);
      w.leaves = detail_.leaves_per_pixel * size.crown / (pixel * pixel * std::max(leaves, 1.0F));
      if (view_.depth_only)
        w.leaves *= std::lerp(1.0F, shadow_coarseness,
                              smoothstep(shadow_fine_range.x, shadow_fine_range.y, distance));
      if (small) {
        // Seen across a meadow a plant shows its top alone; the sun sees the rest of it, too.
        if (!view_.depth_only) w.leaves *= std::min(1.0F, hidden_from / distance);
        const float near = 0.7F * detail_.small_distance;
        w.thin = std::clamp((detail_.small_distance - distance) / (detail_.small_distance - near),
                            0.0F, 1.0F);
      }
      if (size.card) {
        const float tall = size.height / pixel;
        w.card = std::clamp((both_drawn * card_height_ - tall) / ((both_drawn - 1) * card_height_),
                            0.0F, 1.0F);
      }
      out.list.push_back(w);
    }
  }

  bool is_small(const PlantSizes& size) const {
    return !size.card && size.height < detail_.small_height;
  }

  float full_triangles(std::uint32_t model) const {
    return static_cast<float>(levels_[model].coarse.front().index_count) / 3;
  }

  /// Share of leaves in a plant, and of plants, for a share of leaves over all.
  std::pair<float, float> limit(std::uint32_t model, float share) const {
    const bool small = is_small(sizes_[model]);
    const float least =
        std::max(small ? least_small_share : least_share,
                 (small ? least_blades : least_triangles) / std::max(full_triangles(model), 1.0F));
    if (share >= least) return {std::min(share, 1.0F), 1.0F};
    const float of_plants = is_small(sizes_[model]) ? share / least : 1.0F;
    return {std::min(least, 1.0F), std::clamp(of_plants, 1e-6F, 1.0F)};
  }

  double triangles_at(float q, bool small) const {
    double sum = 0;
    for (std::uint32_t m = 0; m < sizes_.size(); ++m) {
      if (is_small(sizes_[m]) != small) continue;
      for (const bool fine : {false, true})
        for (int b = 0; b < wish_bins; ++b) {
          const double count = histogram_[(2 * m + (fine ? 1 : 0)) * std::size_t{wish_bins} +
                                          static_cast<std::size_t>(b)];
          if (count == 0) continue;
          const float leaves = std::exp2(static_cast<float>(24 - b) / 4);
          const auto [share, plants] = limit(m, q * leaves);
          const PlantLevel& level = levels_[m].level(fine && share > 0.5F, share);
          sum += count * static_cast<double>(std::min(1.0F, plants * (1 + plant_fade))) *
                 level.index_count / 3;
        }
    }
    return sum;
  }

  /// The largest density of small plants, or of the others, with so many triangles.
  float solve(bool small, double budget) const {
    if (triangles_at(1, small) <= budget) return 1;
    float low = 1e-6F;
    float high = 1;
    for (int k = 0; k < 24; ++k) {
      const float middle = std::sqrt(low * high);
      (triangles_at(middle, small) <= budget ? low : high) = middle;
    }
    return low;
  }

  /// Calls `put(batch key, plant)` for all that is drawn of one cell.
  template <class Put>
  void each(const CellWishes& cell, const Put& put) const {
    for (const Wish& w : cell.list) {
      const PlantField::Plant& p = fields_[cell.field]->plants()[w.plant];
      DrawnPlant drawn = p.drawn;
      if (w.card > 0) {
        drawn.fade = w.card;
        put(key(PlantBatch::Kind::card, p.model, 0), drawn);
      }
      if (w.card >= 1) continue;
      const float q = is_small(sizes_[p.model]) ? small_density_ : density_;
      const auto [share, plants] = limit(p.model, q * w.leaves);
      if (plants < 1) {
        const float f =
            std::clamp((plants * (1 + plant_fade) - p.rank) / (plant_fade * plants), 0.0F, 1.0F);
        if (f <= 0) continue;
        drawn.growth = f * std::min(strip_growth(plants), most_growth * std::min(share, 1.0F));
      }
      drawn.growth *= w.thin;
      drawn.share = share;
      drawn.fade = 1 - w.card;
      const bool fine = w.fine && share > 0.5F;
      const PlantLevels& levels = levels_[p.model];
      const auto level = static_cast<std::uint32_t>(&levels.level(fine, share) -
                                                    (fine ? levels.fine : levels.coarse).data());
      put(key(fine ? PlantBatch::Kind::fine : PlantBatch::Kind::coarse, p.model, level), drawn);
    }
  }

  /// Sorts the finest first, and cards last.
  static std::uint64_t key(PlantBatch::Kind kind, std::uint32_t model, std::uint32_t level) {
    return static_cast<std::uint64_t>(kind) << 60U | static_cast<std::uint64_t>(level) << 32U |
           model;
  }

  void assign(PlantChoice& choice) const {
    std::vector<std::map<std::uint64_t, std::vector<DrawnPlant>>> found(wishes_.size());
    parallel_for(0, static_cast<int>(wishes_.size()), [&](int k) {
      const auto c = static_cast<std::size_t>(k);
      each(wishes_[c],
           [&](std::uint64_t batch, const DrawnPlant& p) { found[c][batch].push_back(p); });
    });
    std::map<std::uint64_t, std::uint32_t> counts;
    for (const auto& cell : found)
      for (const auto& [batch, list] : cell)
        counts[batch] += static_cast<std::uint32_t>(list.size());
    std::map<std::uint64_t, std::uint32_t> next;
    std::uint32_t first = 0;
    for (const auto& [batch, count] : counts) {
      PlantBatch b;
      b.kind = static_cast<PlantBatch::Kind>(batch >> 60U);
      b.level = static_cast<std::uint32_t>(batch >> 32U) & 0xfffffffU;
      b.model = static_cast<std::uint32_t>(batch);
      b.first = first;
      b.count = count;
      choice.batches.push_back(b);
      choice.triangles += static_cast<std::uint64_t>(count) * triangles_of(b);
      next[batch] = first;
      first += count;
    }
    choice.plants.resize(first);
    for (const auto& cell : found)
      for (const auto& [batch, list] : cell) {
        std::copy(list.begin(), list.end(), choice.plants.begin() + next[batch]);
        next[batch] += static_cast<std::uint32_t>(list.size());
      }
  }

  std::uint32_t triangles_of(const PlantBatch& b) const {
    if (b.kind == PlantBatch::Kind::card) return 2;
    const PlantLevels& l = levels_[b.model];
    return (b.kind == PlantBatch::Kind::fine ? l.fine : l.coarse)[b.level].index_count / 3;
  }

  std::span<const PlantField* const> fields_;
  std::span<const PlantLevels> levels_;
  std::span<const PlantSizes> sizes_;
  const DrawView& view_;
  const PlantDetail& detail_;
  double budget_ = 0;
  float card_height_ = 0;
  float density_ = 1;  // q, and that of small plants
  float small_density_ = 1;
  std::vector<CellWishes> wishes_;
  std::vector<double> histogram_;
};

}  // namespace

Description<PlantDetail> describe(const PlantDetail&) {
  return Description<PlantDetail>("plant_detail", "How finely plants are drawn in real time.")
      .add("triangle_budget", &PlantDetail::triangle_budget, {.min = 1000, .max = 1e9},
           "Triangles of plants in a frame, at most.")
      .add("leaves_per_pixel", &PlantDetail::leaves_per_pixel, {.min = 0.01, .max = 16},
           "Leaves that are drawn for each pixel of a crown.")
      .add("card_height", &PlantDetail::card_height, {.unit = "pixels", .min = 1, .max = 2000},
           "Height below which trees are drawn as pictures of themselves.")
      .add("small_distance", &PlantDetail::small_distance, {.unit = "m", .min = 1, .max = 1e5},
           "Distance at which the last small plants are gone.")
      .add("small_height", &PlantDetail::small_height, {.unit = "m", .min = 0, .max = 100},
           "Height up to which a plant is small.")
      .add("shadow_share", &PlantDetail::shadow_share, {.min = 0.01, .max = 10},
           "Part of the triangles that may be drawn into a shadow map.");
}

PlantSizes plant_sizes(const PlantLevels& levels) {
  PlantSizes s;
  const Vec3 size = levels.high - levels.low;
  s.middle = 0.5F * (levels.low + levels.high);
  s.radius = 0.6F * glm::length(size);  // leaves that grow stand out a little
  s.height = std::max(levels.high.z, 1e-3F);
  s.area = levels.area;
  s.crown = 0.5F * (size.x + size.y) * size.z;
  return s;
}

PlantField::PlantField(std::span<const ModelInstance> instances,
                       std::span<const PlantSizes> sizes) {
  if (instances.empty()) return;
  Vec2 low(instances.front().position);
  Vec2 high = low;
  for (const ModelInstance& i : instances) {
    low = glm::min(low, Vec2(i.position));
    high = glm::max(high, Vec2(i.position));
  }
  constexpr int most_across = 96;
  const float step =
      std::max({(high.x - low.x) / most_across, (high.y - low.y) / most_across, 1.0F});
  const auto cell_of = [&](Vec3 p) {
    const auto i = static_cast<std::uint32_t>((p.x - low.x) / step);
    const auto j = static_cast<std::uint32_t>((p.y - low.y) / step);
    return j * (most_across + 1) + i;
  };
  std::vector<std::uint32_t> start((most_across + 1) * (most_across + 1) + 1, 0);
  for (const ModelInstance& i : instances) ++start[cell_of(i.position) + 1];
  for (std::size_t k = 1; k < start.size(); ++k) start[k] += start[k - 1];
  std::vector<std::uint32_t> order(instances.size());
  std::vector<std::uint32_t> next(start.begin(), start.end() - 1);
  for (std::uint32_t k = 0; k < instances.size(); ++k)
    order[next[cell_of(instances[k].position)]++] = k;
  plants_.resize(instances.size());
  parallel_for(
      0, static_cast<int>(instances.size()),
      [&](int k) {
        const ModelInstance& i = instances[order[static_cast<std::size_t>(k)]];
        Plant& p = plants_[static_cast<std::size_t>(k)];
        const Mat3 turn = instance_matrix(i) / i.scale;
        const glm::quat q = glm::normalize(glm::quat_cast(turn));
        const std::uint64_t bits = random_bits(i.individual, 1);  // as SurfaceMaterial::at
        p.drawn.position = i.position;
        p.drawn.scale = i.scale;
        p.drawn.turn = Vec4(q.x, q.y, q.z, q.w);
        p.drawn.texture = Vec2(uniform(bits), uniform(mix_bits(bits)));
        p.drawn.bits = {static_cast<std::uint32_t>(bits), static_cast<std::uint32_t>(bits >> 32U)};
        p.model = i.model;
        p.rank = uniform(random_bits(i.individual, 2));
      },
      4096);
  for (std::size_t c = 0; c + 1 < start.size(); ++c) {
    Cell cell{start[c], start[c + 1] - start[c], Vec3(1e30F), Vec3(-1e30F)};
    if (cell.count == 0) continue;
    float crowd = 0;
    float crowd_height = 0;
    for (std::uint32_t k = cell.first; k < cell.first + cell.count; ++k) {
      const Plant& p = plants_[k];
      const PlantSizes& size = sizes[p.model];
      const float reach = p.drawn.scale * (size.radius + glm::length(size.middle));
      const float area = size.card ? 0.0F : size.area * p.drawn.scale * p.drawn.scale;
      crowd += area / (step * step);
      crowd_height += area / (step * step) * size.height * p.drawn.scale;
      cell.low = glm::min(cell.low, p.drawn.position - reach);
      cell.high = glm::max(cell.high, p.drawn.position + reach);
    }
    for (std::uint32_t k = cell.first; k < cell.first + cell.count; ++k) {
      if (sizes[plants_[k].model].card || crowd <= 0) continue;
      plants_[k].drawn.crowd = crowd;
      plants_[k].drawn.crowd_height = crowd_height / crowd;
    }
    cells_.push_back(cell);
  }
}

PlantChoice choose_plants(std::span<const PlantField* const> fields,
                          std::span<const PlantLevels> levels, std::span<const PlantSizes> sizes,
                          const DrawView& view, const PlantDetail& detail) {
  return Chooser(fields, levels, sizes, view, detail).choose();
}

}  // namespace wold
