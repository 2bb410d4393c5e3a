#include "terrain/arithmetic.hpp"

#include <cmath>

#include "terrain/field_map.hpp"
#include "terrain/soft.hpp"

namespace wold {

namespace {

const Limits metres{.unit = "m", .min = -1e5, .max = 1e5};

}  // namespace

Description<Scale> describe(const Scale&) {
  return Description<Scale>("scale", "Multiplies heights and adds to them.")
      .add("factor", &Scale::factor, {.min = -1000, .max = 1000}, "What heights are multiplied by.")
      .add("offset", &Scale::offset, metres, "What is added then.");
}

Description<Remap> describe(const Remap&) {
  return Description<Remap>("remap", "Stretches a range of heights to another.")
      .add("from", &Remap::from, metres, "Two heights of the input.")
      .add("to", &Remap::to, metres, "What they become.");
}

Description<Clamp> describe(const Clamp&) {
  return Description<Clamp>("clamp", "Keeps heights within a range.")
      .add("range", &Clamp::range, metres, "Lowest and highest ground.")
      .add("softness", &Clamp::softness, {.unit = "m", .min = 0, .max = 1e5},
           "Rounds off the edges over so much height.");
}

Description<SmoothFloor> describe(const SmoothFloor&) {
  return Description<SmoothFloor>("smooth_floor", "Fills what is below a level, with soft banks.")
      .add("level", &SmoothFloor::level, metres, "Height of the floor.")
      .add("softness", &SmoothFloor::softness, {.unit = "m", .min = 0, .max = 1e5},
           "Rounds off the banks over so much height.");
}

Description<Power> describe(const Power&) {
  return Description<Power>("power", "Bends heights: above 1 flattens valleys, below 1 heights.")
      .add("range", &Power::range, metres, "Heights that stay where they are.")
      .add("exponent", &Power::exponent, {.min = 0.1, .max = 10}, "How heights between bend.");
}

Heightfield scale(const Heightfield& input, const Scale& parameters,
                  const TerrainContext& context) {
  return map_heights(input, context,
                     [&](float h, int, int) { return h * parameters.factor + parameters.offset; });
}

Heightfield remap(const Heightfield& input, const Remap& parameters,
                  const TerrainContext& context) {
  const float extent = parameters.from.high - parameters.from.low;
  if (extent <= 0)
    throw Error(ErrorKind::input, "the two heights in 'from' of 'remap' must differ");
  const float factor = (parameters.to.y - parameters.to.x) / extent;
  return map_heights(input, context, [&](float h, int, int) {
    return parameters.to.x + factor * (h - parameters.from.low);
  });
}

Heightfield clamp_heights(const Heightfield& input, const Clamp& parameters,
                          const TerrainContext& context) {
  return map_heights(input, context, [&](float h, int, int) {
    return soft_min(soft_max(h, parameters.range.low, parameters.softness), parameters.range.high,
                    parameters.softness);
  });
}

Heightfield smooth_floor(const Heightfield& input, const SmoothFloor& parameters,
                         const TerrainContext& context) {
  return map_heights(input, context, [&](float h, int, int) {
    return soft_max(h, parameters.level, parameters.softness);
  });
}

Heightfield power(const Heightfield& input, const Power& parameters,
                  const TerrainContext& context) {
  const float extent = parameters.range.high - parameters.range.low;
  if (extent <= 0)
    throw Error(ErrorKind::input, "the two heights in 'range' of 'power' must differ");
  return map_heights(input, context, [&](float h, int, int) {
    const float t = (h - parameters.range.low) / extent;
    const float bent = std::copysign(std::pow(std::abs(t), parameters.exponent), t);
    return parameters.range.low + extent * bent;
  });
}

}  // namespace wold
