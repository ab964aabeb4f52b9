// A fixture of disks: a filled body with an outline, or a line. A pattern shows its law, inside a
// body and on both sides of a line.

flat in vec4 v_shape;   // pixel of its origin, radius of a ball or 0, first corner in u_corners
flat in vec4 v_marks;   // the enum Pattern of fixture_layer.cpp, thickness of the band with the
                        // pattern and length of a tooth in pixels, displacement in periods
flat in vec2 v_counts;  // corners, and period of dashes in pixels, negative along y; 0: none
flat in vec4 v_fill;    // of a body; transparent: a line
flat in vec4 v_colour;

uniform sampler2D u_corners;  // of polygons: pixels from their origin, and along their outline
uniform float u_line;         // width of outlines, pixels
uniform vec2 u_box_low;       // corners between the faces of the walls, pixels
uniform vec2 u_box_high;
uniform float u_faintness;    // opacity outside the faces, for the parts beyond a periodic border

out vec4 o_colour;

const int kTeeth = 1, kHatch = 2, kGlow = 3;

// Fraction of a pixel inside an edge at `distance` pixels; positive: inside.
float coverage(float distance) { return clamp(distance + 0.5, 0.0, 1.0); }

// Stripes over half of each period: 1 inside, 0 outside. `softness` is the width of their soft edge
// in periods.
float stripes(float phase, float softness) {
  float distance = 0.25 - abs(fract(phase) - 0.5);
  return clamp(distance / softness + 0.5, 0.0, 1.0);
}

vec3 corner(int k) {
  int columns = textureSize(u_corners, 0).x;
  return texelFetch(u_corners, ivec2(k % columns, k / columns), 0).xyz;
}

// Distance from the outline, positive inside, and length along the outline to the nearest point.
vec2 from_polygon(vec2 place) {
  int first = int(v_shape.w), count = int(v_counts.x);
  float nearest = 1e30, along = 0.0;
  bool inside = false;
  vec3 a = corner(first);
  for (int k = 1; k <= count; ++k) {
    vec3 b = corner(first + k);
    vec2 edge = b.xy - a.xy, way = place - a.xy;
    float share = clamp(dot(way, edge) / dot(edge, edge), 0.0, 1.0);
    vec2 away = way - share * edge;
    float squared = dot(away, away);
    if (squared < nearest) {
      nearest = squared;
      along = mix(a.z, b.z, share);
    }
    bool crosses = (a.y > place.y) != (b.y > place.y);
    if (crosses && way.x < edge.x * way.y / edge.y) inside = !inside;
    a = b;
  }
  return vec2(inside ? sqrt(nearest) : -sqrt(nearest), along);
}

// The same of a ball. The reduced radius keeps the area: a soft edge adds pi/12 pixels to it.
vec2 from_ball(vec2 place) {
  float radius = v_shape.z;
  float depth = sqrt(max(radius * radius - 1.0 / 12.0, 0.0)) - length(place);
  return vec2(depth, radius * atan(place.y, place.x));
}

// Opacity of the pattern at a distance from the surface, as of walls.
float marks(float depth, vec2 place, float along) {
  int pattern = int(v_marks.x);
  float thickness = v_marks.y;
  float share = clamp(depth / thickness, 0.0, 1.0);
  if (depth < -0.5 || share == 1.0) return 0.0;
  if (pattern == kHatch) {
    float hatch = stripes((place.x + place.y) / (0.6 * thickness), 2.4 / thickness);
    return 0.5 * hatch * sqrt(1.0 - share);
  }
  if (pattern == kTeeth) {
    float period = 0.75 * thickness;
    float tooth = abs(fract(along / v_marks.z) - 0.5) * 2.0;
    float phase = (depth - 0.6 * thickness * tooth) / period + v_marks.w;
    return mix(0.15, 0.9, stripes(phase, 1.2 / period)) * (1.0 - share);
  }
  return pattern == kGlow ? pow(1.0 - share, 1.5) : 0.0;
}

void main() {
  vec2 place = gl_FragCoord.xy - v_shape.xy;
  vec2 at = v_shape.z > 0.0 ? from_ball(place) : from_polygon(place);
  float depth = at.x, inside = coverage(depth);
  vec4 colour;
  if (v_fill.a > 0.0) {
    float shown = max(coverage(u_line - depth), marks(depth, place, at.y));
    colour = vec4(mix(v_fill.rgb, v_colour.rgb, shown), inside);
  } else {
    float dash = v_counts.y, way = dash > 0.0 ? place.x : place.y;
    if (dash != 0.0) inside *= mix(0.2, 1.0, stripes(way / dash, 1.0 / abs(dash)));
    colour = vec4(v_colour.rgb, max(inside, 0.6 * marks(-depth, place, at.y)));
  }
  vec2 box = min(gl_FragCoord.xy - u_box_low, u_box_high - gl_FragCoord.xy);
  colour.a *= mix(u_faintness, 1.0, coverage(min(box.x, box.y)));
  o_colour = colour;
}
