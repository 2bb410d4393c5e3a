#pragma once
// What two scenes have in common: so that a viewer need not build again what has not changed.

#include "scene/scene.hpp"

namespace wold {

/// Whether both have the same land: terrain, steps, surroundings and seed. Never, if files may have
/// changed in between: with steps that read one.
bool same_land(const Scene& a, const Scene& b);

/// Whether both grow the same models of plants.
bool same_models(const Scene& a, const Scene& b);

/// Whether both have the same sky.
bool same_sky(const Scene& a, const Scene& b);

/// Whether both skies are the same but for where the sun stands: time, place and its angles.
bool same_but_sun(const SkySettings& a, SkySettings b);

}  // namespace wold
