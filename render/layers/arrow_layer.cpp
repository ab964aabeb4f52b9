#include "render/layers/arrow_layer.h"

#include <algorithm>
#include <cstddef>

namespace clatter {

ArrowShape ArrowShape::in(Size size, int samples) {
  const double shaft = samples * std::max(1.0, 0.0014 * std::min(size.width, size.height));
  return {shaft, 7.0 * shaft, 3.5 * shaft};
}

ArrowLayer::ArrowLayer(const Gl& gl)
    : gl_(&gl),
      program_(gl, "arrow.vert", "arrow.frag"),
      buffer_(generate<Buffer>(gl, gl.GenBuffers)),
      vertices_(generate<VertexArray>(gl, gl.GenVertexArrays)) {
  gl.BindVertexArray(vertices_.id());
  gl.BindBuffer(GL_ARRAY_BUFFER, buffer_.id());
  gl.VertexAttribPointer(0, 2, GL_FLOAT, GL_FALSE, sizeof(Arrow), nullptr);
  gl.VertexAttribPointer(1, 2, GL_FLOAT, GL_FALSE, sizeof(Arrow),
                         reinterpret_cast<const void*>(offsetof(Arrow, tip_x)));
  for (GLuint attribute : {0, 1}) {
    gl.EnableVertexAttribArray(attribute);
    gl.VertexAttribDivisor(attribute, 1);
  }
}

void ArrowLayer::collect(const ArrowMap& map, const Projection& projection, double pixels) {
  constexpr double kShortest = 0.5;  // pixels; shorter arrows show no direction
  const double longest = 2.0 * map.cell.minCoeff() * projection.scale();
  arrows_.clear();
  for (const auto& [place, value] : map.arrows) {
    const double length = pixels * value.norm();
    if (!(length >= kShortest)) continue;
    const Vec2 half = 0.5 * std::min(1.0, longest / length) * pixels * value;
    const Eigen::Vector2f tail = (projection.pixels(place) - half).cast<float>();
    const Eigen::Vector2f tip = (projection.pixels(place) + half).cast<float>();
    arrows_.push_back({tail.x(), tail.y(), tip.x(), tip.y()});
  }
}

void ArrowLayer::draw(const ArrowMap& map, const Projection& projection, double pixels,
                      Colour colour, Colour rim) {
  collect(map, projection, pixels);
  gl_->BindBuffer(GL_ARRAY_BUFFER, buffer_.id());
  gl_->BufferData(GL_ARRAY_BUFFER, arrows_.size() * sizeof(Arrow), arrows_.data(), GL_STREAM_DRAW);

  const ArrowShape shape = ArrowShape::in(projection.size, projection.samples);
  const Size drawn = projection.drawn();
  const double rim_width = shape.shaft;
  program_.use();
  gl_->Uniform2f(program_.uniform("u_size"), drawn.width, drawn.height);
  gl_->Uniform1f(program_.uniform("u_margin"), shape.head_width + rim_width + 1.0);
  gl_->Uniform1f(program_.uniform("u_shaft"), shape.shaft);
  gl_->Uniform2f(program_.uniform("u_head"), shape.head_length, shape.head_width);
  gl_->Uniform1f(program_.uniform("u_rim"), rim_width);
  set_colour(*gl_, program_, "u_colour", colour);
  set_colour(*gl_, program_, "u_rim_colour", rim);
  gl_->BindVertexArray(vertices_.id());
  gl_->DrawArraysInstanced(GL_TRIANGLE_STRIP, 0, 4, static_cast<GLsizei>(arrows_.size()));
}

}  // namespace clatter
