#include "engine/physics/lattice.h"

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <limits>
#include <numeric>

namespace clatter {
namespace {

constexpr double kUnlimited = std::numeric_limits<double>::infinity();

/// A grid of points over the room. A primitive lattice has a site at every point. A face-centred
/// lattice has sites at the points whose indices have an even sum, like the black squares of a
/// chess board. In 2D the stretched board is a triangular lattice with close-packed rows along x or
/// y; in 3D it is the fcc lattice.
template <int D>
struct Grid {
  bool centred = false;
  std::array<std::int64_t, D> points{};  ///< along each axis
};

/// Length available to centres along an axis: all of a periodic axis, or the part between the
/// walls.
template <int D>
double span(const Room<D>& room, int axis) {
  return room.box[axis] - (room.walled[axis] ? room.diameter : 0.0);
}

/// Spacing of n evenly spread points along an axis; unlimited for a single point between walls.
template <int D>
double spacing(const Room<D>& room, int axis, std::int64_t n) {
  const std::int64_t gaps = room.walled[axis] ? n - 1 : n;
  return gaps > 0 ? span(room, axis) / static_cast<double>(gaps) : kUnlimited;
}

/// Distance of neighbouring sites in a row along an axis of n points. In a face-centred lattice the
/// next site is two points away; between walls this needs three points.
template <int D>
double distance_in_row(const Room<D>& room, bool centred, int axis, std::int64_t n) {
  if (!centred) return spacing(room, axis, n);
  return !room.walled[axis] || n > 2 ? 2.0 * spacing(room, axis, n) : kUnlimited;
}

/// Least distance between two sites of the grid.
template <int D>
double least_distance(const Room<D>& room, const Grid<D>& grid) {
  double least = kUnlimited;
  for (int k = 0; k < D; ++k) {
    least = std::min(least, distance_in_row(room, grid.centred, k, grid.points[k]));
    for (int l = 0; grid.centred && l < k; ++l) {
      const Vec2 diagonal(spacing(room, l, grid.points[l]), spacing(room, k, grid.points[k]));
      least = std::min(least, diagonal.norm());
    }
  }
  return least;
}

/// The distance that sites must keep so that their rounded coordinates do not overlap: a coordinate
/// is off by at most 2 epsilon of the box, and the minimal image of a difference by another one. So
/// a lattice with exactly touching particles does not fit.
template <int D>
double reach(const Room<D>& room) {
  return room.diameter + 16.0 * std::numeric_limits<double>::epsilon() * room.box.maxCoeff();
}

template <int D>
bool fits(const Room<D>& room, const Grid<D>& grid) {
  return room.box.minCoeff() >= room.diameter && least_distance(room, grid) >= reach(room);
}

template <int D>
std::int64_t site_count(const Grid<D>& grid) {
  std::int64_t points = 1;
  for (const std::int64_t along : grid.points) points *= along;
  return grid.centred ? (points + 1) / 2 : points;
}

/// The number of points along an axis is a multiple of this. On a periodic axis a chess board
/// closes only with an even number of squares.
template <int D>
std::int64_t multiple(const Room<D>& room, bool centred, int axis) {
  return centred && !room.walled[axis] ? 2 : 1;
}

/// Upper bound, a multiple(), of the number of points with this spacing along an axis.
template <int D>
std::int64_t bound_on_points(const Room<D>& room, bool centred, int axis, double spacing) {
  constexpr double kMax = 1LL << 32;  // more than any count of particles
  const auto points = static_cast<std::int64_t>(std::min(span(room, axis) / spacing, kMax)) + 2;
  return points - points % multiple(room, centred, axis);
}

/// Upper bound, a multiple(), of the number of points along an axis of a grid that fits.
template <int D>
std::int64_t bound_along(const Room<D>& room, bool centred, int axis) {
  return bound_on_points(room, centred, axis, room.diameter * (centred ? 0.5 : 1.0));
}

/// The axes in order of edge length, the shortest first. Searches try all numbers of points along
/// all axes except the last; the number along the last axis follows.
template <int D>
using Axes = std::array<int, D>;
template <int D>
Axes<D> by_length(const Room<D>& room) {
  Axes<D> axes;
  std::iota(axes.begin(), axes.end(), 0);
  std::stable_sort(axes.begin(), axes.end(),
                   [&](int a, int b) { return room.box[a] < room.box[b]; });
  return axes;
}

/// Search for the lattice of primitive_lattice and face_centred_lattice.
template <int D>
class WidestGrid {
 public:
  WidestGrid(const Room<D>& room, bool centred, int count)
      : room_(room),
        needed_(centred ? 2LL * count - 1 : count),
        axes_(by_length(room)),
        widest_{.centred = centred} {
    search({.centred = centred}, 0, 1);
  }

  /// The grid found; 0 points if no grid fits.
  const Grid<D>& grid() const { return widest_; }

 private:
  // The numbers of points of the axes before axes_[k] are set; `product` is their product.
  void search(Grid<D> grid, int k, std::int64_t product) {
    const int axis = axes_[k];
    const std::int64_t unit = multiple(room_, grid.centred, axis);
    std::int64_t& points = grid.points[axis];
    if (k == D - 1) {
      points = (needed_ + product * unit - 1) / (product * unit) * unit;
      if (!fits(room_, grid) || least_distance(room_, grid) <= distance_) return;
      distance_ = least_distance(room_, grid);
      widest_ = grid;
      return;
    }
    const std::int64_t last =
        std::min(bound_along(room_, grid.centred, axis), needed_ / product + unit);
    for (points = unit; points <= last; points += unit) {
      // With more points, sites are only closer along this axis.
      if (distance_in_row(room_, grid.centred, axis, points) <= distance_) return;
      search(grid, k + 1, product * points);
    }
  }

  const Room<D>& room_;
  std::int64_t needed_;  // points, with or without a site
  Axes<D> axes_;
  Grid<D> widest_;
  double distance_ = 0.0;
};

/// Largest number of sites of a grid with given points along all axes except axes[D - 1]; 0 if none
/// fits.
template <int D>
std::int64_t most_sites(const Room<D>& room, const Axes<D>& axes, Grid<D> grid) {
  const int last = axes[D - 1];
  const std::int64_t unit = multiple(room, grid.centred, last);
  grid.points[last] = unit;
  if (!fits(room, grid)) return 0;
  const double least = reach(room);
  double closest = grid.centred ? 0.5 * least : least;
  for (int k = 0; grid.centred && k < D - 1; ++k) {
    const double step = spacing(room, axes[k], grid.points[axes[k]]);
    if (step < least) closest = std::max(closest, std::sqrt(least * least - step * step));
  }
  grid.points[last] = bound_on_points(room, grid.centred, last, closest);
  while (!fits(room, grid)) grid.points[last] -= unit;  // the bound is at most a few too high
  return site_count(grid);
}

/// Largest number of sites of a grid with given points along the axes before axes[k]; at most the
/// largest int.
template <int D>
std::int64_t capacity(const Room<D>& room, const Axes<D>& axes, Grid<D> grid, int k) {
  constexpr std::int64_t kMax = std::numeric_limits<int>::max();
  if (k == D - 1) return std::min(most_sites<D>(room, axes, grid), kMax);
  const std::int64_t unit = multiple(room, grid.centred, axes[k]);
  const std::int64_t last = bound_along(room, grid.centred, axes[k]);
  std::int64_t most = 0;
  for (std::int64_t n = unit; n <= last && most < kMax; n += unit) {
    grid.points[axes[k]] = n;
    most = std::max(most, capacity<D>(room, axes, grid, k + 1));
  }
  return most;
}

/// Coordinate of the i-th of n points along an axis.
template <int D>
double coordinate(const Room<D>& room, int axis, std::int64_t i, std::int64_t n) {
  const double step = spacing(room, axis, n);
  if (!room.walled[axis]) return (static_cast<double>(i) + 0.5) * step;
  if (n == 1) return 0.5 * room.box[axis];
  const double radius = 0.5 * room.diameter;
  return std::min(radius + static_cast<double>(i) * step, room.box[axis] - radius);
}

/// The sites of a grid, row by row along x, then along y.
template <int D>
std::vector<Vec<D>> sites_of(const Room<D>& room, const Grid<D>& grid) {
  std::vector<Vec<D>> sites;
  sites.reserve(static_cast<std::size_t>(site_count(grid)));
  std::array<std::int64_t, D> at{};
  while (at[D - 1] < grid.points[D - 1]) {
    const std::int64_t sum = std::accumulate(at.begin(), at.end(), std::int64_t{0});
    if (!grid.centred || sum % 2 == 0) {
      Vec<D> site;
      for (int k = 0; k < D; ++k) site[k] = coordinate(room, k, at[k], grid.points[k]);
      sites.push_back(site);
    }
    for (int k = 0; ++at[k] == grid.points[k] && k < D - 1; ++k) at[k] = 0;
  }
  return sites;
}

template <int D>
std::vector<Vec<D>> widest_lattice(const Room<D>& room, bool centred, int count) {
  if (count <= 0) return {};
  return sites_of(room, WidestGrid<D>(room, centred, count).grid());
}

}  // namespace

template <int D>
std::vector<Vec<D>> primitive_lattice(const Room<D>& room, int count) {
  return widest_lattice(room, false, count);
}

template <int D>
std::vector<Vec<D>> face_centred_lattice(const Room<D>& room, int count) {
  return widest_lattice(room, true, count);
}

template <int D>
int lattice_capacity(const Room<D>& room) {
  const auto axes = by_length(room);
  return static_cast<int>(std::max(capacity<D>(room, axes, {.centred = false}, 0),
                                   capacity<D>(room, axes, {.centred = true}, 0)));
}

template std::vector<Vec<2>> primitive_lattice(const Room<2>&, int);
template std::vector<Vec<3>> primitive_lattice(const Room<3>&, int);
template std::vector<Vec<2>> face_centred_lattice(const Room<2>&, int);
template std::vector<Vec<3>> face_centred_lattice(const Room<3>&, int);
template int lattice_capacity(const Room<2>&);
template int lattice_capacity(const Room<3>&);

}  // namespace clatter
