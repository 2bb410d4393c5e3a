#include <epoxy/gl.h>
#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <memory>
#include <vector>

#include "base/error.hpp"
#include "gpu/context.hpp"
#include "gpu/objects.hpp"

namespace wold {

namespace {

struct Stage {
  unsigned kind;
  const ShaderText* text;
};

class ShaderObject {
 public:
  explicit ShaderObject(const Stage& stage) : id_(glCreateShader(stage.kind)) {
    const char* text = stage.text->text.c_str();
    glShaderSource(id_, 1, &text, nullptr);
    glCompileShader(id_);
    GLint done = GL_FALSE;
    glGetShaderiv(id_, GL_COMPILE_STATUS, &done);
    if (done == GL_TRUE) return;
    const std::string log = readable_shader_log(info_log(), *stage.text);
    glDeleteShader(id_);
    throw Error(ErrorKind::internal,
                fmt::format("the graphics driver refuses shader {}:\n{}", stage.text->name, log));
  }
  ~ShaderObject() { glDeleteShader(id_); }
  ShaderObject(const ShaderObject&) = delete;
  ShaderObject& operator=(const ShaderObject&) = delete;

  unsigned id() const { return id_; }

 private:
  std::string info_log() const {
    GLint length = 0;
    glGetShaderiv(id_, GL_INFO_LOG_LENGTH, &length);
    std::string log(static_cast<std::size_t>(std::max(length, 1)), '\0');
    glGetShaderInfoLog(id_, length, nullptr, log.data());
    return log;
  }

  unsigned id_;
};

std::string link_log(unsigned program) {
  GLint length = 0;
  glGetProgramiv(program, GL_INFO_LOG_LENGTH, &length);
  std::string log(static_cast<std::size_t>(std::max(length, 1)), '\0');
  glGetProgramInfoLog(program, length, nullptr, log.data());
  return log;
}

gl::Name<gl::ProgramKind> linked(std::span<const Stage> stages) {
  gl::Name<gl::ProgramKind> program(glCreateProgram());
  std::string names;
  {
    std::vector<std::unique_ptr<ShaderObject>> shaders;
    for (const Stage& stage : stages) {
      shaders.push_back(std::make_unique<ShaderObject>(stage));
      glAttachShader(program.get(), shaders.back()->id());
      names += (names.empty() ? "" : " with ") + stage.text->name;
    }
    glLinkProgram(program.get());
    for (const auto& shader : shaders) glDetachShader(program.get(), shader->id());
  }
  GLint done = GL_FALSE;
  glGetProgramiv(program.get(), GL_LINK_STATUS, &done);
  if (done != GL_TRUE)
    throw Error(ErrorKind::internal, fmt::format("the graphics driver cannot link {}:\n{}", names,
                                                 link_log(program.get())));
  return program;
}

GLsizei count_of(std::size_t items) {
  return static_cast<GLsizei>(items);
}

}  // namespace

GpuProgram::GpuProgram(const ShaderText& vertex, const ShaderText& fragment)
    : id_(linked(
          std::array<Stage, 2>{{{GL_VERTEX_SHADER, &vertex}, {GL_FRAGMENT_SHADER, &fragment}}})) {}

GpuProgram::GpuProgram(const ShaderText& compute)
    : id_(linked(std::array<Stage, 1>{{{GL_COMPUTE_SHADER, &compute}}})) {}

void GpuProgram::use() const {
  glUseProgram(id());
}

int GpuProgram::location(const char* name) const {
  use();
  return glGetUniformLocation(id(), name);
}

void GpuProgram::set(const char* name, float v) const {
  glUniform1f(location(name), v);
}
void GpuProgram::set(const char* name, int v) const {
  glUniform1i(location(name), v);
}
void GpuProgram::set(const char* name, std::uint32_t v) const {
  glUniform1ui(location(name), v);
}
void GpuProgram::set(const char* name, Vec2 v) const {
  glUniform2f(location(name), v.x, v.y);
}
void GpuProgram::set(const char* name, Vec3 v) const {
  glUniform3f(location(name), v.x, v.y, v.z);
}
void GpuProgram::set(const char* name, Vec4 v) const {
  glUniform4f(location(name), v.x, v.y, v.z, v.w);
}
void GpuProgram::set(const char* name, IVec2 v) const {
  glUniform2i(location(name), v.x, v.y);
}
void GpuProgram::set(const char* name, const Mat3& v) const {
  glUniformMatrix3fv(location(name), 1, GL_FALSE, &v[0][0]);
}
void GpuProgram::set(const char* name, const Mat4& v) const {
  glUniformMatrix4fv(location(name), 1, GL_FALSE, &v[0][0]);
}
void GpuProgram::set(const char* name, std::span<const float> v) const {
  if (!v.empty()) glUniform1fv(location(name), count_of(v.size()), v.data());
}
void GpuProgram::set(const char* name, std::span<const Vec2> v) const {
  if (!v.empty()) glUniform2fv(location(name), count_of(v.size()), &v[0][0]);
}
void GpuProgram::set(const char* name, std::span<const Vec3> v) const {
  if (!v.empty()) glUniform3fv(location(name), count_of(v.size()), &v[0][0]);
}
void GpuProgram::set(const char* name, std::span<const Vec4> v) const {
  if (!v.empty()) glUniform4fv(location(name), count_of(v.size()), &v[0][0]);
}
void GpuProgram::set(const char* name, std::span<const Mat4> v) const {
  if (!v.empty()) glUniformMatrix4fv(location(name), count_of(v.size()), GL_FALSE, &v[0][0][0]);
}
void GpuProgram::set(const char* name, std::span<const std::uint32_t> v) const {
  if (!v.empty()) glUniform1uiv(location(name), count_of(v.size()), v.data());
}

GpuProgram full_screen_program(const ShaderText& fragment) {
  return {assemble_shader("gpu/full_screen.vert.glsl", gpu_info().dialect), fragment};
}

GpuProgram full_screen_program(std::string_view fragment) {
  return full_screen_program(assemble_shader(fragment, gpu_info().dialect));
}

}  // namespace wold
