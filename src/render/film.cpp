#include "render/film.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

#include "base/error.hpp"
#include "base/memory.hpp"

namespace wold {

namespace {

bool finite(const PathSample& s) {
  const Vec3 sum = s.radiance + s.albedo + s.normal;
  return std::isfinite(sum.x + sum.y + sum.z + s.depth);
}

/// Sums over all pixels need no order: they are integers.
template <class Pixels, class Value>
std::uint64_t sum_over(const Pixels& pixels, const Value& value) {
  std::uint64_t sum = 0;
  for (const auto& p : pixels.values()) sum += value(p);
  return sum;
}

}  // namespace

Film::Film(int width, int height) {
  // What writing will need beside the film: the picture with its layers, and a copy for its file.
  constexpr double bytes_to_write = 2 * 12 * sizeof(float);
  const double bytes = static_cast<double>(width) * height * (sizeof(Pixel) + bytes_to_write);
  const auto free = static_cast<double>(available_memory());
  if (free > 0 && bytes > 0.9 * free)
    throw Error(ErrorKind::limit, "a picture of " + std::to_string(width) + " x " +
                                      std::to_string(height) + " needs " + memory_text(bytes) +
                                      ", but only " + memory_text(free) +
                                      " are free; choose a smaller size");
  pixels_ = Grid<Pixel>(width, height);
}

void Film::add(int x, int y, const PathSample& sample) {
  Pixel& p = pixels_(x, y);
  if (!finite(sample)) {
    ++p.rejected;
    return;
  }
  p.radiance += DVec3(sample.radiance);
  p.albedo += sample.albedo;
  p.normal += sample.normal;
  p.depth += sample.depth;
  p.cover += sample.cover;
  ++p.count;
}

std::uint64_t Film::total_samples() const {
  return sum_over(pixels_, [](const Pixel& p) { return p.count; });
}

std::uint64_t Film::rejected() const {
  return sum_over(pixels_, [](const Pixel& p) { return p.rejected; });
}

std::uint32_t Film::least_samples() const {
  std::uint32_t least = std::numeric_limits<std::uint32_t>::max();
  for (const Pixel& p : pixels_.values()) least = std::min(least, p.count);
  return least;
}

Image Film::image() const {
  Image image(width(), height(),
              {"R", "G", "B", "A", "albedo.R", "albedo.G", "albedo.B", "normal.X", "normal.Y",
               "normal.Z", "depth.Z", "samples"});
  for (int y = 0; y < height(); ++y) {
    for (int x = 0; x < width(); ++x) {
      const Pixel& p = pixels_(x, y);
      const auto row = image.row(y).subspan(static_cast<std::size_t>(x) * image.channels.size());
      row[10] = std::numeric_limits<float>::infinity();
      if (p.count == 0) continue;
      const auto n = static_cast<float>(p.count);
      const Vec3 radiance(p.radiance /
                          (static_cast<double>(p.count) * static_cast<double>(white_luminance)));
      for (int c = 0; c < 3; ++c) {
        const auto k = static_cast<std::size_t>(c);
        row[k] = radiance[c];
        row[4 + k] = p.albedo[c] / n;
        row[7 + k] = p.normal[c] / n;
      }
      row[3] = p.cover / n;
      if (p.cover > 0) row[10] = p.depth / p.cover;
      row[11] = n;
    }
  }
  return image;
}

}  // namespace wold
