// A picture as it is, at another size.

uniform sampler2D picture;

in vec2 screen_place;
out vec4 result;

void main() {
  result = texture(picture, screen_place);
}
