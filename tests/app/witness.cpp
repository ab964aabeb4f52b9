#include "tests/app/witness.h"

#include <doctest/doctest.h>

#include <algorithm>
#include <cmath>
#include <limits>

namespace clatter::testing {

namespace {

double kinetic_energy(const Vec2& v, double spin, double moment_of_inertia) {
  return 0.5 * v.squaredNorm() + 0.5 * moment_of_inertia * spin * spin;
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
std::size_t cell_of(const Vec2& place, const Vec2& box, const IntVec<2>& cells) {
  const auto along = [&](int axis) {
    const auto index = static_cast<int>(std::floor(place[axis] / box[axis] * cells[axis]));
    return std::clamp(index, 0, cells[axis] - 1);
  };
  return static_cast<std::size_t>(along(0) + along(1) * cells[0]);
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

Witness::Witness(const Simulation<2>& simulation)
    : simulation_(simulation),
      model_(simulation.model()),
      now_(simulation.particles().size()),
      last_touch_(now_.size(), -std::numeric_limits<double>::infinity()) {
  const State<2> state = simulation.state();
  for (std::size_t i = 0; i < now_.size(); ++i) {
    now_[i] = {i,
               simulation.time(),
               0.0,
               state.positions[i],
               state.velocities[i],
               state.spins.empty() ? 0.0 : state.spins[i][0]};
  }
}

Vec2 Witness::position(const WitnessedFlight& flight, double time) const {
  const double dt = time - flight.from;
  return flight.position + dt * flight.velocity + 0.5 * dt * dt * model_.gravity;
}

Vec2 Witness::velocity(const WitnessedFlight& flight, double time) const {
  return flight.velocity + (time - flight.from) * model_.gravity;
}

// Ends a disk's flight. Returns the energy gain of the disk.
double Witness::gain(const ParticleChange<2>& change, double time) {
  WitnessedFlight& flight = now_[change.particle];
  flight.to = time;
  flights_.push_back(flight);
  const Vec2 position = this->position(flight, time), before = velocity(flight, time);
  falls_.push_back({time, model_.gravity.dot(position - flight.position)});
  const WitnessedFlight next{flight.disk,
                             time,
                             0.0,
                             position,
                             before + change.gain.momentum,
                             flight.spin + change.gain.spin[0]};
  const double gained = kinetic_energy(next.velocity, next.spin, moment_of_inertia()) -
                        kinetic_energy(before, flight.spin, moment_of_inertia());
  flight = next;
  return gained;
}

// Walton's model: beta limited by Coulomb's law.
double Witness::loss_by_law(const WitnessedFlight& a, const WitnessedFlight& b, double time,
                            const Vec2& separation) const {
  const Vec2 n = separation.normalized(), t(-n.y(), n.x());
  const Vec2 v = velocity(a, time) - velocity(b, time);
  const double g_n = v.dot(n), g_t = v.dot(t) - 0.5 * (a.spin + b.spin);
  const double alpha = model_.restitution, q = model_.inertia;
  const double coulomb = model_.roughness.friction_in_force() * (1.0 + alpha) * (1.0 + q) / q *
                         std::fabs(g_n) / std::fabs(g_t);
  const double beta = std::min(model_.roughness.tangential_restitution_in_force(), -1.0 + coulomb);
  return 0.25 * (1.0 - alpha * alpha) * g_n * g_n +
         0.25 * q / (1.0 + q) * (1.0 - beta * beta) * g_t * g_t;
}

void Witness::on_collision(const PairCollision<2>& collision) {
  const auto& [a, b] = collision.particles;
  const double time = base_ + collision.time;
  WitnessedTouch touch;
  touch.time = time;
  touch.first = position(now_[a.particle], time);
  Vec2 separation = touch.first - position(now_[b.particle], time);
  for (int axis : {0, 1}) {
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

void Witness::on_wall(const WallCollision<2>& collision) {
  const std::array<Vec2, 4> inward = {Vec2(1.0, 0.0), Vec2(-1.0, 0.0), Vec2(0.0, 1.0),
                                      Vec2(0.0, -1.0)};
  const ParticleChange<2>& disk = collision.particle;
  WitnessedTouch touch;
  touch.time = base_ + collision.time;
  touch.side = collision.side;
  touch.first = position(now_[disk.particle], touch.time);
  touch.second = touch.first - 0.5 * inward[static_cast<std::size_t>(collision.side)];
  touch.impulse = disk.gain.momentum;
  last_touch_[disk.particle] = touch.time;
  touch.gains = {gain(disk, touch.time), 0.0};
  touches_.push_back(touch);
}

void Witness::on_kick(const Kick<2>& kick) {
  const double time = base_ + kick.time;
  kicks_.push_back({time, gain(kick.particle, time)});
}

void Witness::finish() {
  const State<2> state = simulation_.state();
  for (WitnessedFlight& flight : now_) {
    flight.to = simulation_.time();
    CHECK((velocity(flight, flight.to) - state.velocities[flight.disk]).norm() < 1e-9);
    flights_.push_back(flight);
  }
}

void Witness::at(double time, const std::function<void(const Vec2&, double)>& visit) const {
  for (const WitnessedFlight& flight : flights_) {
    if (flight.from <= time && time < flight.to) visit(velocity(flight, time), flight.spin);
  }
}

int Windows::of(double time) const {
  const double place = std::floor((time - begin) / length);
  return place >= 0.0 && place < count ? static_cast<int>(place) : -1;
}

std::vector<Numbers> totals_of(const Witness& witness, const Windows& windows) {
  std::vector<Numbers> totals(static_cast<std::size_t>(windows.count), Numbers::Zero(kTotals));
  const auto book = [&](double time, Total total, double amount) {
    const int window = windows.of(time);
    if (window >= 0) totals[static_cast<std::size_t>(window)][total] += amount;
  };
  const auto count = static_cast<double>(witness.count());
  for (const WitnessedFlight& flight : witness.flights()) {
    std::vector<double> borders;
    for (int k = 0; k <= windows.count; ++k) {
      const double border = windows.begin + k * windows.length;
      if (border > flight.from && border < flight.to) borders.push_back(border);
    }
    in_parts(borders, flight.from, flight.to, [&](double middle, double from, double to) {
      const Numbers sums = integral(from, to, [&](double time) {
        const Vec2 v = witness.velocity(flight, time);
        return Numbers{{v.x() * v.x(), v.y() * v.y(), flight.spin * flight.spin}};
      });
      book(middle, kSquaresX, sums[0]);
      book(middle, kSquaresY, sums[1]);
      book(middle, kSpinSquares, sums[2]);
    });
  }
  for (const WitnessedTouch& touch : witness.touches()) {
    if (touch.side >= 0) {
      book(touch.time, kWallsIn, touch.gains[0]);
      const auto wall = static_cast<Total>(kLeftImpulse + touch.side);
      book(touch.time, wall, std::fabs(touch.impulse[touch.side / 2]));
    } else {
      book(touch.time, kCollisions, 1.0);
      book(touch.time, kDissipated, -touch.gains[0] - touch.gains[1]);
      book(touch.time, kVirial, touch.impulse.dot(touch.first - touch.second));
    }
  }
  for (const WitnessedGain& kick : witness.kicks()) book(kick.time, kBulkIn, kick.energy);
  for (const WitnessedGain& fall : witness.falls()) book(fall.time, kGravityIn, fall.energy);
  for (int k = 0; k < windows.count; ++k) {
    Numbers& window = totals[static_cast<std::size_t>(k)];
    // The last window ends with the run.
    witness.at(windows.begin + (k + 1) * windows.length - 1e-9, [&](const Vec2& v, double) {
      const Vec2 squares = v.cwiseAbs2();
      window[kSecondX] += squares.x() / count;
      window[kSecondY] += squares.y() / count;
      window[kFourthX] += squares.x() * squares.x() / count;
      window[kFourthY] += squares.y() * squares.y() / count;
    });
  }
  return totals;
}

std::vector<std::vector<Numbers>> cell_sums_of(const Witness& witness, const Windows& windows,
                                               const Vec2& box, const IntVec<2>& cells) {
  std::vector<std::vector<Numbers>> sums(
      static_cast<std::size_t>(windows.count),
      std::vector<Numbers>(static_cast<std::size_t>(cells.prod()), Numbers::Zero(kCellSums)));
  const auto cell_at = [&](double time, const Vec2& place) -> Numbers* {
    const int window = windows.of(time);
    if (window < 0) return nullptr;
    return &sums[static_cast<std::size_t>(window)][cell_of(place, box, cells)];
  };
  // Adds the borders that a motion with these coordinates crosses.
  const auto add_borders = [&](std::vector<double>& times, double from, double to,
                               const Vec2& position, const Vec2& v, const Vec2& acceleration) {
    for (int axis : {0, 1}) {
      for (int k = 1; k < cells[axis]; ++k) {
        add_crossings(times, from, to, position[axis], v[axis], acceleration[axis],
                      k * box[axis] / cells[axis]);
      }
    }
  };
  for (const WitnessedFlight& flight : witness.flights()) {
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
      const double spin_energy = 0.5 * witness.moment_of_inertia() * flight.spin * flight.spin;
      *cell += integral(from, to, [&](double time) {
        const Vec2 v = witness.velocity(flight, time);
        const double energy = 0.5 * v.squaredNorm() + spin_energy;
        Numbers rate = Numbers::Zero(kCellSums);
        rate[kCount] = 1.0;
        rate[kVx] = v.x();
        rate[kVy] = v.y();
        rate[kVxVx] = v.x() * v.x();
        rate[kVyVy] = v.y() * v.y();
        rate[kVxVy] = v.x() * v.y();
        rate[kEnergyVx] = energy * v.x();
        rate[kEnergyVy] = energy * v.y();
        rate[kSpin] = flight.spin;
        rate[kSpinEnergy] = spin_energy;
        return rate;
      });
    });
  }
  for (const WitnessedTouch& touch : witness.touches()) {
    const Vec2 branch = touch.first - touch.second;
    // A collision of two disks transfers half the difference along the branch. A wall transfers
    // all.
    const double passed =
        touch.side >= 0 ? touch.gains[0] : 0.5 * (touch.gains[0] - touch.gains[1]);
    std::vector<double> borders;
    add_borders(borders, 0.0, 1.0, touch.second, branch, Vec2::Zero());
    in_parts(borders, 0.0, 1.0, [&](double middle, double from, double to) {
      Numbers* cell = cell_at(touch.time, touch.second + middle * branch);
      if (!cell) return;
      const Vec2 part = (to - from) * branch;
      (*cell)[kTransferXX] += part.x() * touch.impulse.x();
      (*cell)[kTransferXY] += part.x() * touch.impulse.y();
      (*cell)[kTransferYX] += part.y() * touch.impulse.x();
      (*cell)[kTransferYY] += part.y() * touch.impulse.y();
      (*cell)[kEnergyX] += part.x() * passed;
      (*cell)[kEnergyY] += part.y() * passed;
    });
    if (touch.side >= 0) continue;
    for (const Vec2& end : {touch.first, touch.second}) {
      Numbers* cell = cell_at(touch.time, end);
      if (cell) (*cell)[kSources] += 0.5 * (touch.gains[0] + touch.gains[1]);
    }
  }
  return sums;
}

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
