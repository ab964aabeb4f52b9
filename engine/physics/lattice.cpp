#include "engine/physics/lattice.h"

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <limits>

namespace clatter {
namespace {

constexpr double kNever = std::numeric_limits<double>::infinity();

/// A grid of points over the room. A rectangular lattice takes them all. A triangular one takes
/// every second, like the black fields of a chess board: stretched one way or the other, the board
/// has its close-packed rows along x or along y.
struct Grid {
  bool chess = false;
  std::array<std::int64_t, 2> points = {0, 0};  ///< along x, y
};

/// Where centres may lie along an axis: all of a periodic axis, or what the walls leave.
double span(const Room& room, int axis) {
  return room.box[axis] - (room.periodic[axis] ? 0.0 : room.diameter);
}

/// Spacing of n points spread evenly along an axis; a single one between walls has no neighbour.
double spacing(const Room& room, int axis, std::int64_t n) {
  const std::int64_t gaps = room.periodic[axis] ? n : n - 1;
  return gaps > 0 ? span(room, axis) / static_cast<double>(gaps) : kNever;
}

/// Least distance between two sites of the grid.
double least_distance(const Room& room, const Grid& grid) {
  const double dx = spacing(room, 0, grid.points[0]);
  const double dy = spacing(room, 1, grid.points[1]);
  if (!grid.chess) return std::min(dx, dy);
  // Along a row the next site is two points on; between walls that takes three points.
  const auto two_on = [&](int axis, double step) {
    return room.periodic[axis] || grid.points[axis] > 2 ? 2.0 * step : kNever;
  };
  return std::min({two_on(0, dx), two_on(1, dy), Vec2(dx, dy).norm()});
}

/// The distance that sites must keep so that their rounded coordinates do not overlap: a coordinate
/// is off by at most 2 epsilon of the box, and the minimal image of a difference by another one.
/// So a lattice whose particles would touch exactly does not count as fitting.
double reach(const Room& room) {
  return room.diameter + 16.0 * std::numeric_limits<double>::epsilon() * room.box.maxCoeff();
}

bool fits(const Room& room, const Grid& grid) {
  return room.box.minCoeff() >= room.diameter && least_distance(room, grid) >= reach(room);
}

std::int64_t site_count(const Grid& grid) {
  const std::int64_t points = grid.points[0] * grid.points[1];
  return grid.chess ? (points + 1) / 2 : points;
}

/// Points along an axis come in multiples of this: around a periodic axis a chess board closes only
/// with an even number of fields.
std::int64_t multiple(const Room& room, int axis, bool chess) {
  return chess && room.periodic[axis] ? 2 : 1;
}

/// A multiple that no grid exceeds whose points along the axis keep this spacing.
std::int64_t bound_on_points(const Room& room, int axis, bool chess, double spacing) {
  constexpr double kMax = 1LL << 32;  // more than any count of particles
  const auto points = static_cast<std::int64_t>(std::min(span(room, axis) / spacing, kMax)) + 2;
  return points - points % multiple(room, axis, chess);
}

/// Searches run along the axis that holds fewer points.
int short_axis(const Room& room) {
  return room.box.x() <= room.box.y() ? 0 : 1;
}

/// A multiple that the points along the short axis of a grid that fits do not exceed.
std::int64_t bound_along(const Room& room, bool chess) {
  return bound_on_points(room, short_axis(room), chess, room.diameter * (chess ? 0.5 : 1.0));
}

/// The lattice that square_lattice and hexagonal_lattice look for; no points where there is none.
Grid widest_grid(const Room& room, bool chess, int count) {
  const int along = short_axis(room);
  const int across = 1 - along;
  const std::int64_t needed = chess ? 2LL * count - 1 : count;  // points, taken or not
  const std::int64_t most = bound_along(room, chess);
  const std::int64_t unit = multiple(room, across, chess);
  const std::int64_t first = multiple(room, along, chess);
  Grid widest;
  double distance = 0.0;
  for (std::int64_t n = first; n <= std::min(most, needed + 1); n += first) {
    Grid grid{.chess = chess};
    grid.points[along] = n;
    grid.points[across] = (needed + n * unit - 1) / (n * unit) * unit;
    if (!fits(room, grid) || least_distance(room, grid) <= distance) continue;
    distance = least_distance(room, grid);
    widest = grid;
  }
  return widest;
}

/// The most sites of a grid with n points along the short axis; 0 where none fits.
std::int64_t most_sites(const Room& room, bool chess, std::int64_t n) {
  const int along = short_axis(room);
  const int across = 1 - along;
  const std::int64_t unit = multiple(room, across, chess);
  Grid grid{.chess = chess};
  grid.points[along] = n;
  grid.points[across] = unit;
  if (!fits(room, grid)) return 0;
  const double least = reach(room);
  const double step = spacing(room, along, n);
  const double diagonal = step < least ? std::sqrt(least * least - step * step) : 0.0;
  grid.points[across] =
      bound_on_points(room, across, chess, chess ? std::max(0.5 * least, diagonal) : least);
  while (!fits(room, grid)) grid.points[across] -= unit;  // the bound is at most a few too high
  return site_count(grid);
}

int capacity(const Room& room, bool chess) {
  constexpr std::int64_t kMax = std::numeric_limits<int>::max();
  const int along = short_axis(room);
  const std::int64_t last = bound_along(room, chess);
  const std::int64_t first = multiple(room, along, chess);
  std::int64_t most = 0;
  for (std::int64_t n = first; n <= last && most < kMax; n += first) {
    most = std::max(most, most_sites(room, chess, n));
  }
  return static_cast<int>(std::min(most, kMax));
}

/// Coordinate of the i-th of n points along an axis.
double coordinate(const Room& room, int axis, std::int64_t i, std::int64_t n) {
  const double step = spacing(room, axis, n);
  if (room.periodic[axis]) return (static_cast<double>(i) + 0.5) * step;
  if (n == 1) return 0.5 * room.box[axis];
  const double radius = 0.5 * room.diameter;
  return std::min(radius + static_cast<double>(i) * step, room.box[axis] - radius);
}

std::vector<Vec2> widest_lattice(const Room& room, bool chess, int count) {
  std::vector<Vec2> sites;
  if (count <= 0) return sites;
  const Grid grid = widest_grid(room, chess, count);
  const auto [columns, rows] = grid.points;
  sites.reserve(static_cast<std::size_t>(site_count(grid)));
  for (std::int64_t row = 0; row < rows; ++row) {
    const double y = coordinate(room, 1, row, rows);
    for (std::int64_t column = chess ? row % 2 : 0; column < columns; column += chess ? 2 : 1) {
      sites.emplace_back(coordinate(room, 0, column, columns), y);
    }
  }
  return sites;
}

}  // namespace

std::vector<Vec2> square_lattice(const Room& room, int count) {
  return widest_lattice(room, false, count);
}

std::vector<Vec2> hexagonal_lattice(const Room& room, int count) {
  return widest_lattice(room, true, count);
}

int lattice_capacity(const Room& room) {
  return std::max(capacity(room, false), capacity(room, true));
}

}  // namespace clatter
