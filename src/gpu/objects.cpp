#include "gpu/objects.hpp"

#include <epoxy/gl.h>
#include <fmt/format.h>

#include <algorithm>
#include <chrono>
#include <cmath>

#include "base/error.hpp"

namespace wold {

namespace gl {

void ProgramKind::end(unsigned id) {
  glDeleteProgram(id);
}
void BufferKind::end(unsigned id) {
  glDeleteBuffers(1, &id);
}
void TextureKind::end(unsigned id) {
  glDeleteTextures(1, &id);
}
void TargetKind::end(unsigned id) {
  glDeleteFramebuffers(1, &id);
}
void VertexArrayKind::end(unsigned id) {
  glDeleteVertexArrays(1, &id);
}

void check(std::string_view doing) {
  GLenum error = glGetError();
  if (error == GL_NO_ERROR) return;
  const GLenum first = error;
  for (int k = 0; k < 16 && error != GL_NO_ERROR; ++k) error = glGetError();
  if (first == GL_OUT_OF_MEMORY)
    throw Error(ErrorKind::limit,
                fmt::format("the graphics memory does not suffice for {}", doing));
  throw Error(ErrorKind::internal, fmt::format("OpenGL error 0x{:x} in {}", first, doing));
}

}  // namespace gl

namespace {

template <class Kind, class Make>
gl::Name<Kind> made(const Make& make) {
  unsigned id = 0;
  make(1, &id);
  return gl::Name<Kind>(id);
}

/// How OpenGL names a pixel format.
struct FormatNames {
  GLenum internal;
  GLenum external;
  GLenum type;  // of the texels that come from us
};

FormatNames names_of(PixelFormat format) {
  switch (format) {
    case PixelFormat::r8: return {GL_R8, GL_RED, GL_UNSIGNED_BYTE};
    case PixelFormat::rgba8: return {GL_RGBA8, GL_RGBA, GL_UNSIGNED_BYTE};
    case PixelFormat::srgb8: return {GL_SRGB8_ALPHA8, GL_RGBA, GL_UNSIGNED_BYTE};
    case PixelFormat::r16f: return {GL_R16F, GL_RED, GL_FLOAT};
    case PixelFormat::rg16f: return {GL_RG16F, GL_RG, GL_FLOAT};
    case PixelFormat::rgba16f: return {GL_RGBA16F, GL_RGBA, GL_FLOAT};
    case PixelFormat::r32f: return {GL_R32F, GL_RED, GL_FLOAT};
    case PixelFormat::rg32f: return {GL_RG32F, GL_RG, GL_FLOAT};
    case PixelFormat::rgba32f: return {GL_RGBA32F, GL_RGBA, GL_FLOAT};
    case PixelFormat::rgba32ui: return {GL_RGBA32UI, GL_RGBA_INTEGER, GL_UNSIGNED_INT};
    case PixelFormat::depth24: return {GL_DEPTH_COMPONENT24, GL_DEPTH_COMPONENT, GL_UNSIGNED_INT};
    case PixelFormat::depth32f: return {GL_DEPTH_COMPONENT32F, GL_DEPTH_COMPONENT, GL_FLOAT};
  }
  return {GL_RGBA8, GL_RGBA, GL_UNSIGNED_BYTE};
}

GLint shrinking_filter(TextureFilter filter) {
  if (filter == TextureFilter::mipmap) return GL_LINEAR_MIPMAP_LINEAR;
  return filter == TextureFilter::linear ? GL_LINEAR : GL_NEAREST;
}

int all_levels(int width, int height) {
  return 1 + static_cast<int>(std::floor(std::log2(static_cast<double>(std::max(width, height)))));
}

}  // namespace

GpuBuffer::GpuBuffer(std::span<const std::byte> bytes, bool dynamic)
    : id_(made<gl::BufferKind>(glGenBuffers)), dynamic_(dynamic) {
  assign(bytes);
}

void GpuBuffer::assign(std::span<const std::byte> bytes) {
  // GL_COPY_WRITE_BUFFER: binding to it disturbs no vertex array.
  glBindBuffer(GL_COPY_WRITE_BUFFER, id());
  glBufferData(GL_COPY_WRITE_BUFFER, static_cast<GLsizeiptr>(bytes.size()), bytes.data(),
               dynamic_ ? GL_DYNAMIC_DRAW : GL_STATIC_DRAW);
  bytes_ = bytes.size();
  gl::check(fmt::format("a buffer of {} bytes", bytes_));
}

GpuTexture::GpuTexture(int width, int height, const TextureSettings& settings)
    : id_(made<gl::TextureKind>(glGenTextures)),
      width_(width),
      height_(height),
      settings_(settings) {
  GLint largest = 0;
  glGetIntegerv(GL_MAX_TEXTURE_SIZE, &largest);
  if (std::max(width, height) > largest)
    throw Error(ErrorKind::limit,
                fmt::format("a picture of {} x {} pixels is more than this graphics driver draws: "
                            "at most {} on a side",
                            width, height, largest));
  if (settings_.levels == 0) settings_.levels = all_levels(width, height);
  const GLenum target = this->target();
  glBindTexture(target, id());
  const FormatNames names = names_of(settings.format);
  int w = width;
  int h = height;
  for (int level = 0; level < settings_.levels; ++level) {
    if (settings.layers > 0)
      glTexImage3D(target, level, static_cast<GLint>(names.internal), w, h, settings.layers, 0,
                   names.external, names.type, nullptr);
    else
      glTexImage2D(target, level, static_cast<GLint>(names.internal), w, h, 0, names.external,
                   names.type, nullptr);
    w = std::max(1, w / 2);
    h = std::max(1, h / 2);
  }
  glTexParameteri(target, GL_TEXTURE_MAX_LEVEL, settings_.levels - 1);
  glTexParameteri(target, GL_TEXTURE_MIN_FILTER, shrinking_filter(settings.filter));
  glTexParameteri(target, GL_TEXTURE_MAG_FILTER,
                  settings.filter == TextureFilter::nearest ? GL_NEAREST : GL_LINEAR);
  const GLint wrap = settings.repeat ? GL_REPEAT : GL_CLAMP_TO_EDGE;
  glTexParameteri(target, GL_TEXTURE_WRAP_S, wrap);
  glTexParameteri(target, GL_TEXTURE_WRAP_T, wrap);
  gl::check(fmt::format("a texture of {} x {} pixels", width, height));
}

GpuTexture::GpuTexture(GridView<const float> values, const TextureSettings& settings)
    : GpuTexture(values.width(), values.height(), settings) {
  std::vector<float> packed;
  packed.reserve(static_cast<std::size_t>(width_) * static_cast<std::size_t>(height_));
  for (int j = 0; j < height_; ++j)
    for (int i = 0; i < width_; ++i) packed.push_back(values(i, j));
  upload(packed);
}

unsigned GpuTexture::target() const {
  return settings_.layers > 0 ? GL_TEXTURE_2D_ARRAY : GL_TEXTURE_2D;
}

// It changes what the texture holds.
// NOLINTNEXTLINE(readability-make-member-function-const)
void GpuTexture::put(unsigned type, const void* data, int layer, int level) {
  const GLenum target = this->target();
  const int w = std::max(1, width_ >> level);
  const int h = std::max(1, height_ >> level);
  glBindTexture(target, id());
  glPixelStorei(GL_UNPACK_ALIGNMENT, 1);
  const GLenum external = names_of(settings_.format).external;
  if (settings_.layers > 0)
    glTexSubImage3D(target, level, 0, 0, layer, w, h, 1, external, type, data);
  else
    glTexSubImage2D(target, level, 0, 0, w, h, external, type, data);
  gl::check("filling a texture");
}

void GpuTexture::upload(std::span<const float> values, int layer, int level) {
  put(GL_FLOAT, values.data(), layer, level);
}
void GpuTexture::upload(std::span<const std::uint8_t> values, int layer, int level) {
  put(GL_UNSIGNED_BYTE, values.data(), layer, level);
}
void GpuTexture::upload(std::span<const std::uint32_t> values, int layer, int level) {
  put(GL_UNSIGNED_INT, values.data(), layer, level);
}

// NOLINTNEXTLINE(readability-make-member-function-const)
void GpuTexture::make_mipmaps() {
  glBindTexture(target(), id());
  glGenerateMipmap(target());
  gl::check("mipmaps");
}

void GpuTexture::bind(int unit) const {
  glActiveTexture(GL_TEXTURE0 + static_cast<GLenum>(unit));
  glBindTexture(target(), id());
}

GpuTarget::GpuTarget(int width, int height, std::span<const PixelFormat> colors, bool depth,
                     TextureFilter filter)
    : id_(made<gl::TargetKind>(glGenFramebuffers)), width_(width), height_(height) {
  glBindFramebuffer(GL_FRAMEBUFFER, id());
  std::vector<GLenum> buffers;
  for (const PixelFormat format : colors) {
    colors_.emplace_back(width, height, TextureSettings{.format = format, .filter = filter});
    buffers.push_back(GL_COLOR_ATTACHMENT0 + static_cast<GLenum>(buffers.size()));
    glFramebufferTexture2D(GL_FRAMEBUFFER, buffers.back(), GL_TEXTURE_2D, colors_.back().id(), 0);
  }
  if (depth) {
    depth_ = GpuTexture(width, height,
                        {.format = PixelFormat::depth32f, .filter = TextureFilter::nearest});
    glFramebufferTexture2D(GL_FRAMEBUFFER, GL_DEPTH_ATTACHMENT, GL_TEXTURE_2D, depth_.id(), 0);
  }
  if (buffers.empty()) buffers.push_back(GL_NONE);
  glDrawBuffers(static_cast<GLsizei>(buffers.size()), buffers.data());
  if (glCheckFramebufferStatus(GL_FRAMEBUFFER) != GL_FRAMEBUFFER_COMPLETE)
    throw Error(ErrorKind::limit,
                fmt::format("the graphics driver cannot draw into a picture of {} x {} pixels of "
                            "this kind",
                            width, height));
  gl::check("a picture to draw into");
}

void GpuTarget::bind() const {
  glBindFramebuffer(GL_FRAMEBUFFER, id());
  glViewport(0, 0, width_, height_);
}

std::vector<float> GpuTarget::read(int k) const {
  std::vector<float> out(4 * static_cast<std::size_t>(width_) * static_cast<std::size_t>(height_));
  glBindFramebuffer(GL_FRAMEBUFFER, id());
  glReadBuffer(GL_COLOR_ATTACHMENT0 + static_cast<GLenum>(k));
  glPixelStorei(GL_PACK_ALIGNMENT, 1);
  glReadPixels(0, 0, width_, height_, GL_RGBA, GL_FLOAT, out.data());
  gl::check("reading a picture");
  return out;
}

GpuVertices::GpuVertices() : id_(made<gl::VertexArrayKind>(glGenVertexArrays)) {}

void GpuVertices::bind() const {
  glBindVertexArray(id_.get());
}

void GpuVertices::attribute(const GpuBuffer& buffer, const Attribute& a) const {
  bind();
  glBindBuffer(GL_ARRAY_BUFFER, buffer.id());
  const auto location = static_cast<GLuint>(a.location);
  const auto stride = static_cast<GLsizei>(a.stride);
  const void* offset =
      reinterpret_cast<const void*>(a.offset);  // NOLINT(performance-no-int-to-ptr)
  glEnableVertexAttribArray(location);
  if (a.integer)
    glVertexAttribIPointer(location, a.components, a.type, stride, offset);
  else
    glVertexAttribPointer(location, a.components, a.type, a.normalized ? GL_TRUE : GL_FALSE, stride,
                          offset);
  glVertexAttribDivisor(location, a.per_instance ? 1 : 0);
  gl::check("vertices");
}

void GpuVertices::indices(const GpuBuffer& buffer) const {
  bind();
  glBindBuffer(GL_ELEMENT_ARRAY_BUFFER, buffer.id());
}

void draw_full_screen() {
  const GpuVertices none;
  none.bind();
  glDrawArrays(GL_TRIANGLES, 0, 3);
  gl::check("drawing a picture");
}

namespace {
std::int64_t now_nanoseconds() {
  return std::chrono::steady_clock::now().time_since_epoch() / std::chrono::nanoseconds(1);
}
}  // namespace

// By the clock and with glFinish: llvmpipe's own timer queries measure something else, and a wait
// at both ends holds on every driver.
void GpuTimer::begin() {
  glFinish();
  start_ = now_nanoseconds();
}

double GpuTimer::end() const {
  glFinish();
  return static_cast<double>(now_nanoseconds() - start_) * 1e-6;
}

}  // namespace wold
