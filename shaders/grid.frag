// A square grid over the box.

uniform vec2 u_low;      // lower left corner of the box, pixels
uniform float u_square;  // spacing of the lines, pixels
uniform float u_line;    // width of the lines, pixels
uniform vec4 u_colour;

out vec4 o_colour;

// Fraction of a pixel inside an edge at `distance` pixels; positive: inside.
float coverage(float distance) { return clamp(distance + 0.5, 0.0, 1.0); }

void main() {
  vec2 place = (gl_FragCoord.xy - u_low) / u_square;
  vec2 away = abs(place - round(place)) * u_square;
  float alpha = coverage(0.5 * u_line - min(away.x, away.y));
  o_colour = vec4(u_colour.rgb, u_colour.a * alpha);
}
