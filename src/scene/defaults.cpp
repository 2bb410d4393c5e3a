#include "scene/defaults.hpp"

namespace wold {

const char* const default_steps =
    R"([[terrain.step]]           # broad hills
op = "fbm"
height = 200               # m
base = 280                 # m
feature_size = 1300        # m
octaves = 4
hurst = 1.1

[[terrain.step]]           # valleys, cut into them
op = "ridged"
blend = "subtract"
height = 320               # m
feature_size = 2400        # m
octaves = 2
hurst = 1.2
smooth_ridges = 0.12

[[terrain.step]]           # that wind
op = "warp"
distance = 100             # m
feature_size = 900         # m

[[terrain.step]]           # small hills
op = "fbm"
height = 30                # m
feature_size = 300         # m
hurst = 1.1

[[terrain.step]]           # and a level valley floor
op = "smooth_floor"
level = 90                 # m
softness = 140             # m
)";

const char* const default_forest =
    R"([[species]]
name = "birch"
plant = "plants/birch.lsys"
height = [9, 16]           # m
models = 4

[[species]]
name = "spruce"
plant = "plants/spruce.lsys"
height = [9, 22]           # m
models = 4

[[species]]
name = "oak"
plant = "plants/oak.lsys"
height = [9, 15]           # m
models = 3

[[species]]
name = "hazel"
plant = "plants/hazel.lsys"
height = [1.4, 3]          # m
models = 3

[[species]]
name = "fern"
plant = "plants/fern.lsys"
height = [0.35, 0.75]      # m

[[species]]
name = "grass"
plant = "plants/grass.lsys"
height = [0.15, 0.45]      # m

[[species]]
name = "bilberry"
plant = "plants/bilberry.lsys"
height = [0.2, 0.4]        # m
models = 3

[[species]]
name = "daisy"
plant = "plants/daisy.lsys"
height = [0.2, 0.45]       # m
models = 3

[[scatter]]                # trees, in woods with glades between
species = { birch = 4, spruce = 5, oak = 1 }
density = 0.02             # per m²
slope = [0, 40]            # degrees
clumping = 0.75
clump_size = 150           # m
patchiness = 0.7
patch_size = 90            # m

[[scatter]]                # young growth
species = { hazel = 3, spruce = 1 }
density = 0.004            # per m²
scale = [0.3, 1]
clumping = 0.6

[[scatter]]                # undergrowth, near the camera only
species = { grass = 40, fern = 2, bilberry = 2, daisy = 2 }
density = 9                # per m²
within = 70                # m
patchiness = 0.75
patch_size = 6             # m
)";

}  // namespace wold
