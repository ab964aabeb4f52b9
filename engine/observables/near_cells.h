#pragma once

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <vector>

#include "engine/dynamics/model.h"
#include "engine/vec.h"

namespace clatter {

/// Particles sorted into cells of at least half a range, to visit all pairs within the range.
template <int D>
class NearCells {
 public:
  /// Consecutive particles in the order of the cells, or consecutive cells.
  struct Range {
    std::size_t begin, end;
  };

  /// Cells for a number of particles. The range is shortened to half the shortest period.
  NearCells(const Model<D>& model, std::size_t particles, double range);

  /// The range of the pairs.
  double range() const { return range_; }
  /// Sorts particles by their positions in the box.
  void sort(const std::vector<Vec<D>>& positions);

  /// Number of cells.
  std::size_t cells() const { return first_.size() - 1; }
  /// The particles of a cell.
  Range in_cell(std::size_t cell) const { return {first_[cell], first_[cell + 1]}; }
  /// The particles within the range of those in a cell, and others. Valid until the next call.
  const std::vector<Range>& near(std::size_t cell);
  /// [N] coordinates along an axis, in the order of the cells.
  const std::vector<double>& coordinates(int axis) const { return coordinates_[axis]; }
  /// [N] numbers of the particles, in the order of the cells.
  const std::vector<std::uint32_t>& particles() const { return particles_; }
  /// Period of the box along each axis; infinite between walls.
  const Vec<D>& period() const { return period_; }

  /// Calls visit(first, second, separation) for each pair within the range, in an order that
  /// depends on the positions only. The separation points from the second to the first particle.
  template <class Visit>
  void each_pair(const Visit& visit) {
    for (std::size_t cell = 0; cell < cells(); ++cell) {
      const Range own = in_cell(cell);
      if (own.begin == own.end) continue;
      for (const Range& others : near(cell)) {
        for (std::size_t i = own.begin; i < own.end; ++i) {
          for (std::size_t j = std::max(others.begin, i + 1); j < others.end; ++j) {
            const Vec<D> apart = separation(i, j);
            if (apart.squaredNorm() <= range_ * range_) {
              visit(particles_[i], particles_[j], apart);
            }
          }
        }
      }
    }
  }

 private:
  void choose_cells(const Model<D>& model, std::size_t particles);
  Vec<D> separation(std::size_t i, std::size_t j) const {
    Vec<D> apart;
    for (int axis = 0; axis < D; ++axis) {
      apart[axis] = coordinates_[axis][i] - coordinates_[axis][j];
      if (2.0 * std::fabs(apart[axis]) > period_[axis]) {
        apart[axis] -= std::copysign(period_[axis], apart[axis]);
      }
    }
    return apart;
  }

  Vec<D> box_;
  Vec<D> period_;
  double range_;
  IntVec<D> cells_;                                      // along each axis; x is fastest
  std::array<std::vector<std::vector<Range>>, D> near_;  // [cells] near cells, first and last
  std::vector<std::size_t> first_ = {0};                 // [cells + 1] first particle of each cell
  std::array<std::vector<double>, D> coordinates_;
  std::vector<std::uint32_t> particles_;
  std::vector<Range> ranges_;  // near the present cell
};

extern template class NearCells<2>;
extern template class NearCells<3>;

}  // namespace clatter
