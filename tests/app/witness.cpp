#include "tests/app/witness.h"

#include <doctest/doctest.h>

#include <algorithm>
#include <cmath>
#include <limits>

namespace clatter::testing {

namespace {

template <int D>
double kinetic_energy(const Vec<D>& v, const Spin<D>& spin, double moment_of_inertia) {
  return 0.5 * v.squaredNorm() + 0.5 * moment_of_inertia * spin.squaredNorm();
}

// Adds the times between `from` and `to` at which a coordinate equals `place`.
void add_crossings(std::vector<double>& times, double from, double to, double coordinate, double v,
                   double acceleration, double place) {
  const double c = coordinate - place;
  const auto add = [&](double after) {
    if (after > 0.0 && from + after < to) times.push_back(from + after);
  };
  if (acceleration == 0.0) {
    if (v != 0.0) add(-c / v);
    return;
  }
  const double root = v * v - 2.0 * acceleration * c;
  if (root < 0.0) return;
  add((-v + std::sqrt(root)) / acceleration);
  add((-v - std::sqrt(root)) / acceleration);
}

// The cell of a position. Positions outside the box belong to the cells at its edge.
template <int D>
std::size_t cell_of(const Vec<D>& place, const Vec<D>& box, const IntVec<D>& cells) {
  std::size_t cell = 0;
  for (int axis = D - 1; axis >= 0; --axis) {
    const auto index = static_cast<int>(std::floor(place[axis] / box[axis] * cells[axis]));
    cell = cell * static_cast<std::size_t>(cells[axis]) +
           static_cast<std::size_t>(std::clamp(index, 0, cells[axis] - 1));
  }
  return cell;
}

// Calls visit(middle, from, to) for each part of a motion inside one cell. `crossings` has its
// border times.
template <class Visit>
void in_parts(std::vector<double> crossings, double from, double to, Visit&& visit) {
  crossings.push_back(from);
  crossings.push_back(to);
  std::ranges::sort(crossings);
  for (std::size_t k = 1; k < crossings.size(); ++k) {
    visit(0.5 * (crossings[k - 1] + crossings[k]), crossings[k - 1], crossings[k]);
  }
}

// Integrates polynomials of time of degree five or less.
template <class Rate>
Numbers integral(double from, double to, Rate&& rate) {
  const double middle = 0.5 * (from + to), half = 0.5 * (to - from), place = std::sqrt(0.6);
  return half / 9.0 *
         (5.0 * rate(middle - place * half) + 8.0 * rate(middle) +
          5.0 * rate(middle + place * half));
}

}  // namespace

template <int D>
Witness<D>::Witness(const Simulation<D>& simulation)
    : simulation_(simulation),
      model_(simulation.model()),
      now_(simulation.particles().size()),
      last_touch_(now_.size(), -std::numeric_limits<double>::infinity()) {
  const State<D> state = simulation.state();
  for (std::size_t i = 0; i < now_.size(); ++i) {
    now_[i] = {i, simulation.time(), 0.0, state.positions[i], state.velocities[i]};
    if (!state.spins.empty()) now_[i].spin = state.spins[i];
  }
}

template <int D>
Vec<D> Witness<D>::position(const WitnessedFlight<D>& flight, double time) const {
  const double dt = time - flight.from;
  return flight.position + dt * flight.velocity + 0.5 * dt * dt * model_.gravity;
}

template <int D>
Vec<D> Witness<D>::velocity(const WitnessedFlight<D>& flight, double time) const {
  return flight.velocity + (time - flight.from) * model_.gravity;
}

// Ends a particle's flight. Returns the energy gain of the particle.
template <int D>
double Witness<D>::gain(const ParticleChange<D>& change, double time) {
  WitnessedFlight<D>& flight = now_[change.particle];
  flight.to = time;
  flights_.push_back(flight);
  const Vec<D> position = this->position(flight, time), before = velocity(flight, time);
  falls_.push_back({time, model_.gravity.dot(position - flight.position)});
  const WitnessedFlight<D> next{flight.particle,
                                time,
                                0.0,
                                position,
                                before + change.gain.momentum,
                                flight.spin + change.gain.spin};
  const double gained = kinetic_energy<D>(next.velocity, next.spin, moment_of_inertia()) -
                        kinetic_energy<D>(before, flight.spin, moment_of_inertia());
  flight = next;
  return gained;
}

// Walton's model: beta limited by Coulomb's law. Disks are particles in the plane z = 0 that spin
// about z.
template <int D>
double Witness<D>::loss_by_law(const WitnessedFlight<D>& a, const WitnessedFlight<D>& b,
                               double time, const Vec<D>& separation) const {
  Vec<3> n = Vec<3>::Zero(), v = Vec<3>::Zero(), spin = Vec<3>::Zero();
  n.head<D>() = separation.normalized();
  v.head<D>() = velocity(a, time) - velocity(b, time);
  spin.tail<kSpinSize<D>>() = a.spin + b.spin;
  const double g_n = v.dot(n);
  const double g_t = (v + 0.5 * n.cross(spin) - g_n * n).norm();
  const double alpha = model_.restitution, q = model_.inertia;
  const double coulomb =
      model_.roughness.friction_in_force() * (1.0 + alpha) * (1.0 + q) / q * std::fabs(g_n) / g_t;
  const double beta = std::min(model_.roughness.tangential_restitution_in_force(), -1.0 + coulomb);
  return 0.25 * (1.0 - alpha * alpha) * g_n * g_n +
         0.25 * q / (1.0 + q) * (1.0 - beta * beta) * g_t * g_t;
}

template <int D>
void Witness<D>::on_collision(const PairCollision<D>& collision) {
  const auto& [a, b] = collision.particles;
  const double time = base_ + collision.time;
  WitnessedTouch<D> touch;
  touch.time = time;
  touch.first = position(now_[a.particle], time);
  Vec<D> separation = touch.first - position(now_[b.particle], time);
  for (int axis = 0; axis < D; ++axis) {
    if (!model_.periodic(axis)) continue;
    separation[axis] -= model_.box[axis] * std::round(separation[axis] / model_.box[axis]);
  }
  touch.second = touch.first - separation;
  touch.impulse = a.gain.momentum;
  touch.loss_by_law = loss_by_law(now_[a.particle], now_[b.particle], time, separation);
  const double since = time - std::max(last_touch_[a.particle], last_touch_[b.particle]);
  touch.within_contact_time = model_.contact_time && since < *model_.contact_time;
  last_touch_[a.particle] = last_touch_[b.particle] = time;
  touch.gains = {gain(a, time), gain(b, time)};
  touches_.push_back(touch);
}

template <int D>
void Witness<D>::on_wall(const WallCollision<D>& collision) {
  const ParticleChange<D>& particle = collision.particle;
  WitnessedTouch<D> touch;
  touch.time = base_ + collision.time;
  touch.side = collision.side;
  touch.first = position(now_[particle.particle], touch.time);
  touch.second = touch.first;
  touch.second[collision.side / 2] += collision.side % 2 ? 0.5 : -0.5;
  touch.impulse = particle.gain.momentum;
  last_touch_[particle.particle] = touch.time;
  touch.gains = {gain(particle, touch.time), 0.0};
  touches_.push_back(touch);
}

template <int D>
void Witness<D>::on_kick(const Kick<D>& kick) {
  const double time = base_ + kick.time;
  kicks_.push_back({time, gain(kick.particle, time)});
}

template <int D>
void Witness<D>::finish() {
  const State<D> state = simulation_.state();
  for (WitnessedFlight<D>& flight : now_) {
    flight.to = simulation_.time();
    CHECK((velocity(flight, flight.to) - state.velocities[flight.particle]).norm() < 1e-9);
    flights_.push_back(flight);
  }
}

template <int D>
void Witness<D>::at(double time,
                    const std::function<void(const Vec<D>&, const Spin<D>&)>& visit) const {
  for (const WitnessedFlight<D>& flight : flights_) {
    if (flight.from <= time && time < flight.to) visit(velocity(flight, time), flight.spin);
  }
}

int Windows::of(double time) const {
  const double place = std::floor((time - begin) / length);
  return place >= 0.0 && place < count ? static_cast<int>(place) : -1;
}

template <int D>
std::vector<Numbers> totals_of(const Witness<D>& witness, const Windows& windows) {
  using T = TotalsOf<D>;
  std::vector<Numbers> totals(static_cast<std::size_t>(windows.count), Numbers::Zero(T::kSize));
  const auto book = [&](double time, int total, double amount) {
    const int window = windows.of(time);
    if (window >= 0) totals[static_cast<std::size_t>(window)][total] += amount;
  };
  const auto count = static_cast<double>(witness.count());
  for (const WitnessedFlight<D>& flight : witness.flights()) {
    std::vector<double> borders;
    for (int k = 0; k <= windows.count; ++k) {
      const double border = windows.begin + k * windows.length;
      if (border > flight.from && border < flight.to) borders.push_back(border);
    }
    in_parts(borders, flight.from, flight.to, [&](double middle, double from, double to) {
      const Numbers sums = integral(from, to, [&](double time) -> Numbers {
        return witness.velocity(flight, time).array().square();
      });
      for (int axis = 0; axis < D; ++axis) book(middle, T::kSquares + axis, sums[axis]);
      book(middle, T::kSpinSquares, (to - from) * flight.spin.squaredNorm());
    });
  }
  for (const WitnessedTouch<D>& touch : witness.touches()) {
    if (touch.side >= 0) {
      book(touch.time, T::kWallsIn, touch.gains[0]);
      book(touch.time, T::kImpulse + touch.side, std::fabs(touch.impulse[touch.side / 2]));
    } else {
      book(touch.time, T::kCollisions, 1.0);
      book(touch.time, T::kDissipated, -touch.gains[0] - touch.gains[1]);
      book(touch.time, T::kVirial, touch.impulse.dot(touch.first - touch.second));
    }
  }
  for (const WitnessedGain& kick : witness.kicks()) book(kick.time, T::kBulkIn, kick.energy);
  for (const WitnessedGain& fall : witness.falls()) book(fall.time, T::kGravityIn, fall.energy);
  for (int k = 0; k < windows.count; ++k) {
    Numbers& window = totals[static_cast<std::size_t>(k)];
    // The last window ends with the run.
    witness.at(windows.begin + (k + 1) * windows.length - 1e-9,
               [&](const Vec<D>& v, const Spin<D>&) {
                 const Eigen::Array<double, D, 1> squares = v.array().square();
                 window.template segment<D>(T::kSecond) += squares / count;
                 window.template segment<D>(T::kFourth) += squares.square() / count;
               });
  }
  return totals;
}

template <int D>
std::vector<std::vector<Numbers>> cell_sums_of(const Witness<D>& witness, const Windows& windows,
                                               const Vec<D>& box, const IntVec<D>& cells) {
  using C = CellOf<D>;
  std::vector<std::vector<Numbers>> sums(
      static_cast<std::size_t>(windows.count),
      std::vector<Numbers>(static_cast<std::size_t>(cells.prod()), Numbers::Zero(C::kSize)));
  const auto cell_at = [&](double time, const Vec<D>& place) -> Numbers* {
    const int window = windows.of(time);
    if (window < 0) return nullptr;
    return &sums[static_cast<std::size_t>(window)][cell_of<D>(place, box, cells)];
  };
  // Adds the borders that a motion with these coordinates crosses.
  const auto add_borders = [&](std::vector<double>& times, double from, double to,
                               const Vec<D>& position, const Vec<D>& v,
                               const Vec<D>& acceleration) {
    for (int axis = 0; axis < D; ++axis) {
      for (int k = 1; k < cells[axis]; ++k) {
        add_crossings(times, from, to, position[axis], v[axis], acceleration[axis],
                      k * box[axis] / cells[axis]);
      }
    }
  };
  for (const WitnessedFlight<D>& flight : witness.flights()) {
    std::vector<double> borders;
    for (int k = 0; k <= windows.count; ++k) {
      const double border = windows.begin + k * windows.length;
      if (border > flight.from && border < flight.to) borders.push_back(border);
    }
    add_borders(borders, flight.from, flight.to, flight.position, flight.velocity,
                witness.gravity());
    in_parts(borders, flight.from, flight.to, [&](double middle, double from, double to) {
      Numbers* cell = cell_at(middle, witness.position(flight, middle));
      if (!cell) return;
      const double spin_energy = 0.5 * witness.moment_of_inertia() * flight.spin.squaredNorm();
      *cell += integral(from, to, [&](double time) {
        const Vec<D> v = witness.velocity(flight, time);
        const double energy = 0.5 * v.squaredNorm() + spin_energy;
        Numbers rate = Numbers::Zero(C::kSize);
        rate[C::kCount] = 1.0;
        for (int k = 0; k < D; ++k) {
          rate[C::kVelocity + k] = v[k];
          for (int l = 0; l < D; ++l) rate[C::kSquares + D * k + l] = v[k] * v[l];
          rate[C::kEnergyFlow + k] = energy * v[k];
        }
        for (int k = 0; k < kSpinSize<D>; ++k) rate[C::kSpin + k] = flight.spin[k];
        rate[C::kSpinEnergy] = spin_energy;
        return rate;
      });
    });
  }
  for (const WitnessedTouch<D>& touch : witness.touches()) {
    const Vec<D> branch = touch.first - touch.second;
    // A collision of two particles transfers half the difference along the branch. A wall transfers
    // all.
    const double passed =
        touch.side >= 0 ? touch.gains[0] : 0.5 * (touch.gains[0] - touch.gains[1]);
    std::vector<double> borders;
    add_borders(borders, 0.0, 1.0, touch.second, branch, Vec<D>::Zero());
    in_parts(borders, 0.0, 1.0, [&](double middle, double from, double to) {
      Numbers* cell = cell_at(touch.time, touch.second + middle * branch);
      if (!cell) return;
      const Vec<D> part = (to - from) * branch;
      for (int k = 0; k < D; ++k) {
        for (int l = 0; l < D; ++l) {
          (*cell)[C::kTransfer + D * k + l] += part[k] * touch.impulse[l];
        }
        (*cell)[C::kEnergyTransfer + k] += part[k] * passed;
      }
    });
    if (touch.side >= 0) continue;
    for (const Vec<D>& end : {touch.first, touch.second}) {
      Numbers* cell = cell_at(touch.time, end);
      if (cell) (*cell)[C::kSources] += 0.5 * (touch.gains[0] + touch.gains[1]);
    }
  }
  return sums;
}

template class Witness<2>;
template class Witness<3>;
template std::vector<Numbers> totals_of(const Witness<2>&, const Windows&);
template std::vector<Numbers> totals_of(const Witness<3>&, const Windows&);
template std::vector<std::vector<Numbers>> cell_sums_of(const Witness<2>&, const Windows&,
                                                        const Vec<2>&, const IntVec<2>&);
template std::vector<std::vector<Numbers>> cell_sums_of(const Witness<3>&, const Windows&,
                                                        const Vec<3>&, const IntVec<3>&);

namespace {

struct Blocked {
  double error = 0.0, rise = 1.0;
};

// Meketon and Schmeiser 1984: all blocks of n/16 neighbours, rounded down to a multiple of four;
// extrapolated by those of half the length. Also the rise of the square over a quarter of it.
Blocked blocked(const std::vector<double>& values) {
  const std::size_t n = values.size(), b = n / 64 * 4;
  double mean = 0.0;
  for (const double value : values) mean += value / static_cast<double>(n);
  const auto squared = [&](std::size_t length) {
    double sum = 0.0;
    for (std::size_t k = 0; k + length <= n; ++k) {
      double block = 0.0;
      for (std::size_t i = k; i < k + length; ++i) block += (values[i] - mean);
      sum += std::pow(block / static_cast<double>(length), 2);
    }
    return sum * static_cast<double>(length) / static_cast<double>((n - length) * (n - length + 1));
  };
  const double whole = squared(b), before = squared(b / 4);
  return {std::sqrt(std::max(whole, 2.0 * whole - squared(b / 2))),
          before > 0.0 ? std::max(1.0, whole / before) : 1.0};
}

}  // namespace

WitnessedMean mean_of(const std::vector<Numbers>& windows,
                      const std::function<double(const Numbers&)>& function) {
  Numbers mean = Numbers::Zero(windows.front().size());
  for (const Numbers& window : windows) mean += window / static_cast<double>(windows.size());
  constexpr double kStep = 1e-4;
  std::vector<double> changes;
  for (const Numbers& window : windows) {
    const Numbers step = kStep * (window - mean);
    changes.push_back((function(mean + step) - function(mean - step)) / (2.0 * kStep));
  }
  const Blocked all = blocked(changes);
  const auto middle = changes.begin() + static_cast<std::ptrdiff_t>(changes.size() / 2);
  const std::vector<double> early(changes.begin(), middle), late(middle, changes.end());
  double later = 0.0;
  for (const double change : late) later += change / static_cast<double>(late.size());
  for (const double change : early) later -= change / static_cast<double>(early.size());
  const Blocked first = blocked(early), second = blocked(late);
  const double spread =
      std::sqrt(first.error * first.error * first.rise + second.error * second.error * second.rise);
  return {function(mean), all.error, all.rise, later / spread};
}

}  // namespace clatter::testing
