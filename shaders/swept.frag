#version 330 core
// The light of a disk that moves evenly and straight on, averaged over the time: that of disk.frag
// for a disk at rest.

flat in vec2 v_start;   // of its centre, pixels
flat in vec2 v_along;   // direction of motion
flat in vec2 v_way;     // its length in pixels, and its share of the exposure
flat in vec4 v_colour;  // linear light

uniform float u_radius;   // pixels drawn
uniform float u_samples;  // pixels drawn for one of the finished picture, along each axis

out vec4 o_light;

// The integral of a soft edge, far - sqrt(s^2 + h^2), over s from a to b, by Gauss and Legendre's
// three points: a closed form would lose its digits in differences of squares.
float edge(float far, float h, float a, float b) {
  float middle = 0.5 * (a + b), half_width = 0.5 * (b - a);
  float away = 0.7745967 * half_width;
  float ends = length(vec2(middle - away, h)) + length(vec2(middle + away, h));
  return half_width * (2.0 * far - (5.0 * ends + 8.0 * length(vec2(middle, h))) / 9.0);
}

// The time average of clamp(radius - d + 1/2, 0, 1) where d is the distance from the moving centre,
// which is at s from `from` to `to` along its way, and passes at h.
float average(float radius, float h, float from, float to) {
  float near = max(radius - 0.5, 0.0), far = radius + 0.5;
  float inner = sqrt(max(near * near - h * h, 0.0));
  float outer = sqrt(max(far * far - h * h, 0.0));
  float whole = clamp(to, -inner, inner) - clamp(from, -inner, inner);
  float leaving = edge(far, h, clamp(from, inner, outer), clamp(to, inner, outer));
  float coming = edge(far, h, clamp(-to, inner, outer), clamp(-from, inner, outer));
  return (whole + leaving + coming) / (to - from);
}

void main() {
  vec2 place = gl_FragCoord.xy - v_start;
  float from = -dot(place, v_along), to = from + v_way.x;
  float h = abs(dot(place, vec2(-v_along.y, v_along.x)));

  // The soft edge would add a twelfth of pi pixels to the area.
  float radius = sqrt(u_radius * u_radius - 1.0 / 12.0);
  float alpha = average(radius, h, from, to);
  if (alpha <= 0.0) discard;

  float rim = min(0.14 * u_radius, 2.5 * u_samples);
  float rimmed = clamp((u_radius / u_samples - 1.5) / 5.5, 0.0, 1.0);
  float bright = mix(alpha, mix(average(radius - rim, h, from, to), alpha, 0.3), rimmed);
  o_light = v_way.y * v_colour.a * vec4(bright * v_colour.rgb, alpha);
}
