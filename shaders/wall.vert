// A wall, drawn as a band outside a side of the box.

layout(location = 0) in vec2 a_position;  // pixels
layout(location = 1) in vec2 a_place;     // along the wall and outward from its face, pixels

uniform vec2 u_size;  // size of the picture, pixels

out vec2 v_place;

void main() {
  v_place = a_place;
  gl_Position = vec4(2.0 * a_position / u_size - 1.0, 0.0, 1.0);
}
