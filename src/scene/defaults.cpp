#include "scene/defaults.hpp"

namespace wold {

const char* const default_steps = R"(# The land: broad hills, and smaller ones upon them.
[[terrain.step]]
op = "fbm"
height = 150               # m
feature_size = 1600        # m
octaves = 4

[[terrain.step]]
op = "eroded_noise"
height = 90                # m
feature_size = 700         # m
)";

const char* const default_forest =
    R"(# Plants: each species is a text file that grows a few individuals.
[[species]]
name = "birch"
plant = "plants/birch.lsys"
height = [9, 16]           # m

[[species]]
name = "spruce"
plant = "plants/spruce.lsys"
height = [10, 22]          # m

[[species]]
name = "oak"
plant = "plants/oak.lsys"
height = [9, 15]           # m

[[species]]
name = "hazel"
plant = "plants/hazel.lsys"
height = [1.6, 3.2]        # m

[[species]]
name = "fern"
plant = "plants/fern.lsys"
height = [0.4, 0.8]        # m

[[species]]
name = "grass"
plant = "plants/grass.lsys"
height = [0.15, 0.4]       # m

# Where they stand.
[[scatter]]
species = { birch = 3, spruce = 3, oak = 1 }
density = 0.012            # per m²
slope = [0, 38]            # degrees
clumping = 0.8
clump_size = 120           # m

[[scatter]]
species = { hazel = 1 }
density = 0.004            # per m²
clumping = 0.6

[[scatter]]
species = { fern = 2, grass = 30 }
density = 7                # per m²
within = 60                # m from the camera
)";

}  // namespace wold
