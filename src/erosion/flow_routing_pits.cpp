#include "erosion/flow_routing_pits.hpp"

#include <algorithm>
#include <array>
#include <bit>
#include <numeric>

namespace wold {

namespace {

constexpr int pits_at_once = 64;

std::size_t at(int k) {
  return static_cast<std::size_t>(k);
}

/// Sets of basins that grow together.
class Unions {
 public:
  explicit Unions(int count) : parent_(at(count)) { std::iota(parent_.begin(), parent_.end(), 0); }
  int root(int a) {
    while (parent_[at(a)] != a) a = parent_[at(a)] = parent_[at(parent_[at(a)])];
    return a;
  }
  bool join(int a, int b) {
    a = root(a);
    b = root(b);
    parent_[at(std::max(a, b))] = std::min(a, b);
    return a != b;
  }

 private:
  std::vector<int> parent_;
};

/// Concatenates what the rows found, in their order.
template <class T>
std::vector<T> concatenated(const std::vector<std::vector<T>>& parts) {
  std::vector<T> all;
  for (const std::vector<T>& part : parts) all.insert(all.end(), part.begin(), part.end());
  return all;
}

constexpr int rows_at_once = 64;
int chunks_of(int rows) {
  return (rows + rows_at_once - 1) / rows_at_once;
}

/// Calls `visit(i)` where a and b differ. In blocks, most of which are the same.
template <class Visit>
void each_difference(const int* a, const int* b, int first, int last, const Visit& visit) {
  constexpr int block = 32;
  for (; first < last; first += block) {
    const int end = std::min(last, first + block);
    int differs = 0;
    if (end - first == block)
      for (int k = 0; k < block; ++k) differs |= a[first + k] ^ b[first + k];
    else
      differs = 1;
    if (differs == 0) continue;
    for (int i = first; i < end; ++i)
      if (a[i] != b[i]) visit(i);
  }
}

}  // namespace

std::vector<int> pits_of(const Grid<std::uint8_t>& direction, Progress& progress) {
  const int w = direction.width();
  std::vector<std::vector<int>> found(at(chunks_of(direction.height())));
  parallel_for(0, chunks_of(direction.height()), [&](int c) {
    const int end = std::min(direction.height(), (c + 1) * rows_at_once);
    for (int j = c * rows_at_once; j < end; ++j) {
      const std::span<const std::uint8_t> row = direction.row(j);
      for (auto p = std::find(row.begin(), row.end(), flow_stops); p != row.end();
           p = std::find(p + 1, row.end(), flow_stops))
        found[at(c)].push_back(j * w + static_cast<int>(p - row.begin()));
    }
    progress.advance(0);
  });
  return concatenated(found);
}

// Basins of pits only, each upstream from its pit: where pits are few, little is visited.
void PitRouter::label_basins(const Grid<std::uint8_t>& direction, const std::vector<int>& pits,
                             Progress& progress) {
  donor_masks(direction, donors_, progress);
  if (label_.width() == direction.width() && label_.height() == direction.height())
    for (const std::vector<int>& samples : samples_)
      for (const int k : samples) label_.values()[at(k)] = 0;
  else
    label_ = Grid<int>(direction.width(), direction.height(), 0);
  const int count = static_cast<int>(pits.size());
  samples_.resize(at((count + pits_at_once - 1) / pits_at_once));
  parallel_for(0, static_cast<int>(samples_.size()), [&](int c) {
    samples_[at(c)].clear();
    for (int p = c * pits_at_once; p < std::min(count, (c + 1) * pits_at_once); ++p) {
      label_basin(pits[at(p)], p + 1, samples_[at(c)]);
      progress.advance(0);
    }
  });
}

void PitRouter::label_basin(int pit, int number, std::vector<int>& samples) {
  const int w = label_.width();
  std::array<int, 8> steps{};
  for (int d = 0; d < 8; ++d) steps[at(d)] = flow_step(d, w);
  std::size_t next = samples.size();
  samples.push_back(pit);
  for (; next < samples.size(); ++next) {
    const int k = samples[next];
    label_.values()[at(k)] = number;
    for (unsigned mask = donors_.values()[at(k)]; mask != 0; mask &= mask - 1)
      samples.push_back(k + steps[at(std::countr_zero(mask))]);
  }
}

void PitRouter::find_passes(const Grid<float>& height, const Sides& open, Progress& progress) {
  const int w = height.width();
  const int h = height.height();
  std::vector<std::vector<Pass>> found(at(chunks_of(h)));
  parallel_for(0, chunks_of(h), [&](int c) {
    for (int j = c * rows_at_once; j < std::min(h, (c + 1) * rows_at_once); ++j)
      for (int d = 0; d < 4; ++d) {
        if (j + flow_dy[at(d)] >= h) continue;
        const int dx = flow_dx[at(d)];
        const int* here = label_.row(j).data();
        const int* there = label_.row(j + flow_dy[at(d)]).data() + dx;
        const float* height_here = height.row(j).data();
        const float* height_there = height.row(j + flow_dy[at(d)]).data() + dx;
        each_difference(here, there, std::max(0, -dx), std::min(w, w - dx), [&](int i) {
          found[at(c)].push_back({std::max(height_here[i], height_there[i]), j * w + i, d});
        });
      }
    progress.advance(0);
  });
  passes_ = concatenated(found);
  for (int j = 0; j < h; ++j)
    for (int i = 0; i < w; i += (j == 0 || j == h - 1) ? 1 : w - 1)
      if (open.hold(i, j, w, h) && label(j * w + i) != 0)
        passes_.push_back({height(i, j), j * w + i, flow_leaves});
}

// Borůvka: every group of basins that does not reach outside yet takes its lowest pass to another.
std::vector<PitRouter::Pass> PitRouter::spanning_tree(int basins) {
  Unions groups(basins);
  std::vector<Pass> tree;
  for (bool grows = true; grows;) {
    std::vector<int> lowest(at(basins), -1);
    std::size_t kept = 0;
    for (const Pass& pass : passes_) {
      const int a = groups.root(label(pass.from));
      const int b = groups.root(basin_beyond(pass));
      if (a == b) continue;
      const int p = static_cast<int>(kept);
      passes_[kept++] = pass;
      for (const int group : {a, b})
        if (lowest[at(group)] < 0 || pass < passes_[at(lowest[at(group)])]) lowest[at(group)] = p;
    }
    passes_.resize(kept);
    grows = false;
    for (int group = 1; group < basins; ++group) {
      if (lowest[at(group)] < 0) continue;
      const Pass& pass = passes_[at(lowest[at(group)])];
      if (!groups.join(label(pass.from), basin_beyond(pass))) continue;
      tree.push_back(pass);
      grows = true;
    }
  }
  return tree;
}

void PitRouter::turn_round(Grid<std::uint8_t>& direction, const std::vector<Pass>& tree,
                           int basins) const {
  const int w = direction.width();
  std::vector<std::vector<Pass>> passes_of(at(basins));
  for (const Pass& pass : tree) {
    passes_of[at(basin_beyond(pass))].push_back(pass);
    if (pass.d != flow_leaves)
      passes_of[at(label(pass.from))].push_back(
          {pass.height, pass.from + flow_step(pass.d, w), opposite_flow(pass.d)});
  }
  std::vector<bool> done(at(basins), false);
  std::vector<int> open{0};
  done[0] = true;
  while (!open.empty()) {
    const int basin = open.back();
    open.pop_back();
    for (const Pass& pass : passes_of[at(basin)]) {
      const int upper = label(pass.from);
      if (done[at(upper)]) continue;
      done[at(upper)] = true;
      open.push_back(upper);
      int k = pass.from;
      int towards = pass.d;
      for (;;) {
        const int old = direction.values()[at(k)];
        direction.values()[at(k)] = static_cast<std::uint8_t>(towards);
        if (old >= flow_stops) break;
        towards = opposite_flow(old);
        k += flow_step(old, w);
      }
    }
  }
}

int PitRouter::route(const Grid<float>& height, Grid<std::uint8_t>& direction, const Sides& open,
                     Progress& progress) {
  const std::vector<int> pits = pits_of(direction, progress);
  if (pits.empty()) return 0;
  const int basins = static_cast<int>(pits.size()) + 1;
  label_basins(direction, pits, progress);
  find_passes(height, open, progress);
  turn_round(direction, spanning_tree(basins), basins);
  return basins - 1;
}

}  // namespace wold
