#include "render/layers/line_layer.h"

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>
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

std::vector<Line> trail_lines(const Snapshot& snapshot, const std::vector<FlightPiece>& flights,
                              const DiskColours& colours, double time, double width) {
  std::vector<Line> lines;
  constexpr double kMaxParts = 256.0;  // of a flight
  for (const FlightPiece& piece : flights) {
    const double from = std::max(piece.from, -time);
    if (from >= piece.to) continue;
    // Parts of at most a diameter, so that those beyond a periodic border move to the other end.
    const double way =
        (piece.at(piece.to) - piece.at(from)).norm() / (2.0 * snapshot.radius(piece.particle));
    const double parts = std::min(std::floor(way) + 1.0, kMaxParts);
    Colour colour = colours.of(snapshot, piece.particle);
    for (double k = 0.0; k < parts; ++k) {
      const double begin = from + k / parts * (piece.to - from);
      const double end = from + (k + 1.0) / parts * (piece.to - from);
      Vec3 start = piece.at(begin), stop = piece.at(end);
      for (int axis = 0; axis < 3; ++axis) {
        if (snapshot.walls[2 * axis]) continue;
        const double middle = 0.5 * (start[axis] + stop[axis]);
        const double shift = -std::floor(middle / snapshot.box[axis]) * snapshot.box[axis];
        start[axis] += shift;
        stop[axis] += shift;
      }
      colour.alpha =
          static_cast<std::uint8_t>(std::lround(200.0 * (1.0 + 0.5 * (begin + end) / time)));
      lines.push_back({start, stop, width, colour});
    }
  }
  return lines;
}

std::vector<Line> arrow_lines(const ArrowMap& map, const Eye& eye, double scale, double width,
                              Colour colour) {
  std::vector<Line> lines;
  constexpr double kHead = 0.3;  // of the length
  const double longest = 2.0 * map.cell.minCoeff();
  const Vec3 towards = eye.axes().row(2);
  for (const auto& [place, value] : map.arrows) {
    const double size = value.norm();
    if (!(size > 0.0)) continue;
    const double length = std::min(scale * size, longest);
    const Vec3 direction = value / size;
    const Vec3 tail = Vec3(place) - 0.5 * length * direction, tip = tail + length * direction;
    lines.push_back({tail, tip, width, colour});
    // The head lies in the plane that faces the viewer most.
    const Vec3 across = direction.cross(towards);
    if (!(across.norm() > 0.0)) continue;
    for (const double side : {-1.0, 1.0}) {
      const Vec3 barb = tip - kHead * length * (direction + 0.5 * side * across.normalized());
      lines.push_back({tip, barb, width, colour});
    }
  }
  return lines;
}

}  // namespace clatter
