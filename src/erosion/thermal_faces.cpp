#include <algorithm>
#include <cmath>
#include <limits>

#include "base/vec.hpp"
#include "erosion/thermal_pass.hpp"

namespace wold {

namespace {

using Heights = const std::int32_t*;

/// Two ends of a row of faces, their difference of height and the square of the slope there.
struct Faces {
  float* drop;
  float* steepness;
  int count;
};

float difference(std::int32_t a, std::int32_t b) {
  return static_cast<float>(a - b);
}

void east_slopes(Heights south, Heights row, Heights north, const Faces& out) {
  for (int i = 0; i < out.count; ++i) {
    const float drop = difference(row[i], row[i + 1]);
    const float along =
        0.25F * (difference(north[i], south[i]) + difference(north[i + 1], south[i + 1]));
    out.drop[i] = drop;
    out.steepness[i] = drop * drop + along * along;
  }
}

void north_slopes(Heights row, Heights north, const Faces& out) {
  for (int i = 0; i < out.count; ++i) {
    const float drop = difference(row[i], north[i]);
    const float along =
        0.25F * (difference(row[i + 1], row[i - 1]) + difference(north[i + 1], north[i - 1]));
    out.drop[i] = drop;
    out.steepness[i] = drop * drop + along * along;
  }
}

void cross_slopes(Heights row, Heights north, float* rising, float* falling, float* steepness,
                  int count) {
  for (int i = 0; i < count; ++i) {
    rising[i] = difference(row[i], north[i + 1]);
    falling[i] = difference(row[i + 1], north[i]);
    steepness[i] = 0.5F * (rising[i] * rising[i] + falling[i] * falling[i]);
  }
}

// Without branches, so that loops of it use vectors: `x` where a condition holds, else 0.
std::int32_t where(bool condition, std::int32_t x) {
  return x & -static_cast<std::int32_t>(condition);
}

std::int32_t transfer(float rate, float drop, float steepness, float rest, float flow) {
  const float share = (steepness - flow) / (steepness + flow);
  return where(steepness > rest, static_cast<std::int32_t>(rate * drop * share));
}

void transfers(float rate, const SlideYield& yield, const Faces& faces,
               std::int32_t* __restrict out) {
  for (int i = 0; i < faces.count; ++i)
    out[i] = transfer(rate, faces.drop[i], faces.steepness[i], yield.rest, yield.flow);
}

/// With yields of the higher end.
struct EndYields {
  const float* rest_first;
  const float* rest_second;
  const float* flow_first;
  const float* flow_second;
};
void transfers(float rate, const EndYields& yield, const Faces& faces,
               std::int32_t* __restrict out) {
  for (int i = 0; i < faces.count; ++i) {
    const float drop = faces.drop[i];
    const float steepness = faces.steepness[i];
    const std::int32_t down =
        transfer(rate, drop, steepness, yield.rest_first[i], yield.flow_first[i]);
    const std::int32_t up =
        transfer(rate, drop, steepness, yield.rest_second[i], yield.flow_second[i]);
    out[i] = where(drop > 0, down) | where(drop <= 0, up);
  }
}

/// Where the two ends of the faces of a row begin in a framed grid.
struct Ends {
  int i_first, j_first, i_second, j_second;
};

void yields(const SlidePass& pass, const Ends& ends, const Faces& faces, std::int32_t* of_loose,
            std::int32_t* of_rock) {
  std::int32_t* mapped = of_rock != nullptr ? of_rock : of_loose;
  const bool has_map = !pass.rest_map.empty();
  if (of_rock != nullptr || !has_map) transfers(pass.rate, pass.loose, faces, of_loose);
  if (has_map) {
    const auto at = [&](GridView<const float> map, int i, int j) {
      return &map(i + slide_frame, j + slide_frame);
    };
    transfers(pass.rate,
              EndYields{at(pass.rest_map, ends.i_first, ends.j_first),
                        at(pass.rest_map, ends.i_second, ends.j_second),
                        at(pass.flow_map, ends.i_first, ends.j_first),
                        at(pass.flow_map, ends.i_second, ends.j_second)},
              faces, mapped);
  } else if (of_rock != nullptr) {
    transfers(pass.rate, pass.rock, faces, of_rock);
  }
}

/// Columns [from, to) of what lies in [a, b) as offsets; the rest is set to 0.
struct Columns {
  int from = 0;
  int to = 0;
};
Columns valid_columns(std::int32_t* out, int a, int b, int first, int last) {
  const int from = std::clamp(first, a, b) - a;
  const int to = std::max(from, std::clamp(last, a, b) - a);
  std::fill(out, out + from, 0);
  std::fill(out + to, out + (b - a), 0);
  return {from, to};
}

}  // namespace

float slide_step(double angle, double cell) {
  if (angle >= 90) return 1e37F;
  const double rise = std::tan(radians(std::max(0.0, angle))) * cell;
  return static_cast<float>(std::clamp(rise * rise, 1e-3, 1e36));
}

void slide_faces(const SlidePass& pass, SlideHeights from, int j, int a, int b,
                 const SlideFaces& of_loose, const SlideFaces* of_rock, float* work) {
  const bool inside = j >= 0 && j < pass.height;
  const bool north_inside = j >= 0 && j < pass.height - 1;
  const auto row = [&](int i, int k) { return &from(i + slide_frame, k + slide_frame); };
  const auto columns = [&](bool rows_inside, int last, bool second) {
    const int end = rows_inside ? last : a;
    const int begin = rows_inside ? 0 : a;
    if (of_rock != nullptr)
      valid_columns(second ? of_rock->second : of_rock->first, a, b, begin, end);
    return valid_columns(second ? of_loose.second : of_loose.first, a, b, begin, end);
  };
  const auto rock = [&](bool second, int offset) -> std::int32_t* {
    if (of_rock == nullptr) return nullptr;
    return (second ? of_rock->second : of_rock->first) + offset;
  };
  if (pass.diagonal) {
    const Columns c = columns(north_inside, pass.width - 1, false);
    columns(north_inside, pass.width - 1, true);
    const int i = a + c.from;
    const int count = c.to - c.from;
    if (count <= 0) return;
    float* rising = work;
    float* falling = work + (b - a);
    float* steepness = work + 2 * (b - a);
    cross_slopes(row(i, j), row(i, j + 1), rising, falling, steepness, count);
    yields(pass, {i, j, i + 1, j + 1}, {rising, steepness, count}, of_loose.first + c.from,
           rock(false, c.from));
    yields(pass, {i + 1, j, i, j + 1}, {falling, steepness, count}, of_loose.second + c.from,
           rock(true, c.from));
    return;
  }
  const Columns e = columns(inside, pass.width - 1, false);
  if (e.to > e.from) {
    const int i = a + e.from;
    const Faces faces{work, work + (b - a), e.to - e.from};
    east_slopes(row(i, j - 1), row(i, j), row(i, j + 1), faces);
    yields(pass, {i, j, i + 1, j}, faces, of_loose.first + e.from, rock(false, e.from));
  }
  const Columns n = columns(north_inside, pass.width, true);
  if (n.to > n.from) {
    const int i = a + n.from;
    const Faces faces{work, work + (b - a), n.to - n.from};
    north_slopes(row(i, j), row(i, j + 1), faces);
    yields(pass, {i, j, i, j + 1}, faces, of_loose.second + n.from, rock(true, n.from));
  }
}

}  // namespace wold
