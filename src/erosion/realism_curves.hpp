#pragma once
// Curves and fits for realism.hpp.

#include "erosion/realism.hpp"

namespace wold {

/// Least squares through points of positive x and y with at least `least_weight`. NaN for fewer
/// than 3.
PowerFit fit_power(const std::vector<CurvePoint>& points, double least_weight);

/// Means of y in bins of x, `per_decade` of them; x is the mean of its logarithms.
class LogBins {
 public:
  explicit LogBins(double per_decade) : per_decade_(per_decade) {}
  void add(double x, double y);
  std::vector<CurvePoint> points() const;

 private:
  struct Bin {
    double log_x = 0;
    double y = 0;
    double count = 0;
  };
  double per_decade_;
  int first_ = 0;
  std::vector<Bin> bins_;
};

/// Mean power of rows and columns, 1/m and m³, in bins of a quarter of an octave.
std::vector<CurvePoint> power_spectrum(const Heightfield& field, Progress& progress);

/// Share of the area above relative heights 0, 0.01, …, 1, from the top.
std::vector<CurvePoint> hypsometric_curve(const Heightfield& field);

}  // namespace wold
