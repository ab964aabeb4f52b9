#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <vector>

#include "engine/dynamics/model.h"
#include "engine/vec.h"

namespace clatter {

/// Cells of at least one diameter that say which disks are near: two disks that touch lie in the
/// same cell or in neighbouring ones. Each cell is one cache line of disk numbers; the clusters of
/// a dissipative gas chain further lines to it.
template <int D>
class CellGrid {
 public:
  /// An empty grid of about one cell per disk over the box.
  CellGrid(const Model<D>& model, std::size_t disks);

  /// Takes every disk out.
  void clear();
  /// Puts a disk into a cell.
  void insert(std::uint32_t disk, const IntVec<D>& cell);
  /// Takes a disk out of the cell it was put into.
  void remove(std::uint32_t disk, const IntVec<D>& cell);

  /// Number of cells along each axis.
  const IntVec<D>& counts() const { return counts_; }
  /// The cell that holds a position inside the box.
  IntVec<D> cell_at(const Vec<D>& position) const;
  /// Place along an axis of the border below cell number `cell`; that of cell counts() is the box.
  double border(int axis, int cell) const;

  /// A box of cells about one: the offsets from `from` to `to` along each axis.
  struct Stencil {
    IntVec<D> from = IntVec<D>::Constant(-1);
    IntVec<D> to = IntVec<D>::Constant(1);
  };

  /// Calls visit(disk, wrap) for each disk in the stencil about a cell; `wrap` holds the box lengths
  /// by which the disk's cell lies round the periodic borders. A cell may come up several times,
  /// with different wraps, where the box is only one or two cells wide.
  template <typename Visit>
  void visit(const IntVec<D>& cell, const Stencil& stencil, const Visit& visit) const;

  /// Calls visit(line) with the first cache line of each cell of the stencil, to fetch it early.
  template <typename Visit>
  void visit_lines(const IntVec<D>& cell, const Stencil& stencil, const Visit& visit) const;

 private:
  static constexpr std::uint32_t kNone = 0xffffffffu;
  struct alignas(64) Line {
    std::uint32_t count = 0;
    std::uint32_t next = kNone;  // line that continues this cell
    std::array<std::uint32_t, 14> disks;
  };

  /// The cells of a stencil along one axis: where they begin in lines_, and their wraps.
  struct Steps {
    struct {
      std::size_t offset;
      double wrap;
    } step[3];
    int length = 0;
  };

  template <typename VisitCell>
  void visit_cells(const IntVec<D>& cell, const Stencil& stencil, const VisitCell& visit) const;
  template <int Axis, typename VisitCell>
  static void descend(const std::array<Steps, D>& steps, std::size_t at, Vec<D>& wrap,
                      const VisitCell& visit);
  std::size_t index(const IntVec<D>& cell) const;
  std::uint32_t new_line();

  IntVec<D> counts_;
  IntVec<D> strides_;
  Vec<D> box_;
  Vec<D> per_width_;  // cells per length
  std::array<bool, D> periodic_;
  std::vector<Line> lines_;           // the cells' own lines first, then the chained ones
  std::vector<std::uint32_t> spare_;  // chained lines not in use
};

template <int D>
template <typename VisitCell>
void CellGrid<D>::visit_cells(const IntVec<D>& cell, const Stencil& stencil,
                              const VisitCell& visit) const {
  std::array<Steps, D> steps;
  for (int axis = 0; axis < D; ++axis) {
    for (int offset = stencil.from[axis]; offset <= stencil.to[axis]; ++offset) {
      int at = cell[axis] + offset;
      double wrap = 0.0;
      if (at < 0 || at >= counts_[axis]) {
        if (!periodic_[axis]) continue;
        wrap = at < 0 ? -1.0 : 1.0;
        at -= static_cast<int>(wrap) * counts_[axis];
      }
      steps[axis].step[steps[axis].length++] = {static_cast<std::size_t>(at * strides_[axis]), wrap};
    }
  }
  Vec<D> wrap;
  descend<D - 1>(steps, 0, wrap, visit);
}

template <int D>
template <int Axis, typename VisitCell>
void CellGrid<D>::descend(const std::array<Steps, D>& steps, std::size_t at, Vec<D>& wrap,
                          const VisitCell& visit) {
  for (int k = 0; k < steps[Axis].length; ++k) {
    wrap[Axis] = steps[Axis].step[k].wrap;
    if constexpr (Axis == 0) {
      visit(at + steps[Axis].step[k].offset, wrap);
    } else {
      descend<Axis - 1>(steps, at + steps[Axis].step[k].offset, wrap, visit);
    }
  }
}

template <int D>
template <typename Visit>
void CellGrid<D>::visit(const IntVec<D>& cell, const Stencil& stencil, const Visit& visit) const {
  visit_cells(cell, stencil, [&](std::size_t at, const Vec<D>& wrap) {
    const Line* line = &lines_[at];
    for (;;) {
      for (std::uint32_t k = 0; k < line->count; ++k) visit(line->disks[k], wrap);
      if (line->next == kNone) return;
      line = &lines_[line->next];
    }
  });
}

template <int D>
template <typename Visit>
void CellGrid<D>::visit_lines(const IntVec<D>& cell, const Stencil& stencil,
                              const Visit& visit) const {
  visit_cells(cell, stencil, [&](std::size_t at, const Vec<D>&) { visit(&lines_[at]); });
}

extern template class CellGrid<2>;

}  // namespace clatter
