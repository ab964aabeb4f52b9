// A fixture of disks, drawn as an instance of a rectangle that contains it.

layout(location = 0) in vec4 a_rectangle;  // lower left and upper right corner, pixels
layout(location = 1) in vec4 a_shape;      // pixel of its origin, radius or 0, first corner
layout(location = 2) in vec4 a_marks;      // pattern, thickness, length of a tooth, advance
layout(location = 3) in vec2 a_counts;     // corners, and period of dashes, see fixture.frag
layout(location = 4) in vec4 a_fill;
layout(location = 5) in vec4 a_colour;

uniform vec2 u_size;  // size of the picture, pixels

flat out vec4 v_shape;
flat out vec4 v_marks;
flat out vec2 v_counts;
flat out vec4 v_fill;
flat out vec4 v_colour;

void main() {
  v_shape = a_shape;
  v_marks = a_marks;
  v_counts = a_counts;
  v_fill = a_fill;
  v_colour = a_colour;
  vec2 corner = vec2(gl_VertexID & 1, gl_VertexID >> 1);
  gl_Position = vec4(2.0 * mix(a_rectangle.xy, a_rectangle.zw, corner) / u_size - 1.0, 0.0, 1.0);
}
