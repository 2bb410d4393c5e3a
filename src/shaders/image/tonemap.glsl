// Twin of image/tonemap.hpp: tone maps, and the sRGB curve.

const int tone_clip = 0;
const int tone_exponential = 1;
const int tone_agx = 2;
const int tone_agx_punchy = 3;
const int tone_neutral = 4;

vec3 row_sum_one(vec3 row) {
  return row / (row.x + row.y + row.z);
}

mat3 agx_inset() {
  return transpose(mat3(row_sum_one(vec3(0.842479062253094, 0.0784335999999992, 0.0792237451477643)),
                        row_sum_one(vec3(0.0423282422610123, 0.878468636469772, 0.0791661274605434)),
                        row_sum_one(vec3(0.0423756549057051, 0.0784336, 0.879142973793104))));
}

// One half of the sigmoid, from its pivot to the end `run` away and half the height up.
float agx_half(float x, float run, float power) {
  float ratio = pow(4.0 * run, power);
  float scale = 2.0 * run / pow(ratio - 1.0, 1.0 / power);
  float t = 2.0 * x / scale;
  return scale * t / pow(1.0 + pow(abs(t), power), 1.0 / power);
}

float agx_sigmoid(float light) {
  const float pivot = 10.0 / 16.5;
  if (!(light > 0.0)) return 0.0;
  float x = clamp((log2(light / 0.18) + 10.0) / 16.5, 0.0, 1.0);
  if (x <= 0.0) return 0.0;
  if (x >= 1.0) return 1.0;
  float s = 0.5 + (x < pivot ? agx_half(x - pivot, pivot, 3.0) : agx_half(x - pivot, 1.0 - pivot, 3.25));
  return clamp(s, 0.0, 1.0);
}

vec3 agx(vec3 color, bool punchy) {
  mat3 inset = agx_inset();
  vec3 v = inset * color;
  v = vec3(agx_sigmoid(v.x), agx_sigmoid(v.y), agx_sigmoid(v.z));
  if (punchy) {
    v = pow(v, vec3(1.35));
    float grey = dot(v, vec3(0.2126, 0.7152, 0.0722));
    v = vec3(grey) + 1.4 * (v - vec3(grey));
  }
  return pow(clamp(inverse(inset) * v, 0.0, 1.0), vec3(2.2));
}

// The specification's own names: F90, ks, kd.
vec3 khronos_neutral(vec3 c) {
  const float f90 = 0.04;
  const float ks = 0.8 - f90;
  const float kd = 0.15;
  float x = min(c.r, min(c.g, c.b));
  c -= x <= 2.0 * f90 ? x - x * x / (4.0 * f90) : f90;
  float peak = max(c.r, max(c.g, c.b));
  if (peak < ks) return c;
  float compressed = 1.0 - (1.0 - ks) * (1.0 - ks) / (peak + 1.0 - 2.0 * ks);
  float g = 1.0 / (kd * (peak - compressed) + 1.0);
  return mix(vec3(compressed), c * (compressed / peak), g);
}

// Linear light to linear light of the display, in [0, 1].
vec3 tone_mapped(vec3 color, int tone_map) {
  vec3 c = clamp(color, 0.0, 1e6);
  if (tone_map == tone_clip) return min(c, vec3(1.0));
  if (tone_map == tone_exponential) return vec3(1.0) - exp(-c);
  if (tone_map == tone_neutral) return clamp(khronos_neutral(c), 0.0, 1.0);
  return agx(c, tone_map == tone_agx_punchy);
}

vec3 srgb_encoded(vec3 c) {
  vec3 low = 12.92 * c;
  vec3 high = 1.055 * pow(max(c, vec3(0.0)), vec3(1.0 / 2.4)) - 0.055;
  return mix(high, low, vec3(lessThanEqual(c, vec3(0.0031308))));
}
