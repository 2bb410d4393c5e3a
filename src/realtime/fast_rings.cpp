#include "realtime/fast_rings.hpp"

#include <epoxy/gl.h>

#include <algorithm>
#include <cmath>
#include <cstdlib>

namespace wold {

namespace {

/// A stretch of texels and of what wraps, in one direction: at most two.
struct Stretch {
  int begin = 0;
  int count = 0;
};

std::vector<Stretch> stretches(int low, int high, int size) {
  if (high - low >= size) return {{0, size}};
  const int begin = low & (size - 1);
  const int count = std::min(high - low, size - begin);
  std::vector<Stretch> out{{begin, count}};
  if (count < high - low) out.push_back({0, high - low - count});
  return out;
}

int halved_down(int x, int halvings) {
  return x >> halvings;  // rounds down, below zero too
}

}  // namespace

int RingSquares::levels_over(int size, double cell, double reach) {
  int levels = 1;
  while ((0.5 * size - margin) * std::ldexp(cell, levels - 1) < reach) ++levels;
  return levels;
}

RingSquares::RingSquares(int size, int levels, double cell)
    : size_(size), cell_(cell), corners_(static_cast<std::size_t>(levels)) {}

double RingSquares::cell(int level) const {
  return std::ldexp(cell_, level);
}

RingStrip RingSquares::whole(int level) const {
  const IVec2 low = corners_[static_cast<std::size_t>(level)].low;
  return {level, low, low + size_};
}

void RingSquares::forget() {
  for (Corner& c : corners_) c.known = false;
}

std::vector<RingStrip> RingSquares::move_to(DVec2 eye) {
  std::vector<RingStrip> out;
  for (int level = 0; level < levels(); ++level) {
    Corner& corner = corners_[static_cast<std::size_t>(level)];
    const DVec2 at = eye / cell(level);
    const IVec2 low(static_cast<int>(std::lround(at.x)) - size_ / 2,
                    static_cast<int>(std::lround(at.y)) - size_ / 2);
    const IVec2 move = low - corner.low;
    if (corner.known && std::max(std::abs(move.x), std::abs(move.y)) <= slack) continue;
    const IVec2 before = corner.low;
    const bool anew = !corner.known || std::max(std::abs(move.x), std::abs(move.y)) >= size_;
    corner = {low, true};
    if (anew) {
      out.push_back(whole(level));
      continue;
    }
    RingStrip columns = whole(level);
    if (move.x > 0) columns.low.x = before.x + size_;
    if (move.x < 0) columns.high.x = before.x;
    if (move.x != 0) out.push_back(columns);
    RingStrip rows = whole(level);
    if (move.y > 0) rows.low.y = before.y + size_;
    if (move.y < 0) rows.high.y = before.y;
    if (move.y != 0) out.push_back(rows);
  }
  return out;
}

std::vector<RingRect> RingSquares::rects(const RingStrip& strip, int halvings, int grown) const {
  const int size = size_ >> halvings;
  const auto along = [&](int low, int high) {
    return stretches(halved_down(low - grown, halvings), halved_down(high - 1, halvings) + 1, size);
  };
  std::vector<RingRect> out;
  for (const Stretch& y : along(strip.low.y, strip.high.y))
    for (const Stretch& x : along(strip.low.x, strip.high.x))
      out.push_back({{x.begin, y.begin}, {x.count, y.count}});
  return out;
}

RingTarget::RingTarget() {
  unsigned id = 0;
  glGenFramebuffers(1, &id);
  id_ = gl::Name<gl::TargetKind>(id);
}

void RingTarget::draw(const GpuTexture& texture, int layer, int level,
                      const std::vector<RingRect>& rects) const {
  glBindFramebuffer(GL_FRAMEBUFFER, id_.get());
  glFramebufferTextureLayer(GL_FRAMEBUFFER, GL_COLOR_ATTACHMENT0, texture.id(), level, layer);
  glDrawBuffer(GL_COLOR_ATTACHMENT0);
  glViewport(0, 0, std::max(1, texture.width() >> level), std::max(1, texture.height() >> level));
  glEnable(GL_SCISSOR_TEST);
  for (const RingRect& r : rects) {
    glScissor(r.texel.x, r.texel.y, r.size.x, r.size.y);
    draw_full_screen();
  }
  glDisable(GL_SCISSOR_TEST);
}

}  // namespace wold
