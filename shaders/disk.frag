#version 330 core
// A disk with an antialiased edge and a darker rim. Only the pixel's place matters, so that points
// and squares give the same picture.

flat in vec2 v_centre;
flat in vec4 v_colour;  // linear light

uniform float u_radius;   // pixels drawn
uniform float u_samples;  // pixels drawn for one of the finished picture, along each axis
uniform vec2 u_box_low;  // corners between the faces of the walls, pixels
uniform vec2 u_box_high;

out vec4 o_colour;

const float kGhost = 0.15;  // opacity of what a periodic border shows a second time

// The share of a pixel that lies inside an edge, at a distance (positive: inside) in pixels.
float coverage(float distance) { return clamp(distance + 0.5, 0.0, 1.0); }

void main() {
  // The soft edge would add a twelfth of pi pixels to the area.
  float distance = sqrt(u_radius * u_radius - 1.0 / 12.0) - length(gl_FragCoord.xy - v_centre);
  float alpha = coverage(distance);
  if (alpha == 0.0) discard;

  vec2 inside = min(gl_FragCoord.xy - u_box_low, u_box_high - gl_FragCoord.xy);
  alpha *= mix(kGhost, 1.0, coverage(min(inside.x, inside.y)));

  // Small disks, which are drawn as their coverage, have no rim.
  float rim = min(0.14 * u_radius, 2.5 * u_samples);
  float rimmed = clamp((u_radius / u_samples - 1.5) / 5.5, 0.0, 1.0);
  float shade = mix(0.3, 1.0, coverage(distance - rim));
  o_colour = vec4(mix(1.0, shade, rimmed) * v_colour.rgb, v_colour.a * alpha);
}
