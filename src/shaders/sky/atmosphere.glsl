// Twin of sky/atmosphere.hpp, where the equations stand. Places in the air are (height, cosine to
// the zenith), never points, and no radii are subtracted: heights would drown in a planet's radius.
#include "sky/phase_functions.glsl"

const int air_rec709 = 0;
const int air_popular = 1;
const int air_penndorf = 2;

struct Atmosphere {
  int air;
  float air_height;
  vec3 aerosol_scattering;
  float aerosol_height;
  float aerosol_albedo;
  float aerosol_forward;
  float ozone;
  float planet_radius;
  float air_thickness;
  vec3 ground_albedo;
};

Atmosphere default_atmosphere() {
  return Atmosphere(air_rec709, 8000.0, vec3(4e-6), 1200.0, 0.9, 0.76, 300.0, 6.36e6, 1e5,
                    vec3(0.2));
}

vec3 air_scattering(int air) {
  if (air == air_rec709) return vec3(5.93e-6, 11.81e-6, 28.02e-6);
  return air == air_popular ? vec3(5.8e-6, 13.5e-6, 33.1e-6) : vec3(4.91e-6, 11.62e-6, 28.99e-6);
}

vec3 ozone_absorption(Atmosphere a) {
  vec3 usual =
      a.air == air_rec709 ? vec3(2.51e-6, 1.78e-6, 0.0) : vec3(0.650e-6, 1.881e-6, 0.085e-6);
  return usual * (a.ozone / 300.0);
}

// Heights of molecules and aerosol in units of theirs, within what exp can do.
vec2 air_exponents(Atmosphere a, float height) {
  return clamp(height / vec2(a.air_height, a.aerosol_height), -8.0, 80.0);
}

float ozone_density(float height) {
  return max(0.0, 1.0 - abs(height - 25000.0) / 15000.0);
}

// Of molecules, aerosol and ozone.
vec3 air_density(Atmosphere a, float height) {
  return vec3(exp(-air_exponents(a, height)), ozone_density(height));
}

vec3 optical_depth(Atmosphere a, vec3 column) {
  return air_scattering(a.air) * column.x + a.aerosol_scattering * (column.y / a.aerosol_albedo) +
         ozone_absorption(a) * column.z;
}

struct AirRay {
  float height;
  float cosine;
  float sun_cosine;
  float to_sun;
};

// From a place in world coordinates (Z up, height 0 at z = 0).
AirRay air_ray(Atmosphere a, vec3 origin, vec3 direction, vec3 sun) {
  float across_2 = dot(origin.xy, origin.xy);
  float below = a.planet_radius + origin.z;
  float r = sqrt(below * below + across_2);
  vec3 up = vec3(origin.xy, below) / r;
  return AirRay(origin.z + across_2 / (r + below), dot(up, direction), dot(up, sun),
                dot(direction, sun));
}

float height_after(Atmosphere a, float height, float cosine, float along) {
  float r = a.planet_radius + height;
  float d = along * (along + 2.0 * r * cosine);
  return height + d / (r + sqrt(max(r * r + d, 0.0)));
}

float sun_cosine_after(Atmosphere a, AirRay ray, float along) {
  float r = a.planet_radius + ray.height;
  float there = a.planet_radius + height_after(a, ray.height, ray.cosine, along);
  return clamp((r * ray.sun_cosine + along * ray.to_sun) / there, -1.0, 1.0);
}

// Where a ray meets the sphere `shell` metres above the ground.
struct Crossing {
  bool meets;
  float near_distance;
  float far_distance;
};
Crossing crossing(Atmosphere a, float height, float cosine, float shell) {
  float r = a.planet_radius + height;
  float b = r * cosine;
  float c = (height - shell) * (r + a.planet_radius + shell);
  float discriminant = b * b - c;
  if (discriminant < 0.0) return Crossing(false, 0.0, 0.0);
  float root = sqrt(discriminant);
  // Without differences of like numbers: the product of the two solutions is c.
  float q = b > 0.0 ? -b - root : -b + root;
  float other = q == 0.0 ? 0.0 : c / q;
  return Crossing(true, min(q, other), max(q, other));
}

float distance_to_space(Atmosphere a, float height, float cosine) {
  return max(0.0, crossing(a, height, cosine, a.air_thickness).far_distance);
}

struct AirSpan {
  float begin;
  float end;
  bool ground;
};

AirSpan span_in_air(Atmosphere a, float height, float cosine) {
  Crossing top = crossing(a, height, cosine, a.air_thickness);
  if (!top.meets || top.far_distance <= 0.0) return AirSpan(0.0, 0.0, false);
  AirSpan span = AirSpan(max(0.0, top.near_distance), top.far_distance, false);
  Crossing ground = crossing(a, max(height, 0.0), cosine, 0.0);
  if (ground.meets && cosine < 0.0) {
    span.end = max(ground.near_distance, span.begin);
    span.ground = true;
  }
  return span;
}

AirSpan span_in_layer(Atmosphere a, float height, float cosine, float low, float high) {
  AirSpan nowhere = AirSpan(0.0, 0.0, false);
  Crossing top = crossing(a, height, cosine, high);
  if (!top.meets || top.far_distance <= 0.0) return nowhere;
  AirSpan span = AirSpan(max(0.0, top.near_distance), top.far_distance, false);
  Crossing base = crossing(a, height, cosine, low);
  if (!base.meets || base.far_distance <= 0.0) return span;
  if (height < low) {
    Crossing ground = crossing(a, max(height, 0.0), cosine, 0.0);
    if (ground.meets && cosine < 0.0) return nowhere;
    span.begin = base.far_distance;
  } else {
    span.end = max(span.begin, base.near_distance);
  }
  return span;
}

// The share of a length that lies before the edge `k` of `n` steps.
float step_edge(int k, int n) {
  float part = float(k) / float(n);
  return part * part;
}

// Mean density between two heights, as if height changed evenly, from exponents and densities at
// both ends.
vec2 mean_density(vec2 low, vec2 high, vec2 at_low, vec2 at_high) {
  vec2 rise = high - low;
  bvec2 little = lessThan(abs(rise), vec2(1e-2));
  return mix((at_low - at_high) / mix(rise, vec2(1.0), little), 0.5 * (at_low + at_high), little);
}

// Metres of air of density 1.
vec3 air_column(Atmosphere a, float height, float cosine, float begin, float end, int steps) {
  vec3 sum = vec3(0.0);
  float from = begin;
  float low = height_after(a, height, cosine, from);
  vec2 exponents = air_exponents(a, low);
  vec3 density = vec3(exp(-exponents), ozone_density(low));
  for (int k = 1; k <= steps; ++k) {
    float to = begin + (end - begin) * step_edge(k, steps);
    float high = height_after(a, height, cosine, to);
    vec2 next_exponents = air_exponents(a, high);
    vec3 next_density = vec3(exp(-next_exponents), ozone_density(high));
    sum += vec3(mean_density(exponents, next_exponents, density.xy, next_density.xy),
                0.5 * (density.z + next_density.z)) * (to - from);
    from = to;
    exponents = next_exponents;
    density = next_density;
  }
  return sum;
}

vec3 transmittance(Atmosphere a, float height, float cosine, float reach, int steps) {
  AirSpan span = span_in_air(a, height, cosine);
  float end = min(reach, span.end);
  if (!(end > span.begin)) return vec3(1.0);
  return exp(-optical_depth(a, air_column(a, height, cosine, span.begin, end, steps)));
}

float sun_above_edge(Atmosphere a, float height, float sun_cosine) {
  float sine = a.planet_radius / (a.planet_radius + max(height, 0.0));
  float edge = -sqrt(max(0.0, 1.0 - sine * sine));
  float x = clamp((sun_cosine - edge) / (sine * 0.00463), -1.0, 1.0);  // radius in radians
  return 0.5 + x * (0.75 - 0.25 * x * x);
}

vec3 sun_transmittance(Atmosphere a, float height, float sun_cosine, int steps) {
  float seen = sun_above_edge(a, height, sun_cosine);
  if (!(seen > 0.0)) return vec3(0.0);
  Crossing top = crossing(a, height, sun_cosine, a.air_thickness);
  if (!top.meets || top.far_distance <= 0.0) return vec3(seen);
  float begin = max(0.0, top.near_distance);
  return seen *
         exp(-optical_depth(a, air_column(a, height, sun_cosine, begin, top.far_distance, steps)));
}

// L = surface · transmittance + light.
struct AirLight {
  vec3 transmittance;
  vec3 light;
};

// By kind, not yet times the phase functions and the sun's illuminance.
struct ScatteredSums {
  vec3 transmittance;
  vec3 by_air;
  vec3 by_aerosol;
  vec3 multiple;
};

ScatteredSums no_scattering() {
  return ScatteredSums(vec3(1.0), vec3(0.0), vec3(0.0), vec3(0.0));
}

AirLight with_phases(Atmosphere a, ScatteredSums sums, float to_sun, vec3 sun_illuminance) {
  return AirLight(sums.transmittance,
                  sun_illuminance * (sums.by_air * rayleigh_phase(to_sun) +
                                     sums.by_aerosol * mie_phase(to_sun, a.aerosol_forward) +
                                     sums.multiple));
}

// Sunlight (part of that outside the air) and what comes from all around (per that).
struct LightInAir {
  vec3 sun;
  vec3 multiple;
};

void add_stretch(Atmosphere a, vec3 column, LightInAir light, inout ScatteredSums sums) {
  vec3 depth = optical_depth(a, column);
  vec3 passed = exp(-depth);
  // (1 - e^-x) / x
  vec3 share = mix((1.0 - passed) / max(depth, 1e-9), 1.0 - 0.5 * depth,
                   lessThan(depth, vec3(1e-3))) * sums.transmittance;
  vec3 air = share * air_scattering(a.air) * column.x;
  vec3 aerosol = share * a.aerosol_scattering * column.y;
  sums.by_air += air * light.sun;
  sums.by_aerosol += aerosol * light.sun;
  sums.multiple += (air + aerosol) * light.multiple;
  sums.transmittance *= passed;
}

// Sky and air before surfaces in one, scattered once. Other light: air_march.glsl, sunlit_air.glsl.
AirLight single_scattering(Atmosphere a, AirRay ray, float reach, vec3 sun_illuminance, int steps,
                           int light_steps) {
  AirSpan span = span_in_air(a, ray.height, ray.cosine);
  float whole = min(reach, span.end) - span.begin;
  ScatteredSums sums = no_scattering();
  if (!(whole > 0.0)) return AirLight(vec3(1.0), vec3(0.0));
  float from = span.begin;
  for (int k = 1; k <= steps; ++k) {
    float to = span.begin + whole * step_edge(k, steps);
    float middle = 0.5 * (from + to);
    float height = height_after(a, ray.height, ray.cosine, middle);
    vec3 sun = sun_transmittance(a, height, sun_cosine_after(a, ray, middle), light_steps);
    add_stretch(a, air_column(a, ray.height, ray.cosine, from, to, 1), LightInAir(sun, vec3(0.0)),
                sums);
    from = to;
  }
  return with_phases(a, sums, ray.to_sun, sun_illuminance);
}
