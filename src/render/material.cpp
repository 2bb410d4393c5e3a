#include "render/material.hpp"

#include <algorithm>
#include <array>

#include "base/hash.hpp"

namespace wold {

namespace {

constexpr int texture_octaves = 5;

/// Brightness and a shift between yellow and blue-green, each about 1, from random bits.
Vec3 tint(std::uint64_t bits, float amount) {
  const float brightness = 1 + amount * (2 * uniform(bits) - 1);
  const float warmth = amount * (2 * uniform(mix_bits(bits)) - 1);
  return brightness * Vec3(1 + 0.9F * warmth, 1, 1 - 0.5F * warmth);
}

}  // namespace

TwoColorTexture::TwoColorTexture(const TwoColors& colors, std::uint32_t seed, float stretch)
    : colors_(colors),
      stretch_(stretch),
      noise_(Fractal{.octaves = texture_octaves, .hurst = 0.7F}, seed) {}

Vec3 TwoColorTexture::at(Vec3 p, float footprint) const {
  const Vec3 scaled = Vec3(p.x, p.y, p.z / stretch_) / colors_.feature_size;
  const float n = noise_(DVec3(scaled), footprint / colors_.feature_size).value;
  const float share = std::clamp(0.5F + colors_.contrast * n, 0.0F, 1.0F);
  return glm::mix(colors_.color1, colors_.color2, share);
}

Description<Material> describe(const Material&) {
  return Description<Material>(
             "material",
             "What a part of a plant is made of; overrides or adds to the standard materials.")
      .add("name", &Material::name, "Name that plants and species use.")
      .add("color1", &Material::color1, {.min = 0, .max = 1},
           "First colour, linear Rec. 709 reflectance.")
      .add("color2", &Material::color2, {.min = 0, .max = 1},
           "Second colour, linear Rec. 709 reflectance.")
      .add("feature_size", &Material::feature_size, {.unit = "m", .min = 1e-4, .max = 1e4},
           "Size of the patches of the two colours.")
      .add("contrast", &Material::contrast, {.min = 0, .max = 20},
           "How sharply the two colours part; 0 gives their mean.")
      .add("stretch", &Material::stretch, {.min = 0.01, .max = 100},
           "How much longer patches are along the stem than across.")
      .add("transmission", &Material::transmission, {.min = 0, .max = 0.9},
           "Light let through by a thin leaf, linear Rec. 709.")
      .add("roughness", &Material::roughness, {.min = 0, .max = 1},
           "Roughness of the waxy coat; 0 for no coat.")
      .add("variation", &Material::variation, {.min = 0, .max = 1},
           "Difference of colour between leaves; a species' tint is that between plants.");
}

std::span<const Material> standard_materials() {
  static const std::array list = {
      Material{"bark",
               {0.11F, 0.085F, 0.065F},
               {0.21F, 0.175F, 0.14F},
               0.05F,
               1.6F,
               5,
               Vec3(0),
               0,
               0.12F},
      Material{"birch.bark",
               {0.62F, 0.59F, 0.54F},
               {0.06F, 0.05F, 0.045F},
               0.16F,
               3,
               0.22F,
               Vec3(0),
               0,
               0.06F},
      Material{"pine.bark",
               {0.13F, 0.085F, 0.06F},
               {0.33F, 0.175F, 0.09F},
               0.12F,
               1.5F,
               3,
               Vec3(0),
               0,
               0.1F},
      Material{
          "twig", {0.075F, 0.055F, 0.04F}, {0.13F, 0.1F, 0.075F}, 0.03F, 1, 4, Vec3(0), 0, 0.1F},
      Material{"leaf",
               {0.045F, 0.10F, 0.022F},
               {0.07F, 0.14F, 0.03F},
               0.6F,
               0.8F,
               1,
               {0.07F, 0.15F, 0.015F},
               0.45F,
               0.16F},
      Material{"birch.leaf",
               {0.06F, 0.125F, 0.025F},
               {0.095F, 0.165F, 0.035F},
               0.8F,
               0.8F,
               1,
               {0.10F, 0.19F, 0.018F},
               0.42F,
               0.18F},
      Material{"needle",
               {0.022F, 0.048F, 0.018F},
               {0.04F, 0.075F, 0.025F},
               0.5F,
               0.8F,
               1,
               {0.018F, 0.04F, 0.008F},
               0.4F,
               0.14F},
      Material{"grass",
               {0.055F, 0.115F, 0.022F},
               {0.13F, 0.15F, 0.045F},
               0.5F,
               1.2F,
               1,
               {0.07F, 0.13F, 0.02F},
               0.5F,
               0.25F},
      Material{"fern",
               {0.05F, 0.12F, 0.02F},
               {0.09F, 0.165F, 0.03F},
               0.4F,
               0.8F,
               1,
               {0.08F, 0.17F, 0.015F},
               0.5F,
               0.18F},
      Material{"petal",
               {0.75F, 0.74F, 0.68F},
               {0.8F, 0.78F, 0.6F},
               0.05F,
               1,
               1,
               {0.15F, 0.15F, 0.12F},
               0,
               0.1F},
      Material{
          "stem", {0.05F, 0.10F, 0.025F}, {0.08F, 0.12F, 0.035F}, 0.1F, 1, 2, Vec3(0), 0.5F, 0.1F},
      Material{
          "dead", {0.19F, 0.15F, 0.11F}, {0.28F, 0.23F, 0.17F}, 0.1F, 1.2F, 3, Vec3(0), 0, 0.15F},
      Material{"stone",
               {0.16F, 0.155F, 0.145F},
               {0.27F, 0.26F, 0.24F},
               0.3F,
               1.3F,
               1,
               Vec3(0),
               0,
               0.12F},
  };
  return list;
}

SurfaceMaterial::SurfaceMaterial(const Material& material, float tint)
    : material_(material),
      tint_(tint),
      texture_({material.color1, material.color2, material.feature_size, material.contrast},
               static_cast<std::uint32_t>(hash_text(material.name)), material.stretch) {}

SurfaceColor SurfaceMaterial::at(Vec3 p, float footprint, std::uint32_t individual,
                                 std::uint32_t leaf) const {
  const Material& m = material_;
  const std::uint64_t bits = random_bits(individual, 1);
  // Each individual has a piece of the texture of its own.
  const Vec3 place = p + 100.0F * Vec3(uniform(bits), uniform(mix_bits(bits)), 0);
  Vec3 own{1};
  if (tint_ > 0) own *= tint(bits, tint_);
  if (m.variation > 0) own *= tint(random_bits(bits, leaf), m.variation);
  SurfaceColor c;
  c.reflectance = texture_.at(place, footprint) * own;
  c.transmittance = m.transmission * own;
  // Energy: what is reflected and let through is at most 95 % of what came.
  const Vec3 sum = c.reflectance + c.transmittance;
  const float most = std::max({sum.x, sum.y, sum.z});
  if (most > 0.95F) {
    c.reflectance *= 0.95F / most;
    c.transmittance *= 0.95F / most;
  }
  return c;
}

}  // namespace wold
