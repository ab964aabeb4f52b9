// A field with one colour per cell. Hatching distinguishes cells without a value from all values.

in vec2 v_place;

uniform sampler2D u_cells;
uniform vec4 u_gap;      // colour of the hatching
uniform float u_period;  // horizontal distance of the hatching lines, pixels

out vec4 o_colour;

void main() {
  o_colour = texture(u_cells, v_place);
  if (o_colour.a > 0.0) return;
  float phase = fract((gl_FragCoord.x + gl_FragCoord.y) / u_period);
  float away = min(phase, 1.0 - phase) * u_period * 0.7071;
  o_colour = vec4(u_gap.rgb, u_gap.a * clamp(1.0 - away, 0.0, 1.0));
}
