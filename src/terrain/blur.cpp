#include "terrain/blur.hpp"

#include <algorithm>
#include <cmath>
#include <vector>

#include "base/parallel.hpp"

namespace wold {

namespace {

int kernel_radius(double deviation) {
  return static_cast<int>(std::ceil(4 * deviation));
}

/// Weights of the samples at distance 0, 1, …; all together sum to 1.
std::vector<float> gaussian_kernel(double deviation) {
  std::vector<double> weights;
  double sum = 0;
  for (int k = 0; k <= kernel_radius(deviation); ++k) {
    weights.push_back(std::exp(-0.5 * k * k / (deviation * deviation)));
    sum += (k == 0 ? 1 : 2) * weights.back();
  }
  std::vector<float> kernel;
  for (const double w : weights) kernel.push_back(static_cast<float>(w / sum));
  return kernel;
}

void add_scaled(std::span<float> out, float weight, const float* a, const float* b) {
  for (std::size_t i = 0; i < out.size(); ++i) out[i] += weight * (a[i] + b[i]);
}

void scale_into(std::span<float> out, float weight, const float* a) {
  for (std::size_t i = 0; i < out.size(); ++i) out[i] = weight * a[i];
}

/// The number in [0, size) of the sample that stands for the k-th.
int inside(int k, int size, Outside outside) {
  if (k >= 0 && k < size) return k;
  if (outside == Outside::clamp || size == 1) return std::clamp(k, 0, size - 1);
  const int period = 2 * (size - 1);
  const int t = ((k % period) + period) % period;
  return std::min(t, period - t);
}

void blur_row(std::span<const float> in, std::span<float> out, const std::vector<float>& kernel,
              Outside outside) {
  const auto radius = static_cast<int>(kernel.size()) - 1;
  const auto size = static_cast<int>(in.size());
  std::vector<float> padded(in.size() + 2 * static_cast<std::size_t>(radius));
  float* middle = padded.data() + radius;
  std::copy(in.begin(), in.end(), middle);
  const auto outside_value = [&](int k) {
    return in[static_cast<std::size_t>(inside(k, size, outside))];
  };
  for (int k = 1; k <= radius; ++k) {
    middle[-k] = outside_value(-k);
    middle[size - 1 + k] = outside_value(size - 1 + k);
  }
  scale_into(out, kernel[0], middle);
  for (std::size_t k = 1; k < kernel.size(); ++k)
    add_scaled(out, kernel[k], middle - k, middle + k);
}

}  // namespace

Description<Blur> describe(const Blur&) {
  return Description<Blur>("blur", "Smooths the ground.")
      .add("distance", &Blur::distance, {.unit = "m", .min = 0, .max = 1e5},
           "What is smaller than about this vanishes (standard deviation of the Gaussian).");
}

Grid<float> blurred(const Grid<float>& in, double deviation, Progress& progress, Outside outside) {
  if (deviation < 0.05 || in.empty()) return in;
  const std::vector<float> kernel = gaussian_kernel(deviation);
  Grid<float> along_x(in.width(), in.height());
  parallel_for(0, in.height(), [&](int j) {
    blur_row(in.row(j), along_x.row(j), kernel, outside);
    progress.advance(0);
  });
  Grid<float> out(in.width(), in.height());
  parallel_for(0, in.height(), [&](int j) {
    const auto row = [&](int k) { return along_x.row(inside(k, in.height(), outside)).data(); };
    scale_into(out.row(j), kernel[0], row(j));
    for (int k = 1; k < static_cast<int>(kernel.size()); ++k)
      add_scaled(out.row(j), kernel[static_cast<std::size_t>(k)], row(j - k), row(j + k));
    progress.advance(0);
  });
  return out;
}

Heightfield blur(const Heightfield& input, const Blur& parameters, const TerrainContext& context) {
  return {blurred(input.height, static_cast<double>(parameters.distance) / input.cell,
                  context.progress),
          input.origin, input.cell};
}

double reach_of(const Blur& parameters, double cell) {
  return cell * kernel_radius(static_cast<double>(parameters.distance) / cell);
}

}  // namespace wold
