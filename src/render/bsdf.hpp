#pragma once
// How a surface scatters light at a point: diffuse reflection, diffuse transmission (a thin leaf),
// and a rough dielectric coat over both.
//
//   f = (1 - F(n·ω_o)) (1 - F(n·ω_i)) ρ / π     on the side of the viewer
//     + (1 - F(n·ω_o)) (1 - F(n·ω_i)) τ / π     on the other side
//     + F(ω_o·h) D(h) G(ω_i, ω_o) / (4 |n·ω_i| |n·ω_o|)   coat, where there is one
//
// D and G are GGX (Walter et al., EGSR 2007), normals sampled as visible (Heitz, JCGT 7(4), 2018);
// F is Schlick's with F0 = 0.04, and 0 without a coat. With ρ + τ <= 1 the sum gives back no more
// than it gets.

#include "base/vec.hpp"

namespace wold {

/// Direction and its weight f |cos| / pdf. `pdf` is 0 when no direction could be drawn.
struct BsdfSample {
  Vec3 direction{0};
  Vec3 weight{0};
  float pdf = 0;  ///< 1/sr
};

class Bsdf {
 public:
  /// `normal`: unit, on the side of `outgoing` (towards the viewer). `roughness` in (0, 1]; no coat
  /// when it is 0.
  Bsdf(Vec3 normal, Vec3 outgoing, Vec3 reflectance, Vec3 transmittance, float roughness);

  /// f |n·ω_i|.
  Vec3 evaluate(Vec3 incoming) const;
  /// Density of `sample`, 1/sr.
  float pdf(Vec3 incoming) const;
  BsdfSample sample(Vec2 u, float choice) const;

 private:
  Vec3 to_world(Vec3 v) const { return v.x * tangent_ + v.y * bitangent_ + v.z * normal_; }
  Vec3 to_local(Vec3 v) const {
    return {glm::dot(v, tangent_), glm::dot(v, bitangent_), glm::dot(v, normal_)};
  }
  Vec3 coat(Vec3 incoming_local) const;
  float coat_pdf(Vec3 incoming_local) const;

  Vec3 normal_;
  Vec3 tangent_;
  Vec3 bitangent_;
  Vec3 outgoing_;  // local, z > 0
  Vec3 reflectance_;
  Vec3 transmittance_;
  float alpha_;  // GGX width; 0 for no coat
  float coat_probability_ = 0;
  float transmission_probability_ = 0;
};

/// Cosine-weighted direction about +z; its density is z/π.
Vec3 cosine_hemisphere(Vec2 u);

}  // namespace wold
