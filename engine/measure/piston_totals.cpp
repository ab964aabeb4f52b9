#include "engine/measure/piston_totals.h"

#include <cmath>
#include <vector>

namespace clatter {

template <int D>
PistonTotals<D>::PistonTotals(const Simulation<D>& simulation)
    : simulation_(simulation),
      window_start_(simulation.base_time()),
      integrated_to_(simulation.base_time()) {}

// The integrals of a polynomial in time.
template <int D>
void PistonTotals<D>::integrate(const PistonFlight& flight, double time) {
  const double t = time - integrated_to_, a = flight.acceleration;
  const double x = flight.at(integrated_to_) - simulation_.model().free_piston->position;
  const double u = flight.velocity_at(integrated_to_);
  window_.displacement += t * (x + t * (u / 2.0 + t * a / 6.0));
  window_.squared_displacement +=
      t *
      (x * x + t * (x * u + t * ((u * u + x * a) / 3.0 + t * (u * a / 4.0 + t * a * a / 20.0))));
  window_.squared_velocity += t * (u * u + t * (u * a + t * a * a / 3.0));
  integrated_to_ = time;
}

template <int D>
void PistonTotals<D>::on_wall(const WallCollision<D>& collision) {
  if (!collision.at_piston()) return;
  const FreePiston& piston = *simulation_.model().free_piston;
  const double impulse = -collision.particle.gain.momentum[piston.axis];
  const std::size_t side = collision.normal[piston.axis] < 0.0 ? 0 : 1;
  window_.impulses[side] += std::fabs(impulse);
  window_.hits[side] += 1.0;
  gained_ = collision.particle.energy();
  window_.to_gas += gained_;
  if (piston.pinned) window_.dissipated -= gained_;
}

template <int D>
void PistonTotals<D>::on_piston(const PistonChange& change) {
  integrate(change.before, change.time);
  if (change.cause != PistonChange::Cause::Particle) return;
  const double before = change.before.velocity_at(change.time), after = change.after.velocity;
  const double mass = simulation_.model().free_piston->mass;
  window_.dissipated -= gained_ + 0.5 * mass * (after - before) * (after + before);
}

template <int D>
void PistonTotals<D>::on_base_moved(double shift) {
  window_start_ -= shift;
  integrated_to_ -= shift;
}

template <int D>
PistonWindow PistonTotals<D>::close_window() {
  const double now = simulation_.base_time();
  integrate(*simulation_.free_piston(), now);
  window_.duration = now - window_start_;
  const PistonWindow closed = window_;
  window_ = {};
  window_start_ = now;
  return closed;
}

PistonMeans piston_means(std::span<const PistonWindow> windows, const FreePiston& piston) {
  const auto rate = [&](const auto& sum) {
    std::vector<double> series;
    for (const PistonWindow& window : windows) series.push_back(sum(window) / window.duration);
    return mean_estimate(series);
  };
  PistonMeans means;
  means.position = rate([](const auto& w) { return w.displacement; });
  const double middle = means.position.mean;
  means.variance = rate([&](const auto& w) {
    return w.squared_displacement - 2.0 * middle * w.displacement + middle * middle * w.duration;
  });
  means.position.mean += piston.position;
  means.temperature = rate([&](const auto& w) { return piston.mass * w.squared_velocity; });
  means.force_left = rate([](const auto& w) { return w.impulses[0]; });
  means.force_right = rate([](const auto& w) { return w.impulses[1]; });
  means.hits_left = rate([](const auto& w) { return w.hits[0]; });
  means.hits_right = rate([](const auto& w) { return w.hits[1]; });
  means.power = rate([](const auto& w) { return w.to_gas; });
  means.dissipated = rate([](const auto& w) { return w.dissipated; });
  return means;
}

template class PistonTotals<2>;
template class PistonTotals<3>;

}  // namespace clatter
