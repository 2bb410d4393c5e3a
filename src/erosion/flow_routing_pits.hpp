#pragma once
// Leads the water of pits on, without touching the ground: each depression fills in thought and
// spills over its lowest pass.
//
// Samples are labelled by the pit where their water ends (0: out of the map); between basins that
// touch, the lowest pass max(h_a, h_b) counts, and to the outside the lowest sample of an open
// side; a minimum spanning tree of basins and passes, rooted at the outside, tells over which pass
// each basin spills; the way from there down to its pit is turned round. All in O(n) for the
// samples; the tree by Borůvka's rounds. (Cordonnier, Bovy, Braun, "A versatile, linear complexity
// algorithm for flow routing in topographies with depressions", 2019, its "depression carving".)
//
// Between equal passes the one with the lower place in the grid is taken.

#include "erosion/flow_routing.hpp"

namespace wold {

/// Samples whose direction is `flow_stops`, by rows.
std::vector<int> pits_of(const Grid<std::uint8_t>& direction, Progress& progress);

/// Turns directions until none is `flow_stops`; pits without any way out of the map stay. Returns
/// the number of pits that there were. Keeps its memory from call to call.
class PitRouter {
 public:
  int route(const Grid<float>& height, Grid<std::uint8_t>& direction, const Sides& open,
            Progress& progress);

 private:
  struct Pass {
    float height = 0;
    int from = 0;  ///< sample in one basin
    int d = 0;     ///< the neighbour's number, in the other; flow_leaves: out of the map
    bool operator<(const Pass& b) const {
      return height != b.height ? height < b.height : from != b.from ? from < b.from : d < b.d;
    }
  };

  void label_basins(const Grid<std::uint8_t>& direction, const std::vector<int>& pits,
                    Progress& progress);
  void label_basin(int pit, int number, std::vector<int>& samples);
  void find_passes(const Grid<float>& height, const Sides& open, Progress& progress);
  std::vector<Pass> spanning_tree(int basins);
  void turn_round(Grid<std::uint8_t>& direction, const std::vector<Pass>& tree, int basins) const;
  int basin_beyond(const Pass& pass) const {
    return pass.d == flow_leaves ? 0 : label(pass.from + flow_step(pass.d, label_.width()));
  }
  int label(int k) const { return label_.values()[static_cast<std::size_t>(k)]; }

  Grid<int> label_;
  Grid<std::uint8_t> donors_;
  std::vector<std::vector<int>> samples_;  ///< in basins of pits, of some pits together
  std::vector<Pass> passes_;
};

}  // namespace wold
