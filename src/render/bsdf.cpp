#include "render/bsdf.hpp"

#include <algorithm>
#include <cmath>

#include "render/camera.hpp"

namespace wold {

namespace {

constexpr float normal_reflectance = 0.04F;
constexpr float least_cosine = 1e-4F;

float schlick(float cosine) {
  const float m = 1 - std::clamp(cosine, 0.0F, 1.0F);
  const float m2 = m * m;
  return normal_reflectance + (1 - normal_reflectance) * m2 * m2 * m;
}

float ggx_distribution(float cosine, float alpha) {
  const float a2 = alpha * alpha;
  const float d = cosine * cosine * (a2 - 1) + 1;
  return a2 / (pi * d * d);
}

/// Smith's Λ for GGX.
float lambda(float cosine, float alpha) {
  const float c2 = cosine * cosine;
  return (std::sqrt(1 + alpha * alpha * (1 - c2) / c2) - 1) / 2;
}

Vec3 visible_normal(Vec3 view, float alpha, Vec2 u) {
  const Vec3 v = glm::normalize(Vec3(alpha * view.x, alpha * view.y, view.z));
  const float across = v.x * v.x + v.y * v.y;
  const Vec3 t1 = across > 0 ? Vec3(-v.y, v.x, 0) / std::sqrt(across) : Vec3(1, 0, 0);
  const Vec3 t2 = glm::cross(v, t1);
  const Vec2 d = disc_sample(u);
  const float s = (1 + v.z) / 2;
  const float y = (1 - s) * std::sqrt(std::max(0.0F, 1 - d.x * d.x)) + s * d.y;
  const float z = std::sqrt(std::max(0.0F, 1 - d.x * d.x - y * y));
  const Vec3 n = d.x * t1 + y * t2 + z * v;
  return glm::normalize(Vec3(alpha * n.x, alpha * n.y, std::max(n.z, 1e-6F)));
}

float average(Vec3 c) {
  return (c.x + c.y + c.z) / 3;
}

/// Orthonormal basis about a unit vector (Duff et al., JCGT 6(1), 2017).
void basis(Vec3 n, Vec3& t, Vec3& b) {
  const float sign = std::copysign(1.0F, n.z);
  const float a = -1 / (sign + n.z);
  const float c = n.x * n.y * a;
  t = {1 + sign * n.x * n.x * a, sign * c, -sign * n.x};
  b = {c, sign + n.y * n.y * a, -n.y};
}

}  // namespace

Vec3 cosine_hemisphere(Vec2 u) {
  const Vec2 d = disc_sample(u);
  return {d.x, d.y, std::sqrt(std::max(0.0F, 1 - d.x * d.x - d.y * d.y))};
}

Bsdf::Bsdf(Vec3 normal, Vec3 outgoing, Vec3 reflectance, Vec3 transmittance, float roughness)
    : normal_(normal),
      reflectance_(reflectance),
      transmittance_(transmittance),
      alpha_(roughness > 0 ? std::max(0.02F, roughness * roughness) : 0) {
  basis(normal_, tangent_, bitangent_);
  outgoing_ = to_local(outgoing);
  outgoing_.z = std::max(outgoing_.z, least_cosine);
  const float r = average(reflectance_);
  const float t = average(transmittance_);
  if (alpha_ > 0) {
    const float f = schlick(outgoing_.z);
    reflectance_ *= 1 - f;
    transmittance_ *= 1 - f;
    coat_probability_ = f / std::max(f + r + t, 1e-6F);
  }
  transmission_probability_ = t / std::max(r + t, 1e-6F);
}

Vec3 Bsdf::coat(Vec3 incoming) const {
  const Vec3 h = glm::normalize(incoming + outgoing_);
  const float f = schlick(glm::dot(h, outgoing_));
  const float d = ggx_distribution(h.z, alpha_);
  const float g =
      1 / (1 + lambda(outgoing_.z, alpha_) + lambda(std::max(incoming.z, least_cosine), alpha_));
  return Vec3(f * d * g / (4 * outgoing_.z));
}

float Bsdf::coat_pdf(Vec3 incoming) const {
  const Vec3 h = glm::normalize(incoming + outgoing_);
  const float visible = 1 / (1 + lambda(outgoing_.z, alpha_));
  return visible * ggx_distribution(h.z, alpha_) / (4 * outgoing_.z);
}

Vec3 Bsdf::evaluate(Vec3 incoming) const {
  const Vec3 i = to_local(incoming);
  const float entering = alpha_ > 0 ? 1 - schlick(std::abs(i.z)) : 1;
  if (i.z < 0) return transmittance_ * (-i.z / pi * entering);
  Vec3 value = reflectance_ * (i.z / pi * entering);
  if (alpha_ > 0) value += coat(i);
  return value;
}

float Bsdf::pdf(Vec3 incoming) const {
  const Vec3 i = to_local(incoming);
  const float diffuse = 1 - coat_probability_;
  if (i.z < 0) return diffuse * transmission_probability_ * (-i.z / pi);
  float density = diffuse * (1 - transmission_probability_) * i.z / pi;
  if (alpha_ > 0) density += coat_probability_ * coat_pdf(i);
  return density;
}

BsdfSample Bsdf::sample(Vec2 u, float choice) const {
  Vec3 i;
  if (choice < coat_probability_) {
    const Vec3 h = visible_normal(outgoing_, alpha_, u);
    i = 2 * glm::dot(outgoing_, h) * h - outgoing_;
    if (i.z <= 0) return {};
  } else {
    i = cosine_hemisphere(u);
    const float rest = (choice - coat_probability_) / std::max(1 - coat_probability_, 1e-6F);
    if (rest < transmission_probability_) i.z = -i.z;
  }
  const Vec3 direction = glm::normalize(to_world(i));
  const float density = pdf(direction);
  if (!(density > 0)) return {};
  return {direction, evaluate(direction) / density, density};
}

}  // namespace wold
