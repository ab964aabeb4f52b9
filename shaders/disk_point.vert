#version 330 core
// A disk as a point: one vertex, as long as it is no larger than the driver's largest point.

layout(location = 0) in vec2 a_centre;  // pixels
layout(location = 1) in vec4 a_colour;  // linear light
layout(location = 2) in float a_angle;  // by which it has turned

uniform vec2 u_origin;  // lower left corner and extent of the viewport, pixels; larger than the
uniform vec2 u_extent;  // picture, because a point whose centre lies outside is not drawn at all
uniform float u_reach;  // from the centre to the outermost pixel touched

flat out vec2 v_centre;
flat out vec4 v_colour;
flat out vec2 v_axis;  // of the disk's mark, from its centre

void main() {
  v_centre = a_centre;
  v_colour = a_colour;
  v_axis = vec2(cos(a_angle), sin(a_angle));
  gl_Position = vec4(2.0 * (a_centre - u_origin) / u_extent - 1.0, 0.0, 1.0);
  gl_PointSize = 2.0 * u_reach;
}
