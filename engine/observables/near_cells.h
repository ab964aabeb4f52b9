#pragma once

#include <algorithm>
#include <array>
#include <cstddef>
#include <cstdint>
#include <vector>

#include "engine/dynamics/simulation.h"
#include "engine/laws/model.h"
#include "engine/vec.h"

namespace clatter {

/// Particles sorted into cells, to visit all pairs within a range. Rows of cells are parallel to x,
/// and continue beyond periodic borders with images of their particles. So the particles near
/// another one are a few runs of consecutive entries.
template <int D>
class NearCells {
 public:
  /// Consecutive entries that may be within the range of a particle, and follow it.
  struct Run {
    std::size_t begin, end;
    Vec<D> from;  ///< the particle's position relative to these entries
  };
  /// A run may be extended by so many entries. They are beyond the range.
  static constexpr std::size_t kPadding = 8;

  /// Cells for a number of particles. The range is shortened to half the shortest period.
  NearCells(const Model<D>& model, std::size_t particles, double range);

  /// The range of the pairs.
  double range() const { return range_; }
  /// Number of cells.
  std::size_t cells() const { return static_cast<std::size_t>(cells_.prod()); }
  /// Sorts particles by their positions in the box, whose images are those of the domain.
  void sort(const std::vector<Vec<D>>& positions, const Domain<D>& domain);
  /// [axis][entries] coordinates of particles and images; infinite in gaps between rows.
  const std::array<std::vector<double>, D>& coordinates() const { return coordinates_; }

  /// Calls visit(entry, run) for each run of each particle, at entry `entry`. All runs together
  /// have each pair within the range once.
  template <class Visit>
  [[gnu::always_inline]] void each_run(const Visit& visit) const;

  /// Calls visit(first, second, separation) for each pair within the range, in an order that
  /// depends on the positions only. The separation points from the second to the first particle.
  template <class Visit>
  void each_pair(const Visit& visit) const {
    each_run([&](std::size_t first, const Run& run) {
      for (std::size_t second = run.begin; second < run.end; ++second) {
        const Vec<D> apart = run.from - position(second);
        if (apart.squaredNorm() <= range_ * range_) {
          visit(particles_[first], particles_[second], apart);
        }
      }
    });
  }

 private:
  // Cells per range: along x they may be narrow, because runs follow x.
  static constexpr int kAlongX = 4;
  static constexpr int kAcross = 2;

  // A row near another one and later than it, or the image of a row.
  struct NearRow {
    std::size_t row;
    Vec<D> shift;  // of the image
  };

  // Cells at one place along x. Beyond the ends of the box it holds images.
  struct Column {
    std::size_t cell;  // along x, in the box
    double shift;      // of the images
  };

  void choose_cells(std::size_t particles);
  void list_columns(bool periodic);
  void find_near_rows(const Model<D>& model);
  std::size_t cell_of(const Vec<D>& position) const;
  std::size_t fill_row(std::size_t row, const std::vector<Vec<D>>& positions, std::size_t entry);
  Run sheared_run(Vec<D> from, bool above, const std::size_t* row) const;
  Vec<D> position(std::size_t entry) const {
    Vec<D> position;
    for (int axis = 0; axis < D; ++axis) position[axis] = coordinates_[axis][entry];
    return position;
  }

  Vec<D> box_;
  double range_;
  IntVec<D> cells_;  // along each axis; x is fastest
  IntVec<D> reach_;  // number of near cells to either side
  Vec<D> cells_per_length_;
  double offset_ = 0.0;  // along x of the next images above; 0 without shear
  std::size_t images_;   // columns of images at either end of a row
  std::vector<Column> columns_;
  std::vector<std::vector<NearRow>> near_rows_;  // [rows]
  std::vector<std::size_t> cell_of_particle_;    // [N]
  std::vector<std::size_t> first_in_cell_;       // [cells + 1] index into sorted_
  std::vector<std::uint32_t> sorted_;            // [N] particles in the order of cells
  std::vector<std::size_t> first_;               // [rows][columns + 1] first entry
  std::array<std::vector<double>, D> coordinates_;
  std::vector<std::uint32_t> particles_;  // [entries] numbers of the particles
};

template <int D>
template <class Visit>
inline void NearCells<D>::each_run(const Visit& visit) const {
  const auto along = static_cast<std::size_t>(cells_[0]);
  const auto reach = static_cast<std::size_t>(reach_[0]);
  const std::size_t columns = columns_.size();
  for (std::size_t row = 0; row < near_rows_.size(); ++row) {
    const std::vector<NearRow>& near = near_rows_[row];
    const std::size_t* const first = &first_[row * (columns + 1)];
    for (std::size_t column = images_; column < images_ + along; ++column) {
      const std::size_t low = column < reach ? 0 : column - reach;
      const std::size_t high = std::min(column + reach + 1, columns);
      for (std::size_t entry = first[column]; entry < first[column + 1]; ++entry) {
        const Vec<D> own = position(entry);
        visit(entry, Run{entry + 1, first[high], own});
        for (const NearRow& other : near) {
          const std::size_t* const start = &first_[other.row * (columns + 1)];
          if (offset_ != 0.0 && other.shift[1] != 0.0) [[unlikely]] {
            visit(entry, sheared_run(own - other.shift, other.shift[1] > 0.0, start));
          } else {
            visit(entry, Run{start[low], start[high], own - other.shift});
          }
        }
      }
    }
  }
}

extern template class NearCells<2>;
extern template class NearCells<3>;

/// Whether two particles that NearCells has found are within `range` times the distance of their
/// centres at contact. All pairs of particles that are alike are.
template <int D>
bool are_near(const Simulation<D>& simulation, std::uint32_t first, std::uint32_t second,
              const Vec<D>& apart, double range) {
  if (!simulation.is_mixture()) return true;
  const double contact = simulation.grain(first).radius + simulation.grain(second).radius;
  return apart.squaredNorm() <= range * range * contact * contact;
}

}  // namespace clatter
