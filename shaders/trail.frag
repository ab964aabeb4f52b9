// A straight segment of a trail, with round ends and a soft edge.

in vec2 v_place;           // coordinates along and across the segment, from its start, pixels
flat in float v_length;    // pixels
flat in vec2 v_opacity;    // at the start and at the end
flat in vec4 v_colour;     // linear light
flat in float v_half;      // half the width of the trail, pixels

out vec4 o_light;

// Fraction of a pixel inside an edge at `distance` pixels; positive: inside.
float coverage(float distance) { return clamp(distance + 0.5, 0.0, 1.0); }

void main() {
  float along = clamp(v_place.x, 0.0, v_length);
  float opacity = mix(v_opacity.x, v_opacity.y, along / max(v_length, 1e-6));
  float alpha = opacity * v_colour.a * coverage(v_half - length(v_place - vec2(along, 0.0)));
  o_light = vec4(alpha * v_colour.rgb, alpha);
}
