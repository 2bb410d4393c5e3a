#include "gpu/context.hpp"

#include <epoxy/egl.h>
#include <epoxy/gl.h>
#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <utility>
#include <vector>

#include "base/error.hpp"

namespace wold {

namespace {

constexpr int least_texture = 4096;

constexpr std::string_view advice =
    "On Debian, 'apt install libgl1-mesa-dri libegl-mesa0' gives one that needs no graphics card; "
    "LIBGL_ALWAYS_SOFTWARE=1 chooses it.";

std::string text_of(GLenum name) {
  const auto* text = reinterpret_cast<const char*>(glGetString(name));
  return text != nullptr ? text : "";
}

bool drawn_by_processor(const std::string& renderer) {
  for (const std::string_view name : {"llvmpipe", "softpipe", "SwiftShader", "Software"})
    if (renderer.find(name) != std::string::npos) return true;
  return false;
}

ShaderDialect dialect_of(const GpuInfo& info) {
  if (info.es) return ShaderDialect::es_300;
  return info.compute ? ShaderDialect::gl_430 : ShaderDialect::gl_330;
}

/// What the driver lacks, or an empty text.
std::string lacking(const GpuInfo& info) {
  if (info.es ? info.major < 3 : info.major * 10 + info.minor < 33)
    return fmt::format("it offers only {}", info.version);
  if (info.max_texture_size < least_texture)
    return fmt::format("its textures end at {} pixels, and wold needs {}", info.max_texture_size,
                       least_texture);
  if (info.es && !epoxy_has_gl_extension("GL_EXT_color_buffer_float"))
    return "it cannot draw into float pictures (EXT_color_buffer_float)";
  return {};
}

}  // namespace

GpuInfo gpu_info() {
  GpuInfo info;
  info.vendor = text_of(GL_VENDOR);
  info.renderer = text_of(GL_RENDERER);
  info.version = text_of(GL_VERSION);
  const int version = epoxy_gl_version();
  info.major = version / 10;
  info.minor = version % 10;
  info.es = !epoxy_is_desktop_gl();
  info.software = drawn_by_processor(info.renderer);
  info.compute = !info.es && version >= 43;
  info.dialect = dialect_of(info);
  glGetIntegerv(GL_MAX_TEXTURE_SIZE, &info.max_texture_size);
  if (epoxy_has_gl_extension("GL_EXT_texture_filter_anisotropic") || version >= 46)
    glGetFloatv(GL_MAX_TEXTURE_MAX_ANISOTROPY_EXT, &info.max_anisotropy);
  if (const std::string lack = lacking(info); !lack.empty())
    throw Error(
        ErrorKind::limit,
        fmt::format("the graphics driver ({}) is not enough: {}. wold draws with OpenGL 3.3 "
                    "or newer. {}",
                    info.renderer, lack, advice));
  return info;
}

struct OffscreenContext::State {
  EGLDisplay display = EGL_NO_DISPLAY;
  EGLContext context = EGL_NO_CONTEXT;
  EGLSurface surface = EGL_NO_SURFACE;

  State() = default;
  State(const State&) = delete;
  State& operator=(const State&) = delete;
  ~State() {
    if (context == EGL_NO_CONTEXT) return;
    if (eglGetCurrentContext() == context)
      eglMakeCurrent(display, EGL_NO_SURFACE, EGL_NO_SURFACE, EGL_NO_CONTEXT);
    if (surface != EGL_NO_SURFACE) eglDestroySurface(display, surface);
    eglDestroyContext(display, context);
    // The display is the process's, shared by all its contexts: it is left open.
  }
};

namespace {

EGLDisplay initialized(EGLDisplay display) {
  return display != EGL_NO_DISPLAY && eglInitialize(display, nullptr, nullptr) == EGL_TRUE
             ? display
             : EGL_NO_DISPLAY;
}

/// Displays in the order they are tried: graphics cards, Mesa without any surface, the desktop's.
std::vector<EGLDisplay> displays() {
  std::vector<EGLDisplay> found;
  const auto add = [&](EGLDisplay display) {
    if (display != EGL_NO_DISPLAY) found.push_back(display);
  };
  if (epoxy_has_egl_extension(EGL_NO_DISPLAY, "EGL_EXT_platform_device") &&
      epoxy_has_egl_extension(EGL_NO_DISPLAY, "EGL_EXT_device_enumeration")) {
    std::array<EGLDeviceEXT, 16> devices{};
    EGLint count = 0;
    if (eglQueryDevicesEXT(static_cast<EGLint>(devices.size()), devices.data(), &count) == EGL_TRUE)
      for (EGLint k = 0; k < count; ++k)
        add(eglGetPlatformDisplayEXT(EGL_PLATFORM_DEVICE_EXT, devices[static_cast<std::size_t>(k)],
                                     nullptr));
  }
  if (epoxy_has_egl_extension(EGL_NO_DISPLAY, "EGL_MESA_platform_surfaceless"))
    add(eglGetPlatformDisplayEXT(EGL_PLATFORM_SURFACELESS_MESA, nullptr, nullptr));
  add(eglGetDisplay(EGL_DEFAULT_DISPLAY));
  return found;
}

EGLContext context_on(EGLDisplay display, bool es, int major, int minor) {
  if (eglBindAPI(es ? EGL_OPENGL_ES_API : EGL_OPENGL_API) != EGL_TRUE) return EGL_NO_CONTEXT;
  const std::array<EGLint, 5> wanted{EGL_RENDERABLE_TYPE, es ? EGL_OPENGL_ES3_BIT : EGL_OPENGL_BIT,
                                     EGL_SURFACE_TYPE, EGL_PBUFFER_BIT, EGL_NONE};
  EGLConfig config = nullptr;
  EGLint count = 0;
  if (eglChooseConfig(display, wanted.data(), &config, 1, &count) != EGL_TRUE || count == 0)
    return EGL_NO_CONTEXT;
  const std::array<EGLint, 7> desktop{EGL_CONTEXT_MAJOR_VERSION,
                                      major,
                                      EGL_CONTEXT_MINOR_VERSION,
                                      minor,
                                      EGL_CONTEXT_OPENGL_PROFILE_MASK,
                                      EGL_CONTEXT_OPENGL_CORE_PROFILE_BIT,
                                      EGL_NONE};
  const std::array<EGLint, 3> mobile{EGL_CONTEXT_MAJOR_VERSION, 3, EGL_NONE};
  return eglCreateContext(display, config, EGL_NO_CONTEXT, es ? mobile.data() : desktop.data());
}

/// A display without surfaceless contexts needs a surface, of any size.
EGLSurface tiny_surface(EGLDisplay display) {
  const std::array<EGLint, 3> wanted{EGL_SURFACE_TYPE, EGL_PBUFFER_BIT, EGL_NONE};
  EGLConfig config = nullptr;
  EGLint count = 0;
  if (eglChooseConfig(display, wanted.data(), &config, 1, &count) != EGL_TRUE || count == 0)
    return EGL_NO_SURFACE;
  const std::array<EGLint, 5> size{EGL_WIDTH, 1, EGL_HEIGHT, 1, EGL_NONE};
  return eglCreatePbufferSurface(display, config, size.data());
}

}  // namespace

OffscreenContext::OffscreenContext(const ContextSettings& settings)
    : state_(std::make_unique<State>()) {
  const std::array<std::pair<int, int>, 2> versions{
      {{settings.major, settings.minor}, {std::min(settings.major, 3), 3}}};
  for (EGLDisplay candidate : displays()) {
    const EGLDisplay display = initialized(candidate);
    if (display == EGL_NO_DISPLAY) continue;
    for (const auto& [major, minor] : versions) {
      const EGLContext context = context_on(display, settings.es, major, minor);
      if (context == EGL_NO_CONTEXT) continue;
      state_->display = display;
      state_->context = context;
      if (!epoxy_has_egl_extension(display, "EGL_KHR_surfaceless_context"))
        state_->surface = tiny_surface(display);
      make_current();
      return;
    }
  }
  throw Error(ErrorKind::limit,
              fmt::format("no graphics driver gives OpenGL {} without a window (EGL). {}",
                          settings.es ? "ES 3.0" : "3.3", advice));
}

OffscreenContext::~OffscreenContext() = default;
OffscreenContext::OffscreenContext(OffscreenContext&&) noexcept = default;
OffscreenContext& OffscreenContext::operator=(OffscreenContext&&) noexcept = default;

void OffscreenContext::make_current() const {
  if (eglMakeCurrent(state_->display, state_->surface, state_->surface, state_->context) !=
      EGL_TRUE)
    throw Error(ErrorKind::limit,
                fmt::format("the graphics driver refused its own context (EGL error 0x{:x}). {}",
                            eglGetError(), advice));
}

}  // namespace wold
