#include "engine/measure/balance.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <utility>

namespace clatter {

template <int D>
static Conserved<D> conserved(double mass, const Vec<D>& momentum, double energy) {
  Conserved<D> amount;
  amount << mass, momentum, energy;
  return amount;
}

template <int D>
static void add(Booked<D>& booked, const Conserved<D>& amount) {
  booked.net += amount;
  booked.size += amount.cwiseAbs();
}

// Change of a particle's conserved quantities in an event.
template <int D>
static Conserved<D> given(const ParticleChange<D>& change) {
  return conserved<D>(0.0, change.gain.momentum, change.energy());
}

template <int D>
Balance<D>::Balance(const Simulation<D>& simulation, const IntVec<D>& cells)
    : simulation_(simulation),
      grid_(simulation.model(), cells),
      window_start_(simulation.base_time()),
      species_(simulation.model().species ? simulation.model().species->count() : 0) {
  const Vec<D>& gravity = simulation.model().gravity;
  for (std::uint32_t i = 0; i < simulation.particles().size(); ++i) {
    const Flight<D>& flight = simulation.particles()[i].flight;
    const Cell cell = grid_.cell_at(flight.at(window_start_, gravity));
    particles_.push_back(
        {cell, grid_.index_of(cell), flight.velocity_at(window_start_, gravity), spin(i)});
  }
  clear();
}

template <int D>
void Balance<D>::clear() {
  const auto count = grid_.size();
  for (auto& faces : booked_.faces) faces.assign(count, {});
  booked_.sources.assign(count, {});
  booked_.weights.assign(count, Conserved<D>::Zero());
  for (auto& faces : numbers_.faces) faces.assign(count * species_, 0.0);
  numbers_.passages.assign(count * species_, 0.0);
}

template <int D>
Spin<D> Balance<D>::spin(std::uint32_t particle) const {
  if (simulation_.spins().empty()) return Spin<D>::Zero();
  return simulation_.spins()[particle];
}

template <int D>
Conserved<D> Balance<D>::carried(std::uint32_t particle, const Vec<D>& velocity,
                                 const Spin<D>& spin) const {
  const Grain& grain = simulation_.grain(particle);
  return conserved<D>(
      grain.mass, grain.mass * velocity,
      0.5 * (grain.mass * velocity.squaredNorm() + grain.moment_of_inertia() * spin.squaredNorm()));
}

// Gain, since the window's start, of a particle that is in its first cell. Avoids the rounding of a
// difference of squares.
template <int D>
Conserved<D> Balance<D>::gained(std::uint32_t particle, const Vec<D>& velocity,
                                const Spin<D>& spin) const {
  const Tracked& before = particles_[particle];
  const Grain& grain = simulation_.grain(particle);
  const Vec<D> dp = grain.mass * (velocity - before.first_velocity);
  const Spin<D> dw = spin - before.first_spin;
  return conserved<D>(0.0, dp,
                      0.5 * (dp.dot(velocity + before.first_velocity) +
                             grain.moment_of_inertia() * dw.dot(spin + before.first_spin)));
}

template <int D>
void Balance<D>::follow(std::uint32_t particle, const Flight<D>& flight, double end) {
  const Vec<D>& gravity = simulation_.model().gravity;
  const double begin = std::max(flight.time, window_start_);
  Cell& cell = particles_[particle].cell;
  cell = grid_.image_at(cell, flight.at(begin, gravity));
  grid_.walk(
      flight, gravity, cell, begin, end,
      [&](const Cell& cell, double from, double until) {
        fall(particle, cell, flight, from, until);
      },
      [&](const Cell& cell, double time, int axis, int step) {
        pass(cell, axis, step,
             carried(particle, flight.velocity_at(time, gravity), spin(particle)));
        if (species_ > 0) count_passage(particle, cell, axis, step);
      });
}

// A weight for rounding: 1e-9 of the momentum and energy of a particle whose motion changes.
// Relative to it the rounding of the change is 1e-7, even if friction or gravity give very little.
template <int D>
Conserved<D> Balance<D>::rounding(std::uint32_t particle, const Vec<D>& velocity) const {
  constexpr double kShare = 1e-9;
  Conserved<D> weight = kShare * carried(particle, velocity, spin(particle)).cwiseAbs();
  weight[0] = 0.0;
  return weight;
}

// Books the momentum and work of gravity on a particle: the integrals of g and of g.v.
template <int D>
void Balance<D>::fall(std::uint32_t particle, const Cell& cell, const Flight<D>& flight,
                      double begin, double end) {
  const Vec<D>& gravity = simulation_.model().gravity;
  if (gravity.isZero(0.0)) return;
  const Vec<D> v = flight.velocity_at(begin, gravity);
  const Vec<D> w = flight.velocity_at(end, gravity);
  const Vec<D> gained = simulation_.grain(particle).mass * (end - begin) * gravity;
  arise(cell, conserved<D>(0.0, gained, 0.5 * gained.dot(v + w)));
  const double weight = 0.5 * gained.cwiseAbs().dot(v.cwiseAbs() + w.cwiseAbs());
  booked_.weights[grid_.index_of(cell)] +=
      conserved<D>(0.0, Vec<D>::Zero(), weight) + rounding(particle, v);
}

template <int D>
void Balance<D>::arise(const Cell& cell, const Conserved<D>& amount) {
  add<D>(booked_.sources[grid_.index_of(cell)], amount);
}

// A crossing into the same cell, beyond a wall or across a periodic box of one cell, passes no
// face.
template <int D>
void Balance<D>::pass(const Cell& cell, int axis, int step, const Conserved<D>& amount) {
  Cell next = cell;
  next[axis] += step;
  const std::size_t index = grid_.index_of(cell), beyond = grid_.index_of(next);
  if (index == beyond) return;
  add<D>(booked_.faces[axis][step > 0 ? index : beyond], step * amount);
}

template <int D>
std::size_t Balance<D>::number_index(std::size_t cell, std::uint32_t particle) const {
  return cell * species_ + simulation_.grain(particle).species;
}

// The number of particles of the species that pass a face, see pass().
template <int D>
void Balance<D>::count_passage(std::uint32_t particle, const Cell& cell, int axis, int step) {
  Cell next = cell;
  next[axis] += step;
  const std::size_t index = grid_.index_of(cell), beyond = grid_.index_of(next);
  if (index == beyond) return;
  numbers_.faces[axis][number_index(step > 0 ? index : beyond, particle)] += step;
  numbers_.passages[number_index(index, particle)] += 1.0;
  numbers_.passages[number_index(beyond, particle)] += 1.0;
}

template <int D>
std::vector<double> Balance<D>::number_residuals(const std::vector<double>& changes) const {
  std::vector<double> residuals = changes;
  for (std::size_t cell = 0; cell < grid_.size(); ++cell) {
    for (int axis = 0; axis < D; ++axis) {
      Cell below = grid_.cell_of(cell);
      --below[axis];
      const std::size_t lower = grid_.index_of(below);
      for (std::size_t s = 0; s < species_; ++s) {
        const double in = lower == cell ? 0.0 : numbers_.faces[axis][lower * species_ + s];
        residuals[cell * species_ + s] -= in - numbers_.faces[axis][cell * species_ + s];
      }
    }
  }
  for (std::size_t k = 0; k < residuals.size(); ++k) {
    residuals[k] /= std::max(1.0, numbers_.passages[k]);
  }
  return residuals;
}

template <int D>
void Balance<D>::transport(const Vec<D>& start, const Vec<D>& branch, const Cell& from,
                           const Cell& to, const Conserved<D>& amount) {
  grid_.walk(
      start, branch, grid_.image_at(from, start), grid_.image_at(to, start + branch),
      [](const Cell&, double) {},
      [&](const Cell& cell, int axis, int step) { pass(cell, axis, step, amount); });
}

// The terms p.v and p^2/2 enter with their magnitudes, because they cancel at a wall that conserves
// energy.
template <int D>
void Balance<D>::weigh(const ParticleChange<D>& change) {
  const Vec<D>& p = change.gain.momentum;
  booked_.weights[grid_.index_of(particles_[change.particle].cell)] +=
      conserved<D>(0.0, p.cwiseAbs(),
                   0.5 * p.squaredNorm() / change.grain.mass + std::fabs(p.dot(change.velocity))) +
      rounding(change.particle, change.velocity);
}

// Each partner changes in its own cell. Momentum and the energy (1/2)(dE_0 - dE_1) pass along the
// branch vector (theory 8.7). The rest of the energy is a source at both ends (theory 8.6).
template <int D>
void Balance<D>::on_collision(const PairCollision<D>& collision) {
  const auto& [first, second] = collision.particles;
  for (const ParticleChange<D>& particle : collision.particles) {
    follow(particle.particle, particle.before, collision.time);
    weigh(particle);
  }
  const Cell& to = particles_[first.particle].cell;
  const Cell& from = particles_[second.particle].cell;
  transport(first.position - collision.separation, collision.separation, from, to,
            0.5 * (given<D>(first) - given<D>(second)));
  const Conserved<D> source = 0.5 * (given<D>(first) + given<D>(second));
  arise(to, source);
  arise(from, source);
}

// The wall's whole contribution is a source at the contact point. From there it passes along the
// branch vector.
template <int D>
void Balance<D>::on_wall(const WallCollision<D>& collision) {
  const ParticleChange<D>& particle = collision.particle;
  follow(particle.particle, particle.before, collision.time);
  weigh(particle);
  const Vec<D> branch = collision.branch();
  const Vec<D> touching = particle.position - branch;
  const Cell& to = particles_[particle.particle].cell;
  Cell from = grid_.cell_at(touching);
  if (collision.at_wall()) {
    const int axis = collision.side / 2;
    from = to;
    from[axis] = grid_.cell_at(touching)[axis];
  }
  arise(from, given<D>(particle));
  transport(touching, branch, from, to, given<D>(particle));
}

template <int D>
void Balance<D>::on_kick(const Kick<D>& kick) {
  follow(kick.particle.particle, kick.particle.before, kick.time);
  weigh(kick.particle);
  arise(particles_[kick.particle.particle].cell, given<D>(kick.particle));
}

template <int D>
void Balance<D>::on_base_moved(double shift) {
  window_start_ -= shift;
}

// Change of the cells' contents, from the particles' states at the window's ends. Starts the next
// window.
template <int D>
Imbalances<D> Balance<D>::take_changes(double now, std::vector<double>& numbers) {
  const Vec<D>& gravity = simulation_.model().gravity;
  Imbalances<D> taken;
  taken.gaps.assign(booked_.sources.size(), Conserved<D>::Zero());
  taken.sizes = taken.gaps;
  for (std::uint32_t i = 0; i < particles_.size(); ++i) {
    const Flight<D>& flight = simulation_.particles()[i].flight;
    const Vec<D> v = flight.velocity_at(now, gravity);
    Tracked& particle = particles_[i];
    // Near a border, rounding is ambiguous and the tracked cell decides. A particle far from its
    // tracked cell is an error of tracking, and must show as a residual.
    const Vec<D> r = flight.at(now, gravity);
    particle.cell = grid_.image_at(particle.cell, r);
    if (!grid_.contains(particle.cell, r)) particle.cell = grid_.cell_at(r);
    const std::size_t to = grid_.index_of(particle.cell), from = particle.first_cell;
    if (species_ > 0 && to != from) {
      numbers[number_index(to, i)] += 1.0;
      numbers[number_index(from, i)] -= 1.0;
    }
    if (to == from) {
      taken.gaps[to] += gained(i, v, spin(i));
    } else {
      taken.gaps[to] += carried(i, v, spin(i));
      taken.gaps[from] -= carried(i, particle.first_velocity, particle.first_spin);
    }
    particle = {particle.cell, to, v, spin(i)};
  }
  return taken;
}

// A cell's lower face is the upper face of the cell below it. The lowest cell between walls has no
// lower face.
template <int D>
Booked<D> Balance<D>::booked_at(std::size_t index) const {
  Booked<D> booked = booked_.sources[index];
  booked.size += booked_.weights[index];
  for (int axis = 0; axis < D; ++axis) {
    Cell below = grid_.cell_of(index);
    --below[axis];
    const std::size_t lower = grid_.index_of(below);
    const Booked<D> in = lower == index ? Booked<D>() : booked_.faces[axis][lower];
    const Booked<D>& out = booked_.faces[axis][index];
    booked.net += in.net - out.net;
    booked.size += in.size + out.size;
  }
  return booked;
}

template <int D>
BalanceWindow<D> Balance<D>::close_window() {
  const double now = simulation_.base_time();
  for (std::uint32_t i = 0; i < particles_.size(); ++i)
    follow(i, simulation_.particles()[i].flight, now);
  BalanceWindow<D> window;
  std::vector<double> numbers(numbers_.passages.size());
  window.imbalances = take_changes(now, numbers);
  window.number_residuals = number_residuals(numbers);
  window_start_ = now;
  for (std::size_t index = 0; index < window.imbalances.gaps.size(); ++index) {
    const Booked<D> booked = booked_at(index);
    window.imbalances.gaps[index] -= booked.net;
    window.imbalances.sizes[index] += booked.size;
  }
  window.booked = std::move(booked_);
  clear();
  return window;
}

template <int D>
Conserved<D> Imbalances<D>::residual(std::size_t cell) const {
  Conserved<D> residual = gaps[cell];
  for (int k = 0; k < D + 2; ++k) {
    if (residual[k] == 0.0) continue;
    const double size = sizes[cell][k];
    residual[k] = size > 0.0 ? residual[k] / size : std::copysign(1.0, residual[k]);
    if (std::isnan(residual[k])) residual[k] = std::numeric_limits<double>::infinity();
  }
  return residual;
}

template <int D>
Conserved<D> Imbalances<D>::largest() const {
  Conserved<D> largest = Conserved<D>::Zero();
  for (std::size_t cell = 0; cell < gaps.size(); ++cell) {
    largest = largest.cwiseMax(residual(cell).cwiseAbs());
  }
  return largest;
}

template <int D>
Imbalances<D>& Imbalances<D>::operator+=(const Imbalances& other) {
  if (gaps.empty()) return *this = other;
  for (std::size_t cell = 0; cell < gaps.size(); ++cell) {
    gaps[cell] += other.gaps[cell];
    sizes[cell] += other.sizes[cell];
  }
  return *this;
}

template struct Imbalances<2>;
template struct Imbalances<3>;
template class Balance<2>;
template class Balance<3>;

}  // namespace clatter
