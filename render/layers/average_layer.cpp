#include "render/layers/average_layer.h"

#include <algorithm>

namespace clatter {

AverageLayer::AverageLayer(const Gl& gl)
    : gl_(&gl),
      program_(gl, "field.vert", "average.frag"),
      vertices_(generate<VertexArray>(gl, gl.GenVertexArrays)) {}

void AverageLayer::draw(const Canvas& fine, int samples, bool transparent,
                        const StopRequest& stop) const {
  constexpr int kSamplesAtOnce = 1 << 24;
  const Size size{fine.size().width / samples, fine.size().height / samples};
  gl_->Viewport(0, 0, size.width, size.height);
  gl_->Disable(GL_BLEND);
  gl_->ActiveTexture(GL_TEXTURE0);
  gl_->BindTexture(GL_TEXTURE_2D, fine.texture());
  program_.use();
  gl_->Uniform2f(program_.uniform("u_size"), size.width, size.height);
  gl_->Uniform1i(program_.uniform("u_picture"), 0);
  gl_->Uniform1i(program_.uniform("u_samples"), samples);
  gl_->Uniform1i(program_.uniform("u_transparent"), transparent);
  gl_->BindVertexArray(vertices_.id());
  const int rows = std::max(1, kSamplesAtOnce / (fine.size().width * samples));
  for (int row = 0; row < size.height; row += rows) {
    gl_->Uniform2f(program_.uniform("u_low"), 0.0f, row);
    gl_->Uniform2f(program_.uniform("u_high"), size.width, std::min(row + rows, size.height));
    gl_->DrawArrays(GL_TRIANGLE_STRIP, 0, 4);
    if (rows >= size.height) continue;
    // OpenGL would otherwise draw all rows later, at once.
    gl_->Finish();
    stop.check();
  }
  gl_->Enable(GL_BLEND);
}

}  // namespace clatter
