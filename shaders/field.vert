// A rectangle of the picture, such as the box.

uniform vec2 u_size;  // size of the picture, pixels
uniform vec2 u_low;   // lower left corner of the rectangle, pixels
uniform vec2 u_high;  // upper right corner of the rectangle, pixels

out vec2 v_place;  // position in the rectangle, 0..1

void main() {
  v_place = vec2(gl_VertexID & 1, gl_VertexID >> 1);
  gl_Position = vec4(2.0 * mix(u_low, u_high, v_place) / u_size - 1.0, 0.0, 1.0);
}
