#include "render/layers/strokes.h"

#include <cstddef>

namespace clatter {

Strokes::Strokes(const Gl& gl)
    : gl_(&gl),
      buffer_(generate<Buffer>(gl, gl.GenBuffers)),
      widths_(gl),
      vertices_(generate<VertexArray>(gl, gl.GenVertexArrays)) {
  gl.BindBuffer(GL_ARRAY_BUFFER, buffer_.id());
  gl.BindVertexArray(vertices_.id());
  for (GLuint pair : {0, 1, 2}) {
    gl.VertexAttribPointer(pair, 2, GL_FLOAT, GL_FALSE, sizeof(Stroke),
                           reinterpret_cast<const void*>(pair * sizeof(Eigen::Vector2f)));
  }
  gl.VertexAttribPointer(3, 4, GL_UNSIGNED_SHORT, GL_TRUE, sizeof(Stroke),
                         reinterpret_cast<const void*>(offsetof(Stroke, light)));
  for (GLuint attribute : {0, 1, 2, 3}) {
    gl.EnableVertexAttribArray(attribute);
    gl.VertexAttribDivisor(attribute, 1);
  }
}

void Strokes::draw(const std::vector<Stroke>& strokes, const std::vector<float>& widths) {
  gl_->BindBuffer(GL_ARRAY_BUFFER, buffer_.id());
  gl_->BufferData(GL_ARRAY_BUFFER, strokes.size() * sizeof(Stroke), strokes.data(), GL_STREAM_DRAW);
  gl_->BindVertexArray(vertices_.id());
  widths_.set(4, widths, 1);
  gl_->DrawArraysInstanced(GL_TRIANGLE_STRIP, 0, 4, static_cast<GLsizei>(strokes.size()));
}

}  // namespace clatter
