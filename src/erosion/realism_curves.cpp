#include "erosion/realism_curves.hpp"

#include <algorithm>
#include <cmath>
#include <complex>
#include <limits>

#include "base/parallel.hpp"
#include "base/vec.hpp"
#include "terrain/analysis.hpp"

namespace wold {

namespace {

using Complex = std::complex<double>;

/// In place; the size is a power of 2 (Cooley and Tukey).
void transform(std::vector<Complex>& x) {
  const std::size_t n = x.size();
  for (std::size_t i = 1, j = 0; i < n; ++i) {
    std::size_t bit = n / 2;
    for (; (j & bit) != 0; bit /= 2) j ^= bit;
    j ^= bit;
    if (i < j) std::swap(x[i], x[j]);
  }
  for (std::size_t half = 1; half < n; half *= 2) {
    const double step = -pi_d / static_cast<double>(half);
    for (std::size_t k = 0; k < half; ++k) {
      const Complex turn = std::polar(1.0, step * static_cast<double>(k));
      for (std::size_t i = k; i < n; i += 2 * half) {
        const Complex odd = turn * x[i + half];
        x[i + half] = x[i] - odd;
        x[i] += odd;
      }
    }
  }
}

void remove_trend(std::vector<Complex>& x) {
  const auto n = static_cast<double>(x.size());
  double mean = 0;
  double moment = 0;
  for (std::size_t k = 0; k < x.size(); ++k) {
    mean += x[k].real() / n;
    moment += (static_cast<double>(k) - (n - 1) / 2) * x[k].real();
  }
  const double slope = moment * 12 / (n * (n * n - 1));
  for (std::size_t k = 0; k < x.size(); ++k)
    x[k] -= mean + slope * (static_cast<double>(k) - (n - 1) / 2);
}

using Powers = std::vector<double>;

Powers sum_of(Powers a, const Powers& b) {
  for (std::size_t k = 0; k < a.size(); ++k) a[k] += b[k];
  return a;
}

int power_of_two_within(int n) {
  int p = 1;
  while (2 * p <= n) p *= 2;
  return p;
}

/// The powers at wave numbers 1 … m / 2 - 1 of a line of samples: mean of its first and last m.
template <class At>
Powers line_powers(int samples, const At& at) {
  const int m = power_of_two_within(samples);
  Powers powers(static_cast<std::size_t>(m / 2), 0.0);
  for (const int start : {0, samples - m}) {
    std::vector<Complex> line;
    for (int k = 0; k < m; ++k) line.emplace_back(static_cast<double>(at(start + k)));
    remove_trend(line);
    for (int k = 0; k < m; ++k)
      line[static_cast<std::size_t>(k)] *= 0.5 - 0.5 * std::cos(2 * pi_d * k / m);
    transform(line);
    for (std::size_t k = 1; k < powers.size(); ++k) powers[k] += 0.5 * std::norm(line[k]);
  }
  return powers;
}

/// Mean over `lines` lines.
template <class Line>
void add_powers(LogBins& bins, int lines, int samples, double cell, const Line& line,
                Progress& progress) {
  const int m = power_of_two_within(samples);
  if (m < 8) return;
  const Powers sum = parallel_reduce(
      0, lines, Powers(static_cast<std::size_t>(m / 2), 0.0),
      [&](int j) {
        progress.check();
        return line_powers(samples, [&](int k) { return line(j, k); });
      },
      sum_of);
  // Both signs of the wave number; Σ w² of Hann's window is 3 m / 8.
  const double scale = 2 * cell / (0.375 * m) / lines;
  for (std::size_t k = 1; k < sum.size(); ++k)
    bins.add(static_cast<double>(k) / (m * cell), scale * sum[k]);
}

}  // namespace

double PowerFit::at(double x) const {
  return std::pow(10.0, at_one + slope * std::log10(x));
}

PowerFit fit_power(const std::vector<CurvePoint>& points, double least_weight) {
  double n = 0;
  DVec2 mean(0);
  PowerFit fit;
  const auto used = [&](const CurvePoint& p) {
    return p.x > 0 && p.y > 0 && p.weight >= least_weight;
  };
  for (const CurvePoint& p : points) {
    if (!used(p)) continue;
    if (n == 0) fit.from = p.x;
    fit.to = p.x;
    mean += DVec2(std::log10(p.x), std::log10(p.y));
    ++n;
  }
  mean /= std::max(n, 1.0);
  double xx = 0;
  double xy = 0;
  double yy = 0;
  for (const CurvePoint& p : points) {
    if (!used(p)) continue;
    const DVec2 d = DVec2(std::log10(p.x), std::log10(p.y)) - mean;
    xx += d.x * d.x;
    xy += d.x * d.y;
    yy += d.y * d.y;
  }
  constexpr double none = std::numeric_limits<double>::quiet_NaN();
  if (n < 3 || !(xx > 0)) return {none, none, none, 0, 0, 0};
  fit.least_weight = least_weight;
  fit.slope = xy / xx;
  fit.at_one = mean.y - fit.slope * mean.x;
  fit.r2 = yy > 0 ? xy * xy / (xx * yy) : 1;
  return fit;
}

void LogBins::add(double x, double y) {
  if (!(x > 0)) return;
  const int k = static_cast<int>(std::floor(std::log10(x) * per_decade_));
  if (bins_.empty()) first_ = k;
  if (k < first_) {
    bins_.insert(bins_.begin(), static_cast<std::size_t>(first_ - k), Bin{});
    first_ = k;
  }
  if (static_cast<std::size_t>(k - first_) >= bins_.size())
    bins_.resize(static_cast<std::size_t>(k - first_) + 1);
  Bin& bin = bins_[static_cast<std::size_t>(k - first_)];
  bin.log_x += std::log10(x);
  bin.y += y;
  ++bin.count;
}

std::vector<CurvePoint> LogBins::points() const {
  std::vector<CurvePoint> out;
  for (const Bin& bin : bins_)
    if (bin.count > 0)
      out.push_back({std::pow(10.0, bin.log_x / bin.count), bin.y / bin.count, bin.count});
  return out;
}

std::vector<CurvePoint> power_spectrum(const Heightfield& field, Progress& progress) {
  const Grid<float>& h = field.height;
  LogBins bins(4 / std::log10(2.0));
  add_powers(
      bins, h.height(), h.width(), field.cell, [&](int j, int k) { return h(k, j); }, progress);
  add_powers(
      bins, h.width(), h.height(), field.cell, [&](int i, int k) { return h(i, k); }, progress);
  return bins.points();
}

std::vector<CurvePoint> hypsometric_curve(const Heightfield& field) {
  constexpr int levels = 100;
  const HeightStatistics range = height_statistics(field);
  std::vector<float> sorted(field.height.values().begin(), field.height.values().end());
  std::sort(sorted.begin(), sorted.end());
  std::vector<CurvePoint> curve;
  for (int k = levels; k >= 0; --k) {
    const double e = static_cast<double>(k) / levels;
    const auto level = static_cast<float>(range.min + e * (range.max - range.min));
    const auto above = sorted.end() - std::lower_bound(sorted.begin(), sorted.end(), level);
    curve.push_back({static_cast<double>(above) / static_cast<double>(sorted.size()), e, 1});
  }
  return curve;
}

}  // namespace wold
