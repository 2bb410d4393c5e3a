#pragma once
// The path tracer's picture in a panel of its own, beside what is drawn.

#include <string>

#include "gpu/objects.hpp"
#include "image/image.hpp"
#include "image/tonemap.hpp"

namespace wold {

class TracedPanel {
 public:
  /// A newer picture, as Film::image has it.
  void set(const Image& image, const ToneMapping& mapping, float stops);
  /// Between Interface::begin and end; `status` stands beneath. Returns false once it is closed.
  bool draw(const std::string& status, double done);

 private:
  GpuTexture texture_;
};

}  // namespace wold
