#include "render/layers/line_layer.h"

#include <algorithm>
#include <cstddef>
#include <utility>

namespace clatter {

LineLayer::LineLayer(const Gl& gl)
    : gl_(&gl),
      program_(gl, "line.vert", "line.frag"),
      buffer_(generate<Buffer>(gl, gl.GenBuffers)),
      vertices_(generate<VertexArray>(gl, gl.GenVertexArrays)) {
  gl.BindVertexArray(vertices_.id());
  gl.BindBuffer(GL_ARRAY_BUFFER, buffer_.id());
  gl.VertexAttribPointer(0, 3, GL_FLOAT, GL_FALSE, sizeof(Vertex), nullptr);
  gl.VertexAttribPointer(1, 3, GL_FLOAT, GL_FALSE, sizeof(Vertex),
                         reinterpret_cast<const void*>(offsetof(Vertex, across)));
  gl.VertexAttribPointer(2, 4, GL_UNSIGNED_BYTE, GL_TRUE, sizeof(Vertex),
                         reinterpret_cast<const void*>(offsetof(Vertex, colour)));
  for (const GLuint attribute : {0, 1, 2}) gl.EnableVertexAttribArray(attribute);
}

void LineLayer::add(const Line& line, const Eye& eye, double depth_range) {
  constexpr double kNearest = Eye::kNearest;
  Vec3 a = eye.seen(line.from), b = eye.seen(line.to);
  double w_a = eye.w(a), w_b = eye.w(b);
  if (std::max(w_a, w_b) < kNearest) return;
  // The part behind the viewer is cut off.
  if (w_a < kNearest) {
    a += (kNearest - w_a) / (w_b - w_a) * (b - a);
  } else if (w_b < kNearest) {
    b += (kNearest - w_b) / (w_a - w_b) * (a - b);
  }
  w_a = eye.w(a);
  w_b = eye.w(b);
  const Vec2 start = eye.pixels(a), end = eye.pixels(b), way = end - start;
  const double length = way.norm();
  if (!(length > 0.0)) return;
  const double half = 0.5 * line.width, reach = half + 1.0;
  const Vec2 along = way / length, across(-along.y(), along.x());
  const auto corner = [&](bool at_end, double side) {
    const Vec2 place =
        (at_end ? Vec2(end + half * along) : Vec2(start - half * along)) + side * reach * across;
    const double depth = (at_end ? b.z() / w_b : a.z() / w_a) / depth_range;
    return Vertex{static_cast<float>(place.x()),
                  static_cast<float>(place.y()),
                  static_cast<float>(0.5 - 0.5 * depth),
                  static_cast<float>(side * reach),
                  static_cast<float>(at_end ? length : 0.0),
                  static_cast<float>(half),
                  line.colour};
  };
  for (const auto& [at_end, side] : {std::pair(false, -1.0),
                                     {true, -1.0},
                                     {true, 1.0},
                                     {false, -1.0},
                                     {true, 1.0},
                                     {false, 1.0}}) {
    corners_.push_back(corner(at_end, side));
  }
}

void LineLayer::draw(std::span<const Line> lines, const Vec3& box, const Projection& projection,
                     const Eye& eye, double dash) {
  corners_.clear();
  for (const Line& line : lines) add(line, eye, eye.depth_range(box));
  const Size drawn = projection.drawn();
  gl_->BindBuffer(GL_ARRAY_BUFFER, buffer_.id());
  gl_->BufferData(GL_ARRAY_BUFFER, corners_.size() * sizeof(Vertex), corners_.data(),
                  GL_STREAM_DRAW);
  program_.use();
  gl_->Uniform2f(program_.uniform("u_size"), drawn.width, drawn.height);
  gl_->Uniform1f(program_.uniform("u_dash"), dash);
  gl_->BindVertexArray(vertices_.id());
  gl_->DepthMask(GL_FALSE);
  gl_->DrawArrays(GL_TRIANGLES, 0, static_cast<GLsizei>(corners_.size()));
  gl_->DepthMask(GL_TRUE);
}

}  // namespace clatter
