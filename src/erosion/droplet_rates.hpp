#pragma once
// Parameters of drops as constants of one step.

#include "erosion/droplet_walk.hpp"
#include "erosion/droplets.hpp"

namespace wold {

/// For samples `cell` metres apart and heights in quanta of that many metres.
DropletRates droplet_rates(const Droplets& parameters, double cell, double quantum);

}  // namespace wold
