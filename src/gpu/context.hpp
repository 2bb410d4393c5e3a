#pragma once
// An OpenGL context without a window (EGL), and what the driver of the current context can do.
//
// A context is current on the thread that made it. All of gpu/ expects one to be current.

#include <memory>
#include <string>

#include "shaders/assembly.hpp"

namespace wold {

/// What the current context's driver is.
struct GpuInfo {
  std::string vendor;
  std::string renderer;
  std::string version;
  int major = 0;
  int minor = 0;
  bool es = false;
  bool software = false;     ///< drawn by the processor (llvmpipe, SwiftShader)
  bool compute = false;      ///< OpenGL 4.3
  int max_texture_size = 0;  ///< pixels on a side
  float max_anisotropy = 1;  ///< of texture filtering; 1 where there is none
  ShaderDialect dialect = ShaderDialect::gl_330;
};

/// Throws Error(limit), naming what is missing, where it is less than OpenGL 3.3 or ES 3.0 with
/// textures of 4096 and float targets.
GpuInfo gpu_info();

struct ContextSettings {
  int major = 4;  ///< highest version asked for; 3.3 is the fallback
  int minor = 3;
  bool es = false;  ///< OpenGL ES 3.0
};

/// Current on this thread from its making to its end.
class OffscreenContext {
 public:
  /// Throws Error(limit) where no driver gives such a context, naming the package or setting that
  /// helps.
  explicit OffscreenContext(const ContextSettings& settings = {});
  ~OffscreenContext();
  OffscreenContext(OffscreenContext&&) noexcept;
  OffscreenContext& operator=(OffscreenContext&&) noexcept;

  void make_current() const;

 private:
  struct State;
  std::unique_ptr<State> state_;
};

}  // namespace wold
