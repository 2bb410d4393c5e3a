// Twin of class Haze (sky/haze.hpp).

struct Haze {
  vec3 molecules;  // extinction at height 0, 1/m
  vec3 aerosol;
  float molecules_height;  // m, over which it falls to 1/e
  float aerosol_height;
};

// ∫ e^(-(h + s z) / H) ds over s in [0, distance], m; z is the rise per metre.
float air_on_path(float h, float z, float path, float scale_height) {
  float start = exp(-clamp(h / scale_height, -8.0, 80.0));
  float rise = z / scale_height;
  float x = max(rise * path, -40.0);
  // 1 - e^-x without the difference of like numbers.
  float share = abs(x) < 1e-2 ? 1.0 - 0.5 * x * (1.0 - x / 3.0) : (1.0 - exp(-x)) / x;
  return start * path * share;
}

vec3 haze_transmittance(Haze haze, vec3 origin, vec3 direction, float path) {
  float d = min(path, 1e9);
  vec3 depth = haze.molecules * air_on_path(origin.z, direction.z, d, haze.molecules_height) +
               haze.aerosol * air_on_path(origin.z, direction.z, d, haze.aerosol_height);
  return exp(-depth);
}
