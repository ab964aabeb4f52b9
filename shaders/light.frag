// Blends light over a picture. With ENCODED the output is sRGB values instead of linear light.

uniform sampler2D u_light;  // linear light times opacity, and opacity; may exceed 1
uniform int u_margin;       // margin of u_light around the picture, pixels
uniform vec2 u_box_low;     // corners between the faces of the walls, pixels
uniform vec2 u_box_high;
uniform float u_faintness;  // opacity outside the faces, for the parts beyond a periodic border

out vec4 o_colour;

// Fraction of a pixel inside an edge at `distance` pixels; positive: inside.
float coverage(float distance) { return clamp(distance + 0.5, 0.0, 1.0); }

#ifdef ENCODED
vec3 srgb(vec3 c) {
  return mix(12.92 * c, 1.055 * pow(c, vec3(1.0 / 2.4)) - 0.055, step(0.0031308, c));
}
#endif

void main() {
  vec4 light = texelFetch(u_light, ivec2(gl_FragCoord.xy) + u_margin, 0);
  vec2 inside = min(gl_FragCoord.xy - u_box_low, u_box_high - gl_FragCoord.xy);
  float shown = mix(u_faintness, 1.0, coverage(min(inside.x, inside.y)));
  vec4 laid = shown * light / max(light.a, 1.0);
#ifdef ENCODED
  if (laid.a > 0.0) laid.rgb = laid.a * srgb(laid.rgb / laid.a);
#endif
  o_colour = laid;
}
