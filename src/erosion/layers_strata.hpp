#pragma once
// The stack of layers, and what it is like at a depth. Symbols as in layers.hpp.

#include <cstddef>
#include <vector>

#include "erosion/layers.hpp"

namespace wold::layers_detail {

struct Layer {
  float hardness = 0;
  float tangent = 1;   ///< of the steepest slope
  float capacity = 1;  ///< factor
};

class Stack {
 public:
  /// Throws Error(input) for lists of other lengths or values that may not be.
  explicit Stack(const Layers& parameters);

  /// Index of the layer at depth σ (m).
  int index_at(float depth) const;
  const Layer& at(float depth) const { return layers_[static_cast<std::size_t>(index_at(depth))]; }
  /// Distance (m) over which the steepest stable wall climbs from depth σ to depth 0; negative
  /// above.
  float run_of(float depth) const;

 private:
  /// The depth within one stack, and how many stacks lie above it.
  struct Place {
    float within;
    float stacks;
  };
  Place place(float depth) const;

  std::vector<Layer> layers_;
  std::vector<float> bottoms_;      ///< m, of each layer below the top of the stack
  std::vector<float> bottom_runs_;  ///< run_of each bottom
};

}  // namespace wold::layers_detail
