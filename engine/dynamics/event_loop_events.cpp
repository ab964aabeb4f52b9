#include <fmt/format.h>

#include <algorithm>
#include <utility>
#include <vector>

#include "engine/dynamics/collision_rules.h"
#include "engine/dynamics/event_loop.h"
#include "engine/dynamics/prefetch.h"
#include "engine/error.h"
#include "engine/laws/limits.h"
#include "engine/physics/random.h"

// The effects of events on particles; event_loop.cpp has the loop.

namespace clatter {

template <int D>
void EventLoop<D>::enter_next_cell(std::uint32_t number) {
  Plan<D>& plan = plans_[number];
  if (near_.leaves_all(plan.cell, plan.partner)) [[unlikely]]
    return retire(number);
  gas_.particles.move_image(
      number, near_.leave(model_, gas_.particles, number, plan.cell, plan.partner, now_));
  ++counts_.cell_crossings;
  prediction_.plan({number, &plan}, now_);
  schedule(number);
}

// Removes a particle that leaves the subdomain. Plans of others to meet it become stale.
template <int D>
void EventLoop<D>::retire(std::uint32_t number) {
  Plan<D>& plan = plans_[number];
  near_.remove(number, plan.cell);
  plan.time = kNever;
  Flight<D>& flight = gas_.particles.flight(number);
  flight.number += kNoFlight;
  note_stray(number, flight.at(now_, model_.gravity));
}

// Records the way of a particle of a tile from its place at the start.
template <int D>
void EventLoop<D>::note_stray(std::uint32_t number, const Vec<D>& position) {
  auto& stray = record_->strays[number];
  const Vec<D> place = position - domain_.shift(gas_.particles.image(number)) - lower_;
  float squared_way = 0.0f;
  for (int axis = 0; axis < D; ++axis) {
    const float way = record_->cut[axis] * (static_cast<float>(place[axis]) - stray.home[axis]);
    squared_way += way * way;
  }
  stray.squared_way = std::max(stray.squared_way, squared_way);
}

// Records a collision in a tile. Returns whether it belongs to the tile.
template <int D>
bool EventLoop<D>::note(const Event& event, const IntVec<D>& image) {
  const auto& [time, particle, partner] = event;
  const bool pair = partner < kPiece;
  TileRecord<D>& record = *record_;
  bool own = record.own[particle];
  if (pair && own != record.own[partner]) {
    own = record.own[record.numbers[particle] < record.numbers[partner] ? particle : partner];
  }
  if (!own) return false;
  ++(pair ? record.pair_collisions : record.wall_collisions);
  if (record.keeps_events) {
    record.events.push_back({event, gas_.particles[particle].flight.number,
                             pair ? gas_.particles[partner].flight.number : 0, image});
  }
  return true;
}

// Position and velocity of a particle at its event. The case without gravity comes first, because
// its result is ready sooner.
template <int D>
typename EventLoop<D>::Motion EventLoop<D>::motion_now(std::uint32_t number) {
  const Flight<D>& flight = gas_.particles[number].flight;
  Motion motion{flight.r + flight.v * (now_ - flight.time), flight.v};
  if (model_.has_gravity()) {
    motion = {flight.at(now_, model_.gravity), flight.velocity_at(now_, model_.gravity)};
  }
  if (!gas_.remainders.empty()) carry_remainder(number, motion.r);
  return motion;
}

// Compensated summation of flights: adds the accumulated rounding errors of the positions,
// including the current one.
template <int D>
void EventLoop<D>::carry_remainder(std::uint32_t number, Vec<D>& position) {
  const Flight<D>& flight = gas_.particles[number].flight;
  const double dt = now_ - flight.time;
  const Vec<D> way = (flight.v + model_.gravity * (0.5 * dt)) * dt;
  const Vec<D> left_out = gas_.remainders[number] + ((flight.r - position) + way);
  const Vec<D> rounded = position + left_out;
  gas_.remainders[number] = left_out - (rounded - position);
  position = rounded;
}

// Images of a sheared box are rounded several times in a contact, particles once.
static constexpr double kImageSteps = 16.0;

// Whether a body moves noticeably within the rounding of times. A particle may become fast long
// after the base, for example in a cold gas at a driven wall. In this case the base moves at once.
template <int D>
bool EventLoop<D>::is_fast(double velocity) const {
  constexpr double kFarthest = 16384.0;  // diameters in the time since the base: rounded by 2e-12
  return std::fabs(velocity) * now_ > kFarthest * model_.diameter;
}

// Begins a new flight at an event.
template <int D>
void EventLoop<D>::renew_flight(std::uint32_t number, const Vec<D>& position,
                                const Vec<D>& velocity) {
  if (is_fast(velocity.cwiseAbs().maxCoeff())) until_base_moves_ = 0;
  if (domain_.sheared && is_fast(kImageSteps * domain_.slide)) until_base_moves_ = 0;
  if (record_) note_stray(number, position);
  Flight<D>& flight = gas_.particles.flight(number);
  if (domain_.sheared) [[unlikely]] {
    const Domain<D> domain = domain_.at(now_);
    const Vec<D> image = domain.image_at(position);
    flight = {position - domain.shift(image), velocity - domain.velocity_x(image) * kAlongX<D>,
              now_, flight.number + 1};
    gas_.particles.move_image(number, -image);
    return;
  }
  const Vec<D> image = domain_.image_at(position);
  flight = {position - domain_.shift(image), velocity, now_, flight.number + 1};
  gas_.particles.move_image(number, -image);
}

template <int D>
Spin<D> EventLoop<D>::spin(std::uint32_t number) const {
  return gas_.spins.empty() ? Spin<D>(Spin<D>::Zero()) : gas_.spins[number];
}

template <int D>
void EventLoop<D>::add_spin(std::uint32_t number, const Spin<D>& gain) {
  if (!gas_.spins.empty()) gas_.spins[number] += gain;
}

template <int D>
bool EventLoop<D>::within_contact_time(std::uint32_t number) const {
  return !gas_.last_collisions.empty() &&
         now_ - gas_.last_collisions[number] < *model_.contact_time;
}

// The record of one particle's change for observers.
template <int D>
[[gnu::always_inline]] static inline ParticleChange<D> change_of(
    const ParticleStates<D>& gas, const Domain<D>& domain, std::uint32_t number, const Grain& grain,
    const Vec<D>& position, const Vec<D>& velocity, const Spin<D>& spin, const Impulse<D>& gain) {
  return {
      number, grain, gas.particles[number].flight, position, domain.peculiar(position, velocity),
      spin,   gain};
}

template <int D>
void EventLoop<D>::collide(std::uint32_t first, std::uint32_t second, const IntVec<D>& image) {
  const Vec<D> shift = domain_.shift(image.template cast<double>(), now_);
  const auto [r_a, v_a] = motion_now(first);
  const auto [r_b, v_b] = motion_now(second);
  const Vec<D> x = (r_a - r_b) + shift;
  Vec<D> g = v_a - v_b;
  if (domain_.sheared) [[unlikely]]
    g += domain_.velocity_x(image.template cast<double>()) * kAlongX<D>;
  const bool mixed = !grains_.empty();
  const Grain &one = grain(first), &other = grain(second);
  const double distance = one.radius + other.radius;
  const double least = distance - checks_.deepest_overlap * model_.diameter;
  if (x.squaredNorm() < least * least) {
    checks_.deepest_overlap =
        std::max(checks_.deepest_overlap, (distance - x.norm()) / model_.diameter);
  }
  // Grazing particles may recede at contact by rounding. Then no momentum passes between them. The
  // event still counts, so that it is not predicted again from the same states.
  PairOutcome<D> outcome;
  if (x.dot(g) < 0.0 && gas_.spins.empty() && gas_.last_collisions.empty() && !mixed) {
    outcome.gain.momentum = collision_impulse<D>(x, g, model_.restitution, alike_partners_);
  } else if (x.dot(g) < 0.0) {
    const Spin<D> surface = one.radius * spin(first) + other.radius * spin(second);
    const bool elastic = within_contact_time(first) || within_contact_time(second);
    outcome =
        pair_outcome<D>(model_.pair(one.species, other.species).contact(),
                        mixed ? Partners(one, other) : alike_partners_, x, g, surface, elastic);
  }
  const Vec<D>& momentum = outcome.gain.momentum;
  if (!observers_.empty()) {
    const bool swap = second < first;
    const PairCollision<D> collision{
        now_,
        {change_of(gas_, domain_, swap ? second : first, swap ? other : one, swap ? r_b : r_a,
                   swap ? v_b : v_a, spin(swap ? second : first), outcome.gain.of(swap)),
         change_of(gas_, domain_, swap ? first : second, swap ? one : other, swap ? r_a : r_b,
                   swap ? v_a : v_b, spin(swap ? first : second), outcome.gain.of(!swap))},
        x * (swap ? -1.0 : 1.0),
        outcome.elasticised,
        outcome.undissipated,
        model_.shear_rate.value_or(0.0)};
    for (Observer<D>* observer : observers_) observer->on_collision(collision);
  }
  --until_base_moves_;
  if (mixed) {
    renew_flight(first, r_a, v_a + momentum / one.mass);
    renew_flight(second, r_b, v_b - momentum / other.mass);
  } else {
    renew_flight(first, r_a, v_a + momentum);
    renew_flight(second, r_b, v_b - momentum);
  }
  add_spin(first, outcome.gain.spins[0]);
  add_spin(second, outcome.gain.spins[1]);
  ++counts_.pair_collisions;
  counts_.elasticised += outcome.elasticised;
  if (!gas_.last_collisions.empty())
    gas_.last_collisions[first] = gas_.last_collisions[second] = now_;
}

template <int D>
Arrival<D> EventLoop<D>::arrival_of(std::uint32_t number, const Vec<D>& velocity) {
  return {velocity, spin(number), record_ ? record_->numbers[number] : number,
          std::uint64_t{gas_.era} << 32 | gas_.particles[number].flight.number, grain(number)};
}

// Reflects or emits a particle that touches a surface.
template <int D>
void EventLoop<D>::bounce(std::uint32_t number, const Motion& at, const Surface& surface,
                          const Wall& law, const WallState& motion) {
  const bool elastic = within_contact_time(number) && law.kind != WallKind::Thermal;
  depart(number, at, surface,
         wall_outcome<D>(model_, law, surface.normal, motion, arrival_of(number, at.v), elastic),
         elastic);
}

// Begins the flight of a particle that leaves a surface, and reports the collision.
template <int D>
void EventLoop<D>::depart(std::uint32_t number, const Motion& at, const Surface& surface,
                          const Departure<D>& departure, bool elastic) {
  if (!observers_.empty()) {
    const Spin<D> spin_gain = departure.spin - spin(number);
    const Vec<D> gain = grain(number).mass * (departure.velocity - at.v);
    const WallCollision<D> collision{now_,
                                     surface.side,
                                     change_of(gas_, domain_, number, grain(number), at.r, at.v,
                                               spin(number), Impulse<D>{gain, spin_gain}),
                                     surface.normal,
                                     surface.fixture,
                                     surface.point,
                                     surface.at_centre};
    for (Observer<D>* observer : observers_) observer->on_wall(collision);
  }
  --until_base_moves_;
  renew_flight(number, at.r, departure.velocity);
  if (!gas_.spins.empty()) gas_.spins[number] = departure.spin;
  ++counts_.wall_collisions;
  counts_.elasticised_wall += elastic;
  if (!gas_.last_collisions.empty()) gas_.last_collisions[number] = now_;
}

template <int D>
void EventLoop<D>::hit(std::uint32_t number, std::uint32_t partner, const IntVec<D>& image) {
  if (partner >= kWall) {
    hit_wall(number, static_cast<int>(partner - kWall));
  } else {
    hit_fixture(number, partner - kPiece, image);
  }
}

template <int D>
void EventLoop<D>::hit_wall(std::uint32_t number, int side) {
  const int axis = side / 2;
  Motion at = motion_now(number);
  const double place = boundary_.touching_place(side, grain(number).radius, now_);
  const double beyond = Boundary<D>::inward(side) * (place - at.r[axis]);
  checks_.deepest_overlap = std::max(checks_.deepest_overlap, beyond / model_.diameter);
  // At a fixed wall the position is set to the exact touching coordinate. Otherwise a grain at rest
  // would sink into the wall by rounding.
  if (!model_.walls[side]->moves()) {
    at.r[axis] = place;
    if (!gas_.remainders.empty()) gas_.remainders[number][axis] = 0.0;
  }
  bounce(number, at, {side, 0, Boundary<D>::normal(side), Vec<D>::Zero()},
         model_.wall(side, grain(number).species), boundary_.wall(side, now_));
}

// The position is set to that of contact, as at a fixed wall.
template <int D>
void EventLoop<D>::hit_fixture(std::uint32_t number, std::uint32_t piece, const IntVec<D>& image) {
  const auto& [touched, fixture, valve] = near_.piece(piece);
  Motion at = motion_now(number);
  const Vec<D> place = at.r + domain_.shift(image.template cast<double>());
  if (valve != PieceLists<D>::kNoValve) return meet_valve(number, at, place, near_.piece(piece));
  const Vec<D> normal = touched.normal_at(place);
  const double beyond = grain(number).radius - touched.distance(place);
  checks_.deepest_overlap = std::max(checks_.deepest_overlap, beyond / model_.diameter);
  at.r += beyond * normal;
  bounce(number, at,
         {WallCollision<D>::kNoSide, fixture, normal,
          place - (grain(number).radius - beyond) * normal},
         model_.fixtures[fixture].law_for(grain(number).species), {});
}

// The centre of the particle is put on the plane of the valve, so that the next flight begins
// there.
template <int D>
void EventLoop<D>::meet_valve(std::uint32_t number, const Motion& at, const Vec<D>& place,
                              const typename PieceLists<D>::Owned& opening) {
  const Fixture<D>& fixture = model_.fixtures[opening.fixture];
  const int axis = fixture.plane->axis;
  const int side = at.v[axis] > 0.0 ? -1 : 1;
  Motion there = at;
  there.r[axis] += opening.piece.corner[axis] - place[axis];
  if (fixture.valves[opening.valve].passes(side, at.v.norm())) {
    const Kick<D> passage{
        now_,
        change_of(gas_, domain_, number, grain(number), there.r, at.v, spin(number), Impulse<D>{}),
        KickCause::Passage};
    for (Observer<D>* observer : observers_) observer->on_kick(passage);
    renew_flight(number, there.r, at.v);
    ++counts_.cell_crossings;
    return;
  }
  const Vec<D> normal = side * Vec<D>::Unit(axis);
  const Vec<D> velocity = at.v - 2.0 * at.v[axis] * Vec<D>::Unit(axis);
  depart(number, there, {WallCollision<D>::kNoSide, opening.fixture, normal, place, true},
         {velocity, spin(number)}, false);
}

// The position is set to that of contact, as at a fixed wall.
template <int D>
void EventLoop<D>::hit_piston(std::uint32_t number) {
  const FreePiston& piston = *model_.free_piston;
  const PistonFlight& flight = piston_->flight();
  const double place = flight.at(now_), velocity = flight.velocity_at(now_);
  Motion at = motion_now(number);
  const double side = at.r[piston.axis] < place ? -1.0 : 1.0;
  const Vec<D> normal = side * Vec<D>::Unit(piston.axis);
  const double radius = grain(number).radius;
  const double touching = place + side * (0.5 * piston.thickness + radius);
  const double beyond = side * (touching - at.r[piston.axis]);
  checks_.deepest_overlap = std::max(checks_.deepest_overlap, beyond / model_.diameter);
  at.r[piston.axis] = touching;
  if (!gas_.remainders.empty()) gas_.remainders[number][piston.axis] = 0.0;
  const bool elastic = within_contact_time(number);
  const PistonOutcome<D> outcome =
      piston_outcome<D>(model_, side, velocity, arrival_of(number, at.v), elastic);
  depart(number, at,
         {WallCollision<D>::kNoSide, WallCollision<D>::kOfPiston, normal, at.r - radius * normal},
         outcome.departure, elastic);
  if (piston.pinned) return;
  fly_piston(PistonChange::Cause::Particle, place, velocity - outcome.momentum / piston.mass);
}

// Begins a flight of the piston, and reports it.
template <int D>
void EventLoop<D>::fly_piston(PistonChange::Cause cause, double place, double velocity) {
  const PistonFlight after{place, velocity, model_.free_piston->acceleration(), now_};
  if (is_fast(velocity)) until_base_moves_ = 0;
  const PistonChange change{now_, cause, piston_->flight(), after};
  for (Observer<D>* observer : observers_) observer->on_piston(change);
  piston_->fly(after);
}

template <int D>
void EventLoop<D>::gather_piston() {
  piston_->gather(
      gas_.particles.size(), [this](std::uint32_t i) -> const IntVec<D>& { return plans_[i].cell; },
      now_);
}

template <int D>
typename EventLoop<D>::Halt EventLoop<D>::process_piston() {
  const auto [time, cause, number] = piston_->next();
  checks_.clock_steps_back = std::max(checks_.clock_steps_back, now_ - time);
  now_ = std::max(now_, time);
  if (cause == PistonMotion<D>::Cause::Particle) {
    hit_piston(number);
    prediction_.plan({number, &plans_[number]}, now_);
    schedule(number);
    return after({time, number, kPiston}, true);
  }
  ++counts_.cell_crossings;
  if (cause == PistonMotion<D>::Cause::Zone) {
    gather_piston();
    return Halt::Limit;
  }
  const auto side = static_cast<int>(number);
  fly_piston(PistonChange::Cause::Wall,
             boundary_.touching_place(side, 0.5 * model_.free_piston->thickness, now_),
             2.0 * Boundary<D>::inward(side) * boundary_.wall(side, now_).velocity -
                 piston_->flight().velocity_at(now_));
  return base_due() ? Halt::BaseDue : Halt::Limit;
}

// Takes the changed laws of the piston. A pinned piston loses its velocity.
template <int D>
void EventLoop<D>::set_piston_laws(bool report, bool gather) {
  const FreePiston& law = *model_.free_piston;
  const PistonFlight& before = piston_->flight();
  const double velocity = law.pinned ? 0.0 : before.velocity_at(now_);
  const bool same =
      before.acceleration == law.acceleration() && velocity == before.velocity_at(now_);
  if (!same) {
    const PistonFlight after{before.at(now_), velocity, law.acceleration(), now_};
    const PistonChange change{now_, PistonChange::Cause::Laws, before, after};
    if (report) {
      for (Observer<D>* observer : observers_) observer->on_piston(change);
    }
    piston_->set_flight(after);
  }
  if (gather) gather_piston();
}

// The total momentum stays: every particle loses the same velocity.
template <int D>
void EventLoop<D>::kick() {
  const auto count = static_cast<std::uint32_t>(gas_.particles.size());
  double mass = 0.0;
  for (std::uint32_t i = 0; i < count; ++i) mass += grain(i).mass;
  std::vector<Vec<D>> velocities(count);
  std::vector<Spin<D>> spins(count, Spin<D>::Zero());
  Vec<D> mean = Vec<D>::Zero();
  for (std::uint32_t i = 0; i < count; ++i) {
    Random random(model_.seed, Stream::Kick, i, counts_.kicks);
    const double speed = model_.bulk_drive->kick_speed_of(grain(i).mass);
    for (double& v : velocities[i]) v = speed * random.normal();
    if (model_.spins) {
      for (double& w : spins[i]) w = model_.bulk_drive->kick_spin * random.normal();
    }
    mean += velocities[i] / (mass / grain(i).mass);
  }
  for (std::uint32_t i = 0; i < count; ++i) {
    const Vec<D> gain = velocities[i] - mean;
    const auto [r, v] = motion_now(i);
    const Kick<D> kick{now_, change_of(gas_, domain_, i, grain(i), r, v, spin(i),
                                       Impulse<D>{grain(i).mass * gain, spins[i]})};
    for (Observer<D>* observer : observers_) observer->on_kick(kick);
    renew_flight(i, r, v + gain);
    add_spin(i, spins[i]);
  }
  ++counts_.kicks;
}

// Whether the centre of a particle is in the region of a nudge.
template <int D>
static bool is_in_region(const Domain<D>& domain, const Nudge& nudge, const Vec<D>& position) {
  const Vec<D> way = domain.shortest(domain.wrapped(position) - Vec<D>(*nudge.centre));
  return way.squaredNorm() <= *nudge.radius * *nudge.radius;
}

template <int D>
std::vector<NewVelocity<D>> EventLoop<D>::velocities_after(const Nudge& nudge) const {
  std::vector<NewVelocity<D>> velocities;
  Vec<D> mean = Vec<D>::Zero();
  double mass = 0.0;
  for (std::uint32_t i = 0; i < gas_.particles.size(); ++i) {
    const Flight<D>& flight = gas_.particles[i].flight;
    const bool chosen =
        nudge.particle ? static_cast<std::uint32_t>(*nudge.particle) == i
                       : is_in_region<D>(domain_.at(now_), nudge, flight.at(now_, model_.gravity));
    if (!chosen) continue;
    velocities.push_back({i, domain_.peculiar(flight.at(now_, model_.gravity),
                                              flight.velocity_at(now_, model_.gravity))});
    mean += grain(i).mass * velocities.back().velocity;
    mass += grain(i).mass;
  }
  if (mass > 0.0) mean /= mass;
  for (auto& [particle, velocity] : velocities) {
    if (nudge.scale) velocity = mean + *nudge.scale * (velocity - mean);
    if (nudge.add) velocity += Vec<D>(*nudge.add);
    if (nudge.set) velocity = Vec<D>(*nudge.set);
    if (velocity.norm() <= kMaxSpeed) continue;
    throw PhysicalStop(fmt::format("a nudge gives particle {} a speed above {:.0e}; make it weaker",
                                   particle, kMaxSpeed));
  }
  return velocities;
}

template <int D>
void EventLoop<D>::nudge(const std::vector<NewVelocity<D>>& velocities,
                         std::uint64_t EventCounts::*count) {
  for (const NewVelocity<D>& next : velocities) {
    const auto [r, v] = motion_now(next.particle);
    const Vec<D> change = next.velocity - domain_.peculiar(r, v);
    const Vec<D> gain = grain(next.particle).mass * change;
    const Kick<D> kick{now_,
                       change_of(gas_, domain_, next.particle, grain(next.particle), r, v,
                                 spin(next.particle), Impulse<D>{gain, Spin<D>::Zero()}),
                       KickCause::Nudge};
    for (Observer<D>* observer : observers_) observer->on_kick(kick);
    renew_flight(next.particle, r, domain_.sheared ? v + change : next.velocity);
  }
  ++(counts_.*count);
  if (watchdog_) watchdog_.emplace(gas_.particles.size(), now_);
}

template <int D>
void EventLoop<D>::reverse() {
  for (std::uint32_t i = 0; i < gas_.particles.size(); ++i) {
    const auto [r, v] = motion_now(i);
    const Vec<D> peculiar = domain_.peculiar(r, v);
    const Spin<D> gain = -2.0 * spin(i);
    const Kick<D> kick{now_,
                       change_of(gas_, domain_, i, grain(i), r, v, spin(i),
                                 Impulse<D>{-2.0 * grain(i).mass * peculiar, gain}),
                       KickCause::Nudge};
    for (Observer<D>* observer : observers_) observer->on_kick(kick);
    Vec<D> after = -v;
    if (domain_.sheared) after = v - 2.0 * peculiar;
    renew_flight(i, r, after);
    add_spin(i, gain);
  }
  if (piston_) {
    const PistonFlight& flight = piston_->flight();
    fly_piston(PistonChange::Cause::Laws, flight.at(now_), -flight.velocity_at(now_));
  }
  ++counts_.nudges;
  if (watchdog_) watchdog_.emplace(gas_.particles.size(), now_);
}

template <int D>
void EventLoop<D>::begin_stroke() {
  ++counts_.strokes;
  watchdog_.emplace(gas_.particles.size(), now_);
}

template void EventLoop<2>::enter_next_cell(std::uint32_t);
template void EventLoop<3>::enter_next_cell(std::uint32_t);
template bool EventLoop<2>::note(const Event&, const IntVec<2>&);
template bool EventLoop<3>::note(const Event&, const IntVec<3>&);
template Spin<2> EventLoop<2>::spin(std::uint32_t) const;
template Spin<3> EventLoop<3>::spin(std::uint32_t) const;
template void EventLoop<2>::add_spin(std::uint32_t, const Spin<2>&);
template void EventLoop<3>::add_spin(std::uint32_t, const Spin<3>&);
template void EventLoop<2>::carry_remainder(std::uint32_t, Vec2&);
template void EventLoop<3>::carry_remainder(std::uint32_t, Vec<3>&);
template void EventLoop<2>::retire(std::uint32_t);
template void EventLoop<3>::retire(std::uint32_t);
template void EventLoop<2>::note_stray(std::uint32_t, const Vec2&);
template void EventLoop<3>::note_stray(std::uint32_t, const Vec<3>&);
template bool EventLoop<2>::within_contact_time(std::uint32_t) const;
template bool EventLoop<3>::within_contact_time(std::uint32_t) const;
template void EventLoop<2>::collide(std::uint32_t, std::uint32_t, const IntVec<2>&);
template void EventLoop<3>::collide(std::uint32_t, std::uint32_t, const IntVec<3>&);
template void EventLoop<2>::hit(std::uint32_t, std::uint32_t, const IntVec<2>&);
template void EventLoop<3>::hit(std::uint32_t, std::uint32_t, const IntVec<3>&);
template void EventLoop<2>::hit_wall(std::uint32_t, int);
template void EventLoop<3>::hit_wall(std::uint32_t, int);
template void EventLoop<2>::hit_fixture(std::uint32_t, std::uint32_t, const IntVec<2>&);
template void EventLoop<3>::hit_fixture(std::uint32_t, std::uint32_t, const IntVec<3>&);
template EventLoop<2>::Halt EventLoop<2>::process_piston();
template EventLoop<3>::Halt EventLoop<3>::process_piston();
template void EventLoop<2>::meet_valve(std::uint32_t, const Motion&, const Vec2&,
                                       const PieceLists<2>::Owned&);
template void EventLoop<3>::meet_valve(std::uint32_t, const Motion&, const Vec<3>&,
                                       const PieceLists<3>::Owned&);
template void EventLoop<2>::hit_piston(std::uint32_t);
template void EventLoop<3>::hit_piston(std::uint32_t);
template void EventLoop<2>::fly_piston(PistonChange::Cause, double, double);
template void EventLoop<3>::fly_piston(PistonChange::Cause, double, double);
template void EventLoop<2>::gather_piston();
template void EventLoop<3>::gather_piston();
template void EventLoop<2>::set_piston_laws(bool, bool);
template void EventLoop<3>::set_piston_laws(bool, bool);
template void EventLoop<2>::reverse();
template void EventLoop<3>::reverse();
template void EventLoop<2>::begin_stroke();
template void EventLoop<3>::begin_stroke();
template void EventLoop<2>::kick();
template void EventLoop<3>::kick();
template std::vector<NewVelocity<2>> EventLoop<2>::velocities_after(const Nudge&) const;
template std::vector<NewVelocity<3>> EventLoop<3>::velocities_after(const Nudge&) const;
template void EventLoop<2>::nudge(const std::vector<NewVelocity<2>>&, std::uint64_t EventCounts::*);
template void EventLoop<3>::nudge(const std::vector<NewVelocity<3>>&, std::uint64_t EventCounts::*);

}  // namespace clatter
