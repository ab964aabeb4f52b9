#pragma once

#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

#include "engine/dynamics/cell_grid.h"
#include "engine/laws/model.h"

namespace clatter {

/// The pieces of fixtures that a particle in a cell may touch. Without fixtures it has no lists.
template <int D>
class PieceLists {
 public:
  /// In place of the number of a valve: the piece is none.
  static constexpr std::uint32_t kNoValve = 0xffffffffu;

  /// A piece, and the number of its fixture in the model.
  struct Owned {
    Piece<D> piece;
    std::uint32_t fixture;
    std::uint32_t valve = kNoValve;  ///< whose opening it is, by its number in the fixture
  };
  /// A piece on the list of a cell, in a periodic image, as box lengths.
  struct Entry {
    std::uint32_t piece;
    IntVec<D> image;
  };

  /// No lists until the first lay().
  explicit PieceLists(const Model<D>& model);

  /// Makes the lists for the cells of a grid.
  void lay(const CellGrid<D>& grid);
  /// Whether there are fixtures.
  bool any() const { return !pieces_.empty(); }
  /// A piece, by its number in Event::partner.
  const Owned& piece(std::uint32_t number) const { return pieces_[number]; }
  /// The list of a cell.
  std::span<const Entry> near(std::size_t cell) const {
    return std::span(entries_).subspan(first_[cell], first_[cell + 1] - first_[cell]);
  }

 private:
  Domain<D> domain_;
  double reach_;  // the largest radius of a particle
  std::vector<Owned> pieces_;
  std::vector<Entry> entries_;
  std::vector<std::uint32_t> first_;  // [cells + 1] places in entries_
};

extern template class PieceLists<2>;
extern template class PieceLists<3>;

}  // namespace clatter
