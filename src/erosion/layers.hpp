#pragma once
// Erosion by running water of land that is made of layers: hard ones stand as cliffs, soft ones lie
// back as slopes.
//
// After Šťava, Beneš, Brisbin, Křivánek (2008), "Interactive Terrain Modeling Using Hydraulic
// Erosion". Their cells hold the thickness of each layer; ours hold one height, and the layers are
// surfaces in space: a stack of given thicknesses from the top down, again and again, tilted by
// `dip`, warped by `undulation`, and draped over the land at first as far as `drape` says. With the
// depth σ of a place below the top of the stack along the vertical,
//
//   σ(x, y, z) = top + (tan dip) (x, y)·direction + undulation n(x, y) + drape (b_0 - mean b_0) - z
//
// the layer of a place is the one whose part of the stack σ modulo its total thickness lies in. On
// top lies loose ground r: what was laid down or slid there (their topmost layer).
//
//   water      as in pipes.hpp; K_s of the exposed layer is multiplied by 1 - hardness and C by its
//              capacity; a step takes far less than a layer, so that their rule for going
//              through several layers at once, T_k = C_k |v| sin α - Σ_{i>k} b_i, is that of one
//   slides     a wall between two cells l apart may climb as far as its layers allow together:
//              Σ_k thickness_k / tan talus_k <= l over the layers in the wall, the hard ones steep;
//              what exceeds that falls, and is loose where it comes to lie
//
// The last is our mending: a talus angle of the layer on top alone makes cliffs of soft rock under
// a hard cap. Scheme, steps, mass and ladder are those of pipes.hpp.

#include <string>
#include <vector>

#include "erosion/pipes.hpp"

namespace wold {

/// Rain, springs and rivers of a canyon.
Pipes canyon_water();

struct Layers {
  std::vector<double> thickness{35, 45, 20, 60, 30, 50};               ///< m, from the top down
  std::vector<double> layer_hardness{0.7, 0.1, 0.75, 0.05, 0.8, 0.2};  ///< 0 to 1
  std::vector<double> layer_angle{74, 33, 76, 31, 78, 34};             ///< degrees: steepest slope
  std::vector<double> layer_capacity{1, 1, 1, 1, 1, 1};                ///< factor of the capacity
  float top = 0;                 ///< m, height of the top of the stack; 0: of the highest ground
  float dip = 1;                 ///< degrees
  float dip_direction = 120;     ///< degrees clockwise from north: where the layers go down
  float undulation = 6;          ///< m
  float undulation_size = 1500;  ///< m
  float drape = 0;               ///< 0 level, 1 along the land
  float loose_angle = 33;        ///< degrees, of loose ground
  Pipes water = canyon_water();
};

Description<Layers> describe(const Layers&);

/// Maps: those of `pipes`, and "layer" (index of the exposed layer from the top down, -1 under more
/// than half a metre of loose ground), "strata" (σ at the surface, m: what colours go by), "loose"
/// (m). Throws as `pipes`, and Error(input) for lists that do not fit together.
TerrainResult layers(const Heightfield& input, const Layers& parameters,
                     const TerrainContext& context);

}  // namespace wold
