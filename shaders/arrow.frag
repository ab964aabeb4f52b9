// An arrow with an antialiased edge and a rim that separates it from the picture below.

in vec2 v_place;         // coordinates along and across the arrow, from its tail, pixels
flat in float v_length;  // pixels

uniform float u_shaft;  // half width of the shaft, pixels
uniform vec2 u_head;    // length and half width of the head, pixels
uniform float u_rim;    // width of the rim, pixels
uniform vec4 u_colour;
uniform vec4 u_rim_colour;

out vec4 o_colour;

// Fraction of a pixel inside an edge at `distance` pixels; positive: inside.
float coverage(float distance) { return clamp(distance + 0.5, 0.0, 1.0); }

void main() {
  // Short arrows are scaled down.
  float shrink = min(1.0, v_length / (1.5 * u_head.x));
  vec2 head = shrink * u_head;
  float neck = v_length - head.x;
  vec2 place = vec2(v_place.x, abs(v_place.y));

  vec2 beyond = vec2(max(-place.x, place.x - neck), place.y - shrink * u_shaft);
  float shaft = -min(max(beyond.x, beyond.y), 0.0) - length(max(beyond, 0.0));
  // Signed distance to the slanted side and the base of the head.
  vec2 side = normalize(vec2(u_head.y, u_head.x));
  float tip = min(dot(vec2(v_length, 0.0) - place, side), place.x - neck);

  float distance = max(shaft, tip);
  float inside = coverage(distance);
  float alpha = coverage(distance + u_rim);
  if (alpha == 0.0) discard;
  o_colour = mix(u_rim_colour, u_colour, inside);
  o_colour.a *= alpha;
}
