#pragma once
// A page to draw on, antialiased (cairo): lines, areas, text, pictures. Places in pixels from the
// top left.

#include <memory>
#include <string>
#include <vector>

#include "base/vec.hpp"
#include "image/image.hpp"

namespace wold {

struct Ink {
  double r = 0, g = 0, b = 0, alpha = 1;  ///< as displayed, 0 to 1
};

/// Where a text stands about its place.
struct TextStyle {
  double size = 15;
  double across = 0;  ///< 0: begins there, 0.5: middle, 1: ends there
  double up = 0;      ///< 0: stands on it, 0.5: middle, 1: hangs from it
  bool bold = false;
  bool upright = false;  ///< turned by 90 degrees, to be read from the right
  Ink ink{0.13, 0.13, 0.13, 1};
};

class Canvas {
 public:
  /// A white page.
  Canvas(int width, int height);

  int width() const { return width_; }
  int height() const { return height_; }

  void line(const std::vector<DVec2>& places, const Ink& ink, double width, bool dashed = false);
  void area(const std::vector<DVec2>& places, const Ink& ink);
  void box(DVec2 low, DVec2 high, const Ink& ink, double width);
  void fill_box(DVec2 low, DVec2 high, const Ink& ink);
  void dot(DVec2 place, double radius, const Ink& fill, const Ink& rim);
  void text(DVec2 place, const std::string& words, const TextStyle& style);
  double text_width(const std::string& words, const TextStyle& style) const;
  /// Colours of an image (row 0 at the top) stretched over a rectangle.
  void picture(const Image& rgb, DVec2 low, DVec2 high);
  /// What is drawn until `unclip` stays inside.
  void clip(DVec2 low, DVec2 high);
  void unclip();

  Image image() const;

 private:
  struct Page;
  std::shared_ptr<Page> page_;
  int width_;
  int height_;
};

/// Whether a font was found; without one texts are left out.
bool plots_have_text();

}  // namespace wold
