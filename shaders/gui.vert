// Triangles of Dear ImGui. The origin of its coordinates is the upper left corner.

layout(location = 0) in vec2 a_position;
layout(location = 1) in vec2 a_texture_place;
layout(location = 2) in vec4 a_colour;

uniform vec2 u_origin;  // upper left corner of the picture, in coordinates of Dear ImGui
uniform vec2 u_size;    // size of the picture, in coordinates of Dear ImGui

out vec2 v_texture_place;
out vec4 v_colour;

void main() {
  v_texture_place = a_texture_place;
  v_colour = a_colour;
  vec2 place = (a_position - u_origin) / u_size;
  gl_Position = vec4(2.0 * place.x - 1.0, 1.0 - 2.0 * place.y, 0.0, 1.0);
}
