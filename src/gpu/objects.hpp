#pragma once
// OpenGL objects that own their names: programs, buffers, textures, targets. Each needs the context
// it was made in to be current, at its end too. Errors of the driver are thrown, not polled.

#include <cstddef>
#include <cstdint>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "base/grid.hpp"
#include "base/vec.hpp"
#include "shaders/assembly.hpp"

namespace wold {

namespace gl {

/// The name of an OpenGL object, given back at its end. `Kind` has `static void end(unsigned)`.
template <class Kind>
class Name {
 public:
  Name() = default;
  explicit Name(unsigned id) : id_(id) {}
  ~Name() { reset(); }
  Name(Name&& other) noexcept : id_(other.id_) { other.id_ = 0; }
  Name& operator=(Name&& other) noexcept {
    if (this != &other) {
      reset();
      id_ = other.id_;
      other.id_ = 0;
    }
    return *this;
  }
  Name(const Name&) = delete;
  Name& operator=(const Name&) = delete;

  unsigned get() const { return id_; }
  explicit operator bool() const { return id_ != 0; }

 private:
  void reset() {
    if (id_ != 0) Kind::end(id_);
    id_ = 0;
  }
  unsigned id_ = 0;
};

struct ProgramKind {
  static void end(unsigned id);
};
struct BufferKind {
  static void end(unsigned id);
};
struct TextureKind {
  static void end(unsigned id);
};
struct TargetKind {
  static void end(unsigned id);
};
struct VertexArrayKind {
  static void end(unsigned id);
};

/// Throws Error(internal) that names `doing` if OpenGL reports an error, Error(limit) if it is out
/// of memory.
void check(std::string_view doing);

}  // namespace gl

/// A linked program. Uniforms that the program does not have are passed over: the compiler drops
/// what is not used.
class GpuProgram {
 public:
  GpuProgram() = default;
  /// Throws Error(internal) with the driver's log, in the names of our files.
  GpuProgram(const ShaderText& vertex, const ShaderText& fragment);
  /// A compute shader, OpenGL 4.3.
  explicit GpuProgram(const ShaderText& compute);

  explicit operator bool() const { return static_cast<bool>(id_); }
  unsigned id() const { return id_.get(); }
  void use() const;

  // All make the program current.
  void set(const char* name, float v) const;
  void set(const char* name, int v) const;
  void set(const char* name, std::uint32_t v) const;
  void set(const char* name, bool v) const { set(name, v ? 1 : 0); }
  void set(const char* name, Vec2 v) const;
  void set(const char* name, Vec3 v) const;
  void set(const char* name, Vec4 v) const;
  void set(const char* name, IVec2 v) const;
  void set(const char* name, const Mat3& v) const;
  void set(const char* name, const Mat4& v) const;
  void set(const char* name, std::span<const float> v) const;
  void set(const char* name, std::span<const Vec2> v) const;
  void set(const char* name, std::span<const Vec3> v) const;
  void set(const char* name, std::span<const Vec4> v) const;
  void set(const char* name, std::span<const Mat4> v) const;
  void set(const char* name, std::span<const std::uint32_t> v) const;

 private:
  int location(const char* name) const;
  gl::Name<gl::ProgramKind> id_;
};

class GpuBuffer {
 public:
  GpuBuffer() = default;
  /// `bytes` may be empty; `dynamic` for what changes often.
  explicit GpuBuffer(std::span<const std::byte> bytes, bool dynamic = false);
  template <class T>
  static GpuBuffer of(std::span<const T> items, bool dynamic = false) {
    return GpuBuffer(std::as_bytes(items), dynamic);
  }
  unsigned id() const { return id_.get(); }
  std::size_t bytes() const { return bytes_; }
  /// New contents, of any size.
  void assign(std::span<const std::byte> bytes);

 private:
  gl::Name<gl::BufferKind> id_;
  std::size_t bytes_ = 0;
  bool dynamic_ = false;
};

enum class PixelFormat {
  r8,
  rgba8,
  srgb8,
  r16f,
  rg16f,
  rgba16f,
  r32f,
  rg32f,
  rgba32f,
  rgba32ui,
  depth24,
  depth32f
};
enum class TextureFilter { nearest, linear, mipmap };

struct TextureSettings {
  PixelFormat format = PixelFormat::rgba8;
  TextureFilter filter = TextureFilter::linear;
  bool repeat = false;  ///< else clamped to the edge
  int layers = 0;       ///< 0: a plain 2D texture; else an array
  int levels = 1;       ///< of mipmaps; 0: all
};

/// A 2D texture or array of them.
class GpuTexture {
 public:
  GpuTexture() = default;
  GpuTexture(int width, int height, const TextureSettings& settings);
  explicit GpuTexture(GridView<const float> values,
                      const TextureSettings& settings = {.format = PixelFormat::r32f});

  explicit operator bool() const { return static_cast<bool>(id_); }
  unsigned id() const { return id_.get(); }
  unsigned target() const;  ///< GL_TEXTURE_2D or GL_TEXTURE_2D_ARRAY
  int width() const { return width_; }
  int height() const { return height_; }
  const TextureSettings& settings() const { return settings_; }

  /// Replaces one layer; rows go from texture coordinate v = 0 up. The item type must fit the
  /// format: float or std::uint8_t for 8-bit formats; float for float formats; std::uint32_t.
  void upload(std::span<const float> values, int layer = 0, int level = 0);
  void upload(std::span<const std::uint8_t> values, int layer = 0, int level = 0);
  void upload(std::span<const std::uint32_t> values, int layer = 0, int level = 0);
  void make_mipmaps();
  void bind(int unit) const;

 private:
  void put(unsigned type, const void* data, int layer, int level);
  gl::Name<gl::TextureKind> id_;
  int width_ = 0;
  int height_ = 0;
  TextureSettings settings_;
};

/// A framebuffer with colour textures and perhaps a depth texture, all its own.
class GpuTarget {
 public:
  GpuTarget() = default;
  /// Throws Error(limit) if the driver can't draw into these formats or the size is beyond it.
  GpuTarget(int width, int height, std::span<const PixelFormat> colors, bool depth,
            TextureFilter filter = TextureFilter::linear);

  explicit operator bool() const { return static_cast<bool>(id_); }
  unsigned id() const { return id_.get(); }
  int width() const { return width_; }
  int height() const { return height_; }
  const GpuTexture& color(int k = 0) const { return colors_[static_cast<std::size_t>(k)]; }
  GpuTexture& color(int k = 0) { return colors_[static_cast<std::size_t>(k)]; }
  const GpuTexture& depth() const { return depth_; }
  /// Makes it the one drawn into, with its whole size as viewport.
  void bind() const;
  /// Four floats per pixel of a colour, rows from the bottom up.
  std::vector<float> read(int k = 0) const;

 private:
  gl::Name<gl::TargetKind> id_;
  std::vector<GpuTexture> colors_;
  GpuTexture depth_;
  int width_ = 0;
  int height_ = 0;
};

/// Vertices as they lie in buffers.
class GpuVertices {
 public:
  struct Attribute {
    int location = 0;
    int components = 3;
    unsigned type = 0x1406;  ///< GL_FLOAT
    bool normalized = false;
    bool integer = false;
    std::size_t offset = 0;
    std::size_t stride = 0;
    bool per_instance = false;
  };

  GpuVertices();
  void attribute(const GpuBuffer& buffer, const Attribute& attribute) const;
  void indices(const GpuBuffer& buffer) const;
  void bind() const;

 private:
  gl::Name<gl::VertexArrayKind> id_;
};

/// A program that computes each pixel of a target by a fragment shader, for `draw_full_screen`: of
/// the path of a shader file, or of a text. In the current driver's dialect. Throws as GpuProgram.
GpuProgram full_screen_program(std::string_view fragment);
GpuProgram full_screen_program(const ShaderText& fragment);

/// Draws one triangle over the whole target: the vertex shader is "gpu/full_screen.vert.glsl".
void draw_full_screen();

/// Milliseconds that the drawing between `begin` and `end` took on the device, waiting for it.
class GpuTimer {
 public:
  void begin();
  double end() const;

 private:
  std::int64_t start_ = 0;
};

}  // namespace wold
