#include "render/gl/light_copy.h"

namespace clatter {

LightCopy::LightCopy(const Gl& gl)
    : gl_(&gl),
      program_(gl, "field.vert", "light_copy.frag"),
      vertices_(generate<VertexArray>(gl, gl.GenVertexArrays)) {}

void LightCopy::blend_in_light(Canvas& canvas, bool on) const {
  const Size size = canvas.size();
  canvas.choose_light(on);
  canvas.bind_colours();
  gl_->Viewport(0, 0, size.width, size.height);
  gl_->Disable(GL_BLEND);
  gl_->ActiveTexture(GL_TEXTURE0);
  gl_->BindTexture(GL_TEXTURE_2D, on ? canvas.texture() : canvas.light_texture());
  program_.use();
  gl_->Uniform2f(program_.uniform("u_size"), size.width, size.height);
  gl_->Uniform2f(program_.uniform("u_low"), 0.0f, 0.0f);
  gl_->Uniform2f(program_.uniform("u_high"), size.width, size.height);
  gl_->Uniform1i(program_.uniform("u_picture"), 0);
  gl_->Uniform1i(program_.uniform("u_to_light"), on);
  gl_->BindVertexArray(vertices_.id());
  gl_->DrawArrays(GL_TRIANGLE_STRIP, 0, 4);
  gl_->Enable(GL_BLEND);
  canvas.bind();
}

}  // namespace clatter
