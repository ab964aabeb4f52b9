#version 330 core
// The box, as a rectangle in pixels.

uniform vec2 u_size;  // of the picture, pixels
uniform vec2 u_low;   // corners of the box, pixels
uniform vec2 u_high;

out vec2 v_place;  // in the box, 0..1

void main() {
  v_place = vec2(gl_VertexID & 1, gl_VertexID >> 1);
  gl_Position = vec4(2.0 * mix(u_low, u_high, v_place) / u_size - 1.0, 0.0, 1.0);
}
