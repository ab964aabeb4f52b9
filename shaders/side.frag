// A side of the box with a faint pattern that shows the kind of its wall. With FILLED the pattern
// is on a plate or on a face of a body.

in vec2 v_place;  // world units from the low corner of the side

uniform int u_pattern;    // the enum Pattern of box_layer.h
uniform vec4 u_colour;
uniform vec2 u_extent;    // of the side, world units
uniform float u_advance;  // of the rings of a driven wall, in periods
#ifdef FILLED
uniform vec4 u_fill;
#endif

out vec4 o_colour;

const int kHatch = 0, kRings = 1, kWaves = 2, kGlow = 3;
const float kTurn = 6.2831853;

// Stripes over a share of each period, with soft edges of one pixel.
float stripes(float phase, float share) {
  float distance = 0.5 * share - abs(fract(phase) - 0.5);
  float soft = max(fwidth(phase), 1e-4);
  // Stripes narrower than a pixel become an even tone.
  return mix(clamp(distance / soft + 0.5, 0.0, 1.0), share, smoothstep(0.4, 1.0, soft));
}

void main() {
  vec2 inward = min(v_place, u_extent - v_place);
  float edge = min(inward.x, inward.y);  // distance to the nearest edge
  float size = min(u_extent.x, u_extent.y);
  float period = max(1.0, 0.08 * size);
  float alpha = 0.05;
  if (u_pattern == kHatch) {
    alpha += 0.09 * stripes((v_place.x + v_place.y) / period, 0.3);
  } else if (u_pattern == kRings) {
    alpha += 0.22 * stripes(edge / period + u_advance, 0.4);
  } else if (u_pattern == kWaves) {
    alpha += 0.22 * stripes((edge + 0.25 * period * cos(kTurn * (v_place.x + v_place.y) / period)) /
                                period, 0.4);
  } else if (u_pattern == kGlow) {
    alpha += 0.1 + 0.45 * exp(-edge / (0.12 * size));
  }
  o_colour = vec4(u_colour.rgb, u_colour.a * alpha);
#ifdef FILLED
  alpha *= u_colour.a;
  float whole = alpha + (1.0 - alpha) * u_fill.a;
  o_colour = vec4(mix(u_fill.rgb, u_colour.rgb, alpha / whole), whole);
#endif
}
