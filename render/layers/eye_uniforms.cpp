#include "render/layers/eye_uniforms.h"

namespace clatter {

void set_vector(const Gl& gl, const Program& program, const char* uniform, const Vec3& vector) {
  gl.Uniform3f(program.uniform(uniform), static_cast<float>(vector.x()),
               static_cast<float>(vector.y()), static_cast<float>(vector.z()));
}

void set_eye(const Gl& gl, const Program& program, const Vec3& box, const Projection& projection,
             const Eye& eye) {
  const Size drawn = projection.drawn();
  const Eigen::Matrix3f axes = eye.axes().cast<float>();
  gl.Uniform2f(program.uniform("u_size"), drawn.width, drawn.height);
  gl.Uniform2f(program.uniform("u_origin"), eye.origin().x(), eye.origin().y());
  gl.Uniform1f(program.uniform("u_scale"), eye.scale());
  gl.Uniform1f(program.uniform("u_inverse_distance"), eye.inverse_distance());
  gl.Uniform1f(program.uniform("u_depth_range"), eye.depth_range(box));
  // Transposed: from the view to the world.
  gl.UniformMatrix3fv(program.uniform("u_axes"), 1, GL_TRUE, axes.data());
  set_vector(gl, program, "u_centre", eye.centre());
}

}  // namespace clatter
