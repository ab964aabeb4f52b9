#include "render/layers/grid_layer.h"

#include <algorithm>
#include <cmath>

#include "render/colour_range.h"

namespace clatter {

double scale_length(const Projection& projection) {
  const Size size = projection.drawn();
  const double longest = std::min(0.2 * std::min(size.width, size.height), 0.15 * size.width);
  return round_down(longest / projection.scale());
}

GridLayer::GridLayer(const Gl& gl)
    : gl_(&gl),
      program_(gl, "field.vert", "grid.frag"),
      vertices_(generate<VertexArray>(gl, gl.GenVertexArrays)) {}

void GridLayer::draw(const Snapshot& snapshot, const Projection& projection, Colour colour) const {
  const Size size = projection.size, drawn = projection.drawn();
  const Vec2 low = projection.pixels({0.0, 0.0}), high = projection.pixels(snapshot.box);
  const double square = scale_length(projection) * projection.scale();
  program_.use();
  gl_->Uniform2f(program_.uniform("u_size"), drawn.width, drawn.height);
  gl_->Uniform2f(program_.uniform("u_low"), low.x(), low.y());
  gl_->Uniform2f(program_.uniform("u_high"), high.x(), high.y());
  gl_->Uniform1f(program_.uniform("u_square"), square);
  gl_->Uniform1f(
      program_.uniform("u_line"),
      projection.samples * std::max(1.0, std::round(std::min(size.width, size.height) / 720.0)));
  set_colour(*gl_, program_, "u_colour", colour);
  gl_->BindVertexArray(vertices_.id());
  gl_->DrawArrays(GL_TRIANGLE_STRIP, 0, 4);
}

}  // namespace clatter
