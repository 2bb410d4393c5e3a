#include "view/path_curves.hpp"

#include <algorithm>
#include <cmath>
#include <vector>

namespace wold {

namespace {

/// k with times[k] <= time < times[k + 1], for at least two times.
std::size_t interval_of(std::span<const double> times, double time) {
  const auto above = std::upper_bound(times.begin(), times.end(), time) - times.begin();
  return static_cast<std::size_t>(std::clamp<std::ptrdiff_t>(above - 1, 0, std::ssize(times) - 2));
}

/// Cubic Hermite polynomial on an interval of length h, at the part s of it.
template <class T>
T hermite(const T& a, const T& slope_a, const T& b, const T& slope_b, double h, double s) {
  const double s2 = s * s;
  const double s3 = s2 * s;
  return (2 * s3 - 3 * s2 + 1) * a + (s3 - 2 * s2 + s) * h * slope_a + (3 * s2 - 2 * s3) * b +
         (s3 - s2) * h * slope_b;
}

/// The slope of a monotone cubic at an inner value.
double monotone_slope(double h0, double d0, double h1, double d1) {
  if (d0 * d1 <= 0) return 0;
  const double w0 = 2 * h1 + h0;
  const double w1 = h1 + 2 * h0;
  return (w0 + w1) / (w0 / d0 + w1 / d1);
}

/// The slope at an end, by the parabola through three values, held to what is monotone.
double end_slope(double h0, double d0, double h1, double d1) {
  const double slope = ((2 * h0 + h1) * d0 - h0 * d1) / (h0 + h1);
  if (slope * d0 <= 0) return 0;
  return d0 * d1 <= 0 && std::abs(slope) > 3 * std::abs(d0) ? 3 * d0 : slope;
}

/// The slope of a Catmull-Rom spline with uneven knots (that of the parabola through three points),
/// at the point between two intervals; by one alone if the other has no length.
DVec3 spline_slope(const DVec3& before, double h0, const DVec3& here, double h1,
                   const DVec3& after) {
  if (h0 <= 0 && h1 <= 0) return DVec3(0);
  if (h0 <= 0) return (after - here) / h1;
  if (h1 <= 0) return (here - before) / h0;
  const DVec3 d0 = (here - before) / h0;
  const DVec3 d1 = (after - here) / h1;
  return (h1 * d0 + h0 * d1) / (h0 + h1);
}

}  // namespace

double monotone_at(std::span<const double> times, std::span<const double> values, double time) {
  const std::size_t count = times.size();
  if (count == 1 || time <= times.front()) return values.front();
  if (time >= times.back()) return values.back();
  const auto h = [&](std::size_t k) { return times[k + 1] - times[k]; };
  const auto d = [&](std::size_t k) { return (values[k + 1] - values[k]) / h(k); };
  const auto slope = [&](std::size_t k) {
    if (count == 2) return d(0);
    if (k == 0) return end_slope(h(0), d(0), h(1), d(1));
    if (k == count - 1) return end_slope(h(k - 1), d(k - 1), h(k - 2), d(k - 2));
    return monotone_slope(h(k - 1), d(k - 1), h(k), d(k));
  };
  const std::size_t k = interval_of(times, time);
  return hermite(values[k], slope(k), values[k + 1], slope(k + 1), h(k), (time - times[k]) / h(k));
}

DVec3 spline_at(std::span<const double> times, std::span<const DVec3> points, double time) {
  const std::size_t count = points.size();
  if (count == 1) return points.front();
  std::vector<double> knots{0};
  for (std::size_t k = 0; k + 1 < count; ++k)
    knots.push_back(knots.back() + std::sqrt(glm::length(points[k + 1] - points[k])));
  const double u = monotone_at(times, knots, time);
  const std::size_t k = interval_of(times, std::clamp(time, times.front(), times.back()));
  const double h = knots[k + 1] - knots[k];
  if (h <= 0) return points[k];
  // At its ends the spline has the slope of the last chord.
  const auto slope = [&](std::size_t i) {
    const double h0 = i > 0 ? knots[i] - knots[i - 1] : 0;
    const double h1 = i + 1 < count ? knots[i + 1] - knots[i] : 0;
    return spline_slope(points[i > 0 ? i - 1 : i], h0, points[i], h1,
                        points[i + 1 < count ? i + 1 : i]);
  };
  return hermite(points[k], slope(k), points[k + 1], slope(k + 1), h, (u - knots[k]) / h);
}

DVec3 arc(const DVec3& a, const DVec3& b, double s) {
  const double cosine = std::clamp(glm::dot(a, b), -1.0, 1.0);
  DVec3 side = b - cosine * a;
  double length = glm::length(side);
  const double angle = std::atan2(length, cosine);
  if (length < 1e-12) {
    if (cosine > 0) return a;
    // Opposite directions: round by the horizon.
    side = std::abs(a.z) < 0.999 ? DVec3(-a.y, a.x, 0) : DVec3(1, 0, 0);
    length = glm::length(side);
  }
  return glm::normalize(std::cos(s * angle) * a + std::sin(s * angle) / length * side);
}

DVec3 sphere_curve_at(std::span<const double> times, std::span<const DVec3> directions,
                      double time) {
  const std::size_t count = times.size();
  if (count == 1 || time <= times.front()) return directions.front();
  if (time >= times.back()) return directions.back();
  const std::size_t k = interval_of(times, time);
  // The keys about the interval; beyond the ends, the arc goes on.
  const double t1 = times[k];
  const double t2 = times[k + 1];
  const DVec3& p1 = directions[k];
  const DVec3& p2 = directions[k + 1];
  const double t0 = k > 0 ? times[k - 1] : t1 - (t2 - t1);
  const double t3 = k + 2 < count ? times[k + 2] : t2 + (t2 - t1);
  const DVec3 p0 = k > 0 ? directions[k - 1] : arc(p1, p2, -1);
  const DVec3 p3 = k + 2 < count ? directions[k + 2] : arc(p1, p2, 2);
  const auto along = [time](const DVec3& a, const DVec3& b, double from, double to) {
    return arc(a, b, (time - from) / (to - from));
  };
  const DVec3 a1 = along(p0, p1, t0, t1);
  const DVec3 a2 = along(p1, p2, t1, t2);
  const DVec3 a3 = along(p2, p3, t2, t3);
  return along(along(a1, a2, t0, t2), along(a2, a3, t1, t3), t1, t2);
}

}  // namespace wold
