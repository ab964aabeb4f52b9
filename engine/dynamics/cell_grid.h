#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <vector>

#include "engine/dynamics/large_array.h"
#include "engine/dynamics/model.h"
#include "engine/vec.h"

namespace clatter {

/// Grid of cells that finds near particles. Two particles that touch belong to the same cell or to
/// neighbouring cells. A particle stays in its cell until it is beyond the cell's border by an
/// overhang. This hysteresis prevents repeated crossings; the overhang is as wide as the first
/// condition allows.
///
/// The list of a cell holds the particles of the cell and of all neighbouring cells. A search for
/// partners reads one list. A crossing removes the particle from one row of lists and adds it to
/// another. Searches are far more frequent than crossings.
template <int D>
class CellGrid {
 public:
  /// An empty grid over the box, of about so many cells, each wider than a diameter.
  CellGrid(const Model<D>& model, double cells);

  /// Puts a particle into a cell.
  void insert(std::uint32_t particle, const IntVec<D>& cell);
  /// Removes a particle from its cell.
  void remove(std::uint32_t particle, const IntVec<D>& cell);
  /// Moves a particle from its cell to the neighbour along an axis, on the side of `step` = +1 or
  /// -1.
  void move(std::uint32_t particle, const IntVec<D>& cell, int axis, int step);

  /// Number of cells along each axis.
  const IntVec<D>& counts() const { return counts_; }
  /// The cell that holds a position inside the box.
  IntVec<D> cell_at(const Vec<D>& position) const;
  /// The cell next to one along an axis, on the side of `step` = +1 or -1, across the periodic
  /// border.
  IntVec<D> neighbour(IntVec<D> cell, int axis, int step) const {
    cell[axis] += step;
    if (cell[axis] < 0 || cell[axis] == counts_[axis]) cell[axis] -= step * counts_[axis];
    return cell;
  }
  /// Coordinate at which a particle leaves cell number `cell` through its upper or lower border,
  /// overhang included. Infinite at a wall, which has no cell beyond it.
  double border(int axis, int cell, bool upper) const {
    return borders_[axis][static_cast<std::size_t>(2 * cell + upper)];
  }
  /// Least distance of a particle in cell number `cell` from the lower or upper end of the box.
  double distance_from_end(int axis, int cell, bool upper) const {
    const int cells = upper ? counts_[axis] - 1 - cell : cell;
    return cells * widths_[axis] - overhangs_[axis];
  }

  /// A near particle and its periodic image. The low bits are its number. Two bits per axis above
  /// give its wrap: the box lengths -1, 0 or +1 across the periodic border. If the box is only one
  /// or two cells wide, a particle occurs several times with different wraps.
  using Neighbour = std::uint32_t;
  static constexpr int kParticleBits = 32 - 2 * D;
  static_assert(kMaxParticles<D> < (std::uint64_t{1} << kParticleBits));  // the last is kNobody
  static std::uint32_t particle_of(Neighbour neighbour) { return neighbour & kParticleMask; }
  static int wrap_of(Neighbour neighbour, int axis) {
    // Two bits with their sign.
    return static_cast<std::int32_t>(neighbour << (2 * (D - 1 - axis))) >> 30;
  }

  /// The particles near a cell, or a part of them. A list fills one cache line in 2D and two in 3D.
  struct alignas(64) List {
    static constexpr int kCapacity = D == 2 ? 14 : 30;
    std::array<Neighbour, kCapacity> neighbours;  ///< entries beyond the count are kNobody
    std::uint16_t count = 0;
    bool wraps = false;          ///< whether a neighbour may have a wrap other than 0
    std::uint32_t next = kNone;  ///< list that continues this one, which is full; or kNone

    List() { neighbours.fill(kNobody); }
  };
  static constexpr Neighbour kParticleMask = (Neighbour{1} << kParticleBits) - 1;
  static constexpr Neighbour kNobody = ~Neighbour{0};
  static constexpr std::uint32_t kNone = ~std::uint32_t{0};

  /// The list of a cell.
  const List& near(const IntVec<D>& cell) const { return lists_[index(cell)]; }
  /// The list that continues `list`, or null.
  const List* next(const List& list) const {
    return list.next == kNone ? nullptr : &lists_[list.next];
  }
  /// Number of particles near a cell.
  std::size_t count_near(const IntVec<D>& cell) const;
  /// Calls visit(particle, wrap) for each particle near a cell. `wrap` is its periodic image in box
  /// lengths.
  template <typename Visit>
  void visit(const IntVec<D>& cell, const Visit& visit) const;

  /// Calls visit(list) for the first list of each cell that move() changes. Across a periodic
  /// border move() changes further lists.
  template <typename Visit>
  void visit_moved(const IntVec<D>& cell, int axis, int step, const Visit& visit) const;

 private:
  // A cell along one axis. There is one more beyond either end.
  struct Place {
    std::uint32_t index = kNone;  // this axis' part of the index of its list; kNone: a wall
    Neighbour wrap = 0;           // wrap of a particle within the box, seen from there
  };
  struct Block {
    IntVec<D> from;
    IntVec<D> to;
  };
  static Block about(const IntVec<D>& cell);
  static Block row(const IntVec<D>& cell, int axis, int at);

  template <int Axis, typename Visit>
  void visit_lists(const Block& block, std::uint32_t index, Neighbour wrap,
                   const Visit& visit) const;
  void put_on(std::uint32_t list, Neighbour neighbour);
  void take_off(std::uint32_t list, Neighbour neighbour);
  void take_off_chain(std::uint32_t list, Neighbour neighbour);
  std::uint32_t index(const IntVec<D>& cell) const;
  std::uint32_t new_list();

  IntVec<D> counts_;
  IntVec<D> strides_;
  Vec<D> widths_;
  Vec<D> overhangs_;
  std::array<std::vector<double>, D> borders_;  // [2 counts] along each axis: lower, upper, ...
  std::array<std::vector<Place>, D> places_;    // [counts + 2] along each axis
  LargeArray<List> lists_;            // the first list of each cell, then the continuations
  std::vector<std::uint32_t> spare_;  // unused continuations
};

template <int D>
[[gnu::always_inline]] inline std::uint32_t CellGrid<D>::index(const IntVec<D>& cell) const {
  return static_cast<std::uint32_t>(cell.dot(strides_));
}

template <int D>
std::size_t CellGrid<D>::count_near(const IntVec<D>& cell) const {
  std::size_t count = 0;
  for (const List* list = &near(cell); list; list = next(*list)) count += list->count;
  return count;
}

template <int D>
template <typename Visit>
void CellGrid<D>::visit(const IntVec<D>& cell, const Visit& visit) const {
  for (const List* list = &near(cell); list; list = next(*list)) {
    for (std::uint32_t k = 0; k < list->count; ++k) {
      Vec<D> wrap;
      for (int axis = 0; axis < D; ++axis) wrap[axis] = wrap_of(list->neighbours[k], axis);
      visit(particle_of(list->neighbours[k]), wrap);
    }
  }
}

template <int D>
typename CellGrid<D>::Block CellGrid<D>::about(const IntVec<D>& cell) {
  return {cell - IntVec<D>::Ones(), cell + IntVec<D>::Ones()};
}

// The cells about `cell` whose number along an axis is `at`.
template <int D>
typename CellGrid<D>::Block CellGrid<D>::row(const IntVec<D>& cell, int axis, int at) {
  Block block = about(cell);
  block.from[axis] = block.to[axis] = at;
  return block;
}

// Calls visit(list, wrap) for the list of each cell of a block. `wrap` is the periodic image of a
// particle within the box, seen from that cell.
template <int D>
template <int Axis, typename Visit>
[[gnu::always_inline]] inline void CellGrid<D>::visit_lists(const Block& block, std::uint32_t index,
                                                            Neighbour wrap,
                                                            const Visit& visit) const {
  for (int k = block.from[Axis]; k <= block.to[Axis]; ++k) {
    const Place& place = places_[Axis][static_cast<std::size_t>(k + 1)];
    if (place.index == kNone) continue;
    if constexpr (Axis == 0) {
      visit(index + place.index, wrap | place.wrap);
    } else {
      visit_lists<Axis - 1>(block, index + place.index, wrap | place.wrap, visit);
    }
  }
}

template <int D>
template <typename Visit>
void CellGrid<D>::visit_moved(const IntVec<D>& cell, int axis, int step, const Visit& visit) const {
  const IntVec<D> next = neighbour(cell, axis, step);
  const auto visit_list = [&](std::uint32_t list, Neighbour) { visit(lists_[list]); };
  visit_lists<D - 1>(row(cell, axis, cell[axis] - step), 0, 0, visit_list);
  visit_lists<D - 1>(row(cell, axis, next[axis] + step), 0, 0, visit_list);
}

extern template class CellGrid<2>;
extern template class CellGrid<3>;

}  // namespace clatter
