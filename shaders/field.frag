// A field. With HATCHED hatching distinguishes places without a value from all values.

in vec2 v_place;

uniform sampler2D u_cells;  // colours, multiplied by their opacity
uniform float u_opacity;    // of the whole field
#ifdef HATCHED
uniform vec4 u_gap;      // colour of the hatching
uniform float u_period;  // horizontal distance of the hatching lines, pixels
#endif

out vec4 o_colour;  // multiplied by its opacity

void main() {
  o_colour = u_opacity * texture(u_cells, v_place);
#ifdef HATCHED
  if (o_colour.a > 0.0) return;
  float phase = fract((gl_FragCoord.x + gl_FragCoord.y) / u_period);
  float away = min(phase, 1.0 - phase) * u_period * 0.7071;
  float alpha = u_opacity * u_gap.a * clamp(1.0 - away, 0.0, 1.0);
  o_colour = vec4(alpha * u_gap.rgb, alpha);
#endif
}
