#include "view/window.hpp"

#include <epoxy/gl.h>
#define GLFW_INCLUDE_NONE
#include <GLFW/glfw3.h>
#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cctype>
#include <chrono>
#include <cstdlib>
#include <utility>

#include "base/error.hpp"
#include "view/window_events.hpp"

namespace wold {

namespace {

using Clock = std::chrono::steady_clock;

constexpr double idle_wait = 0.1;      // s between looks at a minimised window
constexpr double longest_frame = 0.5;  // s; a longer one was no frame

constexpr std::string_view without_window =
    "Without one, use --screenshot FILE or --frames N, which need no window.";

std::string& last_glfw_error() {
  static std::string text;
  return text;
}

bool has_desktop() {
#if defined(__linux__) || defined(__FreeBSD__)
  const auto set = [](const char* name) {
    const char* value = std::getenv(name);
    return value != nullptr && *value != '\0';
  };
  return set("DISPLAY") || set("WAYLAND_DISPLAY");
#else
  return true;
#endif
}

/// GLFW, while a window is there.
class Library {
 public:
  Library() {
    if (!has_desktop())
      throw Error(ErrorKind::limit,
                  fmt::format("a window needs a desktop: neither DISPLAY nor WAYLAND_DISPLAY is "
                              "set. {}",
                              without_window));
    glfwSetErrorCallback([](int, const char* text) { last_glfw_error() = text; });
    if (glfwInit() != GLFW_TRUE)
      throw Error(ErrorKind::limit, fmt::format("the desktop cannot be reached ({}): DISPLAY and "
                                                "WAYLAND_DISPLAY say where it is. {}",
                                                last_glfw_error(), without_window));
  }
  ~Library() { glfwTerminate(); }
  Library(const Library&) = delete;
  Library& operator=(const Library&) = delete;
};

struct DestroyWindow {
  void operator()(GLFWwindow* window) const { glfwDestroyWindow(window); }
};
using WindowHandle = std::unique_ptr<GLFWwindow, DestroyWindow>;

WindowHandle opened(const WindowSettings& settings) {
  glfwWindowHint(GLFW_CLIENT_API, GLFW_OPENGL_API);
  glfwWindowHint(GLFW_OPENGL_PROFILE, GLFW_OPENGL_CORE_PROFILE);
  glfwWindowHint(GLFW_OPENGL_FORWARD_COMPAT, GLFW_TRUE);
  glfwWindowHint(GLFW_VISIBLE, settings.visible ? GLFW_TRUE : GLFW_FALSE);
  glfwWindowHint(GLFW_SCALE_TO_MONITOR, GLFW_TRUE);
  glfwWindowHint(GLFW_DEPTH_BITS, 0);
  glfwWindowHint(GLFW_STENCIL_BITS, 0);
  for (const auto& [major, minor] : {std::pair{4, 3}, std::pair{3, 3}}) {
    glfwWindowHint(GLFW_CONTEXT_VERSION_MAJOR, major);
    glfwWindowHint(GLFW_CONTEXT_VERSION_MINOR, minor);
    WindowHandle window(glfwCreateWindow(std::max(settings.width, 1), std::max(settings.height, 1),
                                         settings.title.c_str(), nullptr, nullptr));
    if (window) return window;
  }
  throw Error(ErrorKind::limit,
              fmt::format("no graphics driver gives a window with OpenGL 3.3 ({}). On Debian, 'apt "
                          "install libgl1-mesa-dri libglx-mesa0' gives one that needs no graphics "
                          "card. {}",
                          last_glfw_error(), without_window));
}

/// Letters are drawn for the pixels there are: of a display whose windows are measured in larger
/// units the framebuffer is enlarged already.
float letter_scale(GLFWwindow* window) {
  float x = 1;
  float y = 1;
  glfwGetWindowContentScale(window, &x, &y);
  int width = 1;
  int pixels = 1;
  int ignored = 0;
  glfwGetWindowSize(window, &width, &ignored);
  glfwGetFramebufferSize(window, &pixels, &ignored);
  if (width <= 0 || pixels <= 0) return x;
  return x * static_cast<float>(width) / static_cast<float>(pixels);
}

constexpr auto named_keys = std::to_array<std::pair<int, const char*>>({
    {GLFW_KEY_UP, "Up"},
    {GLFW_KEY_DOWN, "Down"},
    {GLFW_KEY_LEFT, "Left"},
    {GLFW_KEY_RIGHT, "Right"},
    {GLFW_KEY_PAGE_UP, "Page_Up"},
    {GLFW_KEY_PAGE_DOWN, "Page_Down"},
    {GLFW_KEY_HOME, "Home"},
    {GLFW_KEY_END, "End"},
    {GLFW_KEY_LEFT_SHIFT, "Shift"},
    {GLFW_KEY_RIGHT_SHIFT, "Shift"},
    {GLFW_KEY_LEFT_ALT, "Alt"},
    {GLFW_KEY_SPACE, "Space"},
    {GLFW_KEY_ESCAPE, "Escape"},
    {GLFW_KEY_TAB, "Tab"},
    {GLFW_KEY_ENTER, "Enter"},
    {GLFW_KEY_DELETE, "Delete"},
    {GLFW_KEY_LEFT_BRACKET, "["},
    {GLFW_KEY_RIGHT_BRACKET, "]"},
    {GLFW_KEY_COMMA, ","},
    {GLFW_KEY_PERIOD, "."},
    {GLFW_KEY_MINUS, "-"},
    {GLFW_KEY_EQUAL, "="},
    {GLFW_KEY_KP_ADD, "+"},
    {GLFW_KEY_KP_SUBTRACT, "-"},
});

/// The name of a key by its place; empty for one that is never in the table.
std::string place_name(int key) {
  const bool letter = key >= GLFW_KEY_A && key <= GLFW_KEY_Z;
  const bool digit = key >= GLFW_KEY_0 && key <= GLFW_KEY_9;
  if (letter || digit) return std::string(1, static_cast<char>(key));
  if (key >= GLFW_KEY_F1 && key <= GLFW_KEY_F12) return fmt::format("F{}", key - GLFW_KEY_F1 + 1);
  for (const auto& [code, name] : named_keys)
    if (code == key) return name;
  return {};
}

std::string key_name(int key, int scancode) {
  const std::string place = place_name(key);
  const bool keypad = key >= GLFW_KEY_KP_0 && key <= GLFW_KEY_KP_EQUAL;
  const char* printed = keypad ? nullptr : glfwGetKeyName(key, scancode);
  std::string label = printed != nullptr ? printed : "";
  if (label.size() == 1)
    label[0] = static_cast<char>(std::toupper(static_cast<unsigned char>(label[0])));
  return key_for(place, label);
}

}  // namespace

struct Window::State {
  Library library;
  WindowHandle window;
  GpuInfo gpu;
  std::unique_ptr<Interface> interface;
  WindowEvents events;
  DVec2 mouse{0};
  bool mouse_known = false;  // false: the next place of the mouse is no movement
  bool captured = false;
  Clock::time_point last_poll = Clock::now();
  std::array<int, 4> windowed{0, 0, 1280, 800};  // place and size before full screen

  explicit State(const WindowSettings& settings) : window(opened(settings)) {
    glfwMakeContextCurrent(window.get());
    glfwSwapInterval(settings.vsync ? 1 : 0);
    gpu = gpu_info();
    glfwSetWindowUserPointer(window.get(), this);
    // Before the interface's own, which call these in turn.
    set_callbacks();
    interface = std::make_unique<Interface>(letter_scale(window.get()), window.get());
  }

  static State& of(GLFWwindow* window) {
    return *static_cast<State*>(glfwGetWindowUserPointer(window));
  }

  bool over_interface() const { return interface && interface->wants_mouse() && !captured; }

  void set_callbacks() const {
    GLFWwindow* w = window.get();
    glfwSetKeyCallback(w, [](GLFWwindow* at, int key, int scancode, int action, int mods) {
      using Change = WindowEvents::Change;
      State& s = of(at);
      const Change change = action == GLFW_RELEASE  ? Change::up
                            : action == GLFW_REPEAT ? Change::repeat
                                                    : Change::down;
      s.events.key(key_name(key, scancode), (mods & GLFW_MOD_CONTROL) != 0, change,
                   s.interface && s.interface->wants_keys());
    });
    glfwSetMouseButtonCallback(w, [](GLFWwindow* at, int button, int action, int) {
      State& s = of(at);
      if (button == GLFW_MOUSE_BUTTON_LEFT || button == GLFW_MOUSE_BUTTON_RIGHT)
        s.events.button(button, action == GLFW_PRESS, s.over_interface());
      s.capture();
    });
    glfwSetCursorPosCallback(w, [](GLFWwindow* at, double x, double y) { of(at).moved({x, y}); });
    glfwSetScrollCallback(w, [](GLFWwindow* at, double, double notches) {
      State& s = of(at);
      s.events.wheel(static_cast<float>(notches), s.over_interface());
    });
    glfwSetWindowFocusCallback(w, [](GLFWwindow* at, int focused) {
      State& s = of(at);
      if (focused == GLFW_TRUE) return;
      s.events.focus_lost();
      s.capture();
    });
  }

  void moved(const DVec2& place) {
    int width = 1;
    int height = 1;
    glfwGetWindowSize(window.get(), &width, &height);
    if (mouse_known)
      events.mouse_moved(Vec2((place - mouse) / (1.0 * std::max({width, height, 1}))));
    mouse = place;
    mouse_known = true;
  }

  /// Hides the cursor and lets it go without end while the view is held.
  void capture() {
    if (events.looking() == captured) return;
    captured = events.looking();
    glfwSetInputMode(window.get(), GLFW_CURSOR,
                     captured ? GLFW_CURSOR_DISABLED : GLFW_CURSOR_NORMAL);
    if (glfwRawMouseMotionSupported() == GLFW_TRUE)
      glfwSetInputMode(window.get(), GLFW_RAW_MOUSE_MOTION, captured ? GLFW_TRUE : GLFW_FALSE);
    interface->ignore_mouse(captured);
    mouse_known = false;
  }
};

Window::Window(const WindowSettings& settings) : state_(std::make_unique<State>(settings)) {}
Window::~Window() = default;
Window::Window(Window&&) noexcept = default;
Window& Window::operator=(Window&&) noexcept = default;

Controls Window::poll() {
  if (minimised())
    glfwWaitEventsTimeout(idle_wait);
  else
    glfwPollEvents();
  const Clock::time_point now = Clock::now();
  const double seconds = std::chrono::duration<double>(now - state_->last_poll).count();
  state_->last_poll = now;
  return state_->events.take(std::min(seconds, longest_frame));
}

void Window::show() {
  glfwSwapBuffers(state_->window.get());
}

IVec2 Window::size() const {
  IVec2 pixels(0);
  if (glfwGetWindowAttrib(state_->window.get(), GLFW_ICONIFIED) == GLFW_TRUE) return pixels;
  glfwGetFramebufferSize(state_->window.get(), &pixels.x, &pixels.y);
  return pixels;
}

bool Window::minimised() const {
  const IVec2 pixels = size();
  return pixels.x <= 0 || pixels.y <= 0;
}

bool Window::closing() const {
  return glfwWindowShouldClose(state_->window.get()) == GLFW_TRUE;
}
void Window::close() {
  glfwSetWindowShouldClose(state_->window.get(), GLFW_TRUE);
}

void Window::set_title(const std::string& title) {
  glfwSetWindowTitle(state_->window.get(), title.c_str());
}

void Window::resize(IVec2 size) {
  glfwSetWindowSize(state_->window.get(), std::max(size.x, 1), std::max(size.y, 1));
}

void Window::toggle_full_screen() {
  GLFWwindow* window = state_->window.get();
  auto& [x, y, width, height] = state_->windowed;
  if (glfwGetWindowMonitor(window) != nullptr) {
    glfwSetWindowMonitor(window, nullptr, x, y, width, height, GLFW_DONT_CARE);
    return;
  }
  GLFWmonitor* monitor = glfwGetPrimaryMonitor();
  const GLFWvidmode* mode = monitor != nullptr ? glfwGetVideoMode(monitor) : nullptr;
  if (mode == nullptr) return;
  glfwGetWindowPos(window, &x, &y);
  glfwGetWindowSize(window, &width, &height);
  glfwSetWindowMonitor(window, monitor, 0, 0, mode->width, mode->height, mode->refreshRate);
}

std::string Window::clipboard() const {
  const char* text = glfwGetClipboardString(state_->window.get());
  return text != nullptr ? text : "";
}
void Window::set_clipboard(const std::string& text) {
  glfwSetClipboardString(state_->window.get(), text.c_str());
}

Interface& Window::interface() {
  return *state_->interface;
}
const GpuInfo& Window::gpu() const {
  return state_->gpu;
}

}  // namespace wold
