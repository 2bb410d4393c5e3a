#pragma once
// A window on the desktop (GLFW) with an OpenGL context, current on the thread that made it, and
// the interface in it. Everything here is for the main thread.

#include <memory>
#include <string>

#include "gpu/context.hpp"
#include "view/controls.hpp"
#include "view/interface.hpp"

namespace wold {

struct WindowSettings {
  std::string title = "wold";
  int width = 1280;
  int height = 800;
  bool vsync = true;
  bool visible = true;
};

class Window {
 public:
  /// OpenGL 4.3 core, or else 3.3. Throws Error(limit) where there is no desktop or no driver,
  /// saying what helps.
  explicit Window(const WindowSettings& settings = {});
  ~Window();
  Window(Window&&) noexcept;
  Window& operator=(Window&&) noexcept;

  /// Handles what has happened and returns it as the controls of the next frame. Waits a little
  /// when nothing can be seen.
  Controls poll();
  /// Shows what was drawn into framebuffer 0.
  void show();

  /// Of the framebuffer, pixels; 0 × 0 while it is minimised.
  IVec2 size() const;
  bool minimised() const;
  bool closing() const;  ///< the user asked for it
  void close();

  void set_title(const std::string& title);
  void resize(IVec2 size);
  void toggle_full_screen();
  std::string clipboard() const;
  void set_clipboard(const std::string& text);

  Interface& interface();
  const GpuInfo& gpu() const;

 private:
  struct State;
  std::unique_ptr<State> state_;
};

}  // namespace wold
