#include "render/layers/field_layer.h"

#include <algorithm>
#include <cmath>

namespace clatter {

FieldLayer::FieldLayer(const Gl& gl)
    : gl_(&gl),
      program_(gl, "field.vert", "field.frag"),
      vertices_(generate<VertexArray>(gl, gl.GenVertexArrays)),
      cells_(generate<Texture>(gl, gl.GenTextures)) {
  gl.BindTexture(GL_TEXTURE_2D, cells_.id());
  gl.TexParameteri(GL_TEXTURE_2D, GL_TEXTURE_MIN_FILTER, GL_NEAREST);
  gl.TexParameteri(GL_TEXTURE_2D, GL_TEXTURE_MAG_FILTER, GL_NEAREST);
  gl.TexParameteri(GL_TEXTURE_2D, GL_TEXTURE_WRAP_S, GL_CLAMP_TO_EDGE);
  gl.TexParameteri(GL_TEXTURE_2D, GL_TEXTURE_WRAP_T, GL_CLAMP_TO_EDGE);
}

void FieldLayer::draw(const FieldMap& map, const Vec2& box, const Projection& projection,
                      const ColourScale& scale, Colour gap) {
  colours_.resize(map.values.size());
  std::transform(map.values.begin(), map.values.end(), colours_.begin(), [&](double value) {
    return std::isnan(value) ? Colour{0, 0, 0, 0} : scale(value);
  });
  gl_->ActiveTexture(GL_TEXTURE0);
  gl_->BindTexture(GL_TEXTURE_2D, cells_.id());
  gl_->TexImage2D(GL_TEXTURE_2D, 0, GL_RGBA8, map.cells[0], map.cells[1], 0, GL_RGBA,
                  GL_UNSIGNED_BYTE, colours_.data());

  const Size size = projection.size, drawn = projection.drawn();
  const Vec2 low = projection.pixels({0.0, 0.0});
  const Vec2 high = projection.pixels(box);
  program_.use();
  gl_->Uniform2f(program_.uniform("u_size"), drawn.width, drawn.height);
  gl_->Uniform2f(program_.uniform("u_low"), low.x(), low.y());
  gl_->Uniform2f(program_.uniform("u_high"), high.x(), high.y());
  gl_->Uniform1i(program_.uniform("u_cells"), 0);
  set_colour(*gl_, program_, "u_gap", gap);
  gl_->Uniform1f(
      program_.uniform("u_period"),
      projection.samples * std::max(5.0, std::round(std::min(size.width, size.height) / 90.0)));
  gl_->BindVertexArray(vertices_.id());
  gl_->DrawArrays(GL_TRIANGLE_STRIP, 0, 4);
}

}  // namespace clatter
