#pragma once

#include <vector>

#include "render/gl/gl_object.h"

namespace clatter {

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
