#include "realtime/land_fractal.hpp"

#include <fmt/format.h>

#include <cmath>
#include <vector>

#include "noise/lattice.hpp"
#include "realtime/land_function.hpp"
#include "terrain/fractal_ground.hpp"

namespace wold {

namespace {

/// What the loop's body adds to `total` for the octave's noise n.
std::string term(const Fractal& f) {
  switch (f.kind) {
    case FractalKind::fbm: return "total += o.amplitude * share * n;\n";
    case FractalKind::turbulence: return "total += o.amplitude * share * absolute(n, 0.0);\n";
    case FractalKind::hybrid:
      return fmt::format("total += share * hybrid_term(n, w, {}, o.amplitude);\n",
                         glsl_number(f.offset));
    case FractalKind::ridged:
      return fmt::format(
          "total += o.amplitude * share * ridge(n, w, {}, {}, float(SMOOTH_RIDGES) * {});\n",
          glsl_number(f.offset), glsl_number(f.gain), glsl_number(f.smooth_ridges));
    case FractalKind::eroded: break;
  }
  return fmt::format(
      "vec3 a = o.amplitude * share * n;\n    w.yz += a.yz;\n"
      "    total += a / (1.0 + {} * dot(w.yz, w.yz));\n",
      glsl_number(f.damping));
}

}  // namespace

std::string fractal_function(const std::string& name, const Fractal& f, float feature_size,
                             DVec2 middle, std::uint64_t seed, bool with_means) {
  const FractalSampler sampler(f, fractal_seed(seed));
  const auto size = static_cast<double>(feature_size);
  const DVec2 origin = middle / size + fractal_offset(seed);
  std::vector<float> means(static_cast<std::size_t>(f.octaves), 0.0F);
  if (with_means) means = octave_means(f);
  std::vector<std::string> cells;
  std::vector<std::string> octaves;
  double rest = 0;
  for (const float mean : means) rest += double{mean};
  for (int i = 0; i < f.octaves; ++i) {
    const FractalSampler::Octave& octave = sampler.octave(i);
    const DVec2 at = octave.matrix2 * origin + octave.shift2;
    const DVec2 below(std::floor(at.x), std::floor(at.y));
    const double mean = double{means[static_cast<std::size_t>(i)]};
    const auto wrapped = [](double x) {
      return static_cast<std::int32_t>(static_cast<std::uint32_t>(static_cast<std::int64_t>(x)));
    };
    cells.push_back(fmt::format("ivec2({}, {})", wrapped(below.x), wrapped(below.y)));
    octaves.push_back(fmt::format("vec4({}, {}, {}, {})", glsl_number(at.x - below.x),
                                  glsl_number(at.y - below.y), glsl_number(mean),
                                  glsl_number(rest)));
    rest -= mean;
  }
  const auto in_lines = [](const std::vector<std::string>& items, std::size_t per_line) {
    std::string text;
    for (std::size_t k = 0; k < items.size(); ++k) {
      if (k > 0) text += k % per_line == 0 ? ",\n    " : ", ";
      text += items[k];
    }
    return text;
  };
  return fmt::format(
      "\nconst ivec2 {0}_cells[{1}] = ivec2[{1}](\n    {2});\n"
      "// where the octave lies, its mean, and that of all from it on\n"
      "const vec4 {0}_octaves[{1}] = vec4[{1}](\n    {3});\n"
      "vec3 {0}(vec2 place, float spacing) {{\n"
      "  vec3 total = vec3(0.0), w = vec3({10}, 0.0, 0.0);\n"
      "  LandOctave o = first_land_octave();\n"
      "  for (int i = ZERO; i < {1}; ++i) {{\n"
      "    float share = octave_weight(spacing * {4} * o.frequency);\n"
      "    vec4 octave = {0}_octaves[i];\n"
      "    if (share <= 0.0) {{\n"
      "      total.x += octave.w;\n"
      "      break;\n"
      "    }}\n"
      "    vec3 n = land_octave_noise(o, place * {4}, {0}_cells[i], octave.xy,\n"
      "                          lattice_key({5}u + uint(i) * 0x9e3779b9u));\n"
      "    {6}"
      "    total.x += (1.0 - share) * octave.z;\n"
      "    o = next_land_octave(o, {7}, {8});\n"
      "  }}\n"
      "  return vec3(total.x, total.yz * {4});\n"
      "}}\n",
      name, f.octaves, in_lines(cells, 3), in_lines(octaves, 2), glsl_number(1 / size),
      fractal_seed(seed), term(f), glsl_number(f.lacunarity),
      glsl_number(std::pow(double{f.lacunarity}, -double{f.hurst})), "",
      f.kind == FractalKind::eroded ? "0.0" : "1.0");
}

}  // namespace wold
