#include "render/layers/average_layer.h"

namespace clatter {

AverageLayer::AverageLayer(const Gl& gl)
    : gl_(&gl),
      program_(gl, "field.vert", "average.frag"),
      vertices_(generate<VertexArray>(gl, gl.GenVertexArrays)) {}

void AverageLayer::draw(const Canvas& fine, int samples, bool transparent) const {
  const Size size{fine.size().width / samples, fine.size().height / samples};
  gl_->Viewport(0, 0, size.width, size.height);
  gl_->Disable(GL_BLEND);
  gl_->ActiveTexture(GL_TEXTURE0);
  gl_->BindTexture(GL_TEXTURE_2D, fine.texture());
  program_.use();
  gl_->Uniform2f(program_.uniform("u_size"), size.width, size.height);
  gl_->Uniform2f(program_.uniform("u_low"), 0.0f, 0.0f);
  gl_->Uniform2f(program_.uniform("u_high"), size.width, size.height);
  gl_->Uniform1i(program_.uniform("u_picture"), 0);
  gl_->Uniform1i(program_.uniform("u_samples"), samples);
  gl_->Uniform1i(program_.uniform("u_transparent"), transparent);
  gl_->BindVertexArray(vertices_.id());
  gl_->DrawArrays(GL_TRIANGLE_STRIP, 0, 4);
  gl_->Enable(GL_BLEND);
}

}  // namespace clatter
