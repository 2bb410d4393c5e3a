#pragma once
// From the light of a scene to what a screen shows: exposure, a tone map, and the sRGB curve.
//
//   display = srgb(map(2^exposure · c))        c linear Rec. 709
//
//   clip         min(c, 1)
//   exponential  1 - e^-c
//   agx          inset matrix, log2 over [-10, 6.5] stops around 0.18, sigmoid, outset matrix
//                (Troy Sobotka, AgX, github.com/sobotka/AgX, 2022). The sigmoid through
//                (x_p, 0.5), x_p = 10 / 16.5, with slope m = 2 there:
//                  s(x) = 0.5 + S h(m (x - x_p) / S),  h(t) = t / (1 + |t|^p)^(1/p)
//                p = 3 below and 3.25 above x_p; S such that s(0) = 0 and s(1) = 1. The matrix is
//                the published one, each row divided by its sum so that grey stays grey; the
//                outset is its inverse; the result is linearised with gamma 2.2 as in B. Wrensch,
//                "Minimal AgX implementation", 2023.
//   agx_punchy   agx with more contrast (power 1.35) and saturation (1.4) after the sigmoid
//   neutral      Khronos PBR Neutral: true colours up to 0.76, then highlights compressed and
//                desaturated (Khronos Group, "PBR Neutral tone mapper specification", 2024)
//
// Each maps 0 to 0, grey to grey, into [0, 1], and is monotone on greys.
//
// Measured exposure brings the log-average luminance (Reinhard et al., "Photographic tone
// reproduction for digital images", SIGGRAPH 2002) of the pixels between the 5th and the 95th
// percentile to `metered_grey`. So that a bright sky does not turn the land black, the upper
// part of the picture counts less, as in the metering of a camera.

#include <span>
#include <vector>

#include "base/parameters.hpp"
#include "base/vec.hpp"
#include "image/image.hpp"

namespace wold {

enum class ToneOperator { clip, exponential, agx, agx_punchy, neutral };

struct ToneMapping {
  ToneOperator tone_map = ToneOperator::neutral;
  float exposure = 0;         ///< stops, on top of what is measured
  bool auto_exposure = true;  ///< measure first
};

Description<ToneMapping> describe(const ToneMapping&);

/// Linear light to linear light of the display, in [0, 1]. Negative light and NaN count as 0,
/// infinite light as very bright.
Vec3 tone_mapped(Vec3 color, ToneOperator tone_map);

/// What a measured exposure makes of the mean: darker than a photographer's grey card, 0.18,
/// because plants and soil are.
inline constexpr float metered_grey = 0.125F;

/// The exposure in stops that suits a linear picture (channels R, G, B). `weights`, if not empty,
/// says how much each pixel counts, row by row from the top (say 1 for land, 0.1 for sky) and
/// replaces the metering by height. Pixels that are black or not finite do not count; 0 stops if
/// none is left.
float measured_exposure(const Image& linear, std::span<const float> weights = {});

/// Weights by which land decides the exposure and not the sky, of a picture whose channel A is the
/// part that is surface.
std::vector<float> land_weights(const Image& linear);

/// The exposure in stops that `mapping` asks for: measured, if so, plus its own.
float exposure_of(const Image& linear, const ToneMapping& mapping,
                  std::span<const float> weights = {});

/// The same mapping with an exposure that is known, in stops.
ToneMapping at_exposure(ToneMapping mapping, float stops);

/// A picture with R, G, B, opaque, for a display, sRGB encoded, in [0, 1], to be
/// written with write_png {.bits = 8, .srgb = true, .dither = true}.
Image display_image(const Image& linear, const ToneMapping& mapping,
                    std::span<const float> weights = {});

}  // namespace wold
