#pragma once

#include <cstddef>
#include <vector>

#include "engine/dynamics/model.h"
#include "engine/physics/flight.h"
#include "engine/physics/pair_contact.h"
#include "engine/vec.h"

namespace clatter {

/// A way out of a cell, through one of its faces.
struct FaceCrossing {
  double at = kNever;  ///< time on the moving base, or share 0..1 of a branch
  int axis = 0;
  int step = 0;  ///< +1 or -1 along the axis
};

/// Paths of particles and of branch vectors through equal box cells over the whole box. Along a
/// walled axis the edge cells take what lies beyond; along a periodic one the cells go round, and a
/// single one has no faces, for what leaves it is in it again.
///
/// A particle's cell is never told from its place alone, which near a face is a matter of rounding:
/// it is carried from face to face, and every path starts, and a branch ends, in the cell it is
/// told.
template <int D>
class CellPath {
 public:
  /// Paths in a model's box, which outlives this, with the given number of cells along each axis.
  CellPath(const Model<D>& model, const IntVec<D>& cells);

  /// Number of cells along each axis.
  const IntVec<D>& cells() const { return cells_; }
  /// Where a cell stands in an array of all: cell (i, j) at i + j cells.x().
  std::size_t index(const IntVec<D>& cell) const;
  /// The cell that stands there.
  IntVec<D> cell(std::size_t index) const;
  /// The cell that a place lies in, at any image.
  IntVec<D> cell_at(const Vec<D>& place) const;
  /// Whether a place lies in a cell, at any image and to within rounding.
  bool is_current(const IntVec<D>& cell, const Vec<D>& place) const;
  /// The cell beyond a face.
  IntVec<D> beyond(IntVec<D> cell, int axis, int step) const;

  /// Where a flight, which is in `cell` at `time`, leaves it; at kNever where it does not.
  FaceCrossing next_crossing(const Flight<D>& flight, const IntVec<D>& cell, double time) const;
  /// The faces in the way of the straight branch from the place `start` to start + branch, which
  /// lie in the cells `from` and `to`; in the order in which it passes them.
  std::vector<FaceCrossing> along(const Vec<D>& start, const Vec<D>& branch, const IntVec<D>& from,
                                  const IntVec<D>& to) const;

 private:
  bool has_face(int axis, int cell, int step) const;
  double image_index(int axis, int cell, double place) const;
  double near(int axis, int cell, double place) const;
  double face(int axis, int cell, int step) const;

  const Model<D>& model_;
  IntVec<D> cells_;
  Vec<D> widths_;
};

extern template class CellPath<2>;

}  // namespace clatter
