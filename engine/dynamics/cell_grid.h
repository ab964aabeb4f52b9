#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <vector>

#include "engine/dynamics/large_array.h"
#include "engine/dynamics/model.h"
#include "engine/vec.h"

namespace clatter {

/// Cells of at least one diameter that say which disks are near: two disks that touch lie in the
/// same cell or in neighbouring ones. Each cell is half a cache line of disk numbers, to which the
/// clusters of a dissipative gas chain further ones.
template <int D>
class CellGrid {
 public:
  /// An empty grid over the box, of about one cell for each of a number of disks.
  CellGrid(const Model<D>& model, std::size_t disks);

  /// Disks in the cell of a disk, itself included, on average over disks: far more than one where
  /// they lie in clusters.
  double crowding() const;
  /// Puts a disk into a cell.
  void insert(std::uint32_t disk, const IntVec<D>& cell);
  /// Takes a disk out of the cell it was put into.
  void remove(std::uint32_t disk, const IntVec<D>& cell);

  /// Number of cells along each axis.
  const IntVec<D>& counts() const { return counts_; }
  /// The cell that holds a position inside the box.
  IntVec<D> cell_at(const Vec<D>& position) const;
  /// The cell next to one along an axis, on the side of `step` = +1 or -1, round the periodic
  /// border.
  IntVec<D> neighbour(IntVec<D> cell, int axis, int step) const {
    cell[axis] += step;
    if (cell[axis] < 0 || cell[axis] == counts_[axis]) cell[axis] -= step * counts_[axis];
    return cell;
  }
  /// Place along an axis of the border below cell number `cell`, or of the last cell's far border
  /// for counts(); infinitely far off where the box ends at a wall, for there is no cell beyond.
  double border(int axis, int cell) const { return borders_[axis][static_cast<std::size_t>(cell)]; }
  /// Edge length of the cells along an axis.
  double width(int axis) const { return widths_[axis]; }

  /// A box of cells about one: the offsets from `from` to `to` along each axis.
  struct Stencil {
    IntVec<D> from = IntVec<D>::Constant(-1);
    IntVec<D> to = IntVec<D>::Constant(1);
  };

  /// Disks that lie together: some of one cell's.
  struct alignas(32) Line {
    static constexpr int kCapacity = 7;
    std::array<std::uint32_t, kCapacity> disks;
    std::uint32_t count : 3 = 0;
    std::uint32_t next : 29 = kNone;  ///< line that continues the cell
  };
  static constexpr std::uint32_t kNone = (1u << 29) - 1;

  /// Calls visit(line, wrap) for each line of the cells in the stencil about a cell. `wrap` points
  /// to the box lengths by which the line's cell lies round the periodic borders, or is null where
  /// no cell of the stencil does. A cell comes up several times, with different wraps, where the
  /// box is only one or two cells wide.
  template <typename Visit>
  void visit(const IntVec<D>& cell, const Stencil& stencil, const Visit& visit) const;

  /// The same for the first line of each cell only. Cells go on after those that are full.
  template <typename Visit>
  void visit_first_lines(const IntVec<D>& cell, const Stencil& stencil, const Visit& visit) const;

  /// The same for the other lines.
  template <typename Visit>
  void visit_chained_lines(const IntVec<D>& cell, const Stencil& stencil, const Visit& visit) const;

 private:
  /// The cells of a stencil along the axes up to Axis, for given places along the others; kInside:
  /// none of them lies beyond the box.
  template <int Axis, bool kInside, typename VisitCell>
  void visit_cells(const IntVec<D>& cell, const Stencil& stencil, int at, Vec<D>& wrap,
                   const VisitCell& visit) const;
  template <typename VisitCell>
  void visit_cells(const IntVec<D>& cell, const Stencil& stencil, const VisitCell& visit) const;
  std::size_t index(const IntVec<D>& cell) const;
  std::uint32_t new_line();

  IntVec<D> counts_;
  IntVec<D> strides_;
  Vec<D> box_;
  Vec<D> widths_;
  std::array<std::vector<double>, D> borders_;  // [counts + 1] along each axis
  std::array<bool, D> periodic_;
  LargeArray<Line> lines_;            // the cells' own lines first, then the chained ones
  std::vector<std::uint32_t> spare_;  // chained lines not in use
};

// Inlined by force down to the caller's visit, so that what it needs stays in registers.
template <int D>
template <int Axis, bool kInside, typename VisitCell>
[[gnu::always_inline]] inline void CellGrid<D>::visit_cells(const IntVec<D>& cell,
                                                            const Stencil& stencil, int at,
                                                            Vec<D>& wrap,
                                                            const VisitCell& visit) const {
  const int count = counts_[Axis];
  const int stride = strides_[Axis];
  for (int offset = stencil.from[Axis]; offset <= stencil.to[Axis]; ++offset) {
    int k = cell[Axis] + offset;
    if constexpr (!kInside) {
      wrap[Axis] = 0.0;
      if (static_cast<unsigned>(k) >= static_cast<unsigned>(count)) {
        if (!periodic_[Axis]) continue;
        wrap[Axis] = k < 0 ? -1.0 : 1.0;
        k += k < 0 ? count : -count;
      }
    }
    if constexpr (Axis == 0) {
      visit(static_cast<std::size_t>(at + k), kInside ? nullptr : &wrap);
    } else {
      visit_cells<Axis - 1, kInside>(cell, stencil, at + k * stride, wrap, visit);
    }
  }
}

template <int D>
template <typename VisitCell>
[[gnu::always_inline]] inline void CellGrid<D>::visit_cells(const IntVec<D>& cell,
                                                            const Stencil& stencil,
                                                            const VisitCell& visit) const {
  bool inside = true;
  for (int axis = 0; axis < D; ++axis) {
    inside = inside && cell[axis] > 0 && cell[axis] < counts_[axis] - 1;
  }
  Vec<D> wrap = Vec<D>::Zero();
  if (inside) {
    visit_cells<D - 1, true>(cell, stencil, 0, wrap, visit);
  } else {
    visit_cells<D - 1, false>(cell, stencil, 0, wrap, visit);
  }
}

template <int D>
template <typename Visit>
[[gnu::always_inline]] inline void CellGrid<D>::visit_first_lines(const IntVec<D>& cell,
                                                                  const Stencil& stencil,
                                                                  const Visit& visit) const {
  const Line* const lines = lines_.data();
  visit_cells(
      cell, stencil, [&](std::size_t at, const Vec<D>* wrap) __attribute__((always_inline)) {
        visit(lines[at], wrap);
      });
}

template <int D>
template <typename Visit>
void CellGrid<D>::visit_chained_lines(const IntVec<D>& cell, const Stencil& stencil,
                                      const Visit& visit) const {
  visit_first_lines(cell, stencil, [&](const Line& first, const Vec<D>* wrap) {
    for (const Line* line = &first; line->next != kNone; visit(*line, wrap)) {
      line = &lines_[line->next];
    }
  });
}

template <int D>
template <typename Visit>
void CellGrid<D>::visit(const IntVec<D>& cell, const Stencil& stencil, const Visit& visit) const {
  visit_first_lines(cell, stencil, visit);
  visit_chained_lines(cell, stencil, visit);
}

extern template class CellGrid<2>;

}  // namespace clatter
