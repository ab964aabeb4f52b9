// A disk, drawn as an instance of a square, for disks larger than the largest point of the driver.

layout(location = 0) in vec2 a_centre;  // pixels
layout(location = 1) in vec4 a_colour;  // linear light
layout(location = 2) in float a_angle;  // angle of rotation, rad
layout(location = 3) in float a_radius; // pixels

uniform vec2 u_origin;  // lower left corner of the viewport, pixels
uniform vec2 u_extent;  // size of the viewport, pixels
uniform float u_samples;  // drawn pixels per finished pixel, along each axis

flat out vec2 v_centre;
flat out vec4 v_colour;
flat out vec2 v_axis;  // direction of the mark from the centre
flat out float v_radius;
flat out vec3 v_rim;

void main() {
  v_centre = a_centre;
  v_colour = a_colour;
  v_axis = vec2(cos(a_angle), sin(a_angle));
  v_radius = a_radius;
  // The reduced radius keeps the area: a soft edge adds pi/12 pixels to it. The rim fades out
  // towards the small disks that are drawn through their coverage.
  v_rim = vec3(sqrt(a_radius * a_radius - 1.0 / 12.0), min(0.14 * a_radius, 2.5 * u_samples),
               clamp((a_radius / u_samples - 1.5) / 5.5, 0.0, 1.0));
  // With the soft edge of half a pixel.
  vec2 corner = vec2(gl_VertexID & 1, gl_VertexID >> 1) * 2.0 - 1.0;
  vec2 position = a_centre + (a_radius + 0.5) * corner;
  gl_Position = vec4(2.0 * (position - u_origin) / u_extent - 1.0, 0.0, 1.0);
}
