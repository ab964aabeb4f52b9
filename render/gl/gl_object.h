#pragma once

#include <type_traits>
#include <utility>

#include "render/context/gl.h"

namespace clatter {

/// Owner of an OpenGL object. `kDelete` is the member of Gl that deletes objects of its type.
template <auto kDelete>
class GlObject {
 public:
  /// Takes ownership of the object `id` in the context of `gl`.
  GlObject(const Gl& gl, GLuint id) : gl_(&gl), id_(id) {}
  GlObject(GlObject&& other) noexcept : gl_(other.gl_), id_(std::exchange(other.id_, 0)) {}
  GlObject& operator=(GlObject&& other) noexcept {
    std::swap(gl_, other.gl_);
    std::swap(id_, other.id_);
    return *this;
  }
  ~GlObject() {
    if (!id_) return;
    if constexpr (std::is_invocable_v<decltype(gl_->*kDelete), GLuint>) {
      (gl_->*kDelete)(id_);
    } else {
      (gl_->*kDelete)(1, &id_);
    }
  }

  /// OpenGL name of the object.
  GLuint id() const { return id_; }

 private:
  const Gl* gl_;
  GLuint id_;
};

using Buffer = GlObject<&Gl::DeleteBuffers>;
using Framebuffer = GlObject<&Gl::DeleteFramebuffers>;
using Shader = GlObject<&Gl::DeleteShader>;
using ShaderProgram = GlObject<&Gl::DeleteProgram>;
using Texture = GlObject<&Gl::DeleteTextures>;
using VertexArray = GlObject<&Gl::DeleteVertexArrays>;

/// Creates an object with a glGen function, e.g. `generate<Buffer>(gl, gl.GenBuffers)`.
template <class Object, class Generate>
Object generate(const Gl& gl, Generate function) {
  GLuint id = 0;
  function(1, &id);
  return Object(gl, id);
}

}  // namespace clatter
