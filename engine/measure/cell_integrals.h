#pragma once

#include <array>
#include <optional>
#include <vector>

#include "engine/dynamics/observer.h"
#include "engine/dynamics/simulation.h"
#include "engine/measure/field_grid.h"
#include "engine/measure/gaussian_kernel.h"
#include "engine/measure/moment_layout.h"

namespace clatter {

/// What a grid has summed up over a window of time (theory 8.1-8.7) before the division by time
/// and area. With box cells a kinetic sum of particles in a cell is an integral over time, and one
/// over events has the share of the branch vector that lies in the cell as its weight.
struct CellSums {
  double time = 0.0;  ///< the window's length, by which sums over events are to be divided
  /// What kinetic sums are to be divided by: that length too, or the number of samples.
  double kinetic_weight = 0.0;
  std::vector<double> rows;  ///< [cells][MomentLayout::size]

  /// Adds the sums of another window, member by member.
  CellSums& operator+=(const CellSums& other);
};

/// Passes over all members, in order, for checkpoints.
template <class Archive>
void visit(Archive& io, CellSums& sums) {
  auto& [time, kinetic_weight, rows] = sums;
  io(time, kinetic_weight, rows);
}

/// Number of blocks of `block` cells along each axis; the last along an axis may have fewer cells.
template <int D>
IntVec<D> block_counts(const FieldGrid<D>& grid, const IntVec<D>& block) {
  return (grid.cells().array() + block.array() - 1) / block.array();
}

/// The sums of a grid's cells, added up over these blocks; the rows of the blocks, x fastest.
template <int D>
CellSums block_sums(const CellSums& cells, const FieldGrid<D>& grid, const IntVec<D>& block);

/// How particles and collisions are spread over cells.
struct Coarsening {
  Estimator estimator = Estimator::Exact;
  std::optional<double> gaussian_width;  ///< absent: box cells
};

/// Sums up what fields need on a grid of equal cells over the whole box. Exact: each free flight is
/// cut at the cell borders and counts the time spent in each cell, times 1, v_k, v_k v_l and so on
/// (the track-length estimator). Snapshot: particles count where they are whenever sample() is
/// called. Collisions count at once, along the branch vector from particle 2, or from the contact
/// point on a wall, to particle 1.
template <int D>
class CellIntegrals : public Observer<D> {
 public:
  /// Watches a simulation from now on with the given number of cells along each axis. A Gaussian
  /// is for the snapshot estimator only.
  CellIntegrals(const Simulation<D>& simulation, const IntVec<D>& cells,
                const MomentLayout<D>& layout, const Coarsening& coarsening = {});

  void on_collision(const PairCollision<D>& collision) override;
  void on_wall(const WallCollision<D>& collision) override;
  void on_kick(const Kick<D>& kick) override;
  void on_base_moved(double shift) override;

  /// Counts every particle where it is at the simulation's time; of the snapshot estimator.
  void sample();

  /// The sums since the last call, or since the start.
  CellSums close_window();

  /// The cells.
  const FieldGrid<D>& grid() const { return grid_; }
  /// Which sums stand where.
  const MomentLayout<D>& layout() const { return layout_; }

  /// What a checkpoint keeps, of a simulation that goes on at the same time.
  template <class Archive>
  void visit(Archive& io) {
    auto& [simulation, grid, layout, estimator, dissipates, gaussian, window_start, sums] = *this;
    io(window_start, sums);
  }

 private:
  /// A row of kinetic sums, per particle.
  using Rates = std::array<double, 2 + 3 * D + D*(D - 1) / 2 + kSpinSize<D>>;

  Rates rates_of(const Vec<D>& v, const Vec<D>& change, const Spin<D>& spin) const;
  void add_flight(const Flight<D>& flight, const Spin<D>& spin, double end);
  void add_fall(const Flight<D>& flight, const Spin<D>& spin, double begin, double end);
  void end_flight(const ParticleChange<D>& particle, double time);
  void add_transfer(const Vec<D>& from, const Vec<D>& branch, const Vec<D>& momentum,
                    double energy);
  void add_dissipation(const Vec<D>& place, double energy);
  void add(std::size_t cell, int begin, int end, const double* numbers, double weight);
  template <class Visit>
  void spread(const Vec<D>& place, Visit&& visit) const;
  template <class Visit>
  void spread(const Vec<D>& from, const Vec<D>& along, Visit&& visit) const;

  const Simulation<D>& simulation_;
  FieldGrid<D> grid_;
  MomentLayout<D> layout_;
  Estimator estimator_;
  bool dissipates_;  // whether collisions of particles do
  std::optional<GaussianKernel<D>> gaussian_;
  double window_start_;
  CellSums sums_;
};

extern template class CellIntegrals<2>;
extern template class CellIntegrals<3>;

}  // namespace clatter
