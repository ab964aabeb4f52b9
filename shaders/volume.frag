// A field as a fog that emits and absorbs light. Each cell is uniform, so the light of a ray is an
// exact sum over its cells. The ray ends at the surface in the depth buffer.

uniform sampler3D u_cells;         // linear light of the cells, and their share of u_extinction
uniform sampler2D u_depths;
uniform float u_extinction;        // extinction coefficient at the end of the colour range
uniform vec3 u_cell;               // sides of a cell, world units
uniform vec3 u_from;               // corners of what is drawn, world units
uniform vec3 u_to;
uniform vec2 u_origin;             // pixel of the centre of the view
uniform float u_scale;             // pixels per world unit, at the centre
uniform float u_inverse_distance;  // of the viewer from the centre
uniform float u_nearest;           // least w of what is drawn, see render/eye.h
uniform float u_depth_range;       // largest |z/w|
uniform mat3 u_axes;               // from the view to the world
uniform vec3 u_centre;             // world position of the centre of the view

out vec4 o_colour;

const float kOpaque = 1.0 / 512.0;  // a fog that transmits less hides everything
const ivec2 kBeside[4] = ivec2[](ivec2(1, 0), ivec2(-1, 0), ivec2(0, 1), ivec2(0, -1));

#ifdef ENCODED
vec3 srgb(vec3 c) {
  return mix(12.92 * c, 1.055 * pow(c, vec3(1.0 / 2.4)) - 0.055, step(0.0031308, c));
}
#endif

// Place on the ray of a depth of the buffer.
float place_of(float depth) {
  if (depth == 1.0) return 1e30;
  float z_by_w = (1.0 - 2.0 * depth) * u_depth_range;
  return -z_by_w / (1.0 + z_by_w * u_inverse_distance);
}

// Place of the surface that ends the ray, at most `last`. The soft edge of a sphere has the depth
// of the sphere, but covers only a part of its pixel. There the ray ends in the middle between the
// sphere and the surface behind it. A neighbouring pixel has the depth of this surface.
float surface(float last) {
  ivec2 pixel = ivec2(gl_FragCoord.xy), corner = textureSize(u_depths, 0) - 1;
  float own = texelFetch(u_depths, pixel, 0).r, farthest = own;
  for (int k = 0; k < 4; ++k) {
    ivec2 beside = clamp(pixel + kBeside[k], ivec2(0), corner);
    farthest = max(farthest, texelFetch(u_depths, beside, 0).r);
  }
  return 0.5 * (min(place_of(own), last) + min(place_of(farthest), last));
}

void main() {
  // The ray through the pixel. Its places are distances from z = 0 along the view, away from the
  // viewer.
  vec2 place = (gl_FragCoord.xy - u_origin) / u_scale;
  vec3 along = vec3(place * u_inverse_distance, -1.0);
  vec3 start = u_axes * vec3(place, 0.0) + u_centre;
  vec3 way = u_axes * along;
  way = mix(way, vec3(1e-9), equal(way, vec3(0.0)));

  vec3 a = (u_from - start) / way, b = (u_to - start) / way;
  vec3 low = min(a, b), high = max(a, b);
  float at = max(max(low.x, low.y), low.z);
  float end = surface(min(min(high.x, high.y), high.z));
  if (u_inverse_distance > 0.0) at = max(at, (u_nearest - 1.0) / u_inverse_distance);
  if (at >= end) discard;

  // From border to border of the cells (Amanatides and Woo 1987).
  vec3 cells = vec3(textureSize(u_cells, 0));
  vec3 cell = clamp(floor((start + at * way) / u_cell), vec3(0.0), cells - 1.0);
  vec3 border = ((cell + step(0.0, way)) * u_cell - start) / way;  // next one on each axis
  vec3 apart = abs(u_cell / way);
  float extinction = u_extinction * length(along);
  float transmitted = 1.0;
  vec3 light = vec3(0.0);
  while (at < end && transmitted > kOpaque) {
    float next = max(at, min(min(border.x, border.y), min(border.z, end)));
    vec4 fog = texelFetch(u_cells, ivec3(clamp(cell, vec3(0.0), cells - 1.0)), 0);
    float through = exp(-extinction * fog.a * (next - at));
    light += transmitted * (1.0 - through) * fog.rgb;
    transmitted *= through;
    vec3 crossed = step(border, vec3(next));
    cell += crossed * sign(way);
    border += crossed * apart;
    at = next;
  }
  float opacity = 1.0 - transmitted;
#ifdef ENCODED
  if (opacity > 0.0) light = opacity * srgb(light / opacity);
#endif
  o_colour = vec4(light, opacity);
}
