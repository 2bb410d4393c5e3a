#include "raster/plant_levels.hpp"

#include <algorithm>
#include <cmath>
#include <glm/gtc/packing.hpp>
#include <optional>

#include "base/hash.hpp"
#include "base/parallel.hpp"
#include "mesh/parts.hpp"
#include "raster/plant_openness.hpp"
#include "raster/plant_shape.hpp"

namespace wold {

namespace {

constexpr std::size_t max_stems = 24;
constexpr float least_stem = 0.004F;      // of the area of all wood
constexpr float widest_aspect = 2.5F;     // length over width at which growth turns to both
constexpr std::uint32_t simple_leaf = 4;  // triangles, up to which a leaf stays as it is
constexpr float least_share = 1.0F / 1024;

std::array<std::uint16_t, 4> halves(Vec3 v, float w) {
  return {glm::packHalf1x16(v.x), glm::packHalf1x16(v.y), glm::packHalf1x16(v.z),
          glm::packHalf1x16(w)};
}

std::array<std::int8_t, 4> bytes(Vec4 v) {
  std::array<std::int8_t, 4> b{};
  for (int k = 0; k < 4; ++k)
    b[static_cast<std::size_t>(k)] =
        static_cast<std::int8_t>(std::lround(std::clamp(v[k], -127.0F, 127.0F)));
  return b;
}

/// Where an element stands in the order, and its triangles in one of the lists.
struct Entry {
  float rank = 0;
  std::uint32_t element = 0;
};

class Builder {
 public:
  Builder(const Model& model, const std::vector<SurfaceMaterial>& materials)
      : mesh_(model.mesh), elements_(plant_elements(model.mesh)) {
    for (const std::uint32_t m : model.part_materials) {
      const auto found = std::find(levels_.materials.begin(), levels_.materials.end(), m);
      slot_.push_back(static_cast<std::uint32_t>(found - levels_.materials.begin()));
      if (found == levels_.materials.end()) levels_.materials.push_back(m);
      sheet_.push_back(materials[m].settings().transmission != Vec3(0));
    }
    openness_.emplace(mesh_, sheet_);
    levels_.extinction = openness_->mean_extinction(leaf_area());
  }

  PlantLevels build() {
    const auto [low, high] = mesh_.bounds();
    levels_.low = low;
    levels_.high = high;
    order();
    build_fine();
    build_coarse();
    return std::move(levels_);
  }

 private:
  /// Leaves, and what has too few triangles to be a tube: the parts of a flower's head.
  bool is_sheet(const PlantElement& e) const { return sheet_[e.part] || e.count <= simple_leaf; }

  /// As the mean over the surface of leaves, m².
  float leaf_area() const {
    double sum = 0;
    double squares = 0;
    for (const PlantElement& e : elements_.list) {
      if (!is_sheet(e)) continue;
      sum += static_cast<double>(e.area);
      squares += static_cast<double>(e.area) * static_cast<double>(e.area);
    }
    return sum > 0 ? static_cast<float>(squares / sum) : 0.0F;
  }

  /// Ranks by area, so that the kept area is the share, of leaves and wood each; stems have none.
  void order() {
    rank_.assign(elements_.list.size(), 0.0F);
    stem_.assign(elements_.list.size(), false);
    double wood = 0;
    for (const PlantElement& e : elements_.list) {
      levels_.area += is_sheet(e) ? e.area : 0.5F * e.area;
      if (!is_sheet(e)) wood += static_cast<double>(e.area);
    }
    choose_stems(static_cast<float>(wood));
    for (const bool sheet : {false, true}) {
      std::vector<std::pair<std::uint64_t, std::uint32_t>> list;
      double total = 0;
      for (std::uint32_t k = 0; k < elements_.list.size(); ++k) {
        if (is_sheet(elements_.list[k]) != sheet || stem_[k]) continue;
        list.emplace_back(random_bits(k, sheet), k);
        total += static_cast<double>(elements_.list[k].area);
      }
      std::sort(list.begin(), list.end());
      double before = 0;
      for (const auto& [bits, k] : list) {
        const auto area = static_cast<double>(elements_.list[k].area);
        rank_[k] = static_cast<float>((before + 0.5 * area) / std::max(total, 1e-30));
        before += area;
      }
    }
  }

  /// The largest pieces of wood, and all that is wood if there are but few.
  void choose_stems(float wood) {
    std::vector<std::pair<float, std::uint32_t>> list;
    for (std::uint32_t k = 0; k < elements_.list.size(); ++k)
      if (!is_sheet(elements_.list[k])) list.emplace_back(-elements_.list[k].area, k);
    std::sort(list.begin(), list.end());
    for (std::size_t n = 0; n < std::min(list.size(), max_stems); ++n)
      if (-list[n].first >= least_stem * wood) stem_[list[n].second] = true;
  }

  std::vector<Entry> sorted(bool twigs_stay) const {
    std::vector<Entry> list;
    for (std::uint32_t k = 0; k < elements_.list.size(); ++k) {
      const bool stays = stem_[k] || (twigs_stay && !is_sheet(elements_.list[k]));
      list.push_back({stays ? 0 : rank_[k], k});
    }
    std::stable_sort(list.begin(), list.end(),
                     [](const Entry& a, const Entry& b) { return a.rank < b.rank; });
    return list;
  }

  std::uint32_t add(Vec3 position, std::uint32_t identity, Vec3 across, float aspect, Vec3 along,
                    float rank, Vec3 normal) {
    PlantVertex v;
    v.position = position;
    v.identity = identity;
    v.across = halves(across, aspect);
    v.along = halves(along, rank);
    v.normal = bytes(Vec4(127.0F * normal, 0));
    const Vec4 light = openness_->at(position);
    v.light = bytes(Vec4(63.0F * Vec3(light), 127.0F * light.w));
    levels_.vertices.push_back(v);
    return static_cast<std::uint32_t>(levels_.vertices.size() - 1);
  }

  std::uint32_t identity(std::uint32_t part, std::uint32_t triangle) const {
    // As the path tracer numbers leaves.
    return slot_[part] << 24U | ((triangle / 8) & 0xffffffU);
  }

  void build_fine() {
    index_of_.assign(mesh_.positions.size(), {});
    first_index_.resize(elements_.list.size());
    std::vector<Entry> list = sorted(true);
    for (const Entry& entry : list) {
      first_index_[entry.element] = static_cast<std::uint32_t>(levels_.indices.size());
      copy_element(elements_.list[entry.element], entry);
    }
    cut(levels_.fine, list, 0, 0.5F);
  }

  /// An element as it is, with what its vertices need to shrink and grow.
  void copy_element(const PlantElement& e, const Entry& entry) {
    const auto triangles = elements_.of(e);
    Frame frame;
    if (is_sheet(e)) frame = frame_of(triangles, e.area);
    for (const std::uint32_t t : triangles) {
      const std::uint32_t id = identity(e.part, t);
      for (int k = 0; k < 3; ++k) {
        const std::uint32_t v = mesh_.triangles[t][k];
        auto& [owner, index] = index_of_[v];
        if (owner != id + 1) {  // 0: none yet
          owner = id + 1;
          index = add_copy(v, t, id, frame, entry.rank);
        }
        levels_.indices.push_back(index);
      }
    }
  }

  /// The axes of a leaf.
  struct Frame {
    Vec3 centre{0};
    Vec3 side{0};
    float aspect = aspect_fixed;
  };

  Frame frame_of(std::span<const std::uint32_t> triangles, float area) const {
    Frame f;
    float weight = 1e-30F;
    Vec3 a(0);
    Vec3 b(0);
    float longest = 0;
    for (const std::uint32_t t : triangles) {
      const UVec3& c = mesh_.triangles[t];
      const Vec3 p[3] = {mesh_.positions[c.x], mesh_.positions[c.y], mesh_.positions[c.z]};
      const float size = triangle_area(mesh_, t);
      weight += size;
      f.centre += size * (p[0] + p[1] + p[2]) / 3.0F;
      for (const std::uint32_t other : triangles.first(std::min<std::size_t>(triangles.size(), 32)))
        for (int k = 0; k < 3; ++k)
          for (const Vec3& from : p) {
            const Vec3& to = mesh_.positions[mesh_.triangles[other][k]];
            if (glm::distance(from, to) <= longest) continue;
            longest = glm::distance(from, to);
            a = from;
            b = to;
          }
    }
    f.centre /= weight;
    if (!(longest > 0)) return f;
    f.aspect = std::clamp(longest * longest / (widest_aspect * std::max(area, 1e-12F)), 1.0F, 1e4F);
    // Of a bent blade the width is not what lies farthest from the line between its ends.
    if (triangles.size() > simple_leaf) {
      f.side = plant_curve(mesh_, triangles, 2).side;
      return f;
    }
    const Vec3 along = (b - a) / longest;
    Vec3 far(0);
    for (const std::uint32_t t : triangles)
      for (int k = 0; k < 3; ++k) {
        Vec3 off = mesh_.positions[mesh_.triangles[t][k]] - f.centre;
        off -= glm::dot(off, along) * along;
        if (glm::length(off) > glm::length(far)) far = off;
      }
    f.side = glm::length(far) > 0 ? glm::normalize(far) : Vec3(0);
    return f;
  }

  std::uint32_t add_copy(std::uint32_t v, std::uint32_t triangle, std::uint32_t id,
                         const Frame& frame, float rank) {
    const Vec3& p = mesh_.positions[v];
    Vec3 normal = flat_normal(triangle);
    if (!mesh_.normals.empty() && glm::length(mesh_.normals[v]) > 0.5F) normal = mesh_.normals[v];
    const bool moves = frame.aspect > 0;
    const Vec3 off = moves ? p - frame.centre : Vec3(0);
    const Vec3 across = glm::dot(off, frame.side) * frame.side;
    return add(p, id, across, frame.aspect, off - across, moves ? rank : 0, normal);
  }

  Vec3 flat_normal(std::uint32_t triangle) const {
    const UVec3& c = mesh_.triangles[triangle];
    const Vec3 n = glm::cross(mesh_.positions[c.y] - mesh_.positions[c.x],
                              mesh_.positions[c.z] - mesh_.positions[c.x]);
    const float length = glm::length(n);
    return length > 0 ? n / length : Vec3(0, 0, 1);
  }

  void build_coarse() {
    const auto begin = static_cast<std::uint32_t>(levels_.indices.size());
    double widths = 0;
    double weight = 0;
    std::vector<Entry> list = sorted(false);
    for (const Entry& entry : list) {
      const PlantElement& e = elements_.list[entry.element];
      if (is_sheet(e) && e.count <= simple_leaf) {
        repeat(first_index_[entry.element], e.count);
        continue;
      }
      const float width = stem_[entry.element] ? add_tube(e) : add_strip(e, entry);
      if (stem_[entry.element]) continue;
      widths += static_cast<double>(width * e.area);
      weight += static_cast<double>(e.area);
    }
    levels_.fine_pixel = weight > 0 ? static_cast<float>(0.6 * widths / weight) : 0.0F;
    cut(levels_.coarse, list, begin, least_share);
  }

  void repeat(std::uint32_t first, std::uint32_t triangles) {
    for (std::uint32_t k = 0; k < 3 * triangles; ++k)
      levels_.indices.push_back(levels_.indices[first + k]);
  }

  /// As few segments as the bends allow.
  PlantCurve curve_of(const PlantElement& e, int most) const {
    PlantCurve curve = plant_curve(mesh_, elements_.of(e), most);
    float length = 0;
    for (std::size_t k = 0; k + 1 < curve.centre.size(); ++k)
      length += glm::distance(curve.centre[k], curve.centre[k + 1]);
    const float straight =
        glm::distance(curve.centre.front(), curve.centre.back()) / std::max(length, 1e-9F);
    if (straight > 0.985F) return plant_curve(mesh_, elements_.of(e), 1);
    if (straight > 0.93F && most > 2) return plant_curve(mesh_, elements_.of(e), 2);
    return curve;
  }

  static Vec3 tangent(const PlantCurve& c, std::size_t k) {
    const Vec3 d = c.centre[std::min(k + 1, c.centre.size() - 1)] - c.centre[k > 0 ? k - 1 : 0];
    const float length = glm::length(d);
    return length > 0 ? d / length : Vec3(0, 0, 1);
  }

  /// A leaf as a strip through its middle line, a twig as one with half its surface. Returns its
  /// mean width.
  float add_strip(const PlantElement& e, const Entry& entry) {
    const PlantCurve curve = curve_of(e, 3);
    const bool sheet = is_sheet(e);
    const std::size_t nodes = curve.centre.size();
    const float area = sheet ? e.area : 0.5F * e.area;
    std::vector<float> width = curve.width;
    if (sheet && nodes > 2) width.front() *= 0.5F;
    if (sheet && nodes > 2) width.back() = 0;
    float strip = 0;
    for (std::size_t k = 0; k + 1 < nodes; ++k)
      strip +=
          0.5F * (width[k] + width[k + 1]) * glm::distance(curve.centre[k], curve.centre[k + 1]);
    Vec3 side = curve.side;
    if (!sheet) {
      // About its axis a twig shows the same from all sides.
      const float turn = 2 * pi * uniform(random_bits(entry.element, 2));
      side = std::cos(turn) * side + std::sin(turn) * glm::cross(side, tangent(curve, 0));
    }
    const std::uint32_t id = identity(e.part, elements_.of(e).front());
    const auto first = static_cast<std::uint32_t>(levels_.vertices.size());
    for (std::size_t k = 0; k < nodes; ++k) {
      const Vec3 along = tangent(curve, k);
      Vec3 across = side - glm::dot(side, along) * along;
      across = glm::normalize(across + 1e-6F * Vec3(along.y, along.z, along.x));
      const Vec3 off = (0.5F * width[k] * area / std::max(strip, 1e-12F)) * across;
      const Vec3 normal = glm::normalize(glm::cross(along, across));
      for (const float sign : {-1.0F, 1.0F})
        add(curve.centre[k] + sign * off, id, sign * off, aspect_strip, Vec3(0), entry.rank,
            normal);
    }
    for (std::uint32_t k = 0; k + 1 < nodes; ++k) {
      const std::uint32_t v = first + 2 * k;
      const bool tip = k + 2 == nodes && width.back() == 0;
      for (const std::uint32_t c : {v, v + 1, v + 3}) levels_.indices.push_back(c);
      if (tip) continue;
      for (const std::uint32_t c : {v, v + 3, v + 2}) levels_.indices.push_back(c);
    }
    return (sheet ? e.area : e.area / pi) / std::max(curve.length, 1e-9F);
  }

  /// A thick branch as a tube of few sides with all its surface.
  float add_tube(const PlantElement& e) {
    const float tall = std::max(levels_.high.z - levels_.low.z, 1e-6F);
    PlantCurve curve = plant_curve(mesh_, elements_.of(e), 1);
    const int segments = std::clamp(static_cast<int>(curve.length / (0.06F * tall)), 2, 16);
    curve = plant_curve(mesh_, elements_.of(e), segments);
    const float thick = e.area / (pi * std::max(curve.length, 1e-9F));
    const int sides = thick > 0.008F * tall ? 6 : 4;
    // Of a polygon with that girth, a vertex lies this far out.
    const float corner =
        0.5F / (static_cast<float>(sides) * std::sin(pi / static_cast<float>(sides)));
    float surface = 0;
    for (std::size_t k = 0; k + 1 < curve.centre.size(); ++k)
      surface += 0.5F * (curve.width[k] + curve.width[k + 1]) *
                 glm::distance(curve.centre[k], curve.centre[k + 1]);
    const float scale = e.area / std::max(surface, 1e-12F);
    const std::uint32_t id = identity(e.part, elements_.of(e).front());
    const auto first = static_cast<std::uint32_t>(levels_.vertices.size());
    Vec3 side = curve.side;
    for (std::size_t k = 0; k < curve.centre.size(); ++k) {
      const Vec3 along = tangent(curve, k);
      side = glm::normalize(side - glm::dot(side, along) * along +
                            1e-6F * Vec3(along.y, along.z, along.x));
      const Vec3 other = glm::cross(along, side);
      for (int s = 0; s < sides; ++s) {
        const float angle = 2 * pi * static_cast<float>(s) / static_cast<float>(sides);
        const Vec3 out = std::cos(angle) * side + std::sin(angle) * other;
        add(curve.centre[k] + corner * scale * curve.width[k] * out, id, Vec3(0), aspect_fixed,
            Vec3(0), 0, out);
      }
    }
    const auto n = static_cast<std::uint32_t>(sides);
    for (std::uint32_t k = 0; k + 1 < curve.centre.size(); ++k)
      for (std::uint32_t s = 0; s < n; ++s) {
        const std::uint32_t a = first + k * n + s;
        const std::uint32_t b = first + k * n + (s + 1) % n;
        for (const std::uint32_t c : {a, b, b + n, a, b + n, a + n}) levels_.indices.push_back(c);
      }
    return thick;
  }

  /// Levels as beginnings of the list that starts at `begin`, down to `least`.
  void cut(std::vector<PlantLevel>& levels, const std::vector<Entry>& list, std::uint32_t begin,
           float least) const {
    const auto rank_at = [&](std::uint32_t index) {
      return glm::unpackHalf1x16(levels_.vertices[levels_.indices[index]].along[3]);
    };
    const auto end = static_cast<std::uint32_t>(levels_.indices.size());
    if (list.empty()) return;
    for (int k = 0;; ++k) {
      const float share = std::exp2(-0.5F * static_cast<float>(k));
      if (share < 0.999F * least) break;
      const float highest = share * (1 + plant_fade);
      std::uint32_t low = begin / 3;
      std::uint32_t high = end / 3;
      while (low < high) {
        const std::uint32_t middle = (low + high) / 2;
        if (rank_at(3 * middle) < highest)
          low = middle + 1;
        else
          high = middle;
      }
      levels.push_back({share, begin, 3 * low - begin});
    }
  }

  const TriangleMesh& mesh_;
  PlantElements elements_;
  std::optional<PlantOpenness> openness_;
  PlantLevels levels_;
  std::vector<std::uint32_t> slot_;                                // of parts
  std::vector<bool> sheet_;                                        // of parts
  std::vector<float> rank_;                                        // of elements
  std::vector<bool> stem_;                                         // of elements
  std::vector<std::uint32_t> first_index_;                         // of elements in `fine`
  std::vector<std::pair<std::uint32_t, std::uint32_t>> index_of_;  // of vertices: identity + 1, new
};

}  // namespace

const PlantLevel& PlantLevels::level(bool is_fine, float share) const {
  const std::vector<PlantLevel>& list = is_fine ? fine : coarse;
  const float steps = std::floor(-2 * std::log2(std::max(share, 1e-9F)) + 1e-4F);
  const int k = std::clamp(static_cast<int>(steps), 0, static_cast<int>(list.size()) - 1);
  return list[static_cast<std::size_t>(k)];
}

PlantLevels plant_levels(const Model& model, const std::vector<SurfaceMaterial>& materials) {
  return Builder(model, materials).build();
}

std::vector<PlantLevels> plant_levels(const World& world, Progress& progress) {
  const ProgressStage stage(progress, "simplifying plants",
                            static_cast<double>(world.models.size()), "models");
  std::vector<PlantLevels> list(world.models.size());
  parallel_for(0, static_cast<int>(list.size()), [&](int k) {
    const auto m = static_cast<std::size_t>(k);
    list[m] = plant_levels(world.models[m], world.materials);
    progress.advance();
  });
  return list;
}

}  // namespace wold
