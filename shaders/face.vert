// A rectangle in space: a side of the box, or a slice.

layout(location = 0) in vec3 a_position;  // view coordinates, see render/eye.h
layout(location = 1) in vec2 a_place;     // position in the rectangle

uniform vec2 u_size;               // size of the picture, pixels
uniform vec2 u_origin;             // pixel of the centre of the view
uniform float u_scale;             // pixels per world unit, at the centre
uniform float u_inverse_distance;  // of the viewer from the centre
uniform float u_depth_range;       // largest |z/w|

out vec2 v_place;

void main() {
  v_place = a_place;
  float w = 1.0 - a_position.z * u_inverse_distance;
  vec2 pixels = u_origin * w + u_scale * a_position.xy;
  // Cuts of spheres in the same plane are in front of it.
  float depth = 1e-5 * w - a_position.z / u_depth_range;
  gl_Position = vec4(2.0 * pixels / u_size - w, depth, w);
}
