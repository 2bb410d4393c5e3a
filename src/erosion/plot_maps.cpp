#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>

#include "base/hash.hpp"
#include "base/parallel.hpp"
#include "erosion/plot_chart.hpp"
#include "erosion/plots.hpp"
#include "terrain/analysis.hpp"
#include "terrain/field_map.hpp"

namespace wold {

namespace {

using Color = Vec3;

constexpr DVec2 map_low{95, 92};
constexpr DVec2 map_high{985, 728};
constexpr Ink river_ink{0.10, 0.32, 0.60, 0.95};
constexpr int orders_shown = 5;
constexpr float lake_depth = 0.01F;  // m

/// Colours of heights from low to high: meadows, steppe, rock, snow.
Color height_color(float e) {
  static constexpr std::array<Vec3, 6> stops{Vec3(0.53F, 0.67F, 0.49F), Vec3(0.73F, 0.78F, 0.56F),
                                             Vec3(0.89F, 0.83F, 0.63F), Vec3(0.80F, 0.67F, 0.52F),
                                             Vec3(0.72F, 0.62F, 0.56F), Vec3(0.96F, 0.95F, 0.95F)};
  const float x = std::clamp(e, 0.0F, 1.0F) * static_cast<float>(stops.size() - 1);
  const auto k = std::min(static_cast<std::size_t>(x), stops.size() - 2);
  return glm::mix(stops[k], stops[k + 1], x - static_cast<float>(k));
}

/// Light, quiet colours that differ between neighbours by chance.
Color basin_color(std::int32_t basin) {
  const float hue = 6 * uniform(random_bits(11, basin, 0));
  const float value = 0.78F + 0.16F * uniform(random_bits(11, basin, 1));
  const float saturation = 0.16F + 0.2F * uniform(random_bits(11, basin, 2));
  const auto part = [&](float at) {
    const float k = std::fmod(at + hue, 6.0F);
    return value * (1 - saturation * std::clamp(std::min(k, 4 - k), 0.0F, 1.0F));
  };
  return {part(5), part(3), part(1)};
}

/// A map of the land in a frame with axes in km.
class MapPlot {
 public:
  MapPlot(const Analysis& a, const std::string& title, const std::string& subtitle)
      : a_(a), scale_(scale_of(a)), page_(page_width(a), 800) {
    const DVec2 size = a.field.size() + a.field.cell;
    const DVec2 room = map_high - map_low;
    low_ = map_low + DVec2(0, 0.5 * (room.y - size.y * scale_));
    if (size.y * scale_ > 0.8 * room.y) low_.y = map_low.y;
    high_ = low_ + size * scale_;
    page_.text({map_low.x, 42}, title, {22, 0, 0, true});
    page_.text({map_low.x, 70}, subtitle, {15, 0, 0, false, false, plot_grey});
  }

  Canvas& page() { return page_; }
  DVec2 low() const { return low_; }
  DVec2 high() const { return high_; }

  void ground(const Grid<Vec3>& colors) { page_.picture(image_of(colors.view()), low_, high_); }

  DVec2 place(int k) const {
    const int i = k % a_.order.width();
    const int j = k / a_.order.width();
    return {low_.x + (i + 0.5) * a_.field.cell * scale_,
            high_.y - (j + 0.5) * a_.field.cell * scale_};
  }

  /// Rivers of the highest orders, each as wide as `width(order - lowest shown)`; through lakes or
  /// not.
  template <class Width>
  void rivers(bool through_lakes, const Width& width) {
    const int lowest = std::max(1, a_.realism.highest_order - orders_shown + 1);
    page_.clip(low_, high_);
    for (int order = lowest; order <= a_.realism.highest_order; ++order)
      for (int k = 0; k < static_cast<int>(a_.order.size()); ++k)
        if (order_at(k) == order && begins(k))
          for (const auto& part : stream(k, through_lakes))
            page_.line(part, river_ink, width(order - lowest));
    page_.unclip();
  }

  void frame() {
    const DVec2 km = a_.field.size() / 1000.0;
    const double widest = std::max(km.x, km.y);
    page_.box(low_ + 0.5, high_ + 0.5, plot_dark, 1.2);
    const ChartAxis east{"", 0, km.x, false};
    const ChartAxis north{"", 0, km.y, false};
    const double half = 0.5 * a_.field.cell * scale_;
    const double pixels = scale_ * 1000;
    for (const double v :
         ticks_of(east, std::max(1, static_cast<int>(7 * km.x / widest))).labelled) {
      const double x = low_.x + half + v * pixels;
      page_.line({{x, high_.y}, {x, high_.y + 6}}, plot_dark, 1.2);
      page_.text({x, high_.y + 13}, tick_text(v, false), {14, 0.5, 1});
    }
    for (const double v :
         ticks_of(north, std::max(1, static_cast<int>(7 * km.y / widest))).labelled) {
      const double y = high_.y - half - v * pixels;
      page_.line({{low_.x - 6, y}, {low_.x, y}}, plot_dark, 1.2);
      page_.text({low_.x - 11, y}, tick_text(v, false), {14, 1, 0.5});
    }
    page_.text({(low_.x + high_.x) / 2, high_.y + 48}, "East (km)", {16, 0.5, 0});
    page_.text({low_.x - 62, (low_.y + high_.y) / 2}, "North (km)", {16, 0.5, 0, false, true});
  }

 private:
  int order_at(int k) const { return a_.order.values()[static_cast<std::size_t>(k)]; }

  bool begins(int k) const {
    bool first = true;
    each_donor(a_.direction, k, [&](int n) { first = first && order_at(n) != order_at(k); });
    return first;
  }

  bool in_lake(int k) const {
    const auto at = static_cast<std::size_t>(k);
    return a_.filled.values()[at] > a_.field.height.values()[at] + lake_depth;
  }

  /// From its beginning to the sample where the next order begins, in parts between lakes.
  std::vector<std::vector<DVec2>> stream(int k, bool through_lakes) const {
    std::vector<std::vector<DVec2>> parts;
    std::vector<DVec2> way{place(k)};
    const int order = order_at(k);
    const auto end_part = [&] {
      if (way.size() > 1) parts.push_back(smoothed(way));
    };
    for (;;) {
      const std::uint8_t d = a_.direction.values()[static_cast<std::size_t>(k)];
      if (d >= flow_stops) break;
      const int next = k + flow_step(d, a_.order.width());
      if (!through_lakes && in_lake(k) && in_lake(next)) {
        end_part();
        way.clear();
      }
      way.push_back(place(next));
      k = next;
      if (order_at(k) != order) break;
    }
    end_part();
    return parts;
  }

  /// Corners of the grid rounded; the ends stay.
  static std::vector<DVec2> smoothed(const std::vector<DVec2>& way) {
    std::vector<DVec2> out = way;
    for (std::size_t k = 1; k + 1 < way.size(); ++k)
      out[k] = 0.25 * way[k - 1] + 0.5 * way[k] + 0.25 * way[k + 1];
    return out;
  }

  static double scale_of(const Analysis& a) {
    const DVec2 room = (map_high - map_low) / (a.field.size() + a.field.cell);
    return std::min(room.x, room.y);
  }
  /// So that the key stands right of the map, and the title has room.
  static int page_width(const Analysis& a) {
    const double map = (a.field.size().x + a.field.cell) * scale_of(a);
    return std::max(900, static_cast<int>(map_low.x + map + 215));
  }

  const Analysis& a_;
  double scale_;  // pixels per metre
  Canvas page_;
  DVec2 low_{0};
  DVec2 high_{0};
};

std::string size_text(const Analysis& a) {
  const Realism& r = a.realism;
  return fmt::format("{:.4g} × {:.4g} km, cells of {:.4g} m; heights {:.4g} to {:.4g} m",
                     a.field.size().x / 1000, a.field.size().y / 1000, a.field.cell, r.lowest,
                     r.highest);
}

void height_bar(MapPlot& map, const Analysis& a) {
  Canvas& page = map.page();
  const DVec2 low(map.high().x + 40, map.low().y + 40);
  const DVec2 high(low.x + 24, std::min(map.high().y, low.y + 360));
  constexpr int steps = 180;
  Image bar(1, steps, {"R", "G", "B"});
  for (int k = 0; k < steps; ++k) {
    const Color color = height_color(1 - (static_cast<float>(k) + 0.5F) / steps);
    for (int c = 0; c < 3; ++c) bar.at(0, k, c) = color[c];
  }
  page.picture(bar, low, high);
  page.box(low + 0.5, high + 0.5, plot_dark, 1);
  page.text({low.x, low.y - 16}, "Height (m)", {15});
  const ChartAxis axis{"", a.realism.lowest, a.realism.lowest + std::max(a.realism.relief, 1.0),
                       false};
  for (const double v : ticks_of(axis, 6).labelled) {
    const double y = high.y - axis.place(v) * (high.y - low.y);
    page.line({{high.x, y}, {high.x + 5, y}}, plot_dark, 1);
    page.text({high.x + 10, y}, tick_text(v, false), {14, 0, 0.5});
  }
  page.line({{low.x, high.y + 40}, {low.x + 24, high.y + 40}}, river_ink, 3);
  page.text({low.x + 34, high.y + 40}, "rivers", {15, 0, 0.5});
  if (a.realism.lake_share > 0) {
    page.fill_box({low.x, high.y + 58}, {low.x + 24, high.y + 74}, {0.45, 0.66, 0.84, 1});
    page.text({low.x + 34, high.y + 66}, "depressions", {15, 0, 0.5});
  }
}

void order_key(MapPlot& map, const Analysis& a, const std::vector<double>& widths) {
  Canvas& page = map.page();
  const double x = map.high().x + 40;
  double y = map.low().y + 24;
  page.text({x, y}, "Strahler order", {15});
  const int lowest = std::max(1, a.realism.highest_order - orders_shown + 1);
  for (int order = a.realism.highest_order; order >= lowest; --order) {
    y += 28;
    page.line({{x, y}, {x + 40, y}}, river_ink, widths[static_cast<std::size_t>(order - lowest)]);
    page.text({x + 52, y}, fmt::format("{}", order), {15, 0, 0.5});
  }
  y += 50;
  const auto line = [&](const std::string& words) {
    page.text({x, y}, words, {14, 0, 0, false, false, plot_dark});
    y += 24;
  };
  line(fmt::format("{:.3g} km/km²", a.realism.drainage_density));
  if (std::isfinite(a.realism.bifurcation))
    line(fmt::format("bifurcation {:.2f}", a.realism.bifurcation));
  if (std::isfinite(a.realism.hack_exponent))
    line(fmt::format("Hack's h {:.2f}", a.realism.hack_exponent));
}

template <class ColorAt>
Grid<Vec3> colors_of(const Analysis& a, const ColorAt& color_at) {
  Progress silent;
  return map_grid<Vec3>(a.field, silent, color_at);
}

}  // namespace

Image hillshade_plot(const Analysis& a) {
  MapPlot map(a, "Shaded relief", size_text(a));
  const Grid<float> light = hillshade(a.field);
  const double relief = std::max(a.realism.relief, 1e-3);
  map.ground(colors_of(a, [&](int i, int j) {
    const float h = a.field.height(i, j);
    const auto e = static_cast<float>((static_cast<double>(h) - a.realism.lowest) / relief);
    const bool lake = a.filled(i, j) > h + lake_depth;
    const Color flat = lake ? Color(0.45F, 0.66F, 0.84F) : height_color(e);
    const float shade = lake ? 1.0F : 0.42F + 0.85F * light(i, j);
    return glm::min(flat * shade, Color(1));
  }));
  map.rivers(false, [](int above) { return 0.7 + 0.55 * above; });
  map.frame();
  height_bar(map, a);
  return map.page().image();
}

Image drainage_plot(const Analysis& a) {
  MapPlot map(
      a, "Drainage",
      fmt::format("{:.4g} × {:.4g} km; rivers from {:.6g} m² upstream; colours: basins",
                  a.field.size().x / 1000, a.field.size().y / 1000, a.options.channel_area));
  const Grid<float> light = hillshade(a.field);
  map.ground(colors_of(a, [&](int i, int j) {
    const Color flat = basin_color(a.basins(i, j));
    return glm::min(flat * (0.80F + 0.32F * light(i, j)), Color(1));
  }));
  std::vector<double> widths;
  for (int k = 0; k < orders_shown; ++k) widths.push_back(0.9 + 1.0 * k);
  map.rivers(true, [&](int above) { return widths[static_cast<std::size_t>(above)]; });
  map.frame();
  order_key(map, a, widths);
  return map.page().image();
}

}  // namespace wold
