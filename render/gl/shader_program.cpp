#include "render/gl/shader_program.h"

#include <algorithm>
#include <cassert>
#include <regex>
#include <string>

#include "engine/error.h"

namespace clatter {

namespace {

std::string_view embedded_shader(std::string_view file) {
  const auto shaders = embedded_shaders();
  const auto found = std::find_if(shaders.begin(), shaders.end(),
                                  [&](const EmbeddedFile& shader) { return shader.name == file; });
  assert(found != shaders.end());
  return found->bytes;
}

// Messages begin with "0:12(5): " (Mesa), "0(12) : " (NVIDIA) or "ERROR: 0:12: " (others).
std::string name_file_and_line(const std::string& log, std::string_view file) {
  static const std::regex place(R"((^|\n)(?:ERROR: )?\d+[:(](\d+)\)?(?:\(\d+\))?\s*:\s*)");
  return std::regex_replace(log, place, "$1" + std::string(file) + ":$2: ");
}

}  // namespace

const Program& ProgramVariants::with(const std::string& defines) {
  return programs_.try_emplace(defines, *gl_, vertex_file_, fragment_file_, defines).first->second;
}

void set_colour(const Gl& gl, const Program& program, const char* uniform, Colour colour) {
  gl.Uniform4f(program.uniform(uniform), colour.red / 255.0f, colour.green / 255.0f,
               colour.blue / 255.0f, colour.alpha / 255.0f);
}

Shader compile_shader(const Gl& gl, GLenum stage, std::string_view file, std::string_view source) {
  Shader shader(gl, gl.CreateShader(stage));
  const char* text = source.data();
  const GLint length = static_cast<GLint>(source.size());
  gl.ShaderSource(shader.id(), 1, &text, &length);
  gl.CompileShader(shader.id());

  GLint compiled = 0, log_length = 0;
  gl.GetShaderiv(shader.id(), GL_COMPILE_STATUS, &compiled);
  if (compiled) return shader;
  gl.GetShaderiv(shader.id(), GL_INFO_LOG_LENGTH, &log_length);
  std::string log(log_length, '\0');
  gl.GetShaderInfoLog(shader.id(), log_length, &log_length, log.data());
  log.resize(log_length);
  throw RunError(name_file_and_line(log, file));
}

// The source for an API, with macros. Messages of the compiler have the lines of the file.
static std::string whole_source(Api api, std::string_view source, std::string_view defines = {}) {
  std::string text = api == Api::Desktop ? "#version 330 core\n"
                                         : "#version 300 es\n"
                                           "precision highp float;\n"
                                           "precision highp int;\n"
                                           "precision highp sampler2D;\n"
                                           "precision highp sampler3D;\n";
  while (!defines.empty()) {
    const std::string_view name = defines.substr(0, defines.find(' '));
    text += "#define " + std::string(name) + "\n";
    defines.remove_prefix(std::min(defines.size(), name.size() + 1));
  }
  return text + "#line 1\n" + std::string(source);
}

Program::Program(const Gl& gl, std::string_view vertex_file, std::string_view fragment_file,
                 std::string_view defines)
    : gl_(&gl), program_(gl, gl.CreateProgram()) {
  const Shader vertex = compile_shader(gl, GL_VERTEX_SHADER, vertex_file,
                                       whole_source(gl.api, embedded_shader(vertex_file)));
  const Shader fragment =
      compile_shader(gl, GL_FRAGMENT_SHADER, fragment_file,
                     whole_source(gl.api, embedded_shader(fragment_file), defines));
  gl.AttachShader(program_.id(), vertex.id());
  gl.AttachShader(program_.id(), fragment.id());
  gl.LinkProgram(program_.id());

  GLint linked = 0, log_length = 0;
  gl.GetProgramiv(program_.id(), GL_LINK_STATUS, &linked);
  if (linked) return;
  gl.GetProgramiv(program_.id(), GL_INFO_LOG_LENGTH, &log_length);
  std::string log(log_length, '\0');
  gl.GetProgramInfoLog(program_.id(), log_length, &log_length, log.data());
  log.resize(log_length);
  throw RunError(std::string(vertex_file) + " + " + std::string(fragment_file) + ": " + log);
}

}  // namespace clatter
