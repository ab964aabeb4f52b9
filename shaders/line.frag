// A line with antialiased edges, dashed if u_dash is not 0.

in vec3 v_place;  // across, along and half the width, pixels
flat in vec4 v_colour;

uniform float u_dash;  // period of the dashes, pixels; 0: none

out vec4 o_colour;

void main() {
  float alpha = clamp(v_place.z - abs(v_place.x) + 0.5, 0.0, 1.0);
  if (u_dash > 0.0) {
    float distance = (0.25 - abs(fract(v_place.y / u_dash) - 0.5)) * u_dash;
    alpha *= clamp(distance + 0.5, 0.0, 1.0);
  }
  if (alpha == 0.0) discard;
  o_colour = vec4(v_colour.rgb, v_colour.a * alpha);
}
