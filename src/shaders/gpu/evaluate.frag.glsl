// A function at many points, one by fragment (gpu/evaluate.hpp).

uniform sampler2D points_a;
uniform sampler2D points_b;

out vec4 result;

vec4 evaluate(vec4 a, vec4 b);

void main() {
  ivec2 at = ivec2(gl_FragCoord.xy);
  result = evaluate(texelFetch(points_a, at, 0), texelFetch(points_b, at, 0));
}
