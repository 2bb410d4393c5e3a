#pragma once
// Dear ImGui with wold's look, in the current OpenGL context: with a window, whose mouse and keys
// it hears, or without one, drawn into whatever framebuffer is bound.

#include "base/vec.hpp"

struct GLFWwindow;

namespace wold {

/// Colours with a meaning, sRGB and alpha, that all of view/ uses.
namespace palette {
inline constexpr Vec4 text{0.90F, 0.91F, 0.89F, 1};
inline constexpr Vec4 quiet{0.60F, 0.63F, 0.62F, 1};
inline constexpr Vec4 accent{0.53F, 0.74F, 0.44F, 1};
inline constexpr Vec4 changed{0.94F, 0.73F, 0.36F, 1};
inline constexpr Vec4 panel{0.085F, 0.095F, 0.105F, 0.93F};
inline constexpr Vec4 error{0.56F, 0.13F, 0.12F, 0.96F};
}  // namespace palette

class Interface {
 public:
  /// `scale` is that of the display: 2 for letters of twice as many pixels. One at a time.
  explicit Interface(float scale = 1, GLFWwindow* window = nullptr);
  ~Interface();
  Interface(const Interface&) = delete;
  Interface& operator=(const Interface&) = delete;

  /// Begins a frame. `size`, in pixels, counts only without a window.
  void begin(IVec2 size, double seconds);
  /// Draws all that was asked for since `begin` into the framebuffer that is bound.
  void end();

  /// Whether the mouse is on something of the interface, or a text is being typed.
  bool wants_mouse() const;
  bool wants_keys() const;
  /// While the mouse looks around it is not on the interface.
  void ignore_mouse(bool ignore);
  float scale() const { return scale_; }

 private:
  float scale_ = 1;
  GLFWwindow* window_ = nullptr;
};

}  // namespace wold
