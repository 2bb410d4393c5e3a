#pragma once
// A function of GLSL at many points: what the tests use to compare shaders with their C++ twins.

#include <functional>
#include <span>
#include <string_view>
#include <vector>

#include "base/vec.hpp"
#include "gpu/objects.hpp"
#include "shaders/assembly.hpp"

namespace wold {

/// `body` is GLSL that may include files and defines `vec4 evaluate(vec4 a, vec4 b)`; it is called
/// with a[k] and b[k] (b may be empty: zero). Bits of unsigned integers may travel as floats
/// (uintBitsToFloat) as long as they are no NaN. `prepare` sets uniforms and textures, on units 0
/// to 29. Throws as GpuProgram.
std::vector<Vec4> evaluate_shader(std::string_view body, std::span<const Vec4> a,
                                  std::span<const Vec4> b = {},
                                  std::span<const ShaderDefine> defines = {},
                                  const std::function<void(const GpuProgram&)>& prepare = {});

}  // namespace wold
