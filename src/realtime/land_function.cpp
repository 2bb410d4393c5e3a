#include "realtime/land_function.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <map>
#include <optional>
#include <utility>

#include "base/hash.hpp"
#include "realtime/land_fractal.hpp"
#include "terrain/arithmetic.hpp"
#include "terrain/combine.hpp"
#include "terrain/eroded_noise.hpp"
#include "terrain/falloff.hpp"
#include "terrain/fbm.hpp"
#include "terrain/hybrid.hpp"
#include "terrain/mask.hpp"
#include "terrain/plane.hpp"
#include "terrain/ridged.hpp"
#include "terrain/step_mask.hpp"
#include "terrain/terrace.hpp"
#include "terrain/turbulence.hpp"
#include "terrain/warp.hpp"

namespace wold {

namespace {

std::string num(double value) {
  return glsl_number(value);
}

/// What one step gives to those after it.
struct Told {
  std::string ground;  ///< a function's name
  std::string mask;    ///< another, of mask steps
};

/// A step that cannot be told.
struct LeftOut {};

/// The edges of a range as factors of a mask, "" for none.
std::string range_factors(const Range& range, const Range& whole, float width,
                          const std::string& x) {
  std::string factors;
  const auto add = [&](const std::string& factor) {
    factors = factors.empty() ? factor : fmt::format("product({}, {})", factors, factor);
  };
  if (range.low > whole.low)
    add(fmt::format("soft_threshold({}, {}, {})", num(range.low), num(width), x));
  if (range.high < whole.high)
    add(fmt::format("soft_threshold({}, {}, -{})", num(-range.high), num(width), x));
  return factors;
}

class Writer {
 public:
  Writer(const TerrainSettings& terrain, std::span<const TerrainOperator> operators,
         std::uint64_t seed)
      : domain_(domain_of(terrain)), operators_(operators), seed_(seed) {}

  void add(const TerrainStep& step) {
    const int place = places_[step.op]++;
    if (!step.settings.enabled) return;
    ++count_;
    fractals_ = 0;
    const std::string before = text_;
    try {
      seed_of_step_ = step_seed(seed_, step, place);
      const TerrainOperator& op = find_operator(operators_, step.op, step.location);
      write(step, op);
    } catch (const LeftOut&) {
      text_ = before;
      if (step.op != "mask")
        out_.left_out.push_back(step.settings.name.empty() ? step.op : step.settings.name);
    }
  }

  LandFunction take() {
    out_.text =
        "#include \"terrain/steps.glsl\"\n" + text_ +
        fmt::format("\nvec3 land(vec2 place, float spacing) {{\n  return {};\n}}\n", call(ground_));
    if (largest_ > 0) out_.largest_feature = largest_;
    return std::move(out_);
  }

 private:
  static std::string call(const std::string& function, const std::string& place = "place") {
    return function.empty() ? "vec3(0.0)" : fmt::format("{}({}, spacing)", function, place);
  }

  const Told& named(const std::string& name) const {
    const auto found = named_.find(name);
    if (found == named_.end()) throw LeftOut{};
    return found->second;
  }

  /// Writes the raw fractal as a function and returns its name.
  std::string fractal(const Fractal& f, float feature_size, std::uint64_t seed, bool with_means) {
    std::string name = fmt::format("noise_{}{}", count_, static_cast<char>('a' + fractals_++));
    text_ += fractal_function(name, f, feature_size, domain_.center(), seed, with_means);
    return name;
  }

  std::string irregular_noise(float feature_size, int octaves, std::uint64_t seed) {
    return fractal({.octaves = octaves}, feature_size, seed, false) + "(place, spacing)";
  }

  template <class Ground>
  std::string fractal_made(const TerrainStep& step) {
    const Ground& g = step.parameters.as<Ground>();
    const Fractal f = fractal_of(g);
    const Range range = fractal_statistics(f, 0).range;
    const double scale =
        static_cast<double>(g.shape.height) / std::max(1e-6, double{range.high - range.low});
    largest_ = std::max(largest_, g.shape.feature_size);
    const std::string name = fractal(f, g.shape.feature_size, seed_of_step_, true);
    return fmt::format("{} * {}(place, spacing) + level_ground({})", num(scale), name,
                       num(g.shape.base - scale * range.low));
  }

  /// The expression of what the operator makes; `before` is at hand as a variable.
  std::string made(const TerrainStep& step) {
    const Described& p = step.parameters;
    if (step.op == "fbm") return fractal_made<FbmGround>(step);
    if (step.op == "ridged") return fractal_made<RidgedGround>(step);
    if (step.op == "hybrid") return fractal_made<HybridGround>(step);
    if (step.op == "turbulence") return fractal_made<TurbulenceGround>(step);
    if (step.op == "eroded_noise") return fractal_made<ErodedGround>(step);
    if (step.op == "constant") return fmt::format("level_ground({})", num(p.as<Constant>().height));
    if (step.op == "plane") return plane(p.as<Plane>());
    if (step.op == "terrace") return terrace(p.as<Terrace>());
    if (step.op == "falloff") return falloff(p.as<Falloff>());
    if (step.op == "combine") return combine(p.as<Combine>());
    return arithmetic(step.op, p);
  }

  static std::string arithmetic(const std::string& op, const Described& p) {
    if (op == "scale")
      return fmt::format("{} * before + level_ground({})", num(p.as<Scale>().factor),
                         num(p.as<Scale>().offset));
    if (op == "smooth_floor")
      return fmt::format("soft_higher(before, level_ground({}), {})",
                         num(p.as<SmoothFloor>().level), num(p.as<SmoothFloor>().softness));
    if (op == "clamp") {
      const Clamp& c = p.as<Clamp>();
      return fmt::format(
          "soft_lower(soft_higher(before, level_ground({0}), {2}), level_ground({1}), {2})",
          num(c.range.low), num(c.range.high), num(c.softness));
    }
    if (op == "remap") {
      const Remap& r = p.as<Remap>();
      const double factor = double{r.to.y - r.to.x} / double{r.from.high - r.from.low};
      return fmt::format("{} * before + level_ground({})", num(factor),
                         num(r.to.x - factor * r.from.low));
    }
    if (op == "power") {
      const Power& w = p.as<Power>();
      return fmt::format("bent_by_power(before, {}, {}, {})", num(w.range.low),
                         num(w.range.high - w.range.low), num(w.exponent));
    }
    throw LeftOut{};
  }

  static std::string plane(const Plane& p) {
    const double azimuth = radians(double{p.downhill});
    const double fall = std::tan(radians(double{p.slope}));
    const std::string down =
        fmt::format("vec2({}, {})", num(fall * std::sin(azimuth)), num(fall * std::cos(azimuth)));
    return fmt::format("vec3({} - dot({}, place), -{})", num(p.height), down, down);
  }

  std::string terrace(const Terrace& t) {
    std::string shift = "vec3(0.0)";
    if (t.variation > 0)
      shift = num(t.variation) + " * " + irregular_noise(t.feature_size, 4, seed_of_step_);
    return fmt::format("terraced(before, {}, {}, {}, {})", shift, num(t.spacing), num(t.flat),
                       num(t.strength));
  }

  std::string falloff(const Falloff& f) {
    const std::string noise = irregular_noise(f.feature_size, 4, seed_of_step_);
    return fmt::format(
        "fallen_off(before, inside_distance(place, vec2({}, {}), {}), {}, {}, {}, {})",
        num(0.5 * domain_.size.x), num(0.5 * domain_.size.y),
        f.shape == FalloffShape::round ? "true" : "false", noise, num(f.level), num(f.width),
        num(f.irregularity));
  }

  std::string combine(const Combine& c) {
    const std::string other = fmt::format("({} * {})", num(c.scale), call(named(c.with).ground));
    switch (c.method) {
      case CombineMethod::add: return "before + " + other;
      case CombineMethod::subtract: return "before - " + other;
      case CombineMethod::multiply: return fmt::format("product(before, {})", other);
      case CombineMethod::max: return fmt::format("higher(before, {})", other);
      case CombineMethod::min: return fmt::format("lower(before, {})", other);
      case CombineMethod::smooth_max:
        return fmt::format("soft_higher(before, {}, {})", other, num(c.softness));
      case CombineMethod::smooth_min:
        return fmt::format("soft_lower(before, {}, {})", other, num(c.softness));
      case CombineMethod::mix: break;
    }
    return fmt::format("mix(before, {}, {})", other, num(c.amount));
  }

  /// "" where the step acts everywhere.
  std::string step_mask_text(const StepSettings& s) const {
    std::string mask;
    const auto times = [&](const std::string& factor) {
      if (factor.empty()) return;
      mask = mask.empty() ? factor : fmt::format("product({}, {})", mask, factor);
    };
    if (s.opacity < 1) times(fmt::format("level_ground({})", num(s.opacity)));
    if (!s.mask.empty()) {
      const std::string named_mask = call(mask_of(s.mask));
      times(s.mask_invert ? fmt::format("(level_ground(1.0) - {})", named_mask) : named_mask);
    }
    const StepSettings whole;
    times(range_factors(s.mask_height, whole.mask_height, s.mask_height_feather, "before"));
    times(range_factors(s.mask_slope, whole.mask_slope, s.mask_slope_feather,
                        "level_ground(ground_slope(before))"));
    return mask;
  }

  const std::string& mask_of(const std::string& name) const {
    const std::string& mask = named(name).mask;
    if (mask.empty()) throw LeftOut{};
    return mask;
  }

  void write(const TerrainStep& step, const TerrainOperator& op) {
    const StepSettings& s = step.settings;
    const std::string input = s.input.empty() ? ground_ : named(s.input).ground;
    if (step.op == "mask") return write_mask(step, input);
    std::string body;
    const bool warps = step.op == "warp";
    const std::string expression = warps ? warp(step.parameters.as<Warp>(), input) : made(step);
    const std::string mask = step_mask_text(s);
    const Blend blend = actual_blend(step, op);
    std::string result = blended(blend, expression);
    if (!mask.empty()) result = fmt::format("masked(before, {}, {})", result, mask);
    if (result.find("before") != std::string::npos)
      body += fmt::format("  vec3 before = {};\n", call(input));
    body += fmt::format("  return {};\n", result);
    const std::string name = fmt::format("ground_{}", count_);
    text_ += fmt::format("\n// {}\nvec3 {}(vec2 place, float spacing) {{\n{}}}\n", title(step),
                         name, body);
    ground_ = name;
    if (!s.name.empty()) named_[s.name] = {name, ""};
  }

  static std::string title(const TerrainStep& step) {
    return step.settings.name.empty() ? step.op
                                      : fmt::format("{}: {}", step.settings.name, step.op);
  }

  static std::string blended(Blend blend, const std::string& made) {
    switch (blend) {
      case Blend::add: return "before + " + made;
      case Blend::subtract: return fmt::format("before - ({})", made);
      case Blend::multiply: return fmt::format("product(before, {})", made);
      case Blend::max: return fmt::format("higher(before, {})", made);
      case Blend::min: return fmt::format("lower(before, {})", made);
      case Blend::automatic:
      case Blend::replace: break;
    }
    return made;
  }

  /// Writes a function of its own: the move is needed twice.
  std::string warp(const Warp& w, const std::string& input) {
    const std::string east =
        irregular_noise(w.feature_size, w.octaves, random_bits(seed_of_step_, 0));
    const std::string north =
        irregular_noise(w.feature_size, w.octaves, random_bits(seed_of_step_, 1));
    const std::string name = fmt::format("moved_{}", count_);
    text_ += fmt::format(
        "\nvec3 {0}(vec2 place, float spacing) {{\n  vec3 east = bend({1});\n"
        "  vec3 north = bend({2});\n  vec2 there = place + {3} * vec2(east.x, north.x);\n"
        "  return moved_ground({4}, east, north, {3});\n}}\n",
        name, east, north, num(w.distance), call(input, "there"));
    return call(name);
  }

  void write_mask(const TerrainStep& step, const std::string& input) {
    const Mask& m = step.parameters.as<Mask>();
    if (m.smooth > 0) throw LeftOut{};
    std::string value = mask_value(m, input);
    if (value.empty()) value = "level_ground(1.0)";
    if (m.invert) value = fmt::format("level_ground(1.0) - {}", value);
    if (!m.times.empty()) value = fmt::format("product({}, {})", value, call(mask_of(m.times)));
    const std::string name = fmt::format("mask_{}", count_);
    std::string body;
    if (value.find("before") != std::string::npos)
      body += fmt::format("  vec3 before = {};\n", call(input));
    text_ += fmt::format("\n// {}\nvec3 {}(vec2 place, float spacing) {{\n{}  return {};\n}}\n",
                         title(step), name, body, value);
    if (!step.settings.name.empty()) named_[step.settings.name] = {input, name};
  }

  std::string mask_value(const Mask& m, const std::string&) {
    switch (m.from) {
      case MaskSource::height:
        return range_factors(m.height, {-1e5F, 1e5F}, m.height_feather, "before");
      case MaskSource::slope:
        return range_factors(m.slope, {0, 90}, m.slope_feather,
                             "level_ground(ground_slope(before))");
      case MaskSource::noise: {
        const std::string noise = irregular_noise(m.feature_size, patch_octaves, seed_of_step_);
        return fmt::format("soft_threshold({}, {}, {})", num(patch_threshold(m.coverage)),
                           num(m.edge), noise);
      }
      case MaskSource::crests:
      case MaskSource::hollows:
      case MaskSource::picture:
      case MaskSource::map: break;
    }
    throw LeftOut{};
  }

  TerrainDomain domain_;
  std::span<const TerrainOperator> operators_;
  std::uint64_t seed_;
  std::uint64_t seed_of_step_ = 0;
  std::map<std::string, int> places_;
  std::map<std::string, Told> named_;
  std::string ground_;  // the function that gives the ground so far
  std::string text_;
  LandFunction out_;
  float largest_ = 0;
  int count_ = 0;
  int fractals_ = 0;
};

}  // namespace

LandFunction land_function(const TerrainSettings& terrain, std::span<const TerrainStep> steps,
                           std::span<const TerrainOperator> operators, std::uint64_t seed) {
  Writer writer(terrain, operators, seed);
  for (const TerrainStep& step : steps) writer.add(step);
  return writer.take();
}

std::string glsl_number(double value) {
  // float's shortest form; GLSL wants to see that it is no integer.
  std::string text = fmt::format("{}", static_cast<float>(value));
  if (text.find_first_of(".en") == std::string::npos) text += ".0";
  return text;
}

}  // namespace wold
