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

/// Sums of a grid over a window of time (theory 8.1-8.7), before the division by time and area.
/// With box cells, kinetic sums are integrals over the time that particles spend in a cell. Sums
/// over events are weighted with the share of the branch vector in the cell.
struct CellSums {
  double time = 0.0;  ///< the window's length, the divisor of sums over events
  /// Divisor of kinetic sums: the window's length, or the number of samples.
  double kinetic_weight = 0.0;
  std::vector<double> rows;  ///< [cells][MomentLayout::size]

  /// Adds the sums of another window, member by member.
  CellSums& operator+=(const CellSums& other);
  /// Memory of the rows.
  std::size_t bytes() const { return rows.size() * sizeof(double); }
};

/// Visits all members, in order, for checkpoints.
template <class Archive>
void visit(Archive& io, CellSums& sums) {
  auto& [time, kinetic_weight, rows] = sums;
  io(time, kinetic_weight, rows);
}

/// Number of blocks of `block` cells along each axis. The last block of an axis may have fewer
/// cells.
template <int D>
IntVec<D> block_counts(const FieldGrid<D>& grid, const IntVec<D>& block) {
  return (grid.cells().array() + block.array() - 1) / block.array();
}

/// The sums of a grid's cells added over these blocks, one row per block, x fastest.
template <int D>
CellSums block_sums(const CellSums& cells, const FieldGrid<D>& grid, const IntVec<D>& block);

/// Coarse-graining: estimator and kernel.
struct Coarsening {
  Estimator estimator = Estimator::Exact;
  std::optional<double> gaussian_width;  ///< absent: box cells
};

/// Accumulates the sums for fields on a grid of equal cells over the whole box. The exact estimator
/// (track-length estimator) cuts each free flight at the cell borders. It adds the time spent in
/// each cell, times 1, v_k, v_k v_l and so on. The snapshot estimator adds the particles at their
/// positions whenever sample() is called. Collisions add to the cells along the branch vector. It
/// points from particle 2, or from the contact point on a wall, to particle 1. In a sheared box
/// velocities are without the flow, and the cells are those of the box at rest (theory 14).
template <int D>
class CellIntegrals : public Observer<D> {
 public:
  /// Watches a simulation from now on with the given number of cells along each axis. A Gaussian
  /// requires the snapshot estimator.
  CellIntegrals(const Simulation<D>& simulation, const IntVec<D>& cells,
                const MomentLayout<D>& layout, const Coarsening& coarsening = {});

  void on_collision(const PairCollision<D>& collision) override;
  void on_wall(const WallCollision<D>& collision) override;
  void on_kick(const Kick<D>& kick) override;
  void on_base_moved(double shift) override;
  void on_laws() override;

  /// Takes a sample of all particles at the simulation's time (snapshot estimator).
  void sample();

  /// The sums since the last call, or since the start.
  CellSums close_window();

  /// The cells.
  const FieldGrid<D>& grid() const { return grid_; }
  /// The layout of a row of sums.
  const MomentLayout<D>& layout() const { return layout_; }

  /// Visits the members that a checkpoint keeps. The continued simulation must be at the same time.
  template <class Archive>
  void visit(Archive& io) {
    auto& [simulation, grid, layout, estimator, dissipates, gaussian, window_start, sums] = *this;
    io(window_start, sums);
  }

 private:
  /// Kinetic sums of one particle, per time.
  using Rates = std::array<double, 3 + 3 * D + D*(D - 1) / 2 + kSpinSize<D>>;

  Rates rates_of(const Grain& grain, const Vec<D>& v, const Vec<D>& change,
                 const Spin<D>& spin) const;
  template <class Mass>
  Rates rates_of(Mass mass, const Grain& grain, const Vec<D>& v, const Vec<D>& change,
                 const Spin<D>& spin) const;
  void add_flight(const Grain& grain, const Flight<D>& flight, const Spin<D>& spin, double end);
  void add_fall(const Grain& grain, const Flight<D>& flight, const Spin<D>& spin, double begin,
                double end);
  void end_flight(const ParticleChange<D>& particle, double time);
  void add_transfer(const Vec<D>& from, const Vec<D>& branch, const Vec<D>& momentum,
                    double energy);
  void add_dissipation(const Vec<D>& place, double energy);
  void add_drag(const ParticleChange<D>& particle, const Vec<D>& place);
  void add(std::size_t cell, int begin, int end, const double* numbers, double weight);
  void add_kinetic(std::size_t cell, const Grain& grain, const Rates& rates, double weight);
  template <class Visit>
  void spread(const Vec<D>& place, Visit&& visit) const;
  template <class Visit>
  void spread(const Vec<D>& from, const Vec<D>& along, Visit&& visit) const;

  const Simulation<D>& simulation_;
  FieldGrid<D> grid_;
  MomentLayout<D> layout_;
  Estimator estimator_;
  bool dissipates_;  // whether collisions between particles dissipate
  std::optional<GaussianKernel<D>> gaussian_;
  double window_start_;
  CellSums sums_;
};

extern template class CellIntegrals<2>;
extern template class CellIntegrals<3>;

}  // namespace clatter
