#pragma once

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>

#include "engine/dynamics/model.h"
#include "engine/vec.h"

namespace clatter {

/// Equal cells over the whole box. Along each axis cells are numbered from 0 at the box's low end
/// on, without end to either side; folding brings such a number into the box: periodically, or,
/// between walls, into the edge cell, which takes what lies beyond.
template <int D>
class FieldGrid {
 public:
  /// One number per axis.
  using Cell = std::array<long, D>;

  FieldGrid(const Model<D>& model, const IntVec<D>& cells)
      : cells_(cells),
        widths_(model.box.cwiseQuotient(cells.template cast<double>())),
        per_width_(widths_.cwiseInverse()) {
    for (int axis = 0; axis < D; ++axis) periodic_[axis] = model.periodic(axis);
  }

  /// Number of cells along each axis.
  const IntVec<D>& cells() const { return cells_; }
  /// Number of cells.
  std::size_t size() const { return static_cast<std::size_t>(cells_.prod()); }
  /// Edges of a cell.
  const Vec<D>& widths() const { return widths_; }
  /// Area of a cell; its volume in space.
  double cell_measure() const { return widths_.prod(); }
  /// Whether the box is periodic along an axis.
  bool periodic(int axis) const { return periodic_[axis]; }

  /// The cell in which a place lies; a cell holds its lower borders.
  Cell cell_at(const Vec<D>& r) const {
    Cell cell;
    for (int axis = 0; axis < D; ++axis) {
      cell[axis] = static_cast<long>(std::floor(r[axis] * per_width_[axis]));
    }
    return cell;
  }

  /// The middle of a cell, not folded.
  Vec<D> centre_of(const Cell& cell) const {
    Vec<D> centre;
    for (int axis = 0; axis < D; ++axis) {
      centre[axis] = (static_cast<double>(cell[axis]) + 0.5) * widths_[axis];
    }
    return centre;
  }

  /// Index of a cell, folded: in the plane (i, j) has i + j cells().x().
  std::size_t index_of(const Cell& cell) const {
    std::size_t index = 0;
    for (int axis = D - 1; axis >= 0; --axis) {
      index = index * static_cast<std::size_t>(cells_[axis]) + folded(axis, cell[axis]);
    }
    return index;
  }

  /// Cuts the line from `from` to `from + along` at every border of cells and calls visit(index,
  /// share) for each piece, from first to last, with its share of the length; a point is one piece
  /// of share 1.
  template <class Visit>
  void cut(const Vec<D>& from, const Vec<D>& along, Visit&& visit) const {
    Cell cell = cell_at(from);
    const Cell last = cell_at(from + along);
    if (cell == last) {
      visit(index_of(cell), 1.0);
      return;
    }
    std::array<Borders, D> borders;
    long crossings = 0;
    for (int axis = 0; axis < D; ++axis) {
      if (cell[axis] == last[axis]) continue;
      crossings += std::labs(last[axis] - cell[axis]);
      borders[axis] = {along[axis] > 0.0 ? 1 : -1, 1.0 / along[axis]};
      find_next(axis, cell, from, last, borders[axis]);
    }
    double done = 0.0;
    for (; crossings > 0; --crossings) {
      int axis = 0;
      for (int k = 1; k < D; ++k) {
        if (borders[k].next < borders[axis].next) axis = k;
      }
      // Rounding must not let a piece be negative.
      const double next = std::clamp(borders[axis].next, done, 1.0);
      visit(index_of(cell), next - done);
      done = next;
      cell[axis] += borders[axis].step;
      find_next(axis, cell, from, last, borders[axis]);
    }
    visit(index_of(cell), 1.0 - done);
  }

 private:
  /// The borders that a line crosses along one axis.
  struct Borders {
    int step = 0;
    double per_length = 0.0;                                ///< 1 / the line's extent
    double next = std::numeric_limits<double>::infinity();  ///< share of the line up to the next
  };

  void find_next(int axis, const Cell& cell, const Vec<D>& from, const Cell& last,
                 Borders& borders) const {
    const double border = static_cast<double>(cell[axis] + (borders.step > 0)) * widths_[axis];
    borders.next = cell[axis] == last[axis] ? std::numeric_limits<double>::infinity()
                                            : (border - from[axis]) * borders.per_length;
  }

  std::size_t folded(int axis, long cell) const {
    const long n = cells_[axis];
    if (cell >= 0 && cell < n) return static_cast<std::size_t>(cell);
    const long inside = periodic_[axis] ? ((cell % n) + n) % n : std::clamp(cell, 0L, n - 1);
    return static_cast<std::size_t>(inside);
  }

  IntVec<D> cells_;
  Vec<D> widths_;
  Vec<D> per_width_;
  std::array<bool, D> periodic_;
};

}  // namespace clatter
