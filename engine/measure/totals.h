#pragma once

#include <array>
#include <cstdint>
#include <vector>

#include "engine/dynamics/observer.h"
#include "engine/dynamics/simulation.h"

namespace clatter {

/// What happened to the whole gas during one window of time.
template <int D>
struct WindowTotals {
  double duration = 0.0;
  Vec<D> temperature = Vec<D>::Zero();    ///< T_x, T_y: exact time averages of m <v_k^2>
  Vec<D> second_moment = Vec<D>::Zero();  ///< <v_k^2> over the disks at the window's end
  Vec<D> fourth_moment = Vec<D>::Zero();  ///< <v_k^4> there
  double collisions = 0.0;                ///< disk-disk
  double walls_in = 0.0;                  ///< energy that the walls gave
  double dissipated = 0.0;                ///< energy lost between disks, > 0
  double virial = 0.0;                    ///< sum of impulse.separation over disk-disk collisions
  std::array<double, 2 * D> wall_impulse{};  ///< momentum that each wall took up, along its normal
};

/// Books energy and momentum of every event, and averages the temperature exactly over time:
/// between events it does not change.
template <int D>
class Totals : public Observer<D> {
 public:
  /// Watches a simulation from now on; both must outlive each other's use.
  explicit Totals(const Simulation<D>& simulation);

  void on_collision(const PairCollision<D>& collision) override;
  void on_wall(const WallCollision<D>& collision) override;
  void on_base_moved(double shift) override;

  /// What happened since the last call, or since the start.
  WindowTotals<D> close_window();

  /// What the kinetic energy differs by from the energy at the start plus all bookings, relative to
  /// the energy plus the sum of all bookings' sizes.
  double ledger_residual() const;

 private:
  void change(const Vec<D>& before, const Vec<D>& after, double time);
  void integrate_to(double time);

  const Simulation<D>& simulation_;
  double energy_at_start_;
  double booked_ = 0.0;        // energy gained since the start
  double booked_sizes_ = 0.0;  // sum of |bookings|
  Vec<D> squares_;             // sum of v_k^2 now
  double integrated_to_;       // time on the base up to which integral_ reaches
  double window_start_;
  Vec<D> integral_ = Vec<D>::Zero();  // of squares_ over time, in this window
  WindowTotals<D> window_;
};

extern template class Totals<2>;

}  // namespace clatter
