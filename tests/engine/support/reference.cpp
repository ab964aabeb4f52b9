#include "tests/engine/support/reference.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <utility>

#include "engine/dynamics/collision_rules.h"
#include "engine/physics/contact.h"
#include "engine/physics/random.h"

namespace clatter::testing {

Reference::Reference(const Model<2>& model, const State<2>& state, const BaseMoves& moves)
    : model_(model),
      boundary_(model_, clock_),
      spins_(state.spins),
      last_collisions_(state.positions.size(), -kNever),
      moves_(moves) {
  spins_.resize(model.spins ? state.positions.size() : 0, Spin<2>::Zero());
  for (std::size_t i = 0; i < state.positions.size(); ++i) {
    flights_.push_back({state.positions[i], state.velocities[i], 0.0, 0});
  }
}

void Reference::run_until_collisions(std::uint64_t collisions) {
  while (particle_particle_ + particle_wall_ < collisions && step()) continue;
}

// Looks farther and farther ahead until something happens; 10^9 times the first look is never.
bool Reference::step() {
  double fastest = 0.0;
  for (const Flight<2>& flight : flights_) {
    fastest = std::max(fastest, flight.velocity_at(now_, model_.gravity).norm());
  }
  fastest += std::sqrt(model_.gravity.norm() * model_.box.minCoeff());
  if (fastest == 0.0) fastest = 1.0;  // a moving wall, or a kick, may come yet
  const double first_look = model_.box.minCoeff() / fastest;
  for (double look = first_look; look < 1e9 * first_look; look *= 4.0) {
    const Next next = first_before(now_ + look);
    const double kick_time = next_kick();
    if (std::min(next.event.time, kick_time) > now_ + look) continue;
    if (kick_time < next.event.time) {
      now_ = kick_time;
      kick();
    } else {
      now_ = std::max(now_, next.event.time);
      next.event.partner < kWall ? collide(next) : hit_wall(next.event);
    }
    if (moves_.after(particle_particle_ + particle_wall_ + kicks_)) move_base();
    return true;
  }
  return false;
}

Reference::Next Reference::first_before(double horizon) const {
  Next first;
  const auto count = static_cast<std::uint32_t>(flights_.size());
  for (std::uint32_t i = 0; i < count; ++i) {
    for (std::uint32_t j = i + 1; j < count; ++j) weigh_pair(i, j, horizon, first);
    weigh_walls(i, first);
  }
  return first;
}

// All images that the pair can reach until the horizon, in the order in which ties count.
void Reference::weigh_pair(std::uint32_t i, std::uint32_t j, double horizon, Next& first) const {
  const Flight<2>& a = flights_[i];
  const Flight<2>& b = flights_[j];
  const Vec2 x = a.at(now_, model_.gravity) - b.at(now_, model_.gravity);
  const Vec2 g = a.velocity_at(now_, model_.gravity) - b.velocity_at(now_, model_.gravity);
  IntVec<2> from = {0, 0}, to = {0, 0};
  for (int axis = 0; axis < 2; ++axis) {
    if (model_.periodic(axis)) {
      const double reach = model_.diameter + std::fabs(g[axis]) * (horizon - now_);
      from[axis] = static_cast<int>(std::floor((-x[axis] - reach) / model_.box[axis])) - 1;
      to[axis] = static_cast<int>(std::ceil((-x[axis] + reach) / model_.box[axis])) + 1;
    }
  }
  for (int kx = from.x(); kx <= to.x(); ++kx) {
    for (int ky = from.y(); ky <= to.y(); ++ky) {
      const Vec2 shift = {kx * model_.box.x(), ky * model_.box.y()};
      const Event event{contact_time<2>(a, b, shift, model_.diameter, model_.gravity), i, j};
      if (event.time < kNever && before(event, first.event)) first = {event, {kx, ky}};
    }
  }
}

void Reference::weigh_walls(std::uint32_t i, Next& first) const {
  for (int side = 0; side < 4; ++side) {
    if (!model_.walls[side]) continue;
    const double time = boundary_.contact_time(side, flights_[i], now_);
    const Event event{time, i, kWall + static_cast<std::uint32_t>(side)};
    if (time < kNever && before(event, first.event)) first = {event, {0, 0}};
  }
}

Spin<2> Reference::spin(std::uint32_t i) const {
  return spins_.empty() ? Spin<2>(Spin<2>::Zero()) : spins_[i];
}

bool Reference::within_contact_time(std::uint32_t i) const {
  return model_.contact_time && now_ - last_collisions_[i] < *model_.contact_time;
}

void Reference::collide(const Next& next) {
  const std::uint32_t i = next.event.particle, j = next.event.partner;
  const Flight<2>&a = flights_[i], &b = flights_[j];
  const Vec2 r_a = a.at(now_, model_.gravity), r_b = b.at(now_, model_.gravity);
  const Vec2 v_a = a.velocity_at(now_, model_.gravity), v_b = b.velocity_at(now_, model_.gravity);
  const Vec2 x = (r_a - r_b) + next.image.cast<double>().cwiseProduct(model_.box);
  Impulse<2> gain;
  if (x.dot(v_a - v_b) < 0.0) {
    const bool elastic = within_contact_time(i) || within_contact_time(j);
    gain = pair_outcome<2>(model_, x, v_a - v_b, spin(i) + spin(j), elastic).gain;
  }
  renew(i, r_a, v_a + gain.momentum, spin(i) + gain.spin);
  renew(j, r_b, v_b - gain.momentum, spin(j) + gain.spin);
  last_collisions_[i] = last_collisions_[j] = now_;
  ++particle_particle_;
}

void Reference::hit_wall(const Event& event) {
  const std::uint32_t i = event.particle;
  const int side = static_cast<int>(event.partner - kWall);
  Vec2 r = flights_[i].at(now_, model_.gravity);
  if (!model_.walls[side]->moves()) r[side / 2] = boundary_.touching_place(side, now_);
  const Departure<2> departure = wall_outcome<2>(
      model_, side, boundary_.wall(side, now_),
      {flights_[i].velocity_at(now_, model_.gravity), spin(i), i, flights_[i].number},
      within_contact_time(i));
  renew(i, r, departure.velocity, departure.spin);
  last_collisions_[i] = now_;
  ++particle_wall_;
}

double Reference::next_kick() const {
  return model_.bulk_drive ? clock_.relative(0.0, kicks_ + 1, model_.bulk_drive->interval) : kNever;
}

void Reference::kick() {
  const auto count = static_cast<std::uint32_t>(flights_.size());
  std::vector<Vec2> kicks(count);
  std::vector<Spin<2>> spin_kicks(count, Spin<2>::Zero());
  Vec2 mean = Vec2::Zero();
  for (std::uint32_t i = 0; i < count; ++i) {
    Random random(model_.seed, Stream::Kick, i, static_cast<std::uint32_t>(kicks_));
    kicks[i].x() = model_.bulk_drive->kick_speed * random.normal();
    kicks[i].y() = model_.bulk_drive->kick_speed * random.normal();
    if (model_.spins) spin_kicks[i][0] = model_.bulk_drive->kick_spin * random.normal();
    mean += kicks[i] / count;
  }
  for (std::uint32_t i = 0; i < count; ++i) {
    renew(i, flights_[i].at(now_, model_.gravity),
          flights_[i].velocity_at(now_, model_.gravity) + (kicks[i] - mean),
          spin(i) + spin_kicks[i]);
  }
  ++kicks_;
}

void Reference::renew(std::uint32_t i, const Vec2& r, const Vec2& v, const Spin<2>& spin) {
  flights_[i] = {wrapped(r), v, now_, flights_[i].number + 1};
  if (!spins_.empty()) spins_[i] = spin;
}

Vec2 Reference::wrapped(const Vec2& r) const {
  Vec2 inside = r;
  for (int axis = 0; axis < 2; ++axis) {
    if (model_.periodic(axis)) {
      inside[axis] -= std::floor(r[axis] / model_.box[axis]) * model_.box[axis];
    }
  }
  return inside;
}

void Reference::move_base() {
  for (Flight<2>& flight : flights_) flight.time -= now_;
  for (double& time : last_collisions_) time -= now_;
  clock_.advance(now_);
  boundary_.move_base(clock_);
  now_ = 0.0;
}

State<2> Reference::state() const {
  State<2> state;
  for (const Flight<2>& flight : flights_) {
    state.positions.push_back(wrapped(flight.at(now_, model_.gravity)));
    state.velocities.push_back(flight.velocity_at(now_, model_.gravity));
  }
  state.spins = spins_;
  return state;
}

}  // namespace clatter::testing
