#pragma once

#include <map>
#include <span>
#include <string>
#include <string_view>

#include "engine/embedded_file.h"
#include "render/gl/gl_object.h"
#include "render/palette.h"

namespace clatter {

/// The files of shaders/.
std::span<const EmbeddedFile> embedded_shaders();

/// A compiled and linked pair of a vertex and a fragment shader of shaders/.
class Program {
 public:
  /// Compiles and links embedded files, by name, e.g. "field.vert". `defines` are the names of
  /// macros for the fragment shader, separated by spaces. Throws RunError with messages
  /// "file:line: ...".
  Program(const Gl& gl, std::string_view vertex_file, std::string_view fragment_file,
          std::string_view defines = {});

  /// Makes this the program of later draw calls.
  void use() const { gl_->UseProgram(program_.id()); }
  /// Location of a uniform, for glUniform.
  GLint uniform(const char* name) const { return gl_->GetUniformLocation(program_.id(), name); }

 private:
  const Gl* gl_;
  ShaderProgram program_;
};

/// Programs of the same files with different macros. Drivers without branches compute all parts of
/// a shader for each pixel, so a macro removes parts that a picture does not need.
class ProgramVariants {
 public:
  /// Files of a Program. Nothing is compiled yet.
  ProgramVariants(const Gl& gl, std::string_view vertex_file, std::string_view fragment_file)
      : gl_(&gl), vertex_file_(vertex_file), fragment_file_(fragment_file) {}

  /// The program with these macros, see Program. The first call compiles it.
  const Program& with(const std::string& defines);

 private:
  const Gl* gl_;
  std::string_view vertex_file_;
  std::string_view fragment_file_;
  std::map<std::string, Program> programs_;  ///< by their macros
};

/// Sets a vec4 uniform of the program, which must be in use.
void set_colour(const Gl& gl, const Program& program, const char* uniform, Colour colour);

/// Compiles `source`. Throws RunError, where each message of the driver begins with "file:line:".
Shader compile_shader(const Gl& gl, GLenum stage, std::string_view file, std::string_view source);

}  // namespace clatter
