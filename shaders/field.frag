#version 330 core
// A field, one colour a cell.

in vec2 v_place;

uniform sampler2D u_cells;

out vec4 o_colour;

void main() { o_colour = texture(u_cells, v_place); }
