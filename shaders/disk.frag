#version 330 core
// A disk with an antialiased edge and a darker rim. Only the pixel's place matters, so that points
// and squares give the same picture.

flat in vec2 v_centre;
flat in vec4 v_colour;  // linear light
flat in vec2 v_axis;    // of the mark, from the centre

uniform float u_radius;   // pixels drawn
uniform float u_samples;  // pixels drawn for one of the finished picture, along each axis
uniform bool u_encoded;   // whether colours are stored as they are, not as light
uniform bool u_marked;    // whether disks show by how much they have turned
uniform vec2 u_box_low;  // corners between the faces of the walls, pixels
uniform vec2 u_box_high;

out vec4 o_colour;

const float kGhost = 0.15;  // opacity of what a periodic border shows a second time

// The share of a pixel that lies inside an edge, at a distance (positive: inside) in pixels.
float coverage(float distance) { return clamp(distance + 0.5, 0.0, 1.0); }

// The share of a pixel that a disk's mark covers, a line from its centre to its rim.
float mark(vec2 place) {
  float along = dot(place, v_axis);
  float across = abs(dot(place, vec2(-v_axis.y, v_axis.x)));
  return min(coverage(max(0.08 * u_radius, 0.5 * u_samples) - across), coverage(along));
}

vec3 srgb(vec3 c) {
  return mix(12.92 * c, 1.055 * pow(c, vec3(1.0 / 2.4)) - 0.055, step(0.0031308, c));
}

void main() {
  // The soft edge would add a twelfth of pi pixels to the area.
  float distance = sqrt(u_radius * u_radius - 1.0 / 12.0) - length(gl_FragCoord.xy - v_centre);
  float whole = coverage(distance);
  if (whole == 0.0) discard;

  vec2 inside = min(gl_FragCoord.xy - u_box_low, u_box_high - gl_FragCoord.xy);
  float alpha = whole * mix(kGhost, 1.0, coverage(min(inside.x, inside.y)));

  // Small disks, which are drawn as their coverage, have no rim.
  float rim = min(0.14 * u_radius, 2.5 * u_samples);
  float rimmed = clamp((u_radius / u_samples - 1.5) / 5.5, 0.0, 1.0);
  float shade = mix(0.3, 1.0, coverage(distance - rim) / whole);
  if (u_marked) shade = min(shade, mix(1.0, 0.3, mark(gl_FragCoord.xy - v_centre)));
  vec3 light = mix(1.0, shade, rimmed) * v_colour.rgb;
  o_colour = vec4(u_encoded ? srgb(light) : light, v_colour.a * alpha);
}
