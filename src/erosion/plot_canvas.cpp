#include "erosion/plot_canvas.hpp"

#include <cairo.h>

#include <cstdint>

#include "base/error.hpp"
#include "image/io.hpp"

namespace wold {

namespace {

constexpr const char* family = "DejaVu Sans";

void set_ink(cairo_t* cr, const Ink& ink) {
  cairo_set_source_rgba(cr, ink.r, ink.g, ink.b, ink.alpha);
}

void set_font(cairo_t* cr, const TextStyle& style) {
  cairo_select_font_face(cr, family, CAIRO_FONT_SLANT_NORMAL,
                         style.bold ? CAIRO_FONT_WEIGHT_BOLD : CAIRO_FONT_WEIGHT_NORMAL);
  cairo_set_font_size(cr, style.size);
}

void trace(cairo_t* cr, const std::vector<DVec2>& places) {
  cairo_new_path(cr);
  for (const DVec2& p : places) cairo_line_to(cr, p.x, p.y);
}

void trace_box(cairo_t* cr, DVec2 low, DVec2 high) {
  cairo_new_path(cr);
  cairo_rectangle(cr, low.x, low.y, high.x - low.x, high.y - low.y);
}

std::uint32_t packed(const Image& rgb, int x, int y) {
  const auto part = [&](int c) { return quantised(rgb.at(x, y, c), 255); };
  return 0xff000000U | part(0) << 16U | part(1) << 8U | part(2);
}

}  // namespace

struct Canvas::Page {
  Page(int width, int height)
      : surface(cairo_image_surface_create(CAIRO_FORMAT_RGB24, width, height)),
        cr(cairo_create(surface)) {}
  Page(const Page&) = delete;
  Page& operator=(const Page&) = delete;
  ~Page() {
    cairo_destroy(cr);
    cairo_surface_destroy(surface);
  }

  cairo_surface_t* surface;
  cairo_t* cr;
};

Canvas::Canvas(int width, int height)
    : page_(std::make_shared<Page>(width, height)), width_(width), height_(height) {
  cairo_set_source_rgb(page_->cr, 1, 1, 1);
  cairo_paint(page_->cr);
  cairo_set_line_join(page_->cr, CAIRO_LINE_JOIN_ROUND);
  cairo_set_line_cap(page_->cr, CAIRO_LINE_CAP_ROUND);
}

void Canvas::line(const std::vector<DVec2>& places, const Ink& ink, double width, bool dashed) {
  trace(page_->cr, places);
  set_ink(page_->cr, ink);
  cairo_set_line_width(page_->cr, width);
  const double dash[2] = {4 * width, 3.5 * width};
  cairo_set_dash(page_->cr, dash, dashed ? 2 : 0, 0);
  cairo_stroke(page_->cr);
}

void Canvas::area(const std::vector<DVec2>& places, const Ink& ink) {
  trace(page_->cr, places);
  set_ink(page_->cr, ink);
  cairo_fill(page_->cr);
}

void Canvas::box(DVec2 low, DVec2 high, const Ink& ink, double width) {
  trace_box(page_->cr, low, high);
  set_ink(page_->cr, ink);
  cairo_set_dash(page_->cr, nullptr, 0, 0);
  cairo_set_line_width(page_->cr, width);
  cairo_stroke(page_->cr);
}

void Canvas::fill_box(DVec2 low, DVec2 high, const Ink& ink) {
  trace_box(page_->cr, low, high);
  set_ink(page_->cr, ink);
  cairo_fill(page_->cr);
}

void Canvas::dot(DVec2 place, double radius, const Ink& fill, const Ink& rim) {
  cairo_new_path(page_->cr);
  cairo_arc(page_->cr, place.x, place.y, radius, 0, 2 * pi_d);
  set_ink(page_->cr, fill);
  cairo_fill_preserve(page_->cr);
  set_ink(page_->cr, rim);
  cairo_set_dash(page_->cr, nullptr, 0, 0);
  cairo_set_line_width(page_->cr, 1);
  cairo_stroke(page_->cr);
}

void Canvas::text(DVec2 place, const std::string& words, const TextStyle& style) {
  if (!plots_have_text()) return;
  cairo_t* cr = page_->cr;
  set_font(cr, style);
  cairo_font_extents_t font;
  cairo_font_extents(cr, &font);
  // Capitals are about 0.73 of the size of the font.
  const DVec2 shift(-style.across * text_width(words, style), style.up * 0.73 * style.size);
  cairo_save(cr);
  cairo_translate(cr, place.x, place.y);
  if (style.upright) cairo_rotate(cr, -pi_d / 2);
  cairo_move_to(cr, shift.x, shift.y);
  set_ink(cr, style.ink);
  cairo_show_text(cr, words.c_str());
  cairo_restore(cr);
}

double Canvas::text_width(const std::string& words, const TextStyle& style) const {
  set_font(page_->cr, style);
  cairo_text_extents_t extents;
  cairo_text_extents(page_->cr, words.c_str(), &extents);
  return extents.x_advance;
}

void Canvas::picture(const Image& rgb, DVec2 low, DVec2 high) {
  cairo_surface_t* surface = cairo_image_surface_create(CAIRO_FORMAT_RGB24, rgb.width, rgb.height);
  cairo_surface_flush(surface);
  unsigned char* data = cairo_image_surface_get_data(surface);
  if (data == nullptr) {
    cairo_surface_destroy(surface);
    throw Error(ErrorKind::limit, "a picture is too large to be drawn");
  }
  const int stride = cairo_image_surface_get_stride(surface);
  for (int y = 0; y < rgb.height; ++y) {
    auto* row = reinterpret_cast<std::uint32_t*>(data + static_cast<std::ptrdiff_t>(y) * stride);
    for (int x = 0; x < rgb.width; ++x) row[x] = packed(rgb, x, y);
  }
  cairo_surface_mark_dirty(surface);
  cairo_save(page_->cr);
  trace_box(page_->cr, low, high);
  cairo_clip(page_->cr);
  cairo_translate(page_->cr, low.x, low.y);
  cairo_scale(page_->cr, (high.x - low.x) / rgb.width, (high.y - low.y) / rgb.height);
  cairo_set_source_surface(page_->cr, surface, 0, 0);
  cairo_pattern_set_filter(cairo_get_source(page_->cr), CAIRO_FILTER_GOOD);
  cairo_pattern_set_extend(cairo_get_source(page_->cr), CAIRO_EXTEND_PAD);
  cairo_paint(page_->cr);
  cairo_restore(page_->cr);
  cairo_surface_destroy(surface);
}

void Canvas::clip(DVec2 low, DVec2 high) {
  cairo_save(page_->cr);
  trace_box(page_->cr, low, high);
  cairo_clip(page_->cr);
}

void Canvas::unclip() {
  cairo_restore(page_->cr);
}

Image Canvas::image() const {
  Image out(width_, height_, {"R", "G", "B"});
  cairo_surface_flush(page_->surface);
  const unsigned char* data = cairo_image_surface_get_data(page_->surface);
  const int stride = cairo_image_surface_get_stride(page_->surface);
  for (int y = 0; y < height_; ++y) {
    const auto* row =
        reinterpret_cast<const std::uint32_t*>(data + static_cast<std::ptrdiff_t>(y) * stride);
    for (int x = 0; x < width_; ++x)
      for (int c = 0; c < 3; ++c)
        out.at(x, y, c) =
            static_cast<float>(row[x] >> (16U - 8U * static_cast<unsigned>(c)) & 0xffU) / 255.0F;
  }
  return out;
}

bool plots_have_text() {
  static const bool found = [] {
    cairo_surface_t* surface = cairo_image_surface_create(CAIRO_FORMAT_RGB24, 8, 8);
    cairo_t* cr = cairo_create(surface);
    set_font(cr, {});
    cairo_text_extents_t extents{};
    cairo_text_extents(cr, "Hg", &extents);
    const bool drawn = cairo_status(cr) == CAIRO_STATUS_SUCCESS && extents.width > 1;
    cairo_destroy(cr);
    cairo_surface_destroy(surface);
    return drawn;
  }();
  return found;
}

}  // namespace wold
