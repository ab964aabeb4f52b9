#include "tests/engine/support/reference.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <utility>

#include "engine/physics/collision.h"
#include "engine/physics/contact.h"
#include "engine/physics/random.h"
#include "engine/physics/walls.h"

namespace clatter::testing {

Reference::Reference(const Model<2>& model, const State<2>& state)
    : model_(model), until_base_moves_(std::max<std::uint64_t>(64, state.positions.size())) {
  for (std::size_t i = 0; i < state.positions.size(); ++i) {
    flights_.push_back({state.positions[i], state.velocities[i], 0.0, 0});
  }
}

void Reference::run_until_collisions(std::uint64_t collisions) {
  while (disk_disk_ + disk_wall_ < collisions && step()) continue;
}

// Looks farther and farther ahead until something happens; 10^9 times the first look is never.
bool Reference::step() {
  double fastest = 0.0;
  for (const Flight<2>& flight : flights_) fastest = std::max(fastest, flight.v.norm());
  if (fastest == 0.0) return false;
  const double first_look = model_.box.minCoeff() / fastest;
  for (double look = first_look; look < 1e9 * first_look; look *= 4.0) {
    const Next next = first_before(now_ + look);
    if (next.event.time > now_ + look) continue;
    now_ = next.event.time;
    if (next.event.partner < kWall) {
      collide(next);
    } else {
      hit_wall(next.event);
    }
    if (--until_base_moves_ == 0) move_base();
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
  const Vec2 x = a.at(now_) - b.at(now_);
  const Vec2 g = a.v - b.v;
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
      const Event event{contact_time<2>(a, b, shift, model_.diameter), i, j};
      if (event.time < kNever && before(event, first.event)) first = {event, {kx, ky}};
    }
  }
}

void Reference::weigh_walls(std::uint32_t i, Next& first) const {
  for (int side = 0; side < 4; ++side) {
    if (!model_.walls[side]) continue;
    const int axis = side / 2, end = side % 2;
    const double time =
        plane_contact_time<2>(flights_[i], axis, model_.wall_plane(axis, end), end ? -1.0 : 1.0);
    const Event event{time, i, kWall + static_cast<std::uint32_t>(side)};
    if (time < kNever && before(event, first.event)) first = {event, {0, 0}};
  }
}

void Reference::collide(const Next& next) {
  Flight<2>& a = flights_[next.event.disk];
  Flight<2>& b = flights_[next.event.partner];
  const Vec2 r_a = a.at(now_), r_b = b.at(now_);
  const Vec2 x = (r_a - r_b) + next.image.cast<double>().cwiseProduct(model_.box);
  const Vec2 g = a.v - b.v;
  Vec2 impulse = Vec2::Zero();
  if (x.dot(g) < 0.0) impulse = collision_impulse<2>(x, g, model_.restitution);
  renew(a, r_a, a.v + impulse);
  renew(b, r_b, b.v - impulse);
  ++disk_disk_;
}

void Reference::hit_wall(const Event& event) {
  Flight<2>& flight = flights_[event.disk];
  const int side = static_cast<int>(event.partner - kWall);
  const Wall& wall = *model_.walls[side];
  const double inward = side % 2 ? -1.0 : 1.0;
  Vec2 v;
  if (wall.kind == WallKind::Thermal) {
    Random random(model_.seed, Stream::ThermalWall, event.disk, flight.number);
    const double uniform = random.uniform();
    const double normal = random.normal();
    v = emit<2>(side / 2, inward, wall.temperature, uniform, &normal);
  } else {
    v = reflect<2>(flight.v, side / 2, inward, wall.restitution, wall.drive_speed);
  }
  renew(flight, flight.at(now_), v);
  ++disk_wall_;
}

void Reference::renew(Flight<2>& flight, const Vec2& r, const Vec2& v) {
  flight = {wrapped(r), v, now_, flight.number + 1};
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

// When the base moves is part of what a run is: it rounds the times at which flights started.
void Reference::move_base() {
  for (Flight<2>& flight : flights_) flight.time -= now_;
  now_ = 0.0;
  until_base_moves_ = std::max<std::uint64_t>(64, 32 * flights_.size());
}

State<2> Reference::state() const {
  State<2> state;
  for (const Flight<2>& flight : flights_) {
    state.positions.push_back(wrapped(flight.at(now_)));
    state.velocities.push_back(flight.v);
  }
  return state;
}

}  // namespace clatter::testing
