#pragma once
// The parts that a plant's mesh falls into, and the curve along each.
//
// The curve of a part is that of the level sets of distance along its surface from one of its ends
// (Verroust and Lazarus, "Extracting skeletal curves from 3D scattered data", The Visual Computer
// 16, 2000): its points are the centres of where that distance crosses a value. It needs nothing
// but the triangles, so models from files are as good as grown ones.

#include <cstdint>
#include <span>
#include <vector>

#include "base/mesh.hpp"

namespace wold {

/// Triangles that hang together by shared vertices within one part of a mesh: a leaf, a needle, a
/// blade of grass, a branch with all its bends.
struct PlantElement {
  std::uint32_t part = 0;
  std::uint32_t first = 0;  ///< in PlantElements::triangles
  std::uint32_t count = 0;
  float area = 0;  ///< m², of one side
};

struct PlantElements {
  std::vector<PlantElement> list;        ///< by first triangle in the mesh
  std::vector<std::uint32_t> triangles;  ///< of the mesh, element after element

  std::span<const std::uint32_t> of(const PlantElement& e) const {
    return std::span(triangles).subspan(e.first, e.count);
  }
};

PlantElements plant_elements(const TriangleMesh& mesh);

/// The middle line of an element.
struct PlantCurve {
  std::vector<Vec3> centre;  ///< m
  std::vector<float> width;  ///< m, area per length about each centre: of a tube its girth
  Vec3 side{0};              ///< unit, across a flat element
  float length = 0;          ///< m
};

/// With `segments` + 1 centres, even in distance along the surface.
PlantCurve plant_curve(const TriangleMesh& mesh, std::span<const std::uint32_t> triangles,
                       int segments);

float triangle_area(const TriangleMesh& mesh, std::uint32_t triangle);

}  // namespace wold
