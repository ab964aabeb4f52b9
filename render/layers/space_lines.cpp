#include "render/layers/space_lines.h"

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>

namespace clatter {

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
