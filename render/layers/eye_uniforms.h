#pragma once

#include "render/eye.h"
#include "render/gl/shader_program.h"

namespace clatter {

/// Sets a vec3 uniform of the program, which must be in use.
void set_vector(const Gl& gl, const Program& program, const char* uniform, const Vec3& vector);

/// Sets the uniforms of the program, which must be in use, that describe the view of a box: u_size,
/// u_origin, u_scale, u_inverse_distance, u_depth_range, u_axes and u_centre. OpenGL ignores
/// those that the program lacks.
void set_eye(const Gl& gl, const Program& program, const Vec3& box, const Projection& projection,
             const Eye& eye);

}  // namespace clatter
