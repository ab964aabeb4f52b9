#pragma once

#include <array>
#include <cstdint>
#include <vector>

#include "engine/dynamics/observer.h"
#include "engine/dynamics/simulation.h"
#include "engine/measure/field_grid.h"

namespace clatter {

/// What the balance equations account for: mass, the D components of momentum, and energy, of
/// motion and of spin.
template <int D>
using Conserved = Eigen::Matrix<double, D + 2, 1>;

/// A sum of bookings.
template <int D>
struct Booked {
  Conserved<D> net = Conserved<D>::Zero();
  Conserved<D> size = Conserved<D>::Zero();  ///< sum of what was booked, each without its sign
};

/// Passes over all members, in order, for checkpoints.
template <class Archive, int D>
void visit(Archive& io, Booked<D>& sum) {
  auto& [net, size] = sum;
  io(net, size);
}

/// All that was booked in one window of time; [cells] each, cell (i, j) at i + j cells.x().
template <int D>
struct Bookings {
  /// What passed in the direction of each axis through the cells' upper faces across it: particles,
  /// and what collisions carry along their branch.
  std::array<std::vector<Booked<D>>, D> faces;
  /// What arose in the cells: dissipation, gravity, kicks, and what came in through walls.
  std::vector<Booked<D>> sources;
  /// Sizes of what changed the motion of the particles inside, in events and by gravity: what the
  /// faces and sources brought, before any of it cancelled, and 1e-9 of the momentum and energy of
  /// each particle that changed, which are known to rounding.
  std::vector<Conserved<D>> weights;
};

/// Passes over all members, in order, for checkpoints.
template <class Archive, int D>
void visit(Archive& io, Bookings<D>& bookings) {
  auto& [faces, sources, weights] = bookings;
  io(faces, sources, weights);
}

/// What the balance equations (theory 9.1-9.3) leave open over some time; [cells] each, cell (i, j)
/// at i + j cells.x().
template <int D>
struct Imbalances {
  std::vector<Conserved<D>> gaps;  ///< change of what the cell holds - booked
  /// Sum of the sizes of all that was booked at the cell: through its faces, as its sources, and
  /// the weights.
  std::vector<Conserved<D>> sizes;

  /// A cell's gaps over their sizes, of either sign. Where there is no gap, 0; where nothing was
  /// booked and the cell changed all the same, 1 or -1; where that is no number, infinite.
  Conserved<D> residual(std::size_t cell) const;
  /// The largest magnitude of each equation's residuals.
  Conserved<D> largest() const;
  /// Adds those of another time, of the same cells.
  Imbalances& operator+=(const Imbalances& other);
};

/// Passes over all members, in order, for checkpoints.
template <class Archive, int D>
void visit(Archive& io, Imbalances<D>& imbalances) {
  auto& [gaps, sizes] = imbalances;
  io(gaps, sizes);
}

/// How the balance equations close in one window of time.
template <int D>
struct BalanceWindow {
  Imbalances<D> imbalances;
  Bookings<D> booked;  ///< what the cells' changes were compared with
};

/// Closes the balance equations (theory 9.4) on a grid of equal cells over the whole box: what the
/// cells hold, from the particles' states at a window's two ends, against what was booked at faces
/// and as sources in between.
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

  /// What a checkpoint keeps, of a simulation that goes on at the same time.
  template <class Archive>
  void visit(Archive& io) {
    auto& [simulation, grid, particles, window_start, booked] = *this;
    io(particles, window_start, booked);
    for (const Tracked& particle : particles) {
      io.require(particle.first_cell < grid.size() && grid.is_near(particle.cell));
    }
  }

 private:
  using Cell = typename FieldGrid<D>::Cell;

  /// A particle as far as it has been followed, and what it was at the window's start.
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

  double half_inertia() const;
  Spin<D> spin(std::uint32_t particle) const;
  Conserved<D> carried(const Vec<D>& velocity, const Spin<D>& spin) const;
  Conserved<D> gained(const Tracked& particle, const Vec<D>& velocity, const Spin<D>& spin) const;
  void follow(std::uint32_t particle, const Flight<D>& flight, double end);
  Conserved<D> rounding(const Vec<D>& velocity, const Spin<D>& spin) const;
  void fall(std::uint32_t particle, const Cell& cell, const Flight<D>& flight, double begin,
            double end);
  void weigh(const ParticleChange<D>& change);
  void transport(const Vec<D>& start, const Vec<D>& branch, const Cell& from, const Cell& to,
                 const Conserved<D>& amount);
  void pass(const Cell& cell, int axis, int step, const Conserved<D>& amount);
  void arise(const Cell& cell, const Conserved<D>& amount);
  void clear();
  Imbalances<D> take_changes(double now);
  Booked<D> booked_at(std::size_t index) const;

  const Simulation<D>& simulation_;
  FieldGrid<D> grid_;
  std::vector<Tracked> particles_;  // [N]
  double window_start_;
  Bookings<D> booked_;
};

extern template struct Imbalances<2>;
extern template struct Imbalances<3>;
extern template class Balance<2>;
extern template class Balance<3>;

}  // namespace clatter
