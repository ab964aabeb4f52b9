// A disk in straight motion, drawn as an instance of a rectangle around the swept area.

layout(location = 0) in vec2 a_start;  // centre of the disk at the start of the way, pixels
layout(location = 1) in vec2 a_along;  // direction of motion, a unit vector
layout(location = 2) in vec2 a_way;    // length of the way, pixels, and its share of the exposure
layout(location = 3) in vec4 a_colour;  // linear light
layout(location = 4) in float a_radius;  // of the disk, pixels

uniform vec2 u_size;  // size of the picture, pixels

flat out vec2 v_start;
flat out vec2 v_along;
flat out vec2 v_way;
flat out vec4 v_colour;
flat out float v_radius;

void main() {
  v_start = a_start;
  v_along = a_along;
  v_way = a_way;
  v_colour = a_colour;
  v_radius = a_radius;
  float reach = a_radius + 0.5;
  vec2 corner = vec2(gl_VertexID & 1, gl_VertexID >> 1);
  vec2 place = mix(vec2(-reach), vec2(a_way.x + reach, reach), corner);
  vec2 position = a_start + place.x * a_along + place.y * vec2(-a_along.y, a_along.x);
  gl_Position = vec4(2.0 * position / u_size - 1.0, 0.0, 1.0);
}
