#pragma once

#include <string_view>

#include "render/gl/gl_object.h"
#include "render/palette.h"

namespace clatter {

/// A vertex and a fragment shader of shaders/, compiled and linked.
class Program {
 public:
  /// Takes the embedded files by name, e.g. "field.vert"; throws RunError as file:line: message.
  Program(const Gl& gl, std::string_view vertex_file, std::string_view fragment_file);

  /// Makes it the program that draws.
  void use() const { gl_->UseProgram(program_.id()); }
  /// The place of a uniform, to pass to glUniform.
  GLint uniform(const char* name) const { return gl_->GetUniformLocation(program_.id(), name); }

 private:
  const Gl* gl_;
  ShaderProgram program_;
};

/// Sets a vec4 uniform of the program in use.
void set_colour(const Gl& gl, const Program& program, const char* uniform, Colour colour);

/// Compiles `source`; throws RunError in which each message of the driver begins with "file:line:".
Shader compile_shader(const Gl& gl, GLenum stage, std::string_view file, std::string_view source);

}  // namespace clatter
