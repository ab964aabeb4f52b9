#include "render/layers/average_layer.h"

#include <algorithm>

namespace clatter {

AverageLayer::AverageLayer(const Gl& gl)
    : gl_(&gl),
      program_(gl, "field.vert", "average.frag"),
      vertices_(generate<VertexArray>(gl, gl.GenVertexArrays)) {}

void AverageLayer::draw(const Canvas& fine, int samples, bool transparent,
                        const StopRequest& stop) const {
  draw_pass(fine, {samples, transparent, false, false, 1.0}, stop);
}

void AverageLayer::add(const Canvas& fine, int samples, bool transparent, double weight,
                       const StopRequest& stop) const {
  gl_->BlendFuncSeparate(GL_ONE, GL_ONE, GL_ONE, GL_ONE);
  draw_pass(fine, {samples, transparent, false, true, weight}, stop);
  gl_->BlendFuncSeparate(GL_SRC_ALPHA, GL_ONE_MINUS_SRC_ALPHA, GL_ONE, GL_ONE_MINUS_SRC_ALPHA);
}

void AverageLayer::draw_sum(const Canvas& sum, bool transparent, const StopRequest& stop) const {
  draw_pass(sum, {1, transparent, true, false, 1.0}, stop);
}

// Sums are blended; other pictures are replaced.
void AverageLayer::draw_pass(const Canvas& picture, const Pass& pass,
                             const StopRequest& stop) const {
  constexpr int kSamplesAtOnce = 1 << 24;
  const int samples = pass.samples;
  const Size size{picture.size().width / samples, picture.size().height / samples};
  gl_->Viewport(0, 0, size.width, size.height);
  if (!pass.light_out) gl_->Disable(GL_BLEND);
  gl_->ActiveTexture(GL_TEXTURE0);
  gl_->BindTexture(GL_TEXTURE_2D, picture.texture());
  program_.use();
  gl_->Uniform2f(program_.uniform("u_size"), size.width, size.height);
  gl_->Uniform1i(program_.uniform("u_picture"), 0);
  gl_->Uniform1i(program_.uniform("u_samples"), samples);
  gl_->Uniform1i(program_.uniform("u_transparent"), pass.transparent);
  gl_->Uniform1i(program_.uniform("u_light_in"), pass.light_in);
  gl_->Uniform1i(program_.uniform("u_light_out"), pass.light_out);
  gl_->Uniform1f(program_.uniform("u_weight"), pass.weight);
  gl_->BindVertexArray(vertices_.id());
  const int rows = std::max(1, kSamplesAtOnce / (picture.size().width * samples));
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
