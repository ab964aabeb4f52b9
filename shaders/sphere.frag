// A sphere with soft light, the shade of its neighbours, and an antialiased silhouette. With CUT
// the planes of periodic borders and of a slab cut it, and the cut is flat. With ENCODED the output
// is sRGB values instead of linear light. With MARKED spheres have marks that turn with them. With
// BODY the sphere is a fixture, with a pattern that shows its law. These are macros, because
// drivers without branches would compute unused parts for each pixel.

flat in vec3 v_centre;    // view coordinates, see render/eye.h
flat in float v_radius;   // world units
flat in vec4 v_colour;    // linear light
flat in vec4 v_crowding;  // direction and weight of the neighbours
flat in vec3 v_squares;   // xx, yy, zz of their second moments
flat in vec3 v_products;  // xy, xz, yz of these
flat in vec4 v_turn;      // rotation from the view to the sphere, real part last

uniform vec2 u_origin;             // pixel of the centre of the view
uniform float u_scale;             // pixels per world unit, at the centre
uniform float u_inverse_distance;  // of the viewer from the centre
uniform float u_depth_range;       // largest |z/w|
uniform float u_samples;           // drawn pixels per finished pixel, along each axis
uniform mat3 u_axes;               // from the view to the world
uniform vec3 u_centre;             // world position of the centre of the view
uniform vec3 u_low;                // corners of what is drawn, world units
uniform vec3 u_high;
uniform vec3 u_ghost_low;          // corners of what is drawn faintly, world units
uniform vec3 u_ghost_high;

#ifdef BODY
uniform int u_pattern;    // the enum Pattern of box_layer.h
uniform float u_advance;  // of the rings of a driven surface, in periods
uniform float u_least;    // least coverage of drawn pixels
#endif

out vec4 o_colour;

const float kGhost = 0.15;  // opacity of the parts beyond a periodic border
const float kSpot = 0.955;  // cosine of the angle between the axis and the edge of a mark
const vec3 kKey = vec3(-0.40, 0.62, 0.675);  // direction to the main light, in the view

// Fraction of a pixel inside an edge at `distance` pixels; positive: inside.
float coverage(float distance) { return clamp(distance + 0.5, 0.0, 1.0); }

#ifdef ENCODED
vec3 srgb(vec3 c) {
  return mix(12.92 * c, 1.055 * pow(c, vec3(1.0 / 2.4)) - 0.055, step(0.0031308, c));
}
#endif

// Share of the sky that neighbours leave open over a normal (see neighbour_shade.h).
float openness(vec3 n) {
  float across = dot(v_squares, n * n) +
                 2.0 * dot(v_products, vec3(n.x * n.y, n.x * n.z, n.y * n.z));
  float covered = 0.09375 * v_crowding.w + 0.5 * dot(v_crowding.xyz, n) + 0.46875 * across;
  return clamp(1.0 - covered, 0.12, 1.0);
}

// Light on a surface with a normal in view coordinates, relative to its colour.
float light(vec3 n) {
  vec3 up = vec3(u_axes[0].y, u_axes[1].y, u_axes[2].y);
  float open = openness(n);
  float sky = mix(0.3, 0.6, 0.5 + 0.5 * dot(n, up));
  return open * sky + 0.8 * max(dot(n, kKey), 0.0) * mix(0.6, 1.0, open);
}

#ifdef MARKED
// Light of the marks that turn with a sphere: dark spots at both ends of its three axes. They fade
// out towards small spheres.
float mark(vec3 n, float pixels) {
  vec3 turned = abs(n + 2.0 * cross(v_turn.xyz, cross(v_turn.xyz, n) + v_turn.w * n));
  float nearest = max(max(turned.x, turned.y), turned.z);
  float spot = coverage((nearest - kSpot) / sqrt(1.0 - kSpot * kSpot) * pixels);
  return 1.0 - 0.75 * spot * clamp((pixels / u_samples - 1.5) / 5.5, 0.0, 1.0);
}
#endif

#ifdef BODY
// Light of the pattern of a fixture, with its normal in the world. Hatching goes around a slanted
// axis, and the rings of a driven surface around the vertical one.
float law(float shade, vec3 n) {
  const int kRings = 1, kGlow = 3;
  const float kQuarter = 1.5707963;
  if (u_pattern == kGlow) return mix(shade, 1.0, 0.4);
  float period = max(1.0, 0.16 * v_radius) / v_radius;
  float angle = u_pattern == kRings ? kQuarter - abs(asin(clamp(n.y, -1.0, 1.0)))
                                    : acos(dot(n, vec3(0.5, 0.7071068, -0.5)));
  float phase = angle / period - u_advance, share = u_pattern == kRings ? 0.4 : 0.3;
  float distance = 0.5 * share - abs(fract(phase) - 0.5);
  float soft = max(fwidth(angle) / period, 1e-4);
  float stripe = mix(clamp(distance / soft + 0.5, 0.0, 1.0), share, smoothstep(0.4, 1.0, soft));
  return shade * mix(1.0, u_pattern == kRings ? 1.7 : 1.25, stripe);
}
#endif

#ifdef CUT
// First and last t of the part of a ray between two corners.
vec2 inside(vec3 origin, vec3 per_direction, vec3 low, vec3 high) {
  vec3 a = (low - origin) * per_direction, b = (high - origin) * per_direction;
  vec3 first = min(a, b), last = max(a, b);
  return vec2(max(max(first.x, first.y), first.z), min(min(last.x, last.y), last.z));
}
#endif

void main() {
  // The ray through the pixel: from its point nearest to the centre of the sphere, along `along`.
  vec2 place = (gl_FragCoord.xy - u_origin) / u_scale;
  vec3 along = normalize(vec3(place * u_inverse_distance, -1.0));
  vec3 away = vec3(place, 0.0) - v_centre;  // the ray meets the plane z = 0 at `place`
  vec3 nearest = away - dot(away, along) * along;
  float w = 1.0 - v_centre.z * u_inverse_distance;
  float pixels = u_scale / w * v_radius;  // radius on the picture
  float off = length(nearest);
  float whole = coverage((v_radius - off) / v_radius * pixels);
  if (whole == 0.0) discard;
#ifdef BODY
  if (whole < u_least) discard;
#endif

  // The chord inside the sphere, then inside the planes, in world coordinates.
  float half_chord = sqrt(max(v_radius * v_radius - off * off, 0.0));
  bool cut = false;
  float t = -half_chord, alpha = whole;
#ifdef CUT
  vec3 middle = u_axes * (v_centre + nearest) + u_centre;
  vec3 per_direction = 1.0 / (u_axes * along);
  vec2 drawn = inside(middle, per_direction, u_low, u_high);
  cut = drawn.x > -half_chord;
  t = max(-half_chord, drawn.x);
  if (t > min(half_chord, drawn.y)) {
    vec2 ghost = inside(middle, per_direction, u_ghost_low, u_ghost_high);
    cut = ghost.x > -half_chord;
    t = max(-half_chord, ghost.x);
    if (t > min(half_chord, ghost.y)) discard;
    alpha *= kGhost;
  }
#endif

  vec3 point = v_centre + nearest + t * along;
  vec3 normal = (nearest - half_chord * along) / v_radius;
  float shade = light(normal);
#ifdef MARKED
  shade *= mark(normal, pixels);
#endif
#ifdef BODY
  shade = law(shade, u_axes * normal);
#endif
#ifdef CUT
  if (cut) {
    shade = 0.8;  // a flat cut, with a darker rim
    float rim = min(0.14 * pixels, 2.0 * u_samples);
    shade *= mix(0.45, 1.0, coverage((v_radius - off) / v_radius * pixels - rim));
  }
#endif
  vec3 colour = shade * v_colour.rgb;
#ifdef ENCODED
  colour = srgb(colour);
#endif
  o_colour = vec4(colour, v_colour.a * alpha);
  float depth = point.z / (1.0 - point.z * u_inverse_distance);
  gl_FragDepth = 0.5 - 0.5 * depth / u_depth_range;
}
