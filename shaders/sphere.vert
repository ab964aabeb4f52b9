// A sphere, drawn as an instance of the rectangle that contains it on the picture.

layout(location = 0) in vec4 a_centre;     // view coordinates, see render/eye.h, and the radius
layout(location = 1) in vec4 a_colour;     // linear light
layout(location = 2) in vec4 a_crowding;   // direction and weight of the neighbours
layout(location = 3) in vec3 a_squares;    // xx, yy, zz of their second moments
layout(location = 4) in vec3 a_products;   // xy, xz, yz of these
layout(location = 5) in vec4 a_turn;       // rotation from the view to the sphere, real part last

uniform vec2 u_size;               // size of the picture, pixels
uniform vec2 u_origin;             // pixel of the centre of the view
uniform float u_scale;             // pixels per world unit, at the centre
uniform float u_inverse_distance;  // of the viewer from the centre

flat out vec3 v_centre;
flat out float v_radius;
flat out vec4 v_colour;
flat out vec4 v_crowding;
flat out vec3 v_squares;
flat out vec3 v_products;
flat out vec4 v_turn;

// Ends of the shadow of a sphere on one axis of the picture, in world units at the centre.
vec2 extent(float across, float w, float radius) {
  if (u_inverse_distance == 0.0) return vec2(across - radius, across + radius);
  // Tangents from the viewer in the plane of this axis, with lengths in distances of the viewer.
  float x = across * u_inverse_distance, r = radius * u_inverse_distance;
  float root = r * sqrt(max(x * x + w * w - r * r, 0.0));
  return vec2(x * w - root, x * w + root) / ((w * w - r * r) * u_inverse_distance);
}

void main() {
  v_centre = a_centre.xyz;
  v_radius = a_centre.w;
  v_colour = a_colour;
  v_crowding = a_crowding;
  v_squares = a_squares;
  v_products = a_products;
  v_turn = a_turn;
  float w = 1.0 - a_centre.z * u_inverse_distance;
  float reach = a_centre.w + 0.5 * w / u_scale;  // with the soft edge of half a pixel
  vec2 x = extent(a_centre.x, w, reach), y = extent(a_centre.y, w, reach);
  vec2 corner = vec2(gl_VertexID & 1, gl_VertexID >> 1);
  vec2 place = u_scale * mix(vec2(x.x, y.x), vec2(x.y, y.y), corner);
  gl_Position = vec4(2.0 * (u_origin + place) / u_size - 1.0, 0.0, 1.0);
}
