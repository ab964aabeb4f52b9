// A straight segment of a trail, drawn as an instance of a rectangle around it.

layout(location = 0) in vec2 a_start;    // pixels
layout(location = 1) in vec2 a_end;
layout(location = 2) in vec2 a_opacity;  // at the start and at the end
layout(location = 3) in vec4 a_colour;   // linear light
layout(location = 4) in float a_half;    // half the width of the trail, pixels

uniform vec2 u_size;  // size of the picture, pixels

out vec2 v_place;  // coordinates along and across the segment, from its start, pixels
flat out float v_length;
flat out vec2 v_opacity;
flat out vec4 v_colour;
flat out float v_half;

void main() {
  vec2 way = a_end - a_start;
  v_length = length(way);
  v_opacity = a_opacity;
  v_colour = a_colour;
  v_half = a_half;
  vec2 along = v_length > 0.0 ? way / v_length : vec2(1.0, 0.0);
  float reach = a_half + 0.5;
  vec2 corner = vec2(gl_VertexID & 1, gl_VertexID >> 1);
  v_place = mix(vec2(-reach), vec2(v_length + reach, reach), corner);
  vec2 position = a_start + v_place.x * along + v_place.y * vec2(-along.y, along.x);
  gl_Position = vec4(2.0 * position / u_size - 1.0, 0.0, 1.0);
}
