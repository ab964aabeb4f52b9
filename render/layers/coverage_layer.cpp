#include "render/layers/coverage_layer.h"

namespace clatter {

CoverageLayer::CoverageLayer(const Gl& gl)
    : gl_(&gl),
      program_(gl, "field.vert", "coverage.frag"),
      vertices_(generate<VertexArray>(gl, gl.GenVertexArrays)),
      light_(generate<Texture>(gl, gl.GenTextures)) {
  gl.BindTexture(GL_TEXTURE_2D, light_.id());
  gl.TexParameteri(GL_TEXTURE_2D, GL_TEXTURE_MIN_FILTER, GL_NEAREST);
}

void CoverageLayer::draw(const Coverage& coverage, const Vec2& box_low,
                         const Vec2& box_high) const {
  const Size extent = coverage.extent();
  const int width = extent.width - 2 * Coverage::kMargin;
  const int height = extent.height - 2 * Coverage::kMargin;
  gl_->ActiveTexture(GL_TEXTURE0);
  gl_->BindTexture(GL_TEXTURE_2D, light_.id());
  gl_->TexImage2D(GL_TEXTURE_2D, 0, GL_RGBA32F, extent.width, extent.height, 0, GL_RGBA, GL_FLOAT,
                  coverage.pixels().data());
  program_.use();
  gl_->Uniform2f(program_.uniform("u_size"), width, height);
  gl_->Uniform2f(program_.uniform("u_low"), 0.0f, 0.0f);
  gl_->Uniform2f(program_.uniform("u_high"), width, height);
  gl_->Uniform2f(program_.uniform("u_box_low"), box_low.x(), box_low.y());
  gl_->Uniform2f(program_.uniform("u_box_high"), box_high.x(), box_high.y());
  gl_->Uniform1i(program_.uniform("u_light"), 0);
  gl_->Uniform1i(program_.uniform("u_margin"), Coverage::kMargin);
  gl_->BindVertexArray(vertices_.id());
  gl_->BlendFuncSeparate(GL_ONE, GL_ONE_MINUS_SRC_ALPHA, GL_ONE, GL_ONE_MINUS_SRC_ALPHA);
  gl_->DrawArrays(GL_TRIANGLE_STRIP, 0, 4);
  gl_->BlendFuncSeparate(GL_SRC_ALPHA, GL_ONE_MINUS_SRC_ALPHA, GL_ONE, GL_ONE_MINUS_SRC_ALPHA);
}

}  // namespace clatter
