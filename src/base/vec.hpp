#pragma once
// Vector and matrix types (GLM), under the project's own names.
// World convention: right-handed, X east, Y north, Z up, metres.

#include <glm/ext/matrix_double2x2.hpp>
#include <glm/ext/matrix_double3x3.hpp>
#include <glm/ext/matrix_float2x2.hpp>
#include <glm/ext/matrix_float3x3.hpp>
#include <glm/ext/matrix_float4x4.hpp>
#include <glm/ext/vector_double2.hpp>
#include <glm/ext/vector_double3.hpp>
#include <glm/ext/vector_float2.hpp>
#include <glm/ext/vector_float3.hpp>
#include <glm/ext/vector_float4.hpp>
#include <glm/ext/vector_int2.hpp>
#include <glm/ext/vector_uint3.hpp>
#include <glm/geometric.hpp>
#include <glm/matrix.hpp>

namespace wold {

using Vec2 = glm::vec2;
using Vec3 = glm::vec3;
using Vec4 = glm::vec4;
using DVec2 = glm::dvec2;
using DVec3 = glm::dvec3;
using IVec2 = glm::ivec2;
using UVec3 = glm::uvec3;
using Mat2 = glm::mat2;
using Mat3 = glm::mat3;
using Mat4 = glm::mat4;
using DMat2 = glm::dmat2;
using DMat3 = glm::dmat3;

inline constexpr float pi = 3.14159265358979323846F;
inline constexpr double pi_d = 3.14159265358979323846;

constexpr float radians(float degrees) {
  return degrees * (pi / 180.0F);
}
constexpr double radians(double degrees) {
  return degrees * (pi_d / 180.0);
}
constexpr float degrees(float radians) {
  return radians * (180.0F / pi);
}
constexpr double degrees(double radians) {
  return radians * (180.0 / pi_d);
}

}  // namespace wold
