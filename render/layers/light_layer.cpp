#include "render/layers/light_layer.h"

namespace clatter {

LightLayer::LightLayer(const Gl& gl)
    : gl_(&gl),
      programs_(gl, "field.vert", "light.frag"),
      vertices_(generate<VertexArray>(gl, gl.GenVertexArrays)),
      areas_(generate<Texture>(gl, gl.GenTextures)) {
  gl.BindTexture(GL_TEXTURE_2D, areas_.id());
  gl.TexParameteri(GL_TEXTURE_2D, GL_TEXTURE_MIN_FILTER, GL_NEAREST);
  gl.TexParameteri(GL_TEXTURE_2D, GL_TEXTURE_MAG_FILTER, GL_NEAREST);
}

void LightLayer::begin(Size size, GLenum equation) {
  gl_->GetIntegerv(GL_DRAW_FRAMEBUFFER_BINDING, &target_);
  if (!collected_ || collected_->size().width != size.width ||
      collected_->size().height != size.height) {
    collected_.emplace(*gl_, size, GL_RGBA16F);
  }
  collected_->bind();
  gl_->Viewport(0, 0, size.width, size.height);
  gl_->ClearColor(0.0f, 0.0f, 0.0f, 0.0f);
  gl_->Clear(GL_COLOR_BUFFER_BIT);
  gl_->BlendEquation(equation);
  gl_->BlendFuncSeparate(GL_ONE, GL_ONE, GL_ONE, GL_ONE);
}

void LightLayer::end(const Projection& projection, const Faces& faces, float faintness,
                     Blending blending) {
  gl_->BlendEquation(GL_FUNC_ADD);
  gl_->BindFramebuffer(GL_FRAMEBUFFER, static_cast<GLuint>(target_));
  draw(collected_->texture(), 0, projection, faces, faintness, blending);
}

void LightLayer::draw(const Coverage& coverage, const Projection& projection, const Faces& faces,
                      float faintness, Blending blending) {
  const Size extent = coverage.extent();
  gl_->ActiveTexture(GL_TEXTURE0);
  gl_->BindTexture(GL_TEXTURE_2D, areas_.id());
  gl_->TexImage2D(GL_TEXTURE_2D, 0, GL_RGBA32F, extent.width, extent.height, 0, GL_RGBA, GL_FLOAT,
                  coverage.pixels().data());
  draw(areas_.id(), Coverage::kMargin, projection, faces, faintness, blending);
}

void LightLayer::draw(GLuint light, int margin, const Projection& projection, const Faces& faces,
                      float faintness, Blending blending) {
  const Size size = projection.drawn();
  const Vec2 low = projection.pixels(faces.low), high = projection.pixels(faces.high);
  gl_->Viewport(0, 0, size.width, size.height);
  gl_->ActiveTexture(GL_TEXTURE0);
  gl_->BindTexture(GL_TEXTURE_2D, light);
  const Program& program = programs_.with(blending == Blending::Encoded ? "ENCODED" : "");
  program.use();
  gl_->Uniform2f(program.uniform("u_size"), size.width, size.height);
  gl_->Uniform2f(program.uniform("u_low"), 0.0f, 0.0f);
  gl_->Uniform2f(program.uniform("u_high"), size.width, size.height);
  gl_->Uniform2f(program.uniform("u_box_low"), low.x(), low.y());
  gl_->Uniform2f(program.uniform("u_box_high"), high.x(), high.y());
  gl_->Uniform1f(program.uniform("u_faintness"), faintness);
  gl_->Uniform1i(program.uniform("u_light"), 0);
  gl_->Uniform1i(program.uniform("u_margin"), margin);
  gl_->BindVertexArray(vertices_.id());
  gl_->BlendFuncSeparate(GL_ONE, GL_ONE_MINUS_SRC_ALPHA, GL_ONE, GL_ONE_MINUS_SRC_ALPHA);
  encode_light(*gl_, blending == Blending::Light);
  gl_->DrawArrays(GL_TRIANGLE_STRIP, 0, 4);
  encode_light(*gl_, false);
  gl_->BlendFuncSeparate(GL_SRC_ALPHA, GL_ONE_MINUS_SRC_ALPHA, GL_ONE, GL_ONE_MINUS_SRC_ALPHA);
}

}  // namespace clatter
