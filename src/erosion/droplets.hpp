#pragma once
// Water erosion by drops that run over the ground, take it up where they speed along and lay it
// down where they slow.
//
// A drop has a place p, a direction d (|d| = 1), a speed v (m/s), the share w of its water that is
// left, and carries sediment s (m³). It goes on one cell length L (m) at a time:
//
//   g = ∇h(p)                  bilinear in the four samples around p
//   d ← d e^(-L/ℓ) - g (1 - e^(-L/ℓ)),  made 1 long; ℓ: `inertia`, m
//   p' = p + L d,   S = (h(p) - h(p')) / L
//   S < 0 (up):     lay down min(-S L c², s) at p                        c: cell, m
//   else            C = k_c max(S, S_min) v w                            capacity, m³
//     s > C:        lay down (s - C) (1 - e^(-k_d L)), no higher than where the drop came from
//     s < C:        take up  (C - s) (1 - e^(-k_e L)), no deeper than p'
//   v² ← v² e^(-2 k L) + 2 g_e S L;  at most v_max                       k: drag, 1/m
//   w  ← w e^(-e L)                                                      e: evaporation, 1/m
//
// then d turns by a random angle of at most `scatter`. It ends when it leaves the ground, when it
// stands still with nothing to lay down, or after `distance`; what it then carries is laid down
// there, or leaves. All rates are per metre, so paths and amounts do not depend on the distance of
// samples.
//
// Between showers of drops, banks that they cut steeper than `bank_slope` slide (ground that was as
// steep before stays), and what was laid down creeps: it spreads by about `creep` until the end.
// Without, gullies become slots and plains get ripples.
//
// `variant = "momentum"` is the other model of the sources: the drop has a velocity (a vector)
// which the ground accelerates along each axis, unless the step is larger than `max_drop`, and
// C = k_c v w does not depend on the slope.
//
//   H. T. Beyer, "Implementation of a method for hydraulic erosion", bachelor's thesis, Technische
//   Universität München, 2015. There the step is "one cell" and its rates are per step; its rule
//   for the speed, v² + Δh g with Δh negative downhill, has the wrong sign, and misses a 2.
//
// Colours: the ground has a skin `color_depth` deep, mixed within; a drop takes its colour along
// with the ground, and what lay beneath (the picture's colour) comes into the skin; what it lays
// down mixes with the skin, the lowest part of which is buried. Brush and slides do not move them.
//
// Scheme. Heights and sediment are integers (of about a micrometre): what leaves one is added to
// the other, so nothing is lost. The ground is cut into square tiles in four colours (2 x 2). Tiles
// of one colour run side by side; each moves its drops one step at a time, up to 32 at once, and
// may write half a tile over its edge, which no tile of its colour does. Drops that go further go
// on in the tile where they then are, when its turn comes. So drops see what those before them did,
// and the result has the same bits for any number of threads. Rain falls in showers, one drop per
// cell of a lattice in the world, jittered: at the same places at every resolution. After each
// round of showers its change of the ground is spread over `radius`, as wide as with the thesis'
// cone of weights, max(0, r - |p_i - p|), but at no cost per step.

#include <string>

#include "terrain/operator.hpp"

namespace wold {

enum class DropletVariant { slope, momentum };

struct Droplets {
  DropletVariant variant = DropletVariant::slope;
  float rain = 0.15F;           ///< drops per m²
  float distance = 1200;        ///< m
  float inertia = 3;            ///< m
  float scatter = 15;           ///< degrees
  float capacity = 6;           ///< m³ of a drop at slope 1 and 1 m/s
  float min_slope = 0.01F;      ///< of the capacity
  float erosion = 0.005F;       ///< 1/m
  float deposition = 0.02F;     ///< 1/m
  float evaporation = 0.0025F;  ///< 1/m
  float gravity = 9.81F;        ///< m/s²
  float drag = 0.05F;           ///< 1/m
  float max_speed = 20;         ///< m/s
  float max_drop = 1000;        ///< m
  float radius = 8;             ///< m
  float bank_slope = 45;        ///< degrees
  float creep = 12;             ///< m
  std::string hardness = {};
  bool hardness_invert = false;
  std::string rain_map = {};
  bool closed_border = false;
  float contrast = 0.5F;  ///< of the flow map
  FilePath color = {};
  float color_depth = 0.5F;  ///< m
};

Description<Droplets> describe(const Droplets&);

/// Maps: "flow" (0 to 1), "discharge" (m², the area whose drops pass), "velocity" (m/s), "wear" (m
/// taken up), "sediment" (m laid down); with `color` also "color.red", "color.green", "color.blue".
/// Throws Error(input), Error(io) for an unreadable picture, Error(cancelled).
TerrainResult droplets(const Heightfield& input, const Droplets& parameters,
                       const TerrainContext& context);

}  // namespace wold
