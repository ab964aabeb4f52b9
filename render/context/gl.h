#pragma once

#include <functional>

// The prototypes are for decltype only: a call through them does not link.
#define GL_GLEXT_PROTOTYPES
#include <GL/glcorearb.h>

namespace clatter {

/// The functions of OpenGL 3.3 core and OpenGL ES 3.0 that clatter calls.
// clang-format off
#define CLATTER_GL_FUNCTIONS(X)                                                                   \
  X(ActiveTexture) X(AttachShader) X(BindBuffer) X(BindFramebuffer) X(BindTexture)                \
  X(BindVertexArray) X(BlendEquation) X(BlendFuncSeparate) X(BlitFramebuffer) X(BufferData)       \
  X(CheckFramebufferStatus) X(Clear) X(ClearColor) X(CompileShader) X(CreateProgram)              \
  X(CreateShader) X(DeleteBuffers) X(DeleteFramebuffers) X(DeleteProgram) X(DeleteShader)         \
  X(DeleteTextures) X(DeleteVertexArrays) X(DepthFunc) X(DepthMask) X(Disable) \
  X(DisableVertexAttribArray) X(DrawArrays)      \
  X(DrawArraysInstanced) X(DrawElements) X(Enable) X(EnableVertexAttribArray)           \
  X(Finish) X(FramebufferTexture2D) X(GenBuffers) X(GenFramebuffers) X(GenTextures)               \
  X(GenVertexArrays) X(GetFloatv) X(GetIntegerv) X(GetProgramInfoLog) X(GetProgramiv)             \
  X(GetShaderInfoLog) X(GetShaderiv) X(GetString) X(GetUniformLocation) X(LinkProgram)            \
  X(PixelStorei) X(PolygonOffset) X(ReadPixels) X(Scissor) X(ShaderSource) X(TexImage2D)          \
  X(TexImage3D) X(TexParameteri)                                                                  \
  X(Uniform1f) X(Uniform1i) X(Uniform2f) X(Uniform3f) X(Uniform4f) X(UniformMatrix3fv)            \
  X(UseProgram) X(VertexAttrib1f) X(VertexAttribDivisor) X(VertexAttribPointer) X(Viewport)
// clang-format on

/// Language of a context.
enum class Api {
  Desktop,  ///< OpenGL 3.3 core
  Es,       ///< OpenGL ES 3.0, with EXT_color_buffer_float; WebGL 2 is equal
};

/// The OpenGL functions of one context, named as in the specification without "gl".
struct Gl {
  Api api = Api::Desktop;
#define CLATTER_GL_MEMBER(name) decltype(&gl##name) name = nullptr;
  CLATTER_GL_FUNCTIONS(CLATTER_GL_MEMBER)
#undef CLATTER_GL_MEMBER
};

/// Loads every function with `address_of`. Throws RunError with the names of missing functions.
Gl load_gl(const std::function<void*(const char*)>& address_of, Api api = Api::Desktop);

/// Makes later draw calls encode linear light as sRGB, or not. OpenGL ES lacks this switch: draw
/// calls into sRGB framebuffers always encode.
void encode_light(const Gl& gl, bool on);

}  // namespace clatter
