#include "engine/measure/totals.h"

#include <cmath>

namespace clatter {

template <int D>
static Vec<D> sum_of_squares(const Simulation<D>& simulation) {
  Vec<D> sum = Vec<D>::Zero();
  for (const Disk<D>& disk : simulation.disks()) sum += disk.flight.v.cwiseAbs2();
  return sum;
}

template <int D>
Totals<D>::Totals(const Simulation<D>& simulation)
    : simulation_(simulation),
      energy_at_start_(simulation.kinetic_energy()),
      squares_(sum_of_squares(simulation)),
      integrated_to_(simulation.base_time()),
      window_start_(integrated_to_) {}

template <int D>
void Totals<D>::integrate_to(double time) {
  integral_ += squares_ * (time - integrated_to_);
  integrated_to_ = time;
}

template <int D>
void Totals<D>::change(const Vec<D>& before, const Vec<D>& after, double time) {
  integrate_to(time);
  squares_ += (after - before).cwiseProduct(after + before);
}

template <int D>
void Totals<D>::on_collision(const PairCollision<D>& collision) {
  change(collision.before[0].v, collision.before[0].v + collision.impulse, collision.time);
  change(collision.before[1].v, collision.before[1].v - collision.impulse, collision.time);
  const double gained = collision.energy[0] + collision.energy[1];
  booked_ += gained;
  booked_sizes_ += std::fabs(gained);
  window_.collisions += 1.0;
  window_.dissipated -= gained;
  window_.virial += collision.impulse.dot(collision.separation);
}

template <int D>
void Totals<D>::on_wall(const WallCollision<D>& collision) {
  change(collision.before.v, collision.before.v + collision.impulse, collision.time);
  booked_ += collision.energy;
  booked_sizes_ += std::fabs(collision.energy);
  window_.walls_in += collision.energy;
  window_.wall_impulse[collision.side] += std::fabs(collision.impulse[collision.side / 2]);
}

template <int D>
void Totals<D>::on_base_moved(double shift) {
  integrated_to_ -= shift;
  window_start_ -= shift;
}

template <int D>
WindowTotals<D> Totals<D>::close_window() {
  const double now = simulation_.base_time();
  integrate_to(now);
  const double count = static_cast<double>(simulation_.disks().size());
  window_.duration = now - window_start_;
  for (const Disk<D>& disk : simulation_.disks()) {
    const Vec<D> squares = disk.flight.v.cwiseAbs2();
    window_.second_moment += squares / count;
    window_.fourth_moment += squares.cwiseAbs2() / count;
  }
  if (count > 0.0 && window_.duration > 0.0) {
    window_.temperature = integral_ / (window_.duration * count);
  }
  const WindowTotals<D> closed = window_;
  window_ = {};
  integral_.setZero();
  squares_ = sum_of_squares(simulation_);  // sheds the rounding of the increments
  window_start_ = now;
  return closed;
}

template <int D>
double Totals<D>::ledger_residual() const {
  const double energy = simulation_.kinetic_energy();
  const double scale = energy + booked_sizes_;
  return scale > 0.0 ? std::fabs(energy - energy_at_start_ - booked_) / scale : 0.0;
}

template class Totals<2>;

}  // namespace clatter
