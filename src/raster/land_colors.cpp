#include "raster/land_colors.hpp"

#include "base/parallel.hpp"

namespace wold {

namespace {

constexpr int cells = 96;  // on a side

}  // namespace

LandColors land_colors(const Ground& ground) {
  const Heightfield& field = ground.field();
  const DVec2 size = field.size();
  const DVec2 cell = size / double{cells};
  const auto footprint = static_cast<float>(std::max(cell.x, cell.y));
  LandColors out{Grid<Vec3>(cells, cells), Vec4(0)};
  parallel_for(0, cells, [&](int j) {
    for (int i = 0; i < cells; ++i)
      out.reflectance(i, j) =
          ground.surface(field.origin + (DVec2(i, j) + 0.5) * cell, footprint).reflectance;
  });
  out.place = Vec4(Vec2(1.0 / size), Vec2(-field.origin / size));
  return out;
}

}  // namespace wold
