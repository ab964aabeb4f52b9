#include "engine/dynamics/event_loop.h"

#include <algorithm>
#include <cmath>
#include <string>
#include <utility>
#include <vector>

#include "engine/dynamics/prefetch.h"
#include "engine/dynamics/run_start.h"
#include "engine/error.h"
#include "engine/free_memory.h"

// The loop and its calendar; event_loop_events.cpp has the effects of events on particles.

namespace clatter {

// The base moves after this many physical events per particle. Each move predicts the events of all
// particles again, so moves must be rare. They are frequent enough that times on the base stay
// below a few ten mean free times. See also renew_flight().
static constexpr std::uint64_t kEventsPerBase = 32;
// Measured numbers of particles from which prefetching pays: of the next plans, once the data no
// longer fit an L2 cache of 1 MB; of cell lists; and of the particles on these lists, whose many
// cache misses then overlap.
static constexpr std::size_t kPrefetchPlansFrom = 4000;
static constexpr std::size_t kPrefetchListsFrom = 16000;
static constexpr std::size_t kPrefetchNeighboursFrom = 40000;

// A sinusoidal wall moves out of the box by less than the box side. Positions farther out are
// errors, and have no cells. The number of a periodic image is an int.
template <int D>
static bool is_inside(const Model<D>& model, const Vec<D>& r) {
  constexpr double kMostImages = 1 << 30;
  for (int axis = 0; axis < D; ++axis) {
    const double side = model.box[axis];
    const double beyond = model.periodic(axis) ? kMostImages : 1.0;
    if (!(-beyond * side < r[axis] && r[axis] < (1.0 + beyond) * side)) return false;
  }
  return r.allFinite();
}

// Whether the run may collapse or diverge: collisions can dissipate energy, walls can add energy
// without limit, or particles can come to rest on walls.
template <int D>
static bool may_collapse(const Model<D>& model) {
  bool may = model.dissipates();
  model.for_walls([&](const Wall& wall) {
    const bool holds = wall.kind == WallKind::Thermal && wall.temperature == 0.0;
    may = may || model.has_gravity() || holds || wall.moves() || wall.restitution != 1.0 ||
          wall.roughness.any();
  });
  return may;
}

// The particles of a saved run, with the data that the model needs. `saved` then has no particles:
// their memory is free before lists and calendar take theirs.
template <int D>
static ParticleStates<D> states_of(const Model<D>& model, RunState<D>& saved) {
  const std::size_t count = saved.flights.size();
  ParticleStates<D> gas{ParticleArray<D>(count),
                        {saved.spins.begin(), saved.spins.end()},
                        {saved.last_collisions.begin(), saved.last_collisions.end()},
                        {saved.remainders.begin(), saved.remainders.end()}};
  gas.era = saved.era;
  for (std::size_t i = 0; i < count; ++i) gas.particles.flight(i) = saved.flights[i];
  gas.fit(model, count);
  free_memory(saved.flights);
  free_memory(saved.spins);
  free_memory(saved.last_collisions);
  free_memory(saved.remainders);
  return gas;
}

template <int D>
EventLoop<D>::EventLoop(const Model<D>& model, const Boundary<D>& boundary, RunState<D>&& saved)
    : EventLoop(model, boundary) {
  restart(std::move(saved));
}

template <int D>
void EventLoop<D>::restart(RunState<D>&& saved) {
  now_ = saved.now;
  domain_ = boundary_.domain();
  gas_ = ParticleStates<D>();  // frees its memory before the next gas takes its own
  drop_plans();
  grains_.assign(saved.grains);
  free_memory(saved.grains);
  gas_ = states_of<D>(model_, saved);
  for (std::uint32_t i = 0; i < grains_.size(); ++i) gas_.particles.set_kind(i, grains_.kind(i));
  near_ = Neighbourhood<D>(model_, grains_, static_cast<double>(gas_.particles.size()));
  near_.lay_with_flow(domain_, now_);
  set_alike();
  prediction_.set_laws();
  piston_.reset();
  if (model_.free_piston && saved.free_piston) {
    piston_.emplace(*saved.free_piston, model_, boundary_, gas_.particles, grains_, near_);
    set_piston_laws(false, false);
  }
  until_base_moves_ = saved.until_base_moves;
  counts_ = saved.counts;
  checks_ = saved.checks;
  begin_watch(saved.start_speed, saved.mean_collision_time, saved.watchdog);
}

// Sets the speed limit and the watchdog that the laws need.
template <int D>
void EventLoop<D>::begin_watch(double start_speed, double mean_collision_time,
                               const std::optional<WatchdogState>& watchdog) {
  allow_start_speed(start_speed);
  watchdog_.reset();
  if (!may_collapse(model_) && counts_.strokes == 0) return;
  if (watchdog) {
    watchdog_.emplace(gas_.particles.size(), *watchdog);
  } else {
    watchdog_.emplace(gas_.particles.size(), now_, mean_collision_time);
  }
}

// What particles are that are alike.
template <int D>
void EventLoop<D>::set_alike() {
  alike_ = model_.grain();
  alike_partners_ = {alike_, alike_};
}

template <int D>
void EventLoop<D>::set_laws(bool keeps_flights, const RunState<D>& former, double start_speed) {
  gas_.fit(model_, gas_.particles.size());
  begin_watch(start_speed, watchdog_ ? watchdog_->mean_collision_time() : 0.0, std::nullopt);
  set_alike();
  prediction_.set_laws();
  if (piston_) set_piston_laws(true, keeps_flights);
  if (keeps_flights) return;
  near_.set_fixtures(model_);
  for (std::size_t i = 0; i < gas_.particles.size(); ++i) {
    Flight<D>& flight = gas_.particles.flight(i);
    flight = flight_from_now<D>(flight, model_, former, now_);
  }
  domain_ = boundary_.domain();
}

template <int D>
EventLoop<D>::EventLoop(const Model<D>& model, const Boundary<D>& boundary)
    : model_(model),
      boundary_(boundary),
      now_(0.0),
      near_(model, grains_, 1.0),
      prediction_(model, boundary, gas_.particles, grains_, near_),
      until_base_moves_(kNoLimit),
      fastest_(kNever) {}

// Changes the order of a list: element k becomes the one at order[k].
template <typename T>
static void reorder(std::vector<T>& list, const std::vector<std::uint32_t>& order) {
  std::vector<T> ordered;
  ordered.reserve(list.size());
  for (const std::uint32_t k : order) ordered.push_back(list[k]);
  list = std::move(ordered);
}

template <int D>
void EventLoop<D>::load(const ParticleStates<D>& gas, const GrainArray& grains,
                        const GridSizes& sizes, const Subdomain<D>& subdomain,
                        TileRecord<D>& record, double start, double end) {
  constexpr std::size_t kAhead = 16;
  const std::size_t count = record.numbers.size();
  now_ = start;
  domain_ = boundary_.domain();
  latest_ = end;
  record_ = &record;
  lower_ = subdomain.lower;
  until_base_moves_ = kNoLimit;
  counts_ = {};
  checks_ = {};
  set_alike();
  gas_.era = gas.era;
  gas_.particles.resize(count);
  grains_.prepare(grains, count);
  prediction_.set_laws();
  gas_.fit(model_, count);
  plans_.resize(count);
  near_.reset(model_, subdomain, sizes, static_cast<double>(count));
  std::vector<IntVec<D>> cells(count);
  for (std::size_t k = 0; k < count; ++k) {
    Vec<D> home;
    for (int axis = 0; axis < D; ++axis)
      home[axis] = lower_[axis] + double{record.strays[k].home[axis]};
    cells[k] = near_.cell_at(home);
  }
  std::vector<std::uint32_t> by_cell;
  if (grains.empty()) {
    near_.fill(cells, by_cell);
  } else {
    near_.sort(cells, by_cell);
  }
  reorder(record.numbers, by_cell);
  reorder(record.own, by_cell);
  reorder(record.images, by_cell);
  reorder(record.strays, by_cell);
  for (std::uint32_t i = 0; i < count; ++i) {
    if (i + kAhead < count) prefetch(gas.particles[record.numbers[i + kAhead]]);
    gas_.copy(i, gas, record.numbers[i]);
    gas_.particles.set_image(i, record.images[i]);
    plans_[i].cell = cells[by_cell[i]];
    if (grains.empty()) continue;
    grains_.take(i, grains, record.numbers[i]);
    near_.insert(i, plans_[i].cell);
  }
  queue_.order_by(record.numbers.data());
  prediction_.order_by(record.numbers.data());
  Preparation work;
  plan(work, {});
}

template <int D>
void EventLoop<D>::adopt(ParticleStates<D>& later, double time, std::uint64_t pair_collisions,
                         std::uint64_t wall_collisions, const RunChecks& checks) {
  later.era = gas_.era;
  std::swap(gas_, later);
  now_ = std::max(now_, time);
  counts_.pair_collisions += pair_collisions;
  counts_.wall_collisions += wall_collisions;
  until_base_moves_ -= pair_collisions + wall_collisions;
  checks_.deepest_overlap = std::max(checks_.deepest_overlap, checks.deepest_overlap);
  checks_.clock_steps_back = std::max(checks_.clock_steps_back, checks.clock_steps_back);
}

template <int D>
void EventLoop<D>::save_to(RunState<D>& saved) const {
  saved.now = now_;
  saved.flights.reserve(gas_.particles.size());
  for (const Particle<D>& particle : gas_.particles) saved.flights.push_back(particle.flight);
  saved.grains.reserve(grains_.size());
  grains_.for_each([&](const Grain& grain) { saved.grains.push_back(grain); });
  saved.spins.assign(gas_.spins.begin(), gas_.spins.end());
  saved.last_collisions.assign(gas_.last_collisions.begin(), gas_.last_collisions.end());
  saved.remainders.assign(gas_.remainders.begin(), gas_.remainders.end());
  saved.era = gas_.era;
  saved.until_base_moves = until_base_moves_;
  if (watchdog_) {
    saved.mean_collision_time = watchdog_->mean_collision_time();
    saved.watchdog = watchdog_->state();
  }
  if (piston_) saved.free_piston = piston_->flight();
  saved.counts = counts_;
  saved.checks = checks_;
}

template <int D>
bool EventLoop<D>::place(Preparation& work, const StopRequest& pause) {
  const std::size_t count = gas_.particles.size();
  const auto put = [this](std::size_t i) { put_into_cell(i); };
  plans_.resize(count);
  if (!work.placing.advance(count, pause, put)) return false;
  if (!std::exchange(work.fitted, true) && near_.fit(plans_)) {
    near_.lay_with_flow(domain_, now_);
    work.fitted_placing.emplace();
  }
  return !work.fitted_placing || work.fitted_placing->advance(count, pause, put);
}

template <int D>
void EventLoop<D>::put_into_cell(std::size_t number) {
  const auto i = static_cast<std::uint32_t>(number);
  const Vec<D> r = gas_.particles[i].flight.at(now_, model_.gravity);
  if (!is_inside<D>(model_, r)) {
    throw PhysicalStop("particle " + std::to_string(i) + " is outside of the box at the start");
  }
  const Domain<D> domain = domain_.at(now_);
  Vec<D> image = domain.image_at(r);
  if (domain.sheared) {
    Vec<D> place = near_.with_flow(r - domain.shift(image), now_);
    const double boxes = std::floor(place[0] / domain.box[0]);
    image[0] += boxes;
    place[0] -= boxes * domain.box[0];
    gas_.particles.set_image(i, image);
    plans_[i].cell = near_.place(i, place);
    return;
  }
  gas_.particles.set_image(i, image);
  plans_[i].cell = near_.place(i, r - domain.shift(image));
}

template <int D>
bool EventLoop<D>::plan(Preparation& work, const StopRequest& pause) {
  const std::size_t count = gas_.particles.size();
  const auto plan_two = [&](std::size_t pair) {
    const auto first = static_cast<std::uint32_t>(2 * pair);
    prediction_.plan({first, &plans_[first]}, {first + 1, &plans_[first + 1]}, now_);
  };
  if (!work.planning.advance(count / 2, pause, plan_two)) return false;
  if (count % 2 != 0) {
    const auto last = static_cast<std::uint32_t>(count - 1);
    prediction_.plan({last, &plans_[last]}, now_);
  }
  std::vector<Event> events;
  events.reserve(count);
  for (std::uint32_t i = 0; i < count; ++i) {
    if (plans_[i].time <= latest_) events.push_back({plans_[i].time, i, plans_[i].partner});
  }
  queue_.rebuild(events);
  if (piston_) gather_piston();
  return true;
}

// Predictions are repeated, not shifted. So every contact time remains a function of the two stored
// states alone.
template <int D>
void EventLoop<D>::move_base() {
  const double shift = now_;
  domain_ = boundary_.domain();
  for (std::size_t i = 0; i < gas_.particles.size(); ++i) gas_.particles.flight(i).time -= shift;
  for (double& time : gas_.last_collisions) time -= shift;
  now_ = 0.0;
  gas_.era = static_cast<std::uint32_t>((counts_.collisions() + counts_.kicks) >> 31);
  until_base_moves_ =
      std::max<std::uint64_t>(kMinEventsPerBase, kEventsPerBase * gas_.particles.size());
  if (piston_) piston_->move_base(shift);
  if (watchdog_) watchdog_->on_base_moved(shift);
  for (Observer<D>* observer : observers_) observer->on_base_moved(shift);
}

template <int D>
void EventLoop<D>::plan_again() {
  Preparation work;
  if (domain_.sheared && !plans_.empty()) return lay_with_flow();
  if (plans_.empty()) {
    // After drop_plans() there is hardly any cell.
    near_.reset(model_, whole_box<D>(model_), grid_sizes<D>(model_, grains_),
                static_cast<double>(gas_.particles.size()));
    near_.lay_with_flow(domain_, now_);
    place(work, {});
  } else if (near_.fit(plans_)) {
    for (std::size_t i = 0; i < gas_.particles.size(); ++i) put_into_cell(i);
  }
  plan(work, {});
}

template <int D>
void EventLoop<D>::note_all_strays() {
  for (std::uint32_t i = 0; i < gas_.particles.size(); ++i) {
    if (gas_.particles[i].flight.number >= kNoFlight) continue;
    note_stray(i, gas_.particles[i].flight.at(now_, model_.gravity));
  }
}

template <int D>
void EventLoop<D>::drop_plans() {
  free_memory(plans_);
  near_ = Neighbourhood<D>(model_, grains_, 1.0);
  std::vector<Event> none;
  queue_.rebuild(none);
}

template <int D>
bool EventLoop<D>::is_current(const Event& event) const {
  const Plan<D>& plan = plans_[event.particle];
  return (plan.time == event.time) & (plan.partner == event.partner);
}

// Chooses the strain of the cells, sorts the particles into them and plans all events. Contact
// times depend on flights alone, so they stay the same.
template <int D>
void EventLoop<D>::lay_with_flow() {
  if (!near_.fit(plans_)) near_.clear();
  near_.lay_with_flow(domain_, now_);
  for (std::size_t i = 0; i < gas_.particles.size(); ++i) put_into_cell(i);
  Preparation work;
  plan(work, {});
}

template <int D>
typename EventLoop<D>::Halt EventLoop<D>::advance(double stop, std::uint64_t collisions,
                                                  std::uint64_t steps) {
  while (near_.flow_ends() < stop) {
    const Halt halt = advance_to(near_.flow_ends(), collisions, steps);
    if (halt != Halt::Time) return halt;
    now_ = std::max(now_, near_.flow_ends());
    lay_with_flow();
  }
  return advance_to(stop, collisions, steps);
}

template <int D>
typename EventLoop<D>::Halt EventLoop<D>::advance_to(double stop, std::uint64_t collisions,
                                                     std::uint64_t steps) {
  const auto live = [this](const Event& event) { return is_current(event); };
  const bool prefetch = gas_.particles.size() >= kPrefetchPlansFrom;
  while (counts_.collisions() < collisions && counts_.steps() < steps) {
    const Event* next = queue_.top(live);
    if (piston_ && piston_->next().time < (next ? next->time : kNever)) {
      if (piston_->next().time > stop) return Halt::Time;
      const Halt halt = process_piston();
      if (halt != Halt::Limit) return halt;
      continue;
    }
    if (!next || next->time > stop) return Halt::Time;
    const Event event = *next;
    queue_.pop();
    if (prefetch && queue_.bucket() != prefetched_bucket_) prefetch_ahead();
    const std::uint64_t before = counts_.collisions();
    process(event);
    const Halt halt = after(event, counts_.collisions() != before);
    if (halt != Halt::Limit) return halt;
  }
  return Halt::Limit;
}

// Whether the loop must halt after an event.
template <int D>
[[gnu::always_inline]] inline typename EventLoop<D>::Halt EventLoop<D>::after(const Event& event,
                                                                              bool collided) {
  const bool stands_still =
      watchdog_ && collided && watchdog_->sees_collapse(now_, event.particle, event.partner);
  if (event.partner >= kPiece && is_too_fast(event.particle)) return Halt::Diverges;
  if (stands_still) return Halt::StandsStill;
  return base_due() ? Halt::BaseDue : Halt::Limit;
}

template <int D>
bool EventLoop<D>::is_next(const ForeseenEvent<D>& foreseen) const {
  const auto& [event, flight, partner_flight, image] = foreseen;
  return gas_.particles[event.particle].flight.number == flight &&
         (event.partner >= kPiece || gas_.particles[event.partner].flight.number == partner_flight);
}

template <int D>
typename EventLoop<D>::Halt EventLoop<D>::process_foreseen(const ForeseenEvent<D>& foreseen) {
  const Event& event = foreseen.event;
  checks_.clock_steps_back = std::max(checks_.clock_steps_back, now_ - event.time);
  now_ = std::max(now_, event.time);
  if (event.partner >= kPiece) {
    hit(event.particle, event.partner, foreseen.image);
  } else {
    collide(event.particle, event.partner, foreseen.image);
  }
  return after(event, true);
}

// Called after wall events, because only walls make speeds grow without bound.
template <int D>
bool EventLoop<D>::is_too_fast(std::uint32_t number) const {
  return fastest_ < kNever && gas_.particles[number].flight.v.cwiseAbs().maxCoeff() > fastest_;
}

template <int D>
double EventLoop<D>::fastest_now() const {
  double square = 0.0;
  for (const Particle<D>& particle : gas_.particles) {
    const Flight<D>& flight = particle.flight;
    const Vec<D> velocity = flight.velocity_at(now_, model_.gravity);
    square =
        std::max(square, domain_.peculiar(flight.at(now_, model_.gravity), velocity).squaredNorm());
  }
  return std::sqrt(square);
}

template <int D>
void EventLoop<D>::process(Event event) {
  const RunChecks before = checks_;
  checks_.clock_steps_back = std::max(checks_.clock_steps_back, now_ - event.time);
  now_ = std::max(now_, event.time);
  if (event.partner >= kCellBorder) {
    enter_next_cell(event.particle);
  } else if (event.partner >= kPiece) {
    const bool own = !record_ || note(event, plans_[event.particle].image);
    hit(event.particle, event.partner, plans_[event.particle].image);
    if (!own) checks_ = before;
    prediction_.plan({event.particle, &plans_[event.particle]}, now_);
    schedule(event.particle);
  } else if (plans_[event.particle].partner_flight != gas_.particles[event.partner].flight.number) {
    ++counts_.stale;
    prediction_.plan({event.particle, &plans_[event.particle]}, now_);
    schedule(event.particle);
  } else {
    // The lists arrive while the collision is computed; the processor would not load them this
    // early by itself.
    for (const std::uint32_t particle : {event.particle, event.partner}) {
      near_.prefetch_near(particle, plans_[particle].cell);
    }
    const bool own = !record_ || note(event, plans_[event.particle].image);
    collide(event.particle, event.partner, plans_[event.particle].image);
    if (!own) checks_ = before;
    prediction_.plan({event.particle, &plans_[event.particle]},
                     {event.partner, &plans_[event.partner]}, now_);
    schedule(event.particle);
    schedule(event.partner);
  }
}

template <int D>
bool EventLoop<D>::compare(Preparation& work, const StopRequest& pause) const {
  if (!work.fixtures.any()) work.fixtures = FixtureImages<D>(model_.fixtures, domain_);
  return work.comparing.advance(gas_.particles.size(), pause, [&](std::size_t i) {
    work.deepest_overlap = std::max(work.deepest_overlap, deepest_overlap_of(i, work.fixtures));
  });
}

// Deepest overlap of a particle with others, with walls and with fixtures. A pair of particles that
// are alike is compared once. A small particle may be on lists that a large one reads, but not the
// reverse.
template <int D>
double EventLoop<D>::deepest_overlap_of(std::size_t number,
                                        const FixtureImages<D>& fixtures) const {
  const auto i = static_cast<std::uint32_t>(number);
  double deepest = 0.0;
  const Vec<D> r = gas_.particles[i].flight.at(now_, model_.gravity);
  const auto compare = [&](std::uint32_t j, const Vec<D>& wrap) {
    if (j == i || (j < i && grains_.empty())) return;
    Vec<D> image = gas_.particles.image(j) - gas_.particles.image(i) - wrap;
    image[0] += near_.boxes_slid() * wrap[1];
    const Vec<D> x =
        r - gas_.particles[j].flight.at(now_, model_.gravity) + domain_.shift(image, now_);
    const double distance = grain(i).radius + grain(j).radius;
    deepest = std::max(deepest, (distance - x.norm()) / model_.diameter);
  };
  near_.visit(i, plans_[i].cell, compare);
  if (fixtures.any()) {
    const double depth = fixtures.depth(domain_.wrapped(r), grain(i).radius, grain(i).species);
    deepest = std::max(deepest, depth / model_.diameter);
  }
  if (piston_) {
    const FreePiston& piston = *model_.free_piston;
    const double distance = std::fabs(r[piston.axis] - piston_->flight().at(now_));
    const double depth = 0.5 * piston.thickness + grain(i).radius - distance;
    deepest = std::max(deepest, depth / model_.diameter);
  }
  return std::max(deepest, overlap_with_walls(boundary_, i, r));
}

template <int D>
double EventLoop<D>::overlap_with_walls(const Boundary<D>& boundary, std::uint32_t number,
                                        const Vec<D>& position) const {
  double deepest = 0.0;
  for (int side = 0; side < 2 * D; ++side) {
    if (!model_.walls[side]) continue;
    const double place = boundary.touching_place(side, grain(number).radius, now_);
    const double beyond = Boundary<D>::inward(side) * (place - position[side / 2]);
    deepest = std::max(deepest, beyond / model_.diameter);
  }
  return deepest;
}

template <int D>
double EventLoop<D>::deepest_overlap_with(const Boundary<D>& boundary) const {
  double deepest = 0.0;
  for (std::uint32_t i = 0; i < gas_.particles.size(); ++i) {
    const Vec<D> place = gas_.particles[i].flight.at(now_, model_.gravity);
    deepest = std::max(deepest, overlap_with_walls(boundary, i, place));
  }
  if (!piston_) return deepest;
  const FreePiston& law = *model_.free_piston;
  for (const int side : {2 * law.axis, 2 * law.axis + 1}) {
    const double touching = boundary.touching_place(side, 0.5 * law.thickness, now_);
    const double beyond = Boundary<D>::inward(side) * (touching - piston_->flight().at(now_));
    deepest = std::max(deepest, beyond / model_.diameter);
  }
  return deepest;
}

template <int D>
std::optional<std::pair<std::uint32_t, std::size_t>> EventLoop<D>::overlapping(
    const FixtureImages<D>& fixtures, double bearable) const {
  for (std::uint32_t i = 0; i < gas_.particles.size(); ++i) {
    const Vec<D> place = domain_.wrapped(gas_.particles[i].flight.at(now_, model_.gravity));
    const double depth = fixtures.depth(place, grain(i).radius, grain(i).species);
    if (depth > bearable * model_.diameter) {
      return std::pair(i, *fixtures.deepest(place, grain(i).radius, grain(i).species));
    }
  }
  return std::nullopt;
}

// Prefetches data of coming events in stages. A small gas fetches the plans of the next bucket
// only. A larger gas first fetches particles and plans, and one bucket later the cell lists that
// the events read or change. The largest gases then fetch the particles on these lists. Each stage
// finds in the cache the data that the stage before fetched.
template <int D>
void EventLoop<D>::prefetch_ahead() {
  prefetched_bucket_ = queue_.bucket();
  if (gas_.particles.size() < kPrefetchListsFrom) {
    queue_.look_ahead(1, [&](const Event& event) { prefetch(plans_[event.particle]); });
    return;
  }
  const bool neighbours = gas_.particles.size() >= kPrefetchNeighboursFrom;
  const bool many_kinds = !grains_.empty() && grains_.kinds().empty();
  queue_.look_ahead(neighbours ? 3 : 2, [&](const Event& event) {
    prefetch(gas_.particles[event.particle]);
    prefetch(plans_[event.particle]);
    if (many_kinds) prefetch(grains_[event.particle]);
    if (event.partner >= kPiece) return;
    prefetch(gas_.particles[event.partner]);
    prefetch(plans_[event.partner]);
    if (many_kinds) prefetch(grains_[event.partner]);
  });
  queue_.look_ahead(neighbours ? 2 : 1, [&](const Event& event) {
    if (!is_current(event)) return;
    if (event.partner >= kCellBorder) {
      near_.prefetch_crossing(plans_[event.particle].cell, event.partner);
    }
    visit_searches(event, [this](std::uint32_t particle, const IntVec<D>& cell) {
      near_.prefetch_near(particle, cell);
    });
  });
  if (!neighbours) return;
  queue_.look_ahead(1, [&](const Event& event) {
    if (!is_current(event)) return;
    if (event.partner >= kCellBorder) near_.prefetch_search(event.particle);
    visit_searches(event, [this, many_kinds](std::uint32_t particle, const IntVec<D>& cell) {
      const NearListView list = near_.near(particle, cell);
      for (int k = 0; k < list.capacity; ++k) {
        const Neighbour neighbour = list.neighbours[k];
        if (neighbour == kNobody) continue;
        prefetch(gas_.particles[particle_of<D>(neighbour)]);
        if (many_kinds) prefetch(grains_.radii().of_particles[particle_of<D>(neighbour)]);
      }
    });
  });
}

// Visits the particles of an event that search for partners, and their cells.
template <int D>
template <typename Visit>
void EventLoop<D>::visit_searches(const Event& event, const Visit& visit) const {
  const IntVec<D>& cell = plans_[event.particle].cell;
  if (event.partner >= kCellBorder) {
    visit(event.particle, near_.cell_after(cell, event.partner));
    return;
  }
  visit(event.particle, cell);
  if (event.partner < kPiece) visit(event.partner, plans_[event.partner].cell);
}

template class EventLoop<2>;
template class EventLoop<3>;

}  // namespace clatter
