#include "tests/engine/support/reference.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <utility>

#include "engine/dynamics/collision_rules.h"
#include "engine/physics/contact.h"
#include "engine/physics/random.h"

namespace clatter::testing {

template <int D>
Reference<D>::Reference(const Model<D>& model, const State<D>& state, const BaseMoves<D>& moves)
    : model_(model),
      boundary_(model_, clock_),
      grains_(state.grains),
      spins_(state.spins),
      last_collisions_(state.positions.size(), -kNever),
      moves_(moves) {
  if (const auto& piston = model.free_piston) {
    piston_ = {piston->position, piston->speed, piston->acceleration(), 0.0};
  }
  spins_.resize(model.spins ? state.positions.size() : 0, Spin<D>::Zero());
  for (std::size_t i = 0; i < state.positions.size(); ++i) {
    flights_.push_back({state.positions[i], state.velocities[i], 0.0, 0});
  }
}

template <int D>
void Reference<D>::run_until_collisions(std::uint64_t collisions) {
  while (particle_particle_ + particle_wall_ < collisions && step()) continue;
}

// Increases the look-ahead until there is an event. No event within 10^9 times the first look-ahead
// means never.
template <int D>
bool Reference<D>::step() {
  double fastest = 0.0;
  for (const Flight<D>& flight : flights_) {
    fastest = std::max(fastest, flight.velocity_at(now_, model_.gravity).norm());
  }
  fastest += std::sqrt(model_.gravity.norm() * model_.box.minCoeff());
  if (fastest == 0.0) fastest = 1.0;  // a moving wall or a kick may still come
  const double first_look = model_.box.minCoeff() / fastest;
  for (double look = first_look; look < 1e9 * first_look; look *= 4.0) {
    const Next next = first_before(now_ + look);
    if (model_.free_piston && reflect_piston(std::min(next.event.time, now_ + look))) return true;
    const double kick_time = next_kick();
    if (std::min(next.event.time, kick_time) > now_ + look) continue;
    if (kick_time < next.event.time) {
      now_ = kick_time;
      kick();
    } else {
      now_ = std::max(now_, next.event.time);
      if (next.event.partner < kPiece) {
        collide(next);
      } else if (next.event.partner < kWall) {
        hit_fixture(next);
      } else if (next.event.partner == kPiston) {
        hit_piston(next.event.particle);
      } else {
        hit_wall(next.event);
      }
    }
    if (moves_.after(particle_particle_ + particle_wall_ + kicks_)) move_base();
    return true;
  }
  return false;
}

template <int D>
typename Reference<D>::Next Reference<D>::first_before(double horizon) const {
  Next first;
  const auto count = static_cast<std::uint32_t>(flights_.size());
  for (std::uint32_t i = 0; i < count; ++i) {
    for (std::uint32_t j = i + 1; j < count; ++j) weigh_pair(i, j, horizon, first);
    weigh_walls(i, first);
    weigh_fixtures(i, horizon, first);
    weigh_piston(i, first);
  }
  return first;
}

// All images that the pair can reach before the horizon, in the order that decides ties.
template <int D>
void Reference<D>::weigh_pair(std::uint32_t i, std::uint32_t j, double horizon, Next& first) const {
  const Flight<D>& a = flights_[i];
  const Flight<D>& b = flights_[j];
  const Domain<D>& domain = boundary_.domain();
  const double distance = grain(i).radius + grain(j).radius;
  const Vec<D> x = a.at(now_, model_.gravity) - b.at(now_, model_.gravity);
  const Vec<D> g = a.velocity_at(now_, model_.gravity) - b.velocity_at(now_, model_.gravity);
  IntVec<D> from = IntVec<D>::Zero(), to = IntVec<D>::Zero();
  const auto set_range = [&](int axis, double place, double way) {
    if (!model_.periodic(axis)) return;
    const double reach = distance + std::fabs(way);
    from[axis] = static_cast<int>(std::floor((-place - reach) / model_.box[axis])) - 1;
    to[axis] = static_cast<int>(std::ceil((-place + reach) / model_.box[axis])) + 1;
  };
  for (int axis = 0; axis < D; ++axis) set_range(axis, x[axis], g[axis] * (horizon - now_));
  // Lexicographical order: the first axis changes last. In a sheared box it changes first, because
  // its range depends on the others.
  const int last = domain.sheared ? 0 : D - 1, least = domain.sheared ? 1 : 0;
  IntVec<D> image = from;
  const auto begin_row = [&] {
    if (!domain.sheared) return;
    // The time in which the images are near along the other axes.
    double begin = now_, end = horizon;
    for (int axis = 1; axis < D; ++axis) {
      const double middle = x[axis] + image[axis] * model_.box[axis];
      if (std::fabs(middle) > distance && g[axis] == 0.0) end = begin;
      if (g[axis] == 0.0) continue;
      const double half = 1.01 * distance / std::fabs(g[axis]);
      begin = std::max(begin, now_ - middle / g[axis] - half);
      end = std::min(end, now_ - middle / g[axis] + half);
    }
    const double speed = g[0] + image[1] * domain.slide;
    const double place = x[0] + image[1] * (domain.offset + domain.slide * now_);
    end = std::max(begin, end);
    set_range(0, place + speed * (0.5 * (begin + end) - now_), 0.5 * speed * (end - begin));
    image[0] = from[0];
  };
  begin_row();
  while (image[least] <= to[least]) {
    const Vec<D> boxes = image.template cast<double>();
    const Event event{contact_time<D>(a, b, domain.shift(boxes), distance, model_.gravity,
                                      domain.velocity_x(boxes)),
                      i, j};
    if (event.time < kNever && before(event, first.event)) first = {event, image};
    int axis = last;
    const auto next_axis = [&] {
      return domain.sheared ? (axis == 0 ? D - 1 : axis - 1) : axis - 1;
    };
    while (++image[axis] > to[axis] && axis != least) {
      image[axis] = from[axis];
      axis = next_axis();
    }
    if (axis != last) begin_row();
  }
}

template <int D>
void Reference<D>::weigh_walls(std::uint32_t i, Next& first) const {
  for (int side = 0; side < 2 * D; ++side) {
    if (!model_.walls[side]) continue;
    const double time = boundary_.contact_time(side, flights_[i], grain(i).radius, now_);
    const Event event{time, i, kWall + static_cast<std::uint32_t>(side)};
    if (time < kNever && before(event, first.event)) first = {event, IntVec<D>::Zero()};
  }
}

// All images of all pieces that the particle can reach before the horizon.
template <int D>
void Reference<D>::weigh_fixtures(std::uint32_t i, double horizon, Next& first) const {
  const double span = horizon - now_;
  const Vec<D> r = flights_[i].at(now_, model_.gravity);
  const Vec<D> v = flights_[i].velocity_at(now_, model_.gravity);
  std::uint32_t number = 0;
  const auto weigh = [&](const Fixture<D>& fixture, const Piece<D>& piece, bool valve) {
    const std::uint32_t partner = kPiece + number++;
    if (fixture.lets_pass(grain(i).species)) return;
    IntVec<D> from = IntVec<D>::Zero(), to = IntVec<D>::Zero();
    for (int axis = 0; axis < D; ++axis) {
      if (!model_.periodic(axis)) continue;
      const double reach = std::fabs(v[axis]) * span +
                           0.5 * std::fabs(model_.gravity[axis]) * span * span +
                           2.0 * model_.box[axis];
      from[axis] = static_cast<int>(std::floor((-r[axis] - reach) / model_.box[axis])) - 1;
      to[axis] = static_cast<int>(std::ceil((-r[axis] + reach) / model_.box[axis])) + 1;
    }
    IntVec<D> image = from;
    while (image[0] <= to[0]) {
      const Vec<D> shift = image.template cast<double>().cwiseProduct(model_.box);
      const Event event{
          valve ? crossing_time<D>(piece, flights_[i], shift, model_.gravity)
                : piece_contact_time<D>(piece, flights_[i], shift, grain(i).radius, model_.gravity),
          i, partner};
      if (event.time < kNever && before(event, first.event)) first = {event, image};
      for (int axis = D - 1; ++image[axis] > to[axis] && axis > 0; --axis) {
        image[axis] = from[axis];
      }
    }
  };
  for (const Fixture<D>& fixture : model_.fixtures) {
    for (const Piece<D>& piece : fixture.pieces) weigh(fixture, piece, false);
  }
  for (const Fixture<D>& fixture : model_.fixtures) {
    for (const Valve<D>& valve : fixture.valves) weigh(fixture, valve.opening, true);
  }
}

// The valve lets a centre pass, or reflects it.
template <int D>
void Reference<D>::meet_valve(const Fixture<D>& fixture, const Valve<D>& valve, const Next& next) {
  const std::uint32_t i = next.event.particle;
  const int axis = fixture.plane->axis;
  Vec<D> r = flights_[i].at(now_, model_.gravity);
  Vec<D> v = flights_[i].velocity_at(now_, model_.gravity);
  const Vec<D> place = r + next.image.template cast<double>().cwiseProduct(model_.box);
  r[axis] += valve.opening.corner[axis] - place[axis];
  const double speed = v.norm();
  bool passes = !(valve.faster_than && speed < *valve.faster_than) &&
                !(valve.slower_than && speed >= *valve.slower_than);
  if (valve.from == -1) passes = passes && v[axis] > 0.0;
  if (valve.from == 1) passes = passes && !(v[axis] > 0.0);
  if (passes) return renew(i, r, v, spin(i));
  v[axis] -= 2.0 * v[axis];
  renew(i, r, v, spin(i));
  last_collisions_[i] = now_;
  ++particle_wall_;
}

template <int D>
void Reference<D>::weigh_piston(std::uint32_t i, Next& first) const {
  if (!model_.free_piston) return;
  const double distance = 0.5 * model_.free_piston->thickness + grain(i).radius;
  const Event event{piston_contact_time<D>(flights_[i], piston_, model_.free_piston->axis, distance,
                                           model_.gravity),
                    i, kPiston};
  if (event.time < kNever && before(event, first.event)) first = {event, IntVec<D>::Zero()};
}

// Reflects the piston at a wall before a time. Returns whether it met one.
template <int D>
bool Reference<D>::reflect_piston(double horizon) {
  const FreePiston& law = *model_.free_piston;
  const Vec<D> along = Vec<D>::Unit(law.axis);
  const double half = 0.5 * law.thickness;
  int met = -1;
  for (const int side : {2 * law.axis, 2 * law.axis + 1}) {
    const double time = boundary_.contact_time(
        side, {piston_.place * along, piston_.velocity * along, piston_.time, 0}, half,
        piston_.acceleration * along, now_);
    if (time >= horizon) continue;
    horizon = time;
    met = side;
  }
  if (met < 0) return false;
  now_ = std::max(now_, horizon);
  const double wall = Boundary<D>::inward(met) * boundary_.wall(met, now_).velocity;
  piston_ = {boundary_.touching_place(met, half, now_), 2.0 * wall - piston_.velocity_at(now_),
             law.acceleration(), now_};
  return true;
}

template <int D>
void Reference<D>::hit_piston(std::uint32_t i) {
  const FreePiston& law = *model_.free_piston;
  Vec<D> r = flights_[i].at(now_, model_.gravity);
  const double place = piston_.at(now_), velocity = piston_.velocity_at(now_);
  const double side = r[law.axis] < place ? -1.0 : 1.0;
  r[law.axis] = place + side * (0.5 * law.thickness + grain(i).radius);
  const PistonOutcome<D> outcome = piston_outcome<D>(
      model_, side, velocity,
      {flights_[i].velocity_at(now_, model_.gravity), spin(i), i, flights_[i].number, grain(i)},
      within_contact_time(i));
  renew(i, r, outcome.departure.velocity, outcome.departure.spin);
  last_collisions_[i] = now_;
  ++particle_wall_;
  if (law.pinned) return;
  piston_ = {place, velocity - outcome.momentum / law.mass, law.acceleration(), now_};
}

template <int D>
void Reference<D>::hit_fixture(const Next& next) {
  const std::uint32_t i = next.event.particle;
  std::uint32_t number = next.event.partner - kPiece;
  auto fixture = model_.fixtures.begin();
  for (; fixture != model_.fixtures.end() && number >= fixture->pieces.size(); ++fixture) {
    number -= static_cast<std::uint32_t>(fixture->pieces.size());
  }
  if (fixture == model_.fixtures.end()) {
    fixture = model_.fixtures.begin();
    for (; number >= fixture->valves.size(); ++fixture) {
      number -= static_cast<std::uint32_t>(fixture->valves.size());
    }
    return meet_valve(*fixture, fixture->valves[number], next);
  }
  const Piece<D>& piece = fixture->pieces[number];
  Vec<D> r = flights_[i].at(now_, model_.gravity);
  const Vec<D> place = r + next.image.template cast<double>().cwiseProduct(model_.box);
  const Vec<D> normal = piece.normal_at(place);
  r += (grain(i).radius - piece.distance(place)) * normal;
  const Departure<D> departure = wall_outcome<D>(
      model_, fixture->law_for(grain(i).species), normal, {},
      {flights_[i].velocity_at(now_, model_.gravity), spin(i), i, flights_[i].number, grain(i)},
      within_contact_time(i));
  renew(i, r, departure.velocity, departure.spin);
  last_collisions_[i] = now_;
  ++particle_wall_;
}

template <int D>
Spin<D> Reference<D>::spin(std::uint32_t i) const {
  return spins_.empty() ? Spin<D>(Spin<D>::Zero()) : spins_[i];
}

template <int D>
bool Reference<D>::within_contact_time(std::uint32_t i) const {
  return model_.contact_time && now_ - last_collisions_[i] < *model_.contact_time;
}

template <int D>
void Reference<D>::collide(const Next& next) {
  const std::uint32_t i = next.event.particle, j = next.event.partner;
  const Flight<D>&a = flights_[i], &b = flights_[j];
  const Vec<D> r_a = a.at(now_, model_.gravity), r_b = b.at(now_, model_.gravity);
  const Vec<D> v_a = a.velocity_at(now_, model_.gravity), v_b = b.velocity_at(now_, model_.gravity);
  const Vec<D> boxes = next.image.template cast<double>();
  const Vec<D> x = (r_a - r_b) + boundary_.domain().shift(boxes, now_);
  Vec<D> g = v_a - v_b;
  if (model_.shear_rate) g[0] += boundary_.domain().velocity_x(boxes);
  const Grain one = grain(i), other = grain(j);
  Exchange<D> gain;
  if (x.dot(g) < 0.0) {
    const Spin<D> surface = one.radius * spin(i) + other.radius * spin(j);
    const bool elastic = within_contact_time(i) || within_contact_time(j);
    gain = pair_outcome<D>(model_.pair(one.species, other.species).contact(), {one, other}, x, g,
                           surface, elastic)
               .gain;
  }
  renew(i, r_a, v_a + gain.momentum / one.mass, spin(i) + gain.spins[0]);
  renew(j, r_b, v_b - gain.momentum / other.mass, spin(j) + gain.spins[1]);
  last_collisions_[i] = last_collisions_[j] = now_;
  ++particle_particle_;
}

template <int D>
void Reference<D>::hit_wall(const Event& event) {
  const std::uint32_t i = event.particle;
  const int side = static_cast<int>(event.partner - kWall);
  Vec<D> r = flights_[i].at(now_, model_.gravity);
  if (!model_.walls[side]->moves())
    r[side / 2] = boundary_.touching_place(side, grain(i).radius, now_);
  const Departure<D> departure = wall_outcome<D>(
      model_, model_.wall(side, grain(i).species), Boundary<D>::normal(side),
      boundary_.wall(side, now_),
      {flights_[i].velocity_at(now_, model_.gravity), spin(i), i, flights_[i].number, grain(i)},
      within_contact_time(i));
  renew(i, r, departure.velocity, departure.spin);
  last_collisions_[i] = now_;
  ++particle_wall_;
}

template <int D>
double Reference<D>::next_kick() const {
  return model_.bulk_drive
             ? clock_.relative(RegularTimes(model_.bulk_drive->interval).exactly(kicks_ + 1))
             : kNever;
}

template <int D>
void Reference<D>::kick() {
  const auto count = static_cast<std::uint32_t>(flights_.size());
  std::vector<Vec<D>> kicks(count);
  std::vector<Spin<D>> spin_kicks(count, Spin<D>::Zero());
  double mass = 0.0;
  for (std::uint32_t i = 0; i < count; ++i) mass += grain(i).mass;
  Vec<D> mean = Vec<D>::Zero();
  for (std::uint32_t i = 0; i < count; ++i) {
    Random random(model_.seed, Stream::Kick, i, static_cast<std::uint32_t>(kicks_));
    const double speed = model_.bulk_drive->kick_speed_of(grain(i).mass);
    for (double& kick : kicks[i]) kick = speed * random.normal();
    for (double& kick : spin_kicks[i]) {
      if (model_.spins) kick = model_.bulk_drive->kick_spin * random.normal();
    }
    mean += kicks[i] / (mass / grain(i).mass);
  }
  for (std::uint32_t i = 0; i < count; ++i) {
    renew(i, flights_[i].at(now_, model_.gravity),
          flights_[i].velocity_at(now_, model_.gravity) + (kicks[i] - mean),
          spin(i) + spin_kicks[i]);
  }
  ++kicks_;
}

template <int D>
void Reference<D>::renew(std::uint32_t i, const Vec<D>& r, const Vec<D>& v, const Spin<D>& spin) {
  flights_[i] = {wrapped(r), v, now_, flights_[i].number + 1};
  flights_[i].v[0] -= image_velocity(r);
  if (!spins_.empty()) spins_[i] = spin;
}

template <int D>
double Reference<D>::image_velocity(const Vec<D>& r) const {
  return model_.shear_rate ? std::floor(r[1] / model_.box[1]) * boundary_.domain().slide : 0.0;
}

// In a sheared box the shift along x is that of all images together, as in Domain.
template <int D>
Vec<D> Reference<D>::wrapped(const Vec<D>& r) const {
  Vec<D> shift = Vec<D>::Zero();
  for (int axis = D - 1; axis >= 0; --axis) {
    if (!model_.periodic(axis)) continue;
    double slid = 0.0;
    if (model_.shear_rate && axis == 0) {
      const Domain<D>& domain = boundary_.domain();
      slid = std::floor(r[1] / model_.box[1]) * (domain.offset + domain.slide * now_);
    }
    shift[axis] = std::floor((r[axis] - slid) / model_.box[axis]) * model_.box[axis] + slid;
  }
  return r - shift;
}

template <int D>
void Reference<D>::move_base() {
  for (Flight<D>& flight : flights_) flight.time -= now_;
  for (double& time : last_collisions_) time -= now_;
  piston_.time -= now_;
  clock_.advance(now_);
  boundary_.move_base(clock_);
  now_ = 0.0;
}

template <int D>
State<D> Reference<D>::state() const {
  State<D> state;
  for (const Flight<D>& flight : flights_) {
    const Vec<D> r = flight.at(now_, model_.gravity);
    state.positions.push_back(wrapped(r));
    state.velocities.push_back(flight.velocity_at(now_, model_.gravity));
    state.velocities.back()[0] -= image_velocity(r);
  }
  state.spins = spins_;
  if (model_.free_piston) state.piston = {piston_.at(now_), piston_.velocity_at(now_)};
  return state;
}

template class Reference<2>;
template class Reference<3>;

}  // namespace clatter::testing
