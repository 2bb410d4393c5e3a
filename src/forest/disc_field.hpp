#pragma once
// Discs in a rectangle, none of which may overlap another; found by place.
//
// Discs come in size classes, class 0 with the largest radii and each next with at most half of
// them. They must be added class by class: then a new disc is at most as large as the largest of
// any class present, and 3 × 3 cells of each class's grid hold all it may touch.

#include <cstdint>
#include <span>
#include <vector>

#include "base/vec.hpp"

namespace wold {

enum class DiscFit {
  free,       ///< touches no disc
  uncertain,  ///< touches only discs that may not be there
  taken       ///< touches a disc that is there
};

class DiscField {
 public:
  /// `class_radius[k]`: largest radius of class k, m, falling with k.
  DiscField(DVec2 low, DVec2 high, std::span<const float> class_radius);

  DiscFit test(DVec2 centre, float radius, int size_class) const;
  void add(DVec2 centre, float radius, int size_class, bool certain);

 private:
  struct Disc {
    DVec2 centre{0};
    float radius = 0;
    std::int32_t next = -1;
    bool certain = true;
  };
  struct Layer {
    double cell = 1;
    int columns = 0;
    int rows = 0;
    std::vector<std::int32_t> first;  // disc of each cell, -1 for none
  };
  IVec2 cell_of(const Layer& layer, DVec2 place) const;

  DVec2 low_;
  std::vector<Layer> layers_;
  std::vector<Disc> discs_;
};

}  // namespace wold
