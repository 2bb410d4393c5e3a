#include "view/line_drawing.hpp"

#include <epoxy/gl.h>

#include <cstddef>

#include "gpu/context.hpp"

namespace wold {

namespace {
constexpr float line_width = 2.5F;  // pixels
}

LineDrawing::LineDrawing()
    : program_(assemble_shader("raster/line.vert.glsl", gpu_info().dialect),
               assemble_shader("raster/line.frag.glsl", gpu_info().dialect)) {}

void LineDrawing::set(std::span<const Line> lines) {
  count_ = static_cast<int>(lines.size());
  if (count_ == 0) return;
  buffer_ = GpuBuffer::of(lines);
  int location = 0;
  for (const std::size_t offset :
       {offsetof(Line, from), offsetof(Line, to), offsetof(Line, radiance)})
    vertices_.attribute(
        buffer_,
        {.location = location++, .offset = offset, .stride = sizeof(Line), .per_instance = true});
}

void LineDrawing::draw(const DrawView& view) const {
  if (count_ == 0) return;
  program_.use();
  view.apply(program_);
  program_.set("width", line_width);
  vertices_.bind();
  glDisable(GL_CULL_FACE);
  glDrawArraysInstanced(GL_TRIANGLES, 0, 6, count_);
  gl::check("drawing lines");
}

}  // namespace wold
