#pragma once

#include <array>
#include <cstdint>
#include <vector>

#include "engine/dynamics/observer.h"
#include "engine/dynamics/simulation.h"

namespace clatter {

/// Sums and averages of the whole gas over one window of time.
template <int D>
struct WindowTotals {
  double duration = 0.0;
  Vec<D> temperature = Vec<D>::Zero();       ///< T_k: exact time averages of <m v_k^2>
  Vec<D> second_moment = Vec<D>::Zero();     ///< <m v_k^2> over the particles at the window's end
  Vec<D> fourth_moment = Vec<D>::Zero();     ///< <(m v_k^2)^2> at the window's end
  double collisions = 0.0;                   ///< between particles
  double elasticised = 0.0;                  ///< of these, made elastic by the TC model
  double spin_temperature = 0.0;             ///< exact time average of <I omega^2> per component
  double walls_in = 0.0;                     ///< energy input of walls and fixtures
  double bulk_in = 0.0;                      ///< energy input of kicks
  double nudges_in = 0.0;                    ///< energy input of nudges and puffs
  double gravity_in = 0.0;                   ///< work of gravity on the flights that ended
  double shear_in = 0.0;                     ///< work of the shear
  /// [8] in the plane of the flow of a sheared box: averages over time of sum m c_a c_b as [2 a +
  /// b], then sums of x_a J_b over pair collisions, of separation and momentum (theory 14.2).
  /// Otherwise empty.
  std::vector<double> plane;
  double dissipated = 0.0;                   ///< energy lost between particles, > 0
  double undissipated = 0.0;                 ///< energy that the TC model saved from dissipation
  double virial = 0.0;                       ///< sum of impulse.separation over pair collisions
  std::array<double, 2 * D> wall_impulse{};  ///< momentum transfer to each wall, along its normal
  /// [2D x D] momentum transfer to each wall along its surface, if a wall slides. Otherwise empty.
  std::vector<double> wall_drag;
};

/// Visits all members, in order, for checkpoints.
template <class Archive, int D>
void visit(Archive& io, WindowTotals<D>& window) {
  auto& [duration, temperature, second_moment, fourth_moment, collisions, elasticised,
         spin_temperature, walls_in, bulk_in, nudges_in, gravity_in, shear_in, plane, dissipated,
         undissipated, virial, wall_impulse, wall_drag] = window;
  io(duration, temperature, second_moment, fourth_moment, collisions, elasticised, spin_temperature,
     walls_in, bulk_in, nudges_in, gravity_in, shear_in, plane, dissipated, undissipated, virial,
     wall_impulse, wall_drag);
}

/// Books energy and momentum of every event, of gravity and of a sheared flow, and averages the
/// temperatures exactly over time. Velocities are those without the flow.
template <int D>
class Totals : public Observer<D> {
 public:
  /// Watches a simulation from now on. Neither may be used after the other is destroyed.
  explicit Totals(const Simulation<D>& simulation);

  void on_collision(const PairCollision<D>& collision) override;
  void on_wall(const WallCollision<D>& collision) override;
  void on_kick(const Kick<D>& kick) override;
  void on_base_moved(double shift) override;
  void before_laws(const Model<D>& next) override;
  void on_laws() override;

  /// The totals since the last call, or since the start.
  WindowTotals<D> close_window();

  /// Residual of the energy balance: the kinetic energy minus its start value and all bookings,
  /// divided by the energy plus the magnitudes of all bookings.
  double ledger_residual() const;

  /// Visits the members that a checkpoint keeps. The continued simulation must be at the same time.
  template <class Archive>
  void visit(Archive& io);

 private:
  // Sums that events carry along gather rounding. Stock is due when each particle, on average, has
  // changed.
  static constexpr std::uint64_t kDue = std::uint64_t{1} << 63;
  bool is_stock_due() const { return changes_ >= simulation_.particles().size(); }

  void change(const ParticleChange<D>& particle, double time);
  void fit_window();
  void shear_to(double dt);
  void book_shear(const Flight<D>& flight, double mass, double time);
  double rate() const { return simulation_.model().shear_rate.value_or(0.0); }
  void integrate_to(double time);
  double energy_of_starts() const;
  bool accelerates() const;
  void take_stock();
  void add_quartics(double mass, const Vec<D>& velocity, double time, double share);
  Vec<D> quartics_at(double time) const;
  void end_flights();
  void change_inertia(double before, double after);
  void book(double gained);
  void book_work(double mass, const Vec<D>& distance);

  const Simulation<D>& simulation_;
  double energy_at_start_;
  double booked_ = 0.0;               // energy gain since the start, by events and ended flights
  double booked_sizes_ = 0.0;         // sum of |bookings|
  std::size_t count_ = 0;             // of particles
  double mass_ = 0.0;                 // of all particles
  Vec<D> squares_ = Vec<D>::Zero();   // sum of m v_k^2 at integrated_to_
  Vec<D> momentum_ = Vec<D>::Zero();  // sum of m v_k at integrated_to_
  double cross_ = 0.0;                // sum of m c_x c_y in a sheared box
  double spin_squares_ = 0.0;         // sum of I omega^2
  // Sum of (m v_k^2)^2, a polynomial of the time since stock was taken.
  std::array<Vec<D>, 5> quartics_;
  double stock_taken_ = 0.0;          // time of the last stock, on the base
  std::uint64_t changes_ = 0;         // of particles since then
  double integrated_to_;              // upper limit of the integrals, on the base
  double window_start_;
  Vec<D> integral_ = Vec<D>::Zero();  // of squares_ over time, in this window
  double cross_integral_ = 0.0;       // of cross_
  double spin_integral_ = 0.0;        // of spin_squares_
  WindowTotals<D> window_;
};

template <int D>
template <class Archive>
void Totals<D>::visit(Archive& io) {
  auto& [simulation, energy_at_start, booked, booked_sizes, count, mass, squares, momentum, cross,
         spin_squares, quartics, stock_taken, changes, integrated_to, window_start, integral,
         cross_integral, spin_integral, window] = *this;
  const double inertia = simulation.model().inertia;
  double saved_inertia = inertia;
  io(saved_inertia, energy_at_start, booked, booked_sizes, count, mass, squares, momentum, cross,
     spin_squares, quartics, stock_taken, changes, integrated_to, window_start, integral,
     cross_integral, spin_integral, window);
  change_inertia(saved_inertia, inertia);
}

extern template class Totals<2>;
extern template class Totals<3>;

}  // namespace clatter
