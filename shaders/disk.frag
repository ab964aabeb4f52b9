// A disk with an antialiased edge and a darker rim. The result depends only on the pixel position,
// so points and squares give the same picture. With MARKED disks have marks that show their
// rotation. With ENCODED the output is sRGB values instead of linear light.

flat in vec2 v_centre;  // drawn pixels
flat in vec4 v_colour;  // linear light
flat in vec2 v_axis;    // direction of the mark from the centre
flat in float v_radius; // drawn pixels
flat in vec3 v_rim;     // radius of the edge, width of the rim, both drawn pixels; strength of the rim

uniform float u_samples;  // drawn pixels per finished pixel, along each axis
uniform vec2 u_box_low;  // corners between the faces of the walls, pixels
uniform vec2 u_box_high;
uniform float u_faintness;  // opacity outside the faces, for the parts beyond a periodic border

out vec4 o_colour;

// Fraction of a pixel inside an edge at `distance` pixels; positive: inside.
float coverage(float distance) { return clamp(distance + 0.5, 0.0, 1.0); }

#ifdef MARKED
// Fraction of a pixel covered by the mark of a disk, a line from its centre to its rim.
float mark(vec2 place) {
  float along = dot(place, v_axis);
  float across = abs(dot(place, vec2(-v_axis.y, v_axis.x)));
  return min(coverage(max(0.08 * v_radius, 0.5 * u_samples) - across), coverage(along));
}
#endif

#ifdef ENCODED
vec3 srgb(vec3 c) {
  return mix(12.92 * c, 1.055 * pow(c, vec3(1.0 / 2.4)) - 0.055, step(0.0031308, c));
}
#endif

void main() {
  float distance = v_rim.x - length(gl_FragCoord.xy - v_centre);
  float whole = coverage(distance);
  if (whole == 0.0) discard;

  vec2 inside = min(gl_FragCoord.xy - u_box_low, u_box_high - gl_FragCoord.xy);
  float alpha = whole * mix(u_faintness, 1.0, coverage(min(inside.x, inside.y)));

  float shade = mix(0.3, 1.0, coverage(distance - v_rim.y) / whole);
#ifdef MARKED
  shade = min(shade, mix(1.0, 0.3, mark(gl_FragCoord.xy - v_centre)));
#endif
  vec3 light = mix(1.0, shade, v_rim.z) * v_colour.rgb;
#ifdef ENCODED
  light = srgb(light);
#endif
  o_colour = vec4(light, v_colour.a * alpha);
}
