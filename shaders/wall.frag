// The band of a wall, with a pattern that shows the kind of the wall.

in vec2 v_place;  // coordinates along the wall and outward from its face, pixels

uniform int u_pattern;      // the enum Pattern of wall_layer.cpp
uniform vec4 u_colour;
uniform float u_thickness;  // thickness of the band, pixels
uniform float u_advance;    // inward displacement of a driven wall's teeth, in periods
uniform float u_line;       // width of lines, pixels
uniform bool u_slides;      // whether the wall slides along itself

out vec4 o_colour;

const int kHatch = 0, kTeeth = 1, kWaves = 2, kGlow = 3, kDashes = 4, kPlain = 5;
const float kTurn = 6.2831853;

// Fraction of a pixel inside an edge at `distance` pixels; positive: inside.
float coverage(float distance) { return clamp(distance + 0.5, 0.0, 1.0); }

// Stripes over half of each period: 1 inside, 0 outside. `softness` is the width of their soft edge
// in periods.
float stripes(float phase, float softness) {
  float distance = 0.25 - abs(fract(phase) - 0.5);
  return clamp(distance / softness + 0.5, 0.0, 1.0);
}

// Stripes along the wall, displaced outward in proportion to `height`, 0..1. u_advance moves them
// into the box.
float crests(float height) {
  float period = 0.75 * u_thickness;
  float phase = (v_place.y - 0.6 * u_thickness * height) / period + u_advance;
  return stripes(phase, 1.2 / period);
}

// Height of the saw-tooth and wave profiles, 0..1.
float tooth() { return abs(fract(v_place.x / (2.0 * u_thickness)) - 0.5) * 2.0; }
float wave() { return 0.5 + 0.5 * cos(kTurn * v_place.x / (2.0 * u_thickness)); }

void main() {
  float face = coverage(u_line - v_place.y);
  float depth = clamp(v_place.y / u_thickness, 0.0, 1.0);
  float alpha = 0.0;
  if (u_pattern == kHatch) {
    alpha = 0.45 * stripes((v_place.x + v_place.y) / (0.6 * u_thickness), 2.4 / u_thickness);
  } else if (u_pattern == kTeeth || u_pattern == kWaves) {
    float height = u_pattern == kTeeth ? tooth() : wave();
    alpha = mix(0.15, 0.9, crests(height)) * (1.0 - 0.5 * depth);
  } else if (u_pattern == kGlow) {
    alpha = pow(1.0 - depth, 1.5);
    if (u_slides) alpha *= mix(0.35, 1.0, stripes(v_place.x / (2.0 * u_thickness), 1.2 / u_thickness));
  } else if (u_pattern == kDashes) {
    face = 0.7 * stripes(v_place.x / (8.0 * u_line), 1.0 / (8.0 * u_line));
  } else if (u_pattern == kPlain) {
    alpha = 1.0;
  }
  o_colour = vec4(u_colour.rgb, u_colour.a * max(alpha, face));
}
