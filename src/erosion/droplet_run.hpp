#pragma once
// A run of drops over a ground, from rain to maps (droplets.hpp).

#include "erosion/droplet_ground.hpp"
#include "erosion/droplet_maps.hpp"
#include "erosion/droplet_rain.hpp"
#include "erosion/droplets.hpp"

namespace wold {

class DropletRun {
 public:
  /// Arguments must outlive it.
  DropletRun(const Heightfield& input, const Droplets& parameters, const TerrainContext& context);

  /// Lets all drops fall and run.
  void rain();
  /// The ground now, its maps and its balance.
  TerrainResult result();

  /// Cells that drops have gone.
  std::int64_t steps() const { return steps_; }

 private:
  void round(DropletTiles& tiles, int k);
  void start_record();
  Balance balance(const Heightfield& output) const;

  const Heightfield& input_;
  const Droplets& parameters_;
  const TerrainContext& context_;
  DropletGround ground_;
  DropletRates rates_;
  double radius_cells_;
  double creep_ = 0;  ///< of loose sediment, share of a difference and round
  int rounds_ = 0;
  int settled_rounds_ = 1;  ///< rounds until the ground settles again
  DropletWorld world_;
  DropletColors colors_;
  DropletRecord record_;
  std::vector<float> softness_;
  Grid<float> rain_share_;
  double removed_ = 0;  ///< m · cells
  std::int64_t steps_ = 0;
};

}  // namespace wold
