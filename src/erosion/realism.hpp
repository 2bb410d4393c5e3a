#pragma once
// How natural ground is, in numbers: the measures by which geomorphology describes real landscapes,
// with what they are there.
//
// - Concavity θ of S = k A^-θ: slopes along D8 ways over the filled ground, outside lakes, averaged
//   in ten bins per decade of upstream area A, where there is a channel; a line through the bins
//   with both axes logarithmic (Flint, "Stream gradient as a function of order, magnitude, and
//   discharge", 1974). Rivers of the world: median 0.425, quartiles 0.225 and 0.575 (Gailleton et
//   al., "Impact of changing concavity indices on channel steepness and divide migration metrics",
//   2021).
// - Hack's exponent of L = c A^h, L the longest way upstream: 0.6 (Hack, "Studies of longitudinal
//   stream profiles in Virginia and Maryland", 1957), 0.5 to 0.6 elsewhere.
// - Spectrum: of each row and column, its trend removed, under a Hann window, the mean power at
//   each wavelength; a line through it with both axes logarithmic. Near -2 (Huang and Turcotte,
//   "Fractal mapping of digitized images", 1989). Brownian ground of Hurst exponent H has -(2H+1).
// - Hypsometry: the share of the area above each height (Strahler, "Hypsometric (area-altitude)
//   analysis of erosional topography", 1952); its integral is 0.35 to 0.6 for mature land.
// - Bifurcation ratio: streams of an order for each of the next, 3 to 5 (Horton, "Erosional
//   development of streams and their drainage basins", 1945).
// - Ruggedness: the root of the sum of squares of the differences to the 8 neighbours (Riley,
//   DeGloria, Elliot, "A terrain ruggedness index that quantifies topographic heterogeneity",
//   1999).

#include <cstdint>
#include <string>
#include <vector>

#include "base/progress.hpp"
#include "erosion/drainage_network.hpp"
#include "terrain/heightfield.hpp"

namespace wold {

struct AnalysisOptions {
  double channel_area = 50000;  ///< m², upstream area from which there is a channel
  double longest_wave = 0.25;   ///< of the extent: where the fit of the spectrum begins
  double shortest_wave = 8;     ///< cells: where it ends
};

/// NaN is what could not be measured (no channels, too few samples).
struct Realism {
  double lowest = 0;        ///< m
  double highest = 0;       ///< m
  double mean_height = 0;   ///< m
  double relief = 0;        ///< m, highest - lowest
  double deviation = 0;     ///< m, standard deviation of heights
  double mean_slope = 0;    ///< degrees
  double median_slope = 0;  ///< degrees
  double steep_share = 0;   ///< of the area above 35 degrees
  double ruggedness = 0;    ///< m, mean
  double hypsometric_integral = 0;
  double skewness = 0;        ///< of heights: above 0 where lowlands prevail
  double spectrum_slope = 0;  ///< of power against wave number
  double concavity = 0;       ///< θ
  double concavity_fit = 0;   ///< r² of that line
  double hack_exponent = 0;
  double bifurcation = 0;       ///< ratio
  int highest_order = 0;        ///< Strahler's
  double drainage_density = 0;  ///< km of channel per km²
  double pits = 0;              ///< samples without a lower neighbour, off the border
  double lake_share = 0;        ///< of the area, in depressions
};

/// One measure, for printing.
struct Figure {
  std::string name;  ///< "concavity"
  double value = 0;
  std::string unit;  ///< "m", or empty
  std::string text;  ///< what it is
  double low = 0;    ///< what is usual in nature; NaN: no such range
  double high = 0;
  std::string source;  ///< of that range
  bool has_range() const { return low <= high; }
  bool natural() const { return !has_range() || (value >= low && value <= high); }
};

/// A line through points, log10 y = at_one + slope log10 x.
struct PowerFit {
  double slope = 0;
  double at_one = 0;
  double r2 = 0;
  double from = 0;  ///< x of the first and last point
  double to = 0;
  double least_weight = 0;  ///< of a point that counts
  double at(double x) const;
};

struct CurvePoint {
  double x = 0;
  double y = 0;
  double weight = 0;  ///< samples
};

/// All that was found: numbers, and what pictures show.
struct Analysis {
  AnalysisOptions options;
  Realism realism;
  Heightfield field;
  Grid<float> filled;  ///< m, level lakes
  Grid<std::uint8_t> direction;
  Grid<double> area;                           ///< m²
  Grid<std::uint8_t> order;                    ///< Strahler's
  Grid<std::int32_t> basins;                   ///< from 1
  std::vector<CurvePoint> slope_area;          ///< m², slope, of bins
  std::vector<CurvePoint> slope_area_samples;  ///< some of what the bins hold
  PowerFit slope_area_fit;
  std::vector<CurvePoint> length_area;  ///< m², m, of bins
  PowerFit hack_fit;
  std::vector<CurvePoint> spectrum;  ///< 1/m, m³
  PowerFit spectrum_fit;
  std::vector<CurvePoint> hypsometry;   ///< share of the area above, relative height
  std::vector<double> slope_histogram;  ///< share of the area by degree
};

/// Throws as check_ground, Error(cancelled).
Analysis analyze(const Heightfield& field, const AnalysisOptions& options, Progress& progress);

/// Every measure once.
std::vector<Figure> figures(const Realism& realism);

/// Root mean square of the difference of two fields of the same land, relative to the relief of the
/// coarser; the finer is smoothed to the coarser's samples.
double relative_difference(const Heightfield& a, const Heightfield& b, Progress& progress);

}  // namespace wold
