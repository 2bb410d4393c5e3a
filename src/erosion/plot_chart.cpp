#include "erosion/plot_chart.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

namespace wold {

namespace {

constexpr int page_width = 1200;
constexpr int page_height = 800;
constexpr TextStyle title_style{22, 0, 0, true, false, plot_dark};
constexpr TextStyle subtitle_style{15, 0, 0, false, false, plot_grey};

double step_of(double range, int about) {
  const double rough = range / about;
  const double power = std::pow(10.0, std::floor(std::log10(rough)));
  for (const double factor : {1.0, 2.0, 2.5, 5.0})
    if (factor * power >= rough * 0.999) return factor * power;
  return 10 * power;
}

std::string superscript(int number) {
  static constexpr const char* digits[] = {"⁰", "¹", "²", "³", "⁴", "⁵", "⁶", "⁷", "⁸", "⁹"};
  std::string out;
  for (const char c : fmt::format("{}", number)) out += c == '-' ? "⁻" : digits[c - '0'];
  return out;
}

}  // namespace

double ChartAxis::place(double value) const {
  if (!logarithmic) return (value - low) / (high - low);
  return std::log(value / low) / std::log(high / low);
}

ChartAxis axis_over(std::string label, const std::vector<double>& values, bool logarithmic) {
  ChartAxis axis{std::move(label), 0, 1, logarithmic};
  bool any = false;
  for (const double v : values) {
    if (!std::isfinite(v) || (logarithmic && v <= 0)) continue;
    axis.low = any ? std::min(axis.low, v) : v;
    axis.high = any ? std::max(axis.high, v) : v;
    any = true;
  }
  if (logarithmic) {
    if (!any) axis.low = axis.high = 1;
    const double grow = std::pow(std::max(axis.high / axis.low, 4.0), 0.06);
    axis.low /= grow;
    axis.high *= grow;
  } else if (!(axis.high > axis.low)) {
    axis.high = axis.low + 1;
  }
  return axis;
}

Ticks ticks_of(const ChartAxis& axis, int about) {
  Ticks ticks;
  const auto inside = [&](double v) { return axis.place(v) > -1e-9 && axis.place(v) < 1 + 1e-9; };
  if (!axis.logarithmic) {
    const double step = step_of(axis.high - axis.low, about);
    for (double k = std::ceil(axis.low / step - 1e-9); inside(k * step); ++k)
      ticks.labelled.push_back(k * step + 0.0);
    return ticks;
  }
  const int first = static_cast<int>(std::floor(std::log10(axis.low)));
  const int last = static_cast<int>(std::ceil(std::log10(axis.high)));
  for (int p = first; p <= last; ++p)
    for (int k = 1; k < 10; ++k) {
      const double v = k * std::pow(10.0, p);
      if (!inside(v)) continue;
      (k == 1 ? ticks.labelled : ticks.between).push_back(v);
    }
  // Within one decade the values between tell more.
  if (ticks.labelled.size() < 2) {
    for (const double v : ticks.between) ticks.labelled.push_back(v);
    std::sort(ticks.labelled.begin(), ticks.labelled.end());
    ticks.between.clear();
  }
  return ticks;
}

std::string tick_text(double value, bool logarithmic) {
  const double power = std::log10(std::abs(value));
  const bool whole = std::abs(power - std::round(power)) < 1e-6;
  if (logarithmic && whole && std::abs(power) > 1.5)
    return "10" + superscript(static_cast<int>(std::round(power)));
  if (std::abs(value) < 1e-12) return "0";
  return fmt::format("{:.6g}", value);
}

Chart::Chart(const std::string& title, const std::string& subtitle, ChartAxis x, ChartAxis y)
    : canvas_(page_width, page_height), x_(std::move(x)), y_(std::move(y)) {
  canvas_.text({low_.x, 42}, title, title_style);
  canvas_.text({low_.x, 70}, subtitle, subtitle_style);
}

DVec2 Chart::at(double x, double y) const {
  return {low_.x + x_.place(x) * (high_.x - low_.x), high_.y - y_.place(y) * (high_.y - low_.y)};
}

void Chart::points(const std::vector<DVec2>& values, double radius, const Ink& fill,
                   const Ink& rim) {
  canvas_.clip(low_, high_);
  for (const DVec2& v : values) canvas_.dot(at(v.x, v.y), radius, fill, rim);
  canvas_.unclip();
}

void Chart::curve(const std::vector<DVec2>& values, const Ink& ink, double width, bool dashed) {
  std::vector<DVec2> places;
  for (const DVec2& v : values) places.push_back(at(v.x, v.y));
  canvas_.clip(low_, high_);
  canvas_.line(places, ink, width, dashed);
  canvas_.unclip();
}

void Chart::legend(const std::vector<LegendLine>& lines) {
  constexpr double margin = 16;
  constexpr double line_height = 25;
  constexpr double key = 30;
  double width = 0;
  for (const LegendLine& line : lines)
    width = std::max(width, canvas_.text_width(line.words, {}) + key + 2.5 * margin);
  const double height = line_height * static_cast<double>(lines.size()) + margin;
  const DVec2 corner(high_.x - margin - width, low_.y + margin);
  canvas_.fill_box(corner, corner + DVec2(width, height), {1, 1, 1, 0.9});
  canvas_.box(corner + 0.5, corner + 0.5 + DVec2(width, height), {0.8, 0.8, 0.8, 1}, 1);
  double y = corner.y + margin / 2 + line_height / 2;
  for (const LegendLine& line : lines) {
    const double x = corner.x + margin;
    if (line.key == LegendKey::dot)
      canvas_.dot({x + 12, y}, 5.5, line.ink, {1, 1, 1, 1});
    else if (line.key != LegendKey::none)
      canvas_.line({{x, y}, {x + 24, y}}, line.ink, line.key == LegendKey::dashed ? 1.8 : 2.8,
                   line.key == LegendKey::dashed);
    canvas_.text({x + key + 4, y}, line.words, {15, 0, 0.5});
    y += line_height;
  }
}

void Chart::frame(bool grid) {
  const Ink light{0, 0, 0, 0.10};
  const Ink lighter{0, 0, 0, 0.05};
  const Ticks along = ticks_of(x_, 9);
  const Ticks up = ticks_of(y_, 8);
  const auto vertical = [&](double v, const Ink& ink) {
    const double x = std::round(at(v, y_.low).x) + 0.5;
    canvas_.line({{x, low_.y}, {x, high_.y}}, ink, 1);
  };
  const auto horizontal = [&](double v, const Ink& ink) {
    const double y = std::round(at(x_.low, v).y) + 0.5;
    canvas_.line({{low_.x, y}, {high_.x, y}}, ink, 1);
  };
  if (grid) {
    for (const double v : along.between) vertical(v, lighter);
    for (const double v : up.between) horizontal(v, lighter);
    for (const double v : along.labelled) vertical(v, light);
    for (const double v : up.labelled) horizontal(v, light);
  }
  canvas_.box(low_ + 0.5, high_ + 0.5, plot_dark, 1.2);
  for (const double v : along.labelled) {
    const double x = at(v, y_.low).x;
    canvas_.line({{x, high_.y}, {x, high_.y + 6}}, plot_dark, 1.2);
    canvas_.text({x, high_.y + 13}, tick_text(v, x_.logarithmic), {14, 0.5, 1});
  }
  for (const double v : up.labelled) {
    const double y = at(x_.low, v).y;
    canvas_.line({{low_.x - 6, y}, {low_.x, y}}, plot_dark, 1.2);
    canvas_.text({low_.x - 11, y}, tick_text(v, y_.logarithmic), {14, 1, 0.5});
  }
  canvas_.text({(low_.x + high_.x) / 2, high_.y + 54}, x_.label, {16, 0.5, 0});
  canvas_.text({low_.x - 72, (low_.y + high_.y) / 2}, y_.label,
               {16, 0.5, 0, false, true, plot_dark});
}

}  // namespace wold
