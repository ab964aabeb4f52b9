#pragma once

#include <array>
#include <cstdint>
#include <vector>

#include "engine/dynamics/observer.h"
#include "engine/dynamics/simulation.h"
#include "engine/measure/field_grid.h"

// Balances close. Balance books the fluxes through the faces of cells and the sources in cells. It
// compares them with the disks' states at both ends of a window. Measurement keeps the largest
// residual of each cell (Residuals), and so does LiveResiduals for the plot of the window.
// LiveField has the residuals of its averaging window.

namespace clatter {

/// The conserved quantities of the balance equations: mass, D components of momentum, and energy of
/// motion and spin.
template <int D>
using Conserved = Eigen::Matrix<double, D + 2, 1>;

/// A sum of bookings.
template <int D>
struct Booked {
  Conserved<D> net = Conserved<D>::Zero();
  Conserved<D> size = Conserved<D>::Zero();  ///< sum of the bookings' magnitudes
};

/// Visits all members, in order, for checkpoints.
template <class Archive, int D>
void visit(Archive& io, Booked<D>& sum) {
  auto& [net, size] = sum;
  io(net, size);
}

/// The bookings of one window of time. Each list has [cells] elements, cell (i, j) at i + j
/// cells.x().
template <int D>
struct Bookings {
  /// Flux along each axis through the cells' upper faces: particles, and transfers of collisions
  /// along their branch vectors.
  std::array<std::vector<Booked<D>>, D> faces;
  /// Sources in the cells: dissipation, gravity, kicks, and contributions of walls.
  std::vector<Booked<D>> sources;
  /// Magnitudes of the changes of the particles in the cell, by events and gravity, before
  /// cancellation. For each change they also contain 1e-9 of the particle's momentum and energy,
  /// for rounding.
  std::vector<Conserved<D>> weights;
};

/// Visits all members, in order, for checkpoints.
template <class Archive, int D>
void visit(Archive& io, Bookings<D>& bookings) {
  auto& [faces, sources, weights] = bookings;
  io(faces, sources, weights);
}

/// Imbalances of the balance equations (theory 9.1-9.3) over some time. Each list has [cells]
/// elements, cell (i, j) at i + j cells.x().
template <int D>
struct Imbalances {
  std::vector<Conserved<D>> gaps;  ///< change of the cell's content - bookings
  /// Sum of the magnitudes of all bookings at the cell: faces, sources and weights.
  std::vector<Conserved<D>> sizes;

  /// A cell's residuals: gaps divided by sizes, with sign. 0 without a gap; 1 or -1 for a gap
  /// without bookings; infinite if the quotient is NaN.
  Conserved<D> residual(std::size_t cell) const;
  /// The largest magnitude of each equation's residuals.
  Conserved<D> largest() const;
  /// Adds the imbalances of the same cells over another time.
  Imbalances& operator+=(const Imbalances& other);
};

/// Visits all members, in order, for checkpoints.
template <class Archive, int D>
void visit(Archive& io, Imbalances<D>& imbalances) {
  auto& [gaps, sizes] = imbalances;
  io(gaps, sizes);
}

/// Numbers of particles of each species of a mixture: [cells][S], each list empty without species.
template <int D>
struct SpeciesNumbers {
  std::array<std::vector<double>, D> faces;  ///< net passages along each axis of the upper faces
  std::vector<double> passages;              ///< into and out of the cell, added up
};

/// Visits all members, in order, for checkpoints.
template <class Archive, int D>
void visit(Archive& io, SpeciesNumbers<D>& numbers) {
  auto& [faces, passages] = numbers;
  io(faces, passages);
}

/// The balance equations in one window of time.
template <int D>
struct BalanceWindow {
  Imbalances<D> imbalances;
  Bookings<D> booked;  ///< compared with the cells' changes
  /// [cells][S] residuals of the numbers of each species (theory 12.9), relative to the passages;
  /// empty without species.
  std::vector<double> number_residuals = {};
};

/// Closes the balance equations (theory 9.4) on a grid of equal cells over the whole box. It
/// compares the change of the cells' contents, from the particles' states at a window's two ends,
/// with the bookings at faces and as sources.
template <int D>
class Balance : public Observer<D> {
 public:
  /// Watches a simulation from now on with the given number of cells along each axis.
  Balance(const Simulation<D>& simulation, const IntVec<D>& cells);

  void on_collision(const PairCollision<D>& collision) override;
  void on_wall(const WallCollision<D>& collision) override;
  void on_kick(const Kick<D>& kick) override;
  void on_base_moved(double shift) override;

  /// The balance since the last call, or since the start.
  BalanceWindow<D> close_window();

  /// Number of cells along each axis.
  const IntVec<D>& cells() const { return grid_.cells(); }

  /// Visits the members that a checkpoint keeps. The continued simulation must be at the same time.
  template <class Archive>
  void visit(Archive& io) {
    auto& [simulation, grid, particles, window_start, booked, species, numbers] = *this;
    io(particles, window_start, booked, numbers);
    for (const Tracked& particle : particles) {
      io.require(particle.first_cell < grid.size() && grid.is_near(particle.cell));
    }
  }

 private:
  using Cell = typename FieldGrid<D>::Cell;

  /// A particle's tracked cell, and its state at the window's start.
  struct Tracked {
    Cell cell;
    std::uint64_t first_cell;  // index
    Vec<D> first_velocity;
    Spin<D> first_spin;

    template <class Archive>
    void visit(Archive& io) {
      auto& [cell, first_cell, first_velocity, first_spin] = *this;
      io(cell, first_cell, first_velocity, first_spin);
    }
  };

  Spin<D> spin(std::uint32_t particle) const;
  Conserved<D> carried(std::uint32_t particle, const Vec<D>& velocity, const Spin<D>& spin) const;
  Conserved<D> gained(std::uint32_t particle, const Vec<D>& velocity, const Spin<D>& spin) const;
  void follow(std::uint32_t particle, const Flight<D>& flight, double end);
  Conserved<D> rounding(std::uint32_t particle, const Vec<D>& velocity) const;
  void fall(std::uint32_t particle, const Cell& cell, const Flight<D>& flight, double begin,
            double end);
  void weigh(const ParticleChange<D>& change);
  void transport(const Vec<D>& start, const Vec<D>& branch, const Cell& from, const Cell& to,
                 const Conserved<D>& amount);
  void pass(const Cell& cell, int axis, int step, const Conserved<D>& amount);
  void arise(const Cell& cell, const Conserved<D>& amount);
  void count_passage(std::uint32_t particle, const Cell& cell, int axis, int step);
  std::size_t number_index(std::size_t cell, std::uint32_t particle) const;
  std::vector<double> number_residuals(const std::vector<double>& changes) const;
  void clear();
  Imbalances<D> take_changes(double now, std::vector<double>& numbers);
  Booked<D> booked_at(std::size_t index) const;

  const Simulation<D>& simulation_;
  FieldGrid<D> grid_;
  std::vector<Tracked> particles_;  // [N]
  double window_start_;
  Bookings<D> booked_;
  std::size_t species_;  // number of species of a mixture; 0: the particles are alike
  SpeciesNumbers<D> numbers_;
};

extern template struct Imbalances<2>;
extern template struct Imbalances<3>;
extern template class Balance<2>;
extern template class Balance<3>;

}  // namespace clatter
