#include "image/tonemap.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <cstdint>

#include "base/error.hpp"
#include "base/parallel.hpp"
#include "image/color.hpp"

namespace wold {

namespace {

constexpr float middle_grey = 0.18F;

// As published, row by row.
constexpr double agx_inset_published[3][3] = {
    {0.842479062253094, 0.0784335999999992, 0.0792237451477643},
    {0.0423282422610123, 0.878468636469772, 0.0791661274605434},
    {0.0423756549057051, 0.0784336, 0.879142973793104}};

Mat3 agx_inset() {
  Mat3 m{};
  for (int row = 0; row < 3; ++row) {
    const auto& r = agx_inset_published[row];
    for (int column = 0; column < 3; ++column)
      m[column][row] = static_cast<float>(r[column] / (r[0] + r[1] + r[2]));
  }
  return m;
}

/// One half of the sigmoid, from its pivot to the end `run` away and `rise` up.
struct SigmoidHalf {
  float power;
  float scale;

  SigmoidHalf(float run, float rise, float p) : power(p) {
    // scale · h(slope · run / scale) = rise, solved for the scale.
    const float ratio = std::pow(slope * run / rise, power);
    scale = slope * run / std::pow(ratio - 1, 1 / power);
  }
  float operator()(float x) const {
    const float t = slope * x / scale;
    return scale * t / std::pow(1 + std::pow(std::abs(t), power), 1 / power);
  }
  static constexpr float slope = 2;
};

class AgX {
 public:
  explicit AgX(bool punchy) : punchy_(punchy) {}

  Vec3 operator()(Vec3 color) const {
    Vec3 v = inset_ * color;
    for (int c = 0; c < 3; ++c) v[c] = sigmoid(encoded(v[c]));
    if (punchy_) v = look(v);
    v = outset_ * v;
    for (int c = 0; c < 3; ++c) v[c] = std::pow(std::clamp(v[c], 0.0F, 1.0F), 2.2F);
    return v;
  }

 private:
  static constexpr float low = -10;  // stops from middle grey
  static constexpr float high = 6.5F;
  static constexpr float pivot = -low / (high - low);
  static constexpr float height = 0.5F;

  static float encoded(float light) {
    if (!(light > 0)) return 0;
    return std::clamp((std::log2(light / middle_grey) - low) / (high - low), 0.0F, 1.0F);
  }
  float sigmoid(float x) const {
    if (x <= 0) return 0;
    if (x >= 1) return 1;
    const float s = height + (x < pivot ? toe_(x - pivot) : shoulder_(x - pivot));
    return std::clamp(s, 0.0F, 1.0F);
  }
  /// ASC CDL with power 1.35 and saturation 1.4.
  static Vec3 look(Vec3 v) {
    for (int c = 0; c < 3; ++c) v[c] = std::pow(v[c], 1.35F);
    const float grey = luminance(v);
    return Vec3(grey) + 1.4F * (v - Vec3(grey));
  }

  bool punchy_;
  Mat3 inset_ = agx_inset();
  Mat3 outset_ = glm::inverse(agx_inset());
  SigmoidHalf toe_{pivot, height, 3};
  SigmoidHalf shoulder_{1 - pivot, 1 - height, 3.25F};
};

/// The specification's own names: F90, ks, kd.
Vec3 khronos_neutral(Vec3 c) {
  constexpr float f90 = 0.04F;
  constexpr float ks = 0.8F - f90;
  constexpr float kd = 0.15F;
  const float x = std::min({c.x, c.y, c.z});
  const float f = x <= 2 * f90 ? x - x * x / (4 * f90) : f90;
  c -= Vec3(f);
  const float peak = std::max({c.x, c.y, c.z});
  if (peak < ks) return c;
  const float compressed = 1 - (1 - ks) * (1 - ks) / (peak + 1 - 2 * ks);
  const float g = 1 / (kd * (peak - compressed) + 1);
  return c * (compressed / peak) * g + Vec3(compressed) * (1 - g);
}

/// Light that the maps can work with.
Vec3 usable(Vec3 color) {
  constexpr float bright = 1e6F;
  for (int c = 0; c < 3; ++c) color[c] = color[c] > 0 ? std::min(color[c], bright) : 0.0F;
  return color;
}

/// A tone map with its tables made once.
class ToneMap {
 public:
  explicit ToneMap(ToneOperator tone_map)
      : operator_(tone_map), agx_(tone_map == ToneOperator::agx_punchy) {}

  Vec3 operator()(Vec3 color) const {
    const Vec3 c = usable(color);
    switch (operator_) {
      case ToneOperator::clip: return glm::min(c, Vec3(1));
      case ToneOperator::exponential:
        return {-std::expm1(-c.x), -std::expm1(-c.y), -std::expm1(-c.z)};
      case ToneOperator::agx:
      case ToneOperator::agx_punchy: return agx_(c);
      case ToneOperator::neutral: return glm::clamp(khronos_neutral(c), Vec3(0), Vec3(1));
    }
    throw Error(ErrorKind::internal, "unknown tone map");
  }

 private:
  ToneOperator operator_;
  AgX agx_;
};

Vec3 color_at(const Image& image, int x, int y, const ColorChannels& c) {
  return {image.at(x, y, c.r), image.at(x, y, c.g), image.at(x, y, c.b)};
}

/// Luminances in stops as a weighted histogram: percentiles without sorting, and sums of whole
/// bins that depend on no order.
class StopHistogram {
 public:
  void add(float luminance_, float weight) {
    if (!(luminance_ > 0) || !std::isfinite(luminance_) || !(weight > 0)) return;
    const float stops = std::clamp(std::log2(luminance_), -range, range);
    const auto bin = static_cast<std::size_t>((stops + range) * bins_per_stop);
    // Fixed point, so that sums are exact.
    bins_[bin] += static_cast<std::uint64_t>(std::min(weight, 1000.0F) * 65536.0F);
  }
  bool empty() const { return total() == 0; }
  /// Mean of the stops between two quantiles.
  double trimmed_mean(double from, double to) const {
    const double all = total();
    double below = 0;
    double sum = 0;
    double weight = 0;
    for (std::size_t b = 0; b < bins_.size(); ++b) {
      const auto w = static_cast<double>(bins_[b]);
      const double inside = std::min(below + w, to * all) - std::max(below, from * all);
      below += w;
      if (inside <= 0) continue;
      sum += inside * ((static_cast<double>(b) + 0.5) / bins_per_stop - range);
      weight += inside;
    }
    return sum / weight;
  }

 private:
  static constexpr float range = 40;
  static constexpr float bins_per_stop = 64;

  double total() const {
    std::uint64_t sum = 0;
    for (const std::uint64_t b : bins_) sum += b;
    return static_cast<double>(sum);
  }

  std::vector<std::uint64_t> bins_ =
      std::vector<std::uint64_t>(static_cast<std::size_t>(2 * range * bins_per_stop) + 1);
};

/// 1 in the lower half, falling to 0.1 at the top.
float metering_weight(int y, int height) {
  const float up = 1 - (static_cast<float>(y) + 0.5F) / static_cast<float>(height);
  return up <= 0.5F ? 1.0F : 1.0F - 0.9F * (up - 0.5F) / 0.5F;
}

}  // namespace

Description<ToneMapping> describe(const ToneMapping&) {
  return Description<ToneMapping>("tone_mapping",
                                  "How the light of the scene becomes the colours of a PNG.")
      .choice("tone_map", &ToneMapping::tone_map,
              {"clip", "exponential", "agx", "agx_punchy", "neutral"},
              "Curve from light to display: agx like film, neutral keeps colours true, exponential "
              "is 1 - e^-c, clip has no curve.")
      .add("exposure", &ToneMapping::exposure, {.unit = "stops", .min = -30, .max = 30},
           "Brightness: +1 doubles the light; comes on top of what is measured.")
      .add("auto_exposure", &ToneMapping::auto_exposure,
           "Measure the brightness of the picture first.");
}

Vec3 tone_mapped(Vec3 color, ToneOperator tone_map) {
  return ToneMap(tone_map)(color);
}

float measured_exposure(const Image& linear, std::span<const float> weights) {
  const ColorChannels c = color_channels(linear);
  const auto width = static_cast<std::size_t>(linear.width);
  if (!weights.empty() && weights.size() != width * static_cast<std::size_t>(linear.height))
    throw Error(ErrorKind::internal, fmt::format("{} weights for a picture of {} x {}",
                                                 weights.size(), linear.width, linear.height));
  StopHistogram histogram;
  for (int y = 0; y < linear.height; ++y)
    for (int x = 0; x < linear.width; ++x) {
      const std::size_t k = static_cast<std::size_t>(y) * width + static_cast<std::size_t>(x);
      histogram.add(luminance(color_at(linear, x, y, c)),
                    weights.empty() ? metering_weight(y, linear.height) : weights[k]);
    }
  if (histogram.empty()) return 0;
  return static_cast<float>(std::log2(metered_grey) - histogram.trimmed_mean(0.05, 0.95));
}

std::vector<float> land_weights(const Image& linear) {
  const int cover = linear.find("A");
  std::vector<float> weights;
  weights.reserve(static_cast<std::size_t>(linear.width) * static_cast<std::size_t>(linear.height));
  for (int y = 0; y < linear.height; ++y)
    for (int x = 0; x < linear.width; ++x)
      weights.push_back(0.12F + 0.88F * linear.at(x, y, cover));
  return weights;
}

ToneMapping at_exposure(ToneMapping mapping, float stops) {
  mapping.auto_exposure = false;
  mapping.exposure = stops;
  return mapping;
}

float exposure_of(const Image& linear, const ToneMapping& mapping, std::span<const float> weights) {
  return mapping.exposure + (mapping.auto_exposure ? measured_exposure(linear, weights) : 0.0F);
}

Image display_image(const Image& linear, const ToneMapping& mapping,
                    std::span<const float> weights) {
  const float scale = std::exp2(exposure_of(linear, mapping, weights));
  const ToneMap map(mapping.tone_map);
  const ColorChannels c = color_channels(linear);
  Image display(linear.width, linear.height, {"R", "G", "B"});
  parallel_for(0, linear.height, [&](int y) {
    for (int x = 0; x < linear.width; ++x) {
      const Vec3 shown = map(scale * color_at(linear, x, y, c));
      for (int k = 0; k < 3; ++k) display.at(x, y, k) = linear_to_srgb(shown[k]);
    }
  });
  return display;
}

}  // namespace wold
