#pragma once
// A grid whose samples are shifted, each by a random vector: water that runs from sample to sample
// then does not know the axes.
//
//   p_k = x_k + shift cell r_k,  r_k uniform in [-1, 1]², 0 on the border
//
// Between samples the shift is that of the samples around, bicubic; so a value at any place is
// found where place = x + shift(x).

#include <cstdint>

#include "base/progress.hpp"
#include "terrain/heightfield.hpp"

namespace wold {

class StreamPowerMesh {
 public:
  static constexpr float shift = 0.36F;  ///< cells; below 0.5 no two samples change places

  StreamPowerMesh() = default;
  /// Over the samples of `grid`. Where it is not real, samples lie where the grid has them and the
  /// mesh only tells distances.
  StreamPowerMesh(const Heightfield& grid, std::uint64_t seed, bool real);

  bool is_real = false;

  /// 1 / distance, in cells, of each sample to its neighbour d = 0 to 3; 1 where it has none.
  Grid<float> nearness(int d, Progress& progress) const;
  /// Heights at the samples.
  Grid<float> shifted(const Heightfield& field, Progress& progress) const;
  /// Values of these samples at those of a finer mesh.
  Grid<float> laid_over(const Grid<float>& values, const StreamPowerMesh& finer,
                        Progress& progress) const;

 private:
  DVec2 shift_at(DVec2 x) const;

  Heightfield x_shift_;  ///< m
  Heightfield y_shift_;  ///< m
};

}  // namespace wold
