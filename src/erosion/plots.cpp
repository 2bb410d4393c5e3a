#include "erosion/plots.hpp"

#include <fmt/format.h>

#include <cmath>
#include <filesystem>

#include "erosion/plot_chart.hpp"
#include "image/atomic_file.hpp"
#include "image/io.hpp"

namespace wold {

namespace {

constexpr Ink dot_fill{0.12, 0.35, 0.62, 0.75};
constexpr Ink faint_fill{0.6, 0.6, 0.6, 0.5};
constexpr Ink white{1, 1, 1, 1};

std::string extent_text(const Analysis& a) {
  const DVec2 km = a.field.size() / 1000.0;
  return fmt::format("{:.4g} × {:.4g} km, cells of {:.4g} m", km.x, km.y, a.field.cell);
}

struct Values {
  std::vector<double> x;
  std::vector<double> y;
};
Values values_of(const std::vector<CurvePoint>& points) {
  Values out;
  for (const CurvePoint& p : points) {
    out.x.push_back(p.x);
    if (p.x > 0) out.y.push_back(p.y);
  }
  return out;
}

/// Points that the fit used, and the others; the fit as a line.
void draw_fit(Chart& chart, const std::vector<CurvePoint>& points, const PowerFit& fit) {
  std::vector<DVec2> used;
  std::vector<DVec2> others;
  for (const CurvePoint& p : points) {
    if (p.y <= 0) continue;
    const bool in_fit = std::isfinite(fit.slope) && p.x >= fit.from && p.x <= fit.to &&
                        p.weight >= fit.least_weight;
    (in_fit ? used : others).push_back({p.x, p.y});
  }
  chart.points(others, 4.5, faint_fill, white);
  chart.points(used, 5.5, dot_fill, white);
  if (std::isfinite(fit.slope))
    chart.curve({{fit.from, fit.at(fit.from)}, {fit.to, fit.at(fit.to)}}, plot_red, 2.6);
}

/// A line of a given exponent through the middle of a fit, for comparison.
void draw_reference(Chart& chart, const PowerFit& fit, double slope) {
  if (!std::isfinite(fit.slope)) return;
  const double middle = std::sqrt(fit.from * fit.to);
  const auto at = [&](double x) { return fit.at(middle) * std::pow(x / middle, slope); };
  chart.curve({{fit.from, at(fit.from)}, {fit.to, at(fit.to)}}, plot_grey, 1.8, true);
}

}  // namespace

Image slope_area_plot(const Analysis& a) {
  Values v = values_of(a.slope_area);
  // The cloud of samples may be cut off where it is thin.
  for (const double y : std::vector<double>(v.y)) v.y.insert(v.y.end(), {y / 3, y * 2.5});
  Chart chart(
      "Slope and upstream area of channels",
      extent_text(a) + fmt::format("; channels from {:.6g} m² upstream", a.options.channel_area),
      axis_over("Upstream area A (m²)", v.x, true), axis_over("Slope S (m/m)", v.y, true));
  chart.frame(true);
  const PowerFit& fit = a.slope_area_fit;
  std::vector<DVec2> samples;
  for (const CurvePoint& p : a.slope_area_samples) samples.emplace_back(p.x, p.y);
  chart.points(samples, 1.7, {0.55, 0.55, 0.55, 0.35}, {0, 0, 0, 0});
  draw_reference(chart, fit, -0.425);
  draw_fit(chart, a.slope_area, fit);
  if (std::isfinite(fit.slope))
    chart.legend({{"channel samples", LegendKey::dot, {0.6, 0.6, 0.6, 0.6}},
                  {"their means in tenths of a decade", LegendKey::dot, dot_fill},
                  {fmt::format("S = k A⁻ᶿ:  θ = {:.3f}, k = {:.3g}, r² = {:.2f}", -fit.slope,
                               std::pow(10.0, fit.at_one), fit.r2),
                   LegendKey::line, plot_red},
                  {"θ = 0.425, the median of rivers", LegendKey::dashed, plot_grey}});
  else
    chart.legend({{"too few channels for a fit", LegendKey::none, plot_grey}});
  return chart.image();
}

Image spectrum_plot(const Analysis& a) {
  const Values v = values_of(a.spectrum);
  Chart chart("Power spectrum of height along lines",
              extent_text(a) + "; mean of all rows and columns, Hann window",
              axis_over("Wave number (1/m)", v.x, true),
              axis_over("Power density (m³)", v.y, true));
  chart.frame(true);
  const PowerFit& fit = a.spectrum_fit;
  draw_reference(chart, fit, -2);
  draw_fit(chart, a.spectrum, fit);
  if (std::isfinite(fit.slope))
    chart.legend({{"means in quarters of an octave", LegendKey::dot, dot_fill},
                  {fmt::format("slope −{:.2f}, wavelengths {:.3g} to {:.3g} m", -fit.slope,
                               1 / fit.to, 1 / fit.from),
                   LegendKey::line, plot_red},
                  {"slope −2", LegendKey::dashed, plot_grey}});
  else
    chart.legend({{"too few samples for a fit", LegendKey::none, plot_grey}});
  return chart.image();
}

Image hypsometry_plot(const Analysis& a) {
  const Realism& r = a.realism;
  Chart chart("Hypsometric curve", extent_text(a), {"Share of the area above", 0, 1, false},
              {"Height (m)", r.lowest, r.lowest + std::max(r.relief, 1.0), false});
  std::vector<DVec2> curve;
  std::vector<DVec2> shape;
  for (const CurvePoint& p : a.hypsometry) {
    curve.emplace_back(p.x, r.lowest + p.y * std::max(r.relief, 1.0));
    shape.push_back(chart.at(curve.back().x, curve.back().y));
  }
  if (!curve.empty()) {
    shape.push_back(chart.at(1, r.lowest));
    shape.push_back(chart.at(0, r.lowest));
    shape.push_back(chart.at(0, curve.front().y));
    chart.canvas().area(shape, {0.12, 0.35, 0.62, 0.14});
  }
  chart.frame(true);
  chart.curve(curve, plot_blue, 2.8);
  chart.curve({{0, r.mean_height}, {1, r.mean_height}}, plot_grey, 1.6, true);
  chart.legend(
      {{fmt::format("integral {:.3f}, skewness {:.2f}", r.hypsometric_integral, r.skewness),
        LegendKey::line, plot_blue},
       {fmt::format("mean height {:.4g} m", r.mean_height), LegendKey::dashed, plot_grey}});
  return chart.image();
}

std::vector<Plot> plots(const Analysis& a) {
  return {{"hillshade", hillshade_plot(a)},
          {"drainage", drainage_plot(a)},
          {"slope_area", slope_area_plot(a)},
          {"spectrum", spectrum_plot(a)},
          {"hypsometry", hypsometry_plot(a)}};
}

std::vector<std::string> write_plots(const Analysis& analysis, const std::string& folder) {
  std::vector<std::string> paths;
  write_folder(folder, [&] {
    for (const Plot& plot : plots(analysis)) {
      paths.push_back((std::filesystem::path(folder) / (plot.name + ".png")).string());
      write_png(paths.back(), plot.image, {.bits = 8, .srgb = true});
    }
  });
  return paths;
}

}  // namespace wold
