#pragma once
// A chart with two axes on a canvas.

#include <string>
#include <vector>

#include "erosion/plot_canvas.hpp"

namespace wold {

struct ChartAxis {
  std::string label;  ///< with unit
  double low = 0;
  double high = 1;
  bool logarithmic = false;

  double place(double value) const;  ///< 0 at low, 1 at high
};

/// An axis over values of a chart, a little wider; of positive values for a logarithmic one.
ChartAxis axis_over(std::string label, const std::vector<double>& values, bool logarithmic);

/// Round values within an axis, and those between for a finer grid.
struct Ticks {
  std::vector<double> labelled;
  std::vector<double> between;
};
Ticks ticks_of(const ChartAxis& axis, int about);

/// "0.25", "1500"; powers of ten as "10⁻³" for a logarithmic axis.
std::string tick_text(double value, bool logarithmic);

inline constexpr Ink plot_dark{0.13, 0.13, 0.13, 1};
inline constexpr Ink plot_grey{0.45, 0.45, 0.45, 1};
inline constexpr Ink plot_blue{0.12, 0.35, 0.62, 1};
inline constexpr Ink plot_red{0.75, 0.22, 0.17, 1};

enum class LegendKey { none, line, dashed, dot };

struct LegendLine {
  std::string words;
  LegendKey key = LegendKey::none;
  Ink ink;
};

class Chart {
 public:
  Chart(const std::string& title, const std::string& subtitle, ChartAxis x, ChartAxis y);
  Canvas& canvas() { return canvas_; }

  DVec2 at(double x, double y) const;
  DVec2 low() const { return low_; }    ///< upper left of the frame
  DVec2 high() const { return high_; }  ///< lower right

  void points(const std::vector<DVec2>& values, double radius, const Ink& fill, const Ink& rim);
  void curve(const std::vector<DVec2>& values, const Ink& ink, double width, bool dashed = false);
  /// Words in a box in the upper right corner.
  void legend(const std::vector<LegendLine>& lines);
  /// Frame and axes; to be called last for what hides the grid lines, first otherwise.
  void frame(bool grid);

  Image image() const { return canvas_.image(); }

 private:
  Canvas canvas_;
  ChartAxis x_;
  ChartAxis y_;
  DVec2 low_{105, 92};
  DVec2 high_{1160, 712};
};

}  // namespace wold
