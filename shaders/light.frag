#version 330 core
// The light of disks too small to have a shape.

uniform sampler2D u_light;  // linear light times area, and area, in pixels
uniform int u_margin;       // of u_light around the picture, pixels
uniform vec2 u_box_low;     // corners between the faces of the walls, pixels
uniform vec2 u_box_high;

out vec4 o_colour;

const float kGhost = 0.15;  // opacity of what a periodic border shows a second time

// The share of a pixel that lies inside an edge, at a distance (positive: inside) in pixels.
float coverage(float distance) { return clamp(distance + 0.5, 0.0, 1.0); }

void main() {
  vec4 light = texelFetch(u_light, ivec2(gl_FragCoord.xy) + u_margin, 0);
  vec2 inside = min(gl_FragCoord.xy - u_box_low, u_box_high - gl_FragCoord.xy);
  float shown = mix(kGhost, 1.0, coverage(min(inside.x, inside.y)));
  o_colour = shown * light / max(light.a, 1.0);
}
