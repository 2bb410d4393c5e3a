#pragma once
// What water starts from and what it leaves, for the operators with water.

#include <map>
#include <string>

#include "erosion/pipes.hpp"
#include "erosion/pipes_rows.hpp"

namespace wold::pipes_detail {

inline constexpr float deepest_at_first = 300;  ///< m, of maps of water and of lakes

/// Throws Error(input) for springs without a place, off the land, or with a rate that may not be.
void check_springs(const Heightfield& input, const Pipes& parameters);

/// Rain and springs over the samples of `ground`, m/s. `rain` is the factor of the rain.
Grid<float> inflow_over(const Heightfield& ground, const Grid<float>& rain,
                        const Pipes& parameters);

/// 1 - hardness, from the map of that name; 1 without.
Grid<float> ease_of(const Heightfield& input, const std::string& hardness, bool invert,
                    const TerrainContext& context);

/// Depths of the map of that name, m; 0 without. Throws Error(input) for depths above 300 m.
Grid<float> depth_map(const Heightfield& input, const std::string& name,
                      const TerrainContext& context);

/// The input with its change and with what is still in the water; adds the maps "wear", "sediment"
/// and "carried".
Heightfield changed_ground(const Heightfield& input, const Grid<Grains>& change,
                           const Grid<Grains>& carried, std::map<std::string, Grid<float>>& maps,
                           Progress& progress);

}  // namespace wold::pipes_detail
