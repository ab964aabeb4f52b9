// A line in space, drawn as a strip of constant width on the picture.

layout(location = 0) in vec3 a_position;  // pixels, and depth 0..1
layout(location = 1) in vec3 a_place;     // across, along and half the width, pixels
layout(location = 2) in vec4 a_colour;

uniform vec2 u_size;  // size of the picture, pixels

out vec3 v_place;
flat out vec4 v_colour;

void main() {
  v_place = a_place;
  v_colour = a_colour;
  gl_Position = vec4(2.0 * a_position.xy / u_size - 1.0, 2.0 * a_position.z - 1.0, 1.0);
}
