// A field. Hatching distinguishes places without a value from all values.

in vec2 v_place;

uniform sampler2D u_cells;  // colours, multiplied by their opacity
uniform vec4 u_gap;         // colour of the hatching
uniform float u_period;     // horizontal distance of the hatching lines, pixels

out vec4 o_colour;

void main() {
  vec4 field = texture(u_cells, v_place);
  o_colour = vec4(field.rgb / max(field.a, 1e-3), field.a);
  if (field.a > 0.0) return;
  float phase = fract((gl_FragCoord.x + gl_FragCoord.y) / u_period);
  float away = min(phase, 1.0 - phase) * u_period * 0.7071;
  o_colour = vec4(u_gap.rgb, u_gap.a * clamp(1.0 - away, 0.0, 1.0));
}
