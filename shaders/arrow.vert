// An arrow, drawn as an instance of a rectangle around it.

layout(location = 0) in vec2 a_tail;  // pixels
layout(location = 1) in vec2 a_tip;

uniform vec2 u_size;    // size of the picture, pixels
uniform float u_margin; // margin of the rectangle around the line from tail to tip, pixels

out vec2 v_place;            // coordinates along and across the arrow, from its tail, pixels
flat out float v_length;     // pixels

void main() {
  vec2 arrow = a_tip - a_tail;
  v_length = length(arrow);
  vec2 along = v_length > 0.0 ? arrow / v_length : vec2(1.0, 0.0);
  vec2 corner = vec2(gl_VertexID & 1, gl_VertexID >> 1);
  v_place = vec2(mix(-u_margin, v_length + u_margin, corner.x), mix(-u_margin, u_margin, corner.y));
  vec2 position = a_tail + v_place.x * along + v_place.y * vec2(-along.y, along.x);
  gl_Position = vec4(2.0 * position / u_size - 1.0, 0.0, 1.0);
}
