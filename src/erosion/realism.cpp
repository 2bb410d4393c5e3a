#include "erosion/realism.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

#include "base/parallel.hpp"
#include "base/vec.hpp"
#include "erosion/drainage_depressions.hpp"
#include "erosion/ground.hpp"
#include "erosion/realism_curves.hpp"
#include "terrain/analysis.hpp"
#include "terrain/blur.hpp"
#include "terrain/field_map.hpp"

namespace wold {

namespace {

constexpr double none = std::numeric_limits<double>::quiet_NaN();
constexpr double steep = 35;                   // degrees
constexpr std::size_t samples_shown = 200000;  // of the field; a few hundredths are channels
constexpr double least_in_bin = 10;            // channel samples, for a bin to count

struct Moments {
  double second = 0;
  double third = 0;
};

void measure_heights(Analysis& a) {
  Realism& r = a.realism;
  const HeightStatistics range = height_statistics(a.field);
  r.lowest = static_cast<double>(range.min);
  r.highest = static_cast<double>(range.max);
  r.mean_height = range.mean;
  r.relief = r.highest - r.lowest;
  const Grid<float>& h = a.field.height;
  const Moments sum = parallel_reduce(
      0, h.height(), Moments{},
      [&](int j) {
        Moments m;
        for (const float v : h.row(j)) {
          const double d = static_cast<double>(v) - range.mean;
          m.second += d * d;
          m.third += d * d * d;
        }
        return m;
      },
      [](const Moments& x, const Moments& y) {
        return Moments{x.second + y.second, x.third + y.third};
      });
  const auto n = static_cast<double>(h.size());
  r.deviation = std::sqrt(sum.second / n);
  r.skewness = r.deviation > 0 ? sum.third / n / std::pow(r.deviation, 3) : 0;
  r.hypsometric_integral = r.relief > 0 ? (r.mean_height - r.lowest) / r.relief : none;
  a.hypsometry = hypsometric_curve(a.field);
}

void measure_slopes(Analysis& a) {
  const Grid<float> slope = slope_map(a.field);
  std::vector<double> count(90, 0.0);
  double sum = 0;
  double above = 0;
  for (const float s : slope.values()) {
    ++count[static_cast<std::size_t>(std::clamp(s, 0.0F, 89.9F))];
    sum += static_cast<double>(s);
    above += static_cast<double>(s) > steep ? 1 : 0;
  }
  const auto n = static_cast<double>(slope.size());
  std::vector<float> sorted(slope.values().begin(), slope.values().end());
  const auto middle = sorted.begin() + static_cast<std::ptrdiff_t>(sorted.size() / 2);
  std::nth_element(sorted.begin(), middle, sorted.end());
  a.realism.mean_slope = sum / n;
  a.realism.median_slope = static_cast<double>(*middle);
  a.realism.steep_share = above / n;
  for (double& c : count) c /= n;
  a.slope_histogram = std::move(count);
}

/// Root of the sum of squares of the differences to the 8 neighbours, mean over the field.
double mean_ruggedness(const Grid<float>& h) {
  const double sum = parallel_reduce(
      0, h.height(), 0.0,
      [&](int j) {
        double of_row = 0;
        for (int i = 0; i < h.width(); ++i) {
          double squares = 0;
          for (std::size_t n = 0; n < 8; ++n) {
            const double d = static_cast<double>(h.clamped(i + flow_dx[n], j + flow_dy[n])) -
                             static_cast<double>(h(i, j));
            squares += d * d;
          }
          of_row += std::sqrt(squares);
        }
        return of_row;
      },
      [](double x, double y) { return x + y; });
  return sum / static_cast<double>(h.size());
}

void measure_spectrum(Analysis& a, Progress& progress) {
  a.spectrum = power_spectrum(a.field, progress);
  const double extent = std::max(a.field.size().x, a.field.size().y);
  const double from = 1 / (a.options.longest_wave * extent);
  const double to = 1 / (a.options.shortest_wave * a.field.cell);
  std::vector<CurvePoint> band;
  for (const CurvePoint& p : a.spectrum)
    if (p.x >= from && p.x <= to) band.push_back(p);
  a.spectrum_fit = fit_power(band, 0);
  a.realism.spectrum_slope = a.spectrum_fit.slope;
}

/// Calls `visit(k, receiver, distance)` for all channel samples whose water goes on.
template <class Visit>
void each_channel(const Analysis& a, const Visit& visit) {
  for (int k = 0; k < static_cast<int>(a.order.size()); ++k) {
    const auto at = static_cast<std::size_t>(k);
    const std::uint8_t d = a.direction.values()[at];
    if (a.order.values()[at] == 0 || d >= flow_stops) continue;
    visit(k, k + flow_step(d, a.order.width()), flow_distance(d) * a.field.cell);
  }
}

void measure_channels(Analysis& a, const Grid<float>& sloping, const FlowOrder& order) {
  const auto at = [](const auto& grid, int k) {
    return static_cast<double>(grid.values()[static_cast<std::size_t>(k)]);
  };
  const Grid<float> length = upstream_length(a.direction, order, a.field.cell);
  LogBins slopes(10);
  LogBins lengths(10);
  double total = 0;
  int outside_lakes = 0;
  const int every = 1 + static_cast<int>(a.order.size() / samples_shown);
  each_channel(a, [&](int k, int receiver, double distance) {
    total += distance;
    lengths.add(at(a.area, k), at(length, k));
    const bool lake = at(a.filled, k) > at(a.field.height, k) ||
                      at(a.filled, receiver) > at(a.field.height, receiver);
    if (lake) return;
    const double slope = (at(sloping, k) - at(sloping, receiver)) / distance;
    slopes.add(at(a.area, k), slope);
    if (++outside_lakes % every == 0) a.slope_area_samples.push_back({at(a.area, k), slope, 1});
  });
  a.slope_area = slopes.points();
  a.length_area = lengths.points();
  a.slope_area_fit = fit_power(a.slope_area, least_in_bin);
  a.hack_fit = fit_power(a.length_area, least_in_bin);
  a.realism.concavity = -a.slope_area_fit.slope;
  a.realism.concavity_fit = a.slope_area_fit.r2;
  a.realism.hack_exponent = a.hack_fit.slope;
  const double land = static_cast<double>(a.order.size()) * a.field.cell * a.field.cell;
  a.realism.drainage_density = total / land * 1000;
}

/// Streams of each order, from 1: maximal ways through samples of it.
std::vector<double> streams_by_order(const Analysis& a) {
  std::vector<double> count;
  for (int k = 0; k < static_cast<int>(a.order.size()); ++k) {
    const std::uint8_t order = a.order.values()[static_cast<std::size_t>(k)];
    if (order == 0) continue;
    bool begins = true;
    each_donor(a.direction, k, [&](int n) {
      begins = begins && a.order.values()[static_cast<std::size_t>(n)] != order;
    });
    if (count.size() < order) count.resize(order, 0.0);
    if (begins) ++count[order - 1U];
  }
  return count;
}

void measure_orders(Analysis& a) {
  const std::vector<double> streams = streams_by_order(a);
  a.realism.highest_order = static_cast<int>(streams.size());
  a.realism.bifurcation = none;
  if (streams.size() < 2) return;
  // Slope of the logarithms of the counts.
  const auto n = static_cast<double>(streams.size());
  double moment = 0;
  for (std::size_t k = 0; k < streams.size(); ++k)
    moment += (static_cast<double>(k) - (n - 1) / 2) * std::log(std::max(1.0, streams[k]));
  a.realism.bifurcation = std::exp(-moment * 12 / (n * (n * n - 1)));
}

void measure_drainage(Analysis& a, Progress& progress) {
  const Grid<float>& height = a.field.height;
  a.filled = fill_depressions(height, FillSurface::level, progress);
  const Grid<float> sloping = fill_depressions(height, FillSurface::sloping, progress);
  a.direction = d8_directions(sloping, progress);
  const FlowOrder order(a.direction, progress);
  a.area = d8_area(a.direction, order, a.field.cell);
  a.basins = basin_labels(a.direction, order);
  a.order = strahler_order(a.direction, order, a.area, a.options.channel_area);
  measure_channels(a, sloping, order);
  measure_orders(a);
  a.realism.pits = count_pits(height);
  double lakes = 0;
  for (std::size_t k = 0; k < height.size(); ++k)
    lakes += a.filled.values()[k] > height.values()[k] ? 1 : 0;
  a.realism.lake_share = lakes / static_cast<double>(height.size());
}

}  // namespace

Analysis analyze(const Heightfield& field, const AnalysisOptions& options, Progress& progress) {
  check_ground(field, "analyze");
  Analysis a;
  a.options = options;
  a.field = field;
  const ProgressStage stage(progress, "analysis", 4, "parts");
  measure_heights(a);
  progress.advance();
  measure_slopes(a);
  a.realism.ruggedness = mean_ruggedness(field.height);
  progress.advance();
  measure_spectrum(a, progress);
  progress.advance();
  measure_drainage(a, progress);
  progress.advance();
  return a;
}

std::vector<Figure> figures(const Realism& r) {
  const auto plain = [](const char* name, double value, const char* unit, const char* text) {
    return Figure{name, value, unit, text, none, none, {}};
  };
  return {
      plain("lowest", r.lowest, "m", "lowest height"),
      plain("highest", r.highest, "m", "highest height"),
      plain("mean_height", r.mean_height, "m", "mean height"),
      plain("relief", r.relief, "m", "highest less lowest"),
      plain("deviation", r.deviation, "m", "standard deviation of heights"),
      plain("mean_slope", r.mean_slope, "degrees", "mean slope"),
      plain("median_slope", r.median_slope, "degrees", "median slope"),
      plain("steep_share", r.steep_share, "", "share of the area above 35 degrees"),
      plain("ruggedness", r.ruggedness, "m",
            "mean difference to the 8 neighbours (Riley 1999); grows with the cell"),
      {"hypsometric_integral", r.hypsometric_integral, "", "area under the hypsometric curve", 0.35,
       0.6, "Strahler 1952, mature land"},
      {"skewness", r.skewness, "", "of heights; above 0 where lowlands prevail", 0, 2,
       "lowlands prevail on Earth's continents"},
      {"spectrum_slope", r.spectrum_slope, "", "exponent of power against wave number, in lines",
       -2.3, -1.7, "Huang and Turcotte 1989"},
      {"concavity", r.concavity, "", "theta of slope = k area^-theta along channels", 0.225, 0.575,
       "Gailleton et al. 2021, quartiles; median 0.425"},
      plain("concavity_fit", r.concavity_fit, "", "r^2 of that line"),
      {"hack_exponent", r.hack_exponent, "", "h of length = c area^h along channels", 0.5, 0.6,
       "Hack 1957"},
      {"bifurcation", r.bifurcation, "", "streams of an order for each of the next", 3, 5,
       "Horton 1945"},
      plain("highest_order", r.highest_order, "", "Strahler's order of the largest river"),
      plain("drainage_density", r.drainage_density, "km/km2",
            "length of channels per area; depends on channel_area"),
      {"pits", r.pits, "", "samples without a lower neighbour, off the border", 0, 0,
       "what rivers have shaped has none but lakes"},
      plain("lake_share", r.lake_share, "", "share of the area in depressions"),
  };
}

double relative_difference(const Heightfield& a, const Heightfield& b, Progress& progress) {
  const Heightfield& coarse = a.cell >= b.cell ? a : b;
  Heightfield fine = a.cell >= b.cell ? b : a;
  const double ratio = coarse.cell / fine.cell;
  // A Gaussian as wide as a box of the coarser cell.
  if (ratio > 1.01)
    fine.height = blurred(fine.height, std::sqrt((ratio * ratio - 1) / 12), progress);
  const Grid<float>& h = coarse.height;
  const double squares = parallel_reduce(
      0, h.height(), 0.0,
      [&](int j) {
        double of_row = 0;
        for (int i = 0; i < h.width(); ++i)
          of_row += std::pow(static_cast<double>(h(i, j)) -
                                 static_cast<double>(height_at(fine, place_of(coarse, i, j))),
                             2);
        return of_row;
      },
      [](double x, double y) { return x + y; });
  const HeightStatistics range = height_statistics(coarse);
  const double relief = static_cast<double>(range.max) - static_cast<double>(range.min);
  const double rms = std::sqrt(squares / static_cast<double>(h.size()));
  return relief > 0 ? rms / relief : (rms > 0 ? std::numeric_limits<double>::infinity() : 0);
}

}  // namespace wold
