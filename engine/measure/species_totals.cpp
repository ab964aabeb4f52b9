#include "engine/measure/species_totals.h"

namespace clatter {

template <int D>
SpeciesTotals<D>::SpeciesTotals(const Simulation<D>& simulation)
    : simulation_(simulation),
      species_(simulation.model().species->count()),
      window_start_(simulation.base_time()) {
  start_window();
  take_stock();
}

template <int D>
void SpeciesTotals<D>::start_window() {
  const std::size_t count = species_.size();
  window_ = {};
  window_.species.resize(count);
  window_.pairs.resize(count * (count + 1) / 2);
  for (Motion& motion : species_) {
    motion.squares_time.setZero();
    motion.place_time.setZero();
    motion.spin_squares_time = 0.0;
  }
}

// Computes the sums over the particles at the present time. The time integrals do not change.
template <int D>
void SpeciesTotals<D>::take_stock() {
  const double now = simulation_.base_time();
  const Vec<D>& gravity = simulation_.model().gravity;
  const LargeArray<Spin<D>>& spins = simulation_.spins();
  counts_.assign(species_.size(), 0);
  changes_ = 0;
  for (Motion& motion : species_) {
    motion.time = now;
    motion.mass = motion.cross = motion.spin_squares = 0.0;
    for (Vec<D>* sum : {&motion.squares, &motion.momentum, &motion.flow, &motion.place}) {
      sum->setZero();
    }
  }
  for (std::uint32_t i = 0; i < simulation_.particles().size(); ++i) {
    const Grain& grain = simulation_.grain(i);
    const Flight<D>& flight = simulation_.particles()[i].flight;
    const Vec<D> v = simulation_.peculiar_at(flight, now);
    Motion& motion = species_[grain.species];
    ++counts_[grain.species];
    motion.mass += grain.mass;
    motion.squares += grain.mass * v.cwiseAbs2();
    motion.cross += grain.mass * v[0] * v[1];
    motion.momentum += grain.mass * v;
    motion.flow += v;
    motion.place += flight.at(now, gravity);
    if (!spins.empty()) motion.spin_squares += grain.moment_of_inertia() * spins[i].squaredNorm();
  }
}

// Between events of a species its sums are polynomials in time, because all particles have the same
// acceleration.
template <int D>
void SpeciesTotals<D>::integrate(std::size_t species, double time) {
  Motion& motion = species_[species];
  const double dt = time - motion.time;
  const Vec<D>& gravity = simulation_.model().gravity;
  const Vec<D> slope = gravity.cwiseProduct(motion.momentum);
  const Vec<D> curvature = motion.mass * gravity.cwiseAbs2();
  const Vec<D> pull = static_cast<double>(counts_[species]) * gravity;
  motion.squares_time += dt * (motion.squares + dt * (slope + dt / 3.0 * curvature));
  motion.squares += dt * (2.0 * slope + dt * curvature);
  motion.momentum += dt * motion.mass * gravity;
  if (const auto rate = simulation_.model().shear_rate) {
    // As in Totals: dc_x/dt = -G c_y.
    const double way = *rate * dt, across = motion.squares[1];
    motion.squares_time[0] += dt * way * (way / 3.0 * across - motion.cross);
    motion.squares[0] += way * (way * across - 2.0 * motion.cross);
    motion.cross -= way * across;
    motion.momentum[0] -= way * motion.momentum[1];
  }
  motion.place_time += dt * (motion.place + dt / 2.0 * (motion.flow + dt / 3.0 * pull));
  motion.place += dt * (motion.flow + dt / 2.0 * pull);
  motion.flow += dt * pull;
  motion.spin_squares_time += dt * motion.spin_squares;
  motion.time = time;
}

template <int D>
void SpeciesTotals<D>::change(const ParticleChange<D>& particle, double time) {
  const Grain& grain = particle.grain;
  const Impulse<D>& gain = particle.gain;
  integrate(grain.species, time);
  ++changes_;
  Motion& motion = species_[grain.species];
  motion.squares +=
      gain.momentum.cwiseProduct(gain.momentum / grain.mass + 2.0 * particle.velocity);
  const Vec<D>&c = particle.velocity, &p = gain.momentum;
  motion.cross += p[0] * c[1] + c[0] * p[1] + p[0] * p[1] / grain.mass;
  motion.momentum += gain.momentum;
  motion.flow += gain.momentum / grain.mass;
  motion.spin_squares += grain.moment_of_inertia() * gain.spin.dot(gain.spin + 2.0 * particle.spin);
}

// The gain of an elastic collision is a rounding error, see Totals.
template <int D>
void SpeciesTotals<D>::on_collision(const PairCollision<D>& collision) {
  const auto& [first, second] = collision.particles;
  change(first, collision.time);
  change(second, collision.time);
  PairWindow& pair = window_.pairs[pair_index(first.grain.species, second.grain.species)];
  pair.collisions += 1.0;
  pair.elasticised += collision.elasticised;
  const PairLaw law = simulation_.model().pair(first.grain.species, second.grain.species);
  if (!collision.elasticised && law.dissipates()) pair.dissipated -= collision.energy();
}

template <int D>
void SpeciesTotals<D>::on_wall(const WallCollision<D>& collision) {
  change(collision.particle, collision.time);
  window_.species[collision.particle.grain.species].walls_in += collision.particle.energy();
}

template <int D>
void SpeciesTotals<D>::on_kick(const Kick<D>& kick) {
  change(kick.particle, kick.time);
  if (kick.cause == KickCause::Nudge) return;
  window_.species[kick.particle.grain.species].bulk_in += kick.particle.energy();
}

template <int D>
void SpeciesTotals<D>::on_base_moved(double shift) {
  window_start_ -= shift;
  for (Motion& motion : species_) motion.time -= shift;
}

template <int D>
void SpeciesTotals<D>::before_laws(const Model<D>&) {
  for (std::size_t s = 0; s < species_.size(); ++s) integrate(s, simulation_.base_time());
}

// Particles may have entered.
template <int D>
void SpeciesTotals<D>::on_laws() {
  take_stock();
}

template <int D>
SpeciesTotalsWindow<D> SpeciesTotals<D>::close_window() {
  const double now = simulation_.base_time();
  const double span = now - window_start_;
  window_.duration = span;
  for (std::size_t s = 0; s < species_.size(); ++s) {
    integrate(s, now);
    if (counts_[s] == 0 || !(span > 0.0)) continue;
    const Motion& motion = species_[s];
    const double weight = span * static_cast<double>(counts_[s]);
    window_.species[s].temperature = motion.squares_time / weight;
    window_.species[s].position = motion.place_time / weight;
    window_.species[s].spin_temperature = motion.spin_squares_time / (weight * kSpinSize<D>);
  }
  SpeciesTotalsWindow<D> closed = std::move(window_);
  start_window();
  // Removes the rounding of the sums that events carry along.
  if (changes_ >= simulation_.particles().size()) take_stock();
  window_start_ = now;
  return closed;
}

template class SpeciesTotals<2>;
template class SpeciesTotals<3>;

}  // namespace clatter
