#version 330 core
// Light laid over a picture.

uniform sampler2D u_light;  // linear light times opacity, and opacity; may exceed 1
uniform int u_margin;       // of u_light around the picture, pixels
uniform bool u_encoded;     // whether colours are stored as they are, not as light
uniform vec2 u_box_low;     // corners between the faces of the walls, pixels
uniform vec2 u_box_high;

out vec4 o_colour;

const float kGhost = 0.15;  // opacity of what a periodic border shows a second time

// The share of a pixel that lies inside an edge, at a distance (positive: inside) in pixels.
float coverage(float distance) { return clamp(distance + 0.5, 0.0, 1.0); }

vec3 srgb(vec3 c) {
  return mix(12.92 * c, 1.055 * pow(c, vec3(1.0 / 2.4)) - 0.055, step(0.0031308, c));
}

void main() {
  vec4 light = texelFetch(u_light, ivec2(gl_FragCoord.xy) + u_margin, 0);
  vec2 inside = min(gl_FragCoord.xy - u_box_low, u_box_high - gl_FragCoord.xy);
  float shown = mix(kGhost, 1.0, coverage(min(inside.x, inside.y)));
  vec4 laid = shown * light / max(light.a, 1.0);
  if (u_encoded && laid.a > 0.0) laid.rgb = laid.a * srgb(laid.rgb / laid.a);
  o_colour = laid;
}
