// Twin of sky/clouds.hpp, where the equations stand: density, transmittance and light of a layer of
// clouds. `cloud_layer` prepares what does not change from place to place.
#include "noise/fractal3.glsl"
#include "sky/atmosphere.glsl"

struct Clouds {
  float coverage;
  float height;
  float thickness;
  float feature_size;
  float billows;
  float scattering;
  float absorption;
  float forward;
  float back;
  float back_share;
  int orders;
  uint seed;
};

Clouds default_clouds() {
  return Clouds(0.5, 1500.0, 1200.0, 2500.0, 0.5, 0.03, 0.0, 0.7, -0.5, 0.3, 4, 1u);
}

struct CloudLayer {
  Clouds clouds;
  float threshold;
  uint lumps_key;
};

// The value that the share q of a standard normal distribution exceeds.
float normal_threshold(float q) {
  return (pow(1.0 - q, 0.135) - pow(q, 0.135)) / 0.1975;
}

CloudLayer cloud_layer(Clouds c) {
  float share = pow(c.coverage, 1.35);
  return CloudLayer(c, 0.5 + 0.166 * normal_threshold(share), lattice_key(~c.seed));
}

// Distance to the nearest of one random point per cell, at most 1. The rows nearest to the place go
// first: the farther are left out where they cannot hold a nearer point.
float worley_distance(uvec3 cell, vec3 t, uint key) {
  float nearest = 1.0;
  for (int kk = 0; kk < 3; ++kk) {
    int k = kk == 0 ? 0 : 2 * kk - 3;
    float off_z = k == 0 ? 0.0 : k < 0 ? t.z : 1.0 - t.z;
    if (off_z * off_z >= nearest) continue;
    uint plane = lattice_line(cell.z + uint(k), key);
    for (int jj = 0; jj < 3; ++jj) {
      int j = jj == 0 ? 0 : 2 * jj - 3;
      float off_y = j == 0 ? 0.0 : j < 0 ? t.y : 1.0 - t.y;
      if (off_y * off_y + off_z * off_z >= nearest) continue;
      uint row = lattice_line(cell.y + uint(j), plane);
      for (int i = -1; i <= 1; ++i) {
        uint h = lattice_hash(cell.x + uint(i), row);
        vec3 point = vec3(uvec3(h, h >> 10u, h >> 20u) & 1023u) / 1024.0;
        vec3 offset = vec3(float(i), float(j), float(k)) + point - t;
        nearest = min(nearest, dot(offset, offset));
      }
    }
  }
  return sqrt(nearest);
}

// At a place times `factor`, a number of tenths.
float worley_distance(LatticePlace3 p, int factor, uint key) {
  ivec3 cell = p.grid >> 12;
  ivec3 times = cell * factor;
  ivec3 whole = ivec3(floor(vec3(times) / 10.0));
  vec3 t = vec3(times - whole * 10) / 10.0 + cell_fraction(p) * (float(factor) / 10.0);
  vec3 below = floor(t);
  return worley_distance(uvec3(whole + ivec3(below)), t - below, key);
}

float cloud_density(CloudLayer layer, vec2 place, float height) {
  Clouds c = layer.clouds;
  float v = (height - c.height) / c.thickness;
  if (!(v > 0.0 && v < 1.0)) return 0.0;
  LatticePlace3 p = lattice_place(vec3(place, height), c.feature_size);
  Fractal noise = Fractal(fractal_fbm, noise_basis_value, 6, 2.0, 1.0, 1.0, 2.0, 0.0, 1.0);
  float n = 0.5 + 0.5 * fbm_value(p, noise, c.seed, 6, 0.0);
  float shape = (n - layer.threshold - 0.3 * v * v) / 0.16;
  if (!(shape > 0.0)) return 0.0;
  float d = min(shape, 1.0) * smoothstep(0.0, 0.07, v) * (1.0 - smoothstep(0.9, 1.0, v));
  if (c.billows == 0.0) return d;
  float notch = c.billows * (0.65 * worley_distance(p, 70, layer.lumps_key) +
                             0.35 * worley_distance(p, 161, layer.lumps_key));
  return max(0.0, (d - notch) / (1.0 - notch));
}

// Of sunlight and of light from behind on `reach` metres of a ray through the layer.
float cloud_transmittance(CloudLayer layer, Atmosphere a, vec2 place, AirRay ray, vec3 direction,
                          float reach, int steps) {
  Clouds c = layer.clouds;
  AirSpan span = span_in_layer(a, ray.height, ray.cosine, c.height, c.height + c.thickness);
  float whole = min(reach, span.end) - span.begin;
  if (!(whole > 0.0)) return 1.0;
  float sum = 0.0;
  float from = span.begin;
  for (int k = 1; k <= steps; ++k) {
    float to = span.begin + whole * step_edge(k, steps);
    float s = 0.5 * (from + to);
    sum += (to - from) * cloud_density(layer, place + s * direction.xy,
                                       height_after(a, ray.height, ray.cosine, s));
    from = to;
  }
  return exp(-(c.scattering + c.absorption) * sum);
}

// Phase functions of all orders times the sunlight they get, of which `lit` is the first's.
float scattered_in_cloud(Clouds c, float to_sun, float lit) {
  float sum = 0.0;
  float share = 1.0;
  for (int k = 0; k < c.orders; ++k) {
    sum += share * lit *
           double_henyey_greenstein(to_sun, share * c.forward, share * c.back, c.back_share);
    share *= 0.5;
    lit = sqrt(lit);
  }
  return sum;
}

// L = behind · transmittance + light.
struct CloudLight {
  float transmittance;
  vec3 light;
};

struct CloudSteps {
  int along;
  int to_sun;
};

CloudLight clouds_seen(CloudLayer layer, Atmosphere a, vec2 place, AirRay ray, vec3 direction,
                       vec3 sun_direction, float reach, vec3 sun_illuminance, vec3 sky_radiance,
                       float start, CloudSteps steps) {
  Clouds c = layer.clouds;
  CloudLight seen = CloudLight(1.0, vec3(0.0));
  AirSpan span = span_in_layer(a, ray.height, ray.cosine, c.height, c.height + c.thickness);
  float whole = min(reach, span.end) - span.begin;
  float extinction = c.scattering + c.absorption;
  if (!(whole > 0.0) || !(extinction > 0.0)) return seen;
  float stride = whole / float(steps.along);
  for (int k = 0; k < steps.along; ++k) {
    if (seen.transmittance <= 1e-3) break;
    float s = span.begin + (float(k) + start) * stride;
    float height = height_after(a, ray.height, ray.cosine, s);
    vec2 at = place + s * direction.xy;
    float dense = cloud_density(layer, at, height);
    if (!(dense > 0.0)) continue;
    float sun_cosine = sun_cosine_after(a, ray, s);
    AirRay sunward = AirRay(height, sun_cosine, sun_cosine, 1.0);
    float lit = cloud_transmittance(layer, a, at, sunward, sun_direction, 1e30, steps.to_sun);
    float passed = exp(-extinction * dense * stride);
    vec3 source = (scattered_in_cloud(c, ray.to_sun, lit) * sun_illuminance + sky_radiance) *
                  (c.scattering / extinction);
    seen.light += seen.transmittance * (1.0 - passed) * source;
    seen.transmittance *= passed;
  }
  return seen;
}
