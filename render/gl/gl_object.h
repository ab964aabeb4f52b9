#pragma once

#include <type_traits>
#include <utility>
#include <vector>

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

/// A number that a vertex shader reads, of each vertex or instance, or one for all.
class InstanceNumbers {
 public:
  explicit InstanceNumbers(const Gl& gl) : gl_(&gl), buffer_(generate<Buffer>(gl, gl.GenBuffers)) {}

  /// Makes `numbers` the attribute `index` of the bound vertex array: a single one is the same for
  /// all. `divisor` is 0 for vertices, 1 for instances.
  void set(GLuint index, const std::vector<float>& numbers, GLuint divisor) const {
    if (numbers.size() == 1) {
      gl_->DisableVertexAttribArray(index);
      gl_->VertexAttrib1f(index, numbers.front());
      return;
    }
    gl_->BindBuffer(GL_ARRAY_BUFFER, buffer_.id());
    gl_->BufferData(GL_ARRAY_BUFFER, numbers.size() * sizeof(float), numbers.data(),
                    GL_STREAM_DRAW);
    gl_->VertexAttribPointer(index, 1, GL_FLOAT, GL_FALSE, sizeof(float), nullptr);
    gl_->EnableVertexAttribArray(index);
    gl_->VertexAttribDivisor(index, divisor);
  }

 private:
  const Gl* gl_;
  Buffer buffer_;
};

}  // namespace clatter
