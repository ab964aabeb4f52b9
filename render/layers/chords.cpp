#include "render/layers/chords.h"

#include <algorithm>
#include <cmath>
#include <cstddef>

namespace clatter {

namespace {

// A chord in world coordinates.
struct Way {
  Vec2 start, end;

  Vec2 low() const { return start.cwiseMin(end); }
  Vec2 high() const { return start.cwiseMax(end); }
};

// Calls `visit` with each number of box lengths along an axis for which a disk of this radius
// touches the box or a copy on its way. The way must not be longer than the box.
template <class Visit>
void visit_shifts(const Snapshot& snapshot, const Tiling& tiling, int axis, const Way& way,
                  double radius, Visit visit) {
  if (snapshot.walls[2 * axis]) return visit(0.0);
  const double box = snapshot.box[axis];
  const double low = tiling.low(snapshot.box)[axis], high = tiling.high(snapshot.box)[axis];
  const double first = std::floor((low - way.high()[axis] - radius) / box) + 1.0;
  const double last = std::min(first + tiling.last[axis] - tiling.first[axis] + 2.0,
                               std::ceil((high - way.low()[axis] + radius) / box) - 1.0);
  for (double boxes = first; boxes <= last; ++boxes) visit(boxes);
}

class Collector {
 public:
  Collector(const Snapshot& snapshot, const Projection& projection, const Tiling& tiling)
      : snapshot_(snapshot), projection_(projection), tiling_(tiling) {}

  std::vector<Chord> chords;

  // The deviation of a chord from its parabola is at most a dt^2 / 8. A chord is no longer than a
  // box. The number of chords is limited, because a flight over thousands of boxes is a blur.
  void add(const FlightPiece& piece, double from, double to) {
    constexpr double kOff = 1.0 / 16.0;  // pixels
    const double curvature = piece.acceleration.norm() * projection_.scale();
    constexpr double kMax = 4096.0;
    const double bends = (to - from) * std::sqrt(curvature / (8.0 * kOff));
    const Vec2 way = piece.at(to) - piece.at(from);
    // Images above and below are carried along in a sheared box.
    const double images = 1.0 + std::max(-tiling_.first[1], tiling_.last[1]);
    const double carried = images * std::fabs(snapshot_.slide) * (to - from) / snapshot_.box[0];
    const double boxes = (way.array() / snapshot_.box.array()).abs().maxCoeff() + carried;
    const double count = std::floor(std::min(std::max(bends, boxes), kMax)) + 1.0;
    const double step = (to - from) / count;
    for (double k = 0.0; k < count; ++k) {
      const double start = from + k * step, end = k + 1.0 < count ? start + step : to;
      add(piece.particle, {piece.at(start), piece.at(end)}, start, end);
    }
  }

 private:
  void add(std::uint32_t disk, const Way& way, double from, double to) {
    const double radius = snapshot_.radius(disk);
    const auto show = [&](const Way& at, double across, double above) {
      const Vec2 shift(across * snapshot_.box[0], above * snapshot_.box[1]);
      const Chord chord{disk, projection_.pixels(at.start + shift),
                        projection_.pixels(at.end + shift), from, to};
      if (in_sight(chord)) chords.push_back(chord);
    };
    if (snapshot_.slide == 0.0 && snapshot_.offset == 0.0) {
      visit_shifts(snapshot_, tiling_, 0, way, radius, [&](double across) {
        visit_shifts(snapshot_, tiling_, 1, way, radius,
                     [&](double above) { show(way, across, above); });
      });
      return;
    }
    visit_shifts(snapshot_, tiling_, 1, way, radius, [&](double above) {
      Way slid = way;
      slid.start.x() += above * (snapshot_.offset + snapshot_.slide * from);
      slid.end.x() += above * (snapshot_.offset + snapshot_.slide * to);
      visit_shifts(snapshot_, tiling_, 0, slid, radius,
                   [&](double across) { show(slid, across, above); });
    });
  }

  // The soft edge of a disk extends half a pixel beyond its radius.
  bool in_sight(const Chord& chord) const {
    const double reach = snapshot_.radius(chord.disk) * projection_.scale() + 0.5;
    const Size size = projection_.drawn();
    const Vec2 low = chord.start.cwiseMin(chord.end), high = chord.start.cwiseMax(chord.end);
    return (high.array() > -reach).all() && low.x() < size.width + reach &&
           low.y() < size.height + reach;
  }

  const Snapshot& snapshot_;
  const Projection& projection_;
  const Tiling& tiling_;
};

}  // namespace

std::vector<Chord> chords(const Snapshot& snapshot, const std::vector<FlightPiece>& flights,
                          const Projection& projection, double time, const Tiling& tiling) {
  Collector collector(snapshot, projection, tiling);
  for (const FlightPiece& piece : flights) {
    const double from = std::max(piece.from, -time);
    if (from < piece.to) collector.add(piece, from, piece.to);
  }
  return std::move(collector.chords);
}

Strokes::Strokes(const Gl& gl)
    : gl_(&gl),
      buffer_(generate<Buffer>(gl, gl.GenBuffers)),
      widths_(gl),
      vertices_(generate<VertexArray>(gl, gl.GenVertexArrays)) {
  gl.BindBuffer(GL_ARRAY_BUFFER, buffer_.id());
  gl.BindVertexArray(vertices_.id());
  for (GLuint pair : {0, 1, 2}) {
    gl.VertexAttribPointer(pair, 2, GL_FLOAT, GL_FALSE, sizeof(Stroke),
                           reinterpret_cast<const void*>(pair * sizeof(Eigen::Vector2f)));
  }
  gl.VertexAttribPointer(3, 4, GL_UNSIGNED_SHORT, GL_TRUE, sizeof(Stroke),
                         reinterpret_cast<const void*>(offsetof(Stroke, light)));
  for (GLuint attribute : {0, 1, 2, 3}) {
    gl.EnableVertexAttribArray(attribute);
    gl.VertexAttribDivisor(attribute, 1);
  }
}

void Strokes::draw(const std::vector<Stroke>& strokes, const std::vector<float>& widths) {
  gl_->BindBuffer(GL_ARRAY_BUFFER, buffer_.id());
  gl_->BufferData(GL_ARRAY_BUFFER, strokes.size() * sizeof(Stroke), strokes.data(), GL_STREAM_DRAW);
  gl_->BindVertexArray(vertices_.id());
  widths_.set(4, widths, 1);
  gl_->DrawArraysInstanced(GL_TRIANGLE_STRIP, 0, 4, static_cast<GLsizei>(strokes.size()));
}

}  // namespace clatter
