#pragma once
// The programs of the fast landscape, each compiled when it is first wanted.

#include <array>
#include <functional>
#include <string>
#include <vector>

#include "gpu/objects.hpp"
#include "realtime/fast_rings.hpp"
#include "realtime/landscape.hpp"

namespace wold {

enum class FastPass {
  transmittances,
  multiples,
  heights,
  patches,
  maxima,
  horizons,
  shades,
  cloud_lights,
  flight_view,
  free_view,
  sky,
  land,
  clouds,
  resolve,
  show
};

class FastPasses {
 public:
  explicit FastPasses(const Landscape& landscape);
  /// Throws Error(internal) with the driver's log.
  const GpuProgram& operator[](FastPass pass);
  /// Compiles one more of those that a camera (or the flight) needs; how many are left then. Throws
  /// the same.
  int compile_next(bool camera);

 private:
  static constexpr std::size_t count = static_cast<std::size_t>(FastPass::show) + 1;
  std::string body_;
  std::array<GpuProgram, count> programs_;
};

/// What all passes have in common, with #include: uniforms, the landscape (`landscape_body`), the
/// functions of landscape/fast_*.glsl.
std::string fast_pass_functions(const std::string& body);

/// Draws strips of squares into a texture with `layers` layers for each level, one of them, by a
/// program that is bound: sets its strip_low and strip_cell.
void draw_strips(const GpuProgram& program, const RingTarget& target, const RingSquares& squares,
                 const std::vector<RingStrip>& strips, const GpuTexture& texture, int layers = 1,
                 int layer = 0);

/// Bakes strips of the land into `heights` and raises the pyramid of `maxima` over them (both
/// arrays with a layer for each level of the squares). `bind` sets uniforms and textures: heights
/// on unit 0, maxima on unit 1.
void bake_land(FastPasses& passes, const RingTarget& target, const RingSquares& squares,
               const std::vector<RingStrip>& strips, const GpuTexture& heights,
               const GpuTexture& maxima, const std::function<void(const GpuProgram&)>& bind);

}  // namespace wold
