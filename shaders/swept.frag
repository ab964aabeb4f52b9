// Time average of the light of a disk in uniform straight motion. A disk at rest looks as in
// disk.frag.

flat in vec2 v_start;   // centre of the disk at the start of the way, pixels
flat in vec2 v_along;   // direction of motion, a unit vector
flat in vec2 v_way;     // length of the way in pixels, and its fraction of the exposure time
flat in vec4 v_colour;  // linear light
flat in float v_radius;  // drawn pixels

uniform float u_samples;  // drawn pixels per finished pixel, along each axis

out vec4 o_light;

// Integral of a soft edge, far - sqrt(s^2 + h^2), over s from a to b, by three-point Gauss-Legendre
// quadrature. The closed form suffers from cancellation.
float edge(float far, float h, float a, float b) {
  float middle = 0.5 * (a + b), half_width = 0.5 * (b - a);
  float away = 0.7745967 * half_width;
  float ends = length(vec2(middle - away, h)) + length(vec2(middle + away, h));
  return half_width * (2.0 * far - (5.0 * ends + 8.0 * length(vec2(middle, h))) / 9.0);
}

// Time average of clamp(radius - d + 1/2, 0, 1), with d = sqrt(s^2 + h^2) the distance of a pixel
// from the moving centre. s runs from `from` to `to`. h is the distance of the pixel from the line
// of motion.
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

  // The reduced radius keeps the area: a soft edge adds pi/12 pixels to it.
  float radius = sqrt(v_radius * v_radius - 1.0 / 12.0);
  float alpha = average(radius, h, from, to);
  if (alpha <= 0.0) discard;

  float rim = min(0.14 * v_radius, 2.5 * u_samples);
  float rimmed = clamp((v_radius / u_samples - 1.5) / 5.5, 0.0, 1.0);
  float bright = mix(alpha, mix(average(radius - rim, h, from, to), alpha, 0.3), rimmed);
  o_light = v_way.y * v_colour.a * vec4(bright * v_colour.rgb, alpha);
}
