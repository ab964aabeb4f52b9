#include "engine/dynamics/simulation.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <string>
#include <utility>

#include "engine/dynamics/collapse.h"
#include "engine/dynamics/prefetch.h"
#include "engine/dynamics/state_hash.h"
#include "engine/error.h"
#include "engine/physics/fraction.h"

namespace clatter {

// The base moves after this many physical events per particle. Each move predicts the events of all
// particles again, so moves must be rare. They are frequent enough that times on the base stay
// below a few ten mean free times. See also renew_flight().
static constexpr std::uint64_t kEventsPerBase = 32;
static constexpr std::uint64_t kMinEventsPerBase = 64;
// Measured numbers of particles from which prefetching pays: of the next plans, once the data no
// longer fit an L2 cache of 1 MB; of cell lists; and of the particles on these lists, whose many
// cache misses then overlap.
static constexpr std::size_t kPrefetchPlansFrom = 4000;
static constexpr std::size_t kPrefetchListsFrom = 16000;
static constexpr std::size_t kPrefetchNeighboursFrom = 40000;

// Whether the run may collapse or diverge: collisions can dissipate energy, walls can add energy
// without limit, or particles can come to rest on walls.
template <int D>
static bool may_collapse(const Model<D>& model) {
  bool may = model.dissipates();
  for (const auto& wall : model.walls) {
    if (!wall) continue;
    const bool holds = wall->kind == WallKind::Thermal && wall->temperature == 0.0;
    may = may || model.has_gravity() || holds || wall->moves() || wall->restitution != 1.0 ||
          wall->roughness.any();
  }
  return may;
}

// Interval of kicks; 0 without bulk driving.
template <int D>
static double kick_interval(const Model<D>& model) {
  return model.bulk_drive ? model.bulk_drive->interval : 0.0;
}

template <int D>
static RunState<D> fresh(const Model<D>& model, State<D> state, double start_time) {
  RunState<D> saved;
  saved.gravity = model.gravity;
  saved.wall_motions = wall_motions<D>(model);
  saved.base = {start_time, 0.0};
  saved.kick_interval = kick_interval<D>(model);
  saved.kick_origin = start_time;
  saved.until_base_moves = std::max<std::uint64_t>(kMinEventsPerBase, state.positions.size());
  saved.flights.reserve(state.positions.size());
  for (std::size_t i = 0; i < state.positions.size(); ++i) {
    saved.flights.push_back({state.positions[i], state.velocities[i], 0.0, 0});
    saved.start_speed = std::max(saved.start_speed, state.velocities[i].norm());
  }
  saved.spins = std::move(state.spins);
  state = {};  // frees the memory before the simulation allocates its own
  return saved;
}

// A clock with its base at the time of the state.
template <int D>
static Clock clock_at(const RunState<D>& saved) {
  Clock clock(saved.base);
  clock.advance(saved.now);
  return clock;
}

// The shifts of phases that keep walls at their places if their frequencies change now. Rest is a
// motion of frequency 0.
template <int D>
static std::array<double, 2 * D> phase_shifts(const Model<D>& model, const RunState<D>& saved) {
  const std::array<WallMotion, 2 * D> motions = wall_motions<D>(model);
  std::array<double, 2 * D> shifts = saved.phase_shifts;
  const Clock now = clock_at(saved);
  for (int side = 0; side < 2 * D; ++side) {
    const double before = saved.wall_motions[side].frequency, after = motions[side].frequency;
    if (!model.walls[side] || !model.walls[side]->moves()) {
      shifts[side] = 0.0;
    } else if (before != after) {
      shifts[side] = fraction(shifts[side] + now.periods(before, 0.0) - now.periods(after, 0.0));
    }
  }
  return shifts;
}

// The error of a start with overlaps. If walls have changed their motion, they are the cause. Just
// after the beginning of a period a wall is at its rest position, whatever its stroke.
template <int D>
static PhysicalStop overlap_at_start(const Model<D>& model, const RunState<D>& saved,
                                     double overlap) {
  constexpr double kJustAfter = 1e-4;  // periods
  const std::string deepest = fmt::format("by {:.3g} diameters", overlap);
  const Clock now = clock_at(saved);
  const double time = now.absolute(0.0);
  std::string changed, remedy = "make a smaller change";
  for (int side = 0; side < 2 * D; ++side) {
    const WallMotion& before = saved.wall_motions[side];
    const WallMotion after = wall_motions<D>(model)[side];
    if (before == after) continue;
    changed += std::string(changed.empty() ? "" : ", ") + "walls." + kSideNames[side];
    if (before.frequency == 0.0 || before.phase != after.phase) continue;
    const double phase = now.periods(before.frequency, before.phase + saved.phase_shifts[side]);
    remedy +=
        fmt::format(", or change walls.{} without a ramp at its rest position, as at t = {:.9g}",
                    kSideNames[side], time + (1.0 + kJustAfter - phase) / before.frequency);
  }
  if (!changed.empty()) {
    return PhysicalStop(
        fmt::format("the change of {} at t = {:.9g} moves a wall into a particle, {}; {}", changed,
                    time, deepest, remedy));
  }
  return PhysicalStop("particles overlap each other or a wall at the start, the deepest " +
                      deepest + "; move them apart");
}

template <int D>
Simulation<D>::Simulation(const Model<D>& model, State<D> state, double start_time,
                          const StopRequest& stop)
    : Simulation(model, fresh<D>(model, std::move(state), start_time), stop) {}

template <int D>
Simulation<D>::Simulation(const Model<D>& model, RunState<D> saved, const StopRequest& stop)
    : model_(model),
      clock_(saved.base),
      boundary_(model_, clock_, phase_shifts<D>(model_, saved)),
      now_(saved.now),
      particles_(saved.flights.size()),
      spins_(saved.spins.begin(), saved.spins.end()),
      last_collisions_(saved.last_collisions.begin(), saved.last_collisions.end()),
      remainders_(saved.remainders.begin(), saved.remainders.end()),
      plans_(particles_.size()),
      near_(model_, static_cast<double>(particles_.size())),
      prediction_(model_, boundary_, particles_, near_),
      until_base_moves_(saved.until_base_moves),
      start_speed_(saved.start_speed),
      fastest_(fastest_speed<D>(model_, start_speed_)),
      kick_origin_(saved.kick_origin),
      kicks_since_origin_(saved.kicks_since_origin),
      counts_(saved.counts),
      checks_(saved.checks) {
  spins_.resize(model_.spins ? particles_.size() : 0, Spin<D>::Zero());
  last_collisions_.resize(model_.contact_time ? particles_.size() : 0, -kNever);
  remainders_.resize(model_.box.maxCoeff() > kLongBox * model_.diameter ? particles_.size() : 0,
                     Vec<D>::Zero());
  if (may_collapse(model_)) {
    watchdog_.emplace(particles_.size(), now_, saved.mean_collision_time);
  }
  if (saved.kick_interval != kick_interval<D>(model_)) {
    kick_origin_ = time();
    kicks_since_origin_ = 0;
  }
  // Predictions along a flight begin at its start. Under changed laws flights must start now.
  const bool restart_flights =
      saved.gravity != model_.gravity || saved.wall_motions != wall_motions<D>(model_);
  for (std::size_t i = 0; i < particles_.size(); ++i) {
    Flight<D>& flight = particles_.flight(i) = saved.flights[i];
    if (restart_flights) {
      flight = {flight.at(now_, saved.gravity), flight.velocity_at(now_, saved.gravity), now_,
                flight.number};
    }
  }
  saved.flights.clear();
  saved.flights.shrink_to_fit();  // before lists and calendar take their memory
  place_all(stop);
  if (near_.fit(model_, plans_)) place_all(stop);
  // Overlaps that the run has already accepted at contacts are accepted at a restart too.
  const double borne = kStartRounding + checks_.deepest_overlap;
  if (const double overlap = deepest_overlap(stop); overlap > borne) {
    throw overlap_at_start<D>(model_, saved, overlap);
  }
  plan_all(stop);
}

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

template <int D>
void Simulation<D>::place_all(const StopRequest& stop) {
  for (std::uint32_t i = 0; i < particles_.size(); ++i) {
    stop.check();
    const Vec<D> r = particles_[i].flight.at(now_, model_.gravity);
    if (!is_inside<D>(model_, r)) {
      throw PhysicalStop("particle " + std::to_string(i) + " is outside of the box at the start");
    }
    const Vec<D> image = model_.image_index(r);
    particles_.set_image(i, image);
    plans_[i].cell = near_.place(i, r - image.cwiseProduct(model_.box));
  }
}

template <int D>
void Simulation<D>::plan_all(const StopRequest& stop) {
  std::vector<Event> events;
  events.reserve(particles_.size());
  for (std::uint32_t i = 0; i < particles_.size(); ++i) {
    stop.check();
    prediction_.plan({i, &plans_[i]}, now_);
    const Plan<D>& plan = plans_[i];
    if (plan.time < kNever) events.push_back({plan.time, i, plan.partner});
  }
  queue_.rebuild(events);
}

// Predictions are repeated, not shifted. So every contact time remains a function of the two stored
// states alone.
template <int D>
void Simulation<D>::move_base() {
  const double shift = now_;
  for (std::size_t i = 0; i < particles_.size(); ++i) particles_.flight(i).time -= shift;
  for (double& time : last_collisions_) time -= shift;
  clock_.advance(shift);
  boundary_.move_base(clock_);
  now_ = 0.0;
  until_base_moves_ =
      std::max<std::uint64_t>(kMinEventsPerBase, kEventsPerBase * particles_.size());
  if (near_.fit(model_, plans_)) place_all();
  plan_all();
  if (watchdog_) watchdog_->on_base_moved(shift);
  for (Observer<D>* observer : observers_) observer->on_base_moved(shift);
}

template <int D>
bool Simulation<D>::is_current(const Event& event) const {
  const Plan<D>& plan = plans_[event.particle];
  return (plan.time == event.time) & (plan.partner == event.partner);
}

template <int D>
typename Simulation<D>::Halt Simulation<D>::advance(double stop, std::uint64_t collisions,
                                                    std::uint64_t steps) {
  const auto live = [this](const Event& event) { return is_current(event); };
  const bool prefetch = particles_.size() >= kPrefetchPlansFrom;
  while (counts_.collisions() < collisions && counts_.steps() < steps) {
    const Event* next = queue_.top(live);
    if (!next || next->time > stop) return Halt::Time;
    const Event event = *next;
    queue_.pop();
    if (prefetch && queue_.bucket() != prefetched_bucket_) prefetch_ahead();
    const std::uint64_t before = counts_.collisions();
    process(event);
    const bool stands_still = watchdog_ && counts_.collisions() != before &&
                              watchdog_->sees_collapse(now_, event.particle, event.partner);
    const bool diverges = event.partner >= kWall && is_too_fast(event.particle);
    const bool base_moves = until_base_moves_ == 0;
    if (base_moves) move_base();
    if (diverges) stop_at_divergence();
    if (stands_still) stop_at_collapse();
    if (base_moves) return Halt::BaseMoved;
  }
  return Halt::Limit;
}

// Called after wall events, because only walls make speeds grow without bound.
template <int D>
bool Simulation<D>::is_too_fast(std::uint32_t number) const {
  return fastest_ < kNever && particles_[number].flight.v.cwiseAbs().maxCoeff() > fastest_;
}

template <int D>
bool Simulation<D>::run_until(double time, std::uint64_t collisions, std::uint64_t steps,
                              const StopRequest& stop_request) {
  constexpr std::uint64_t kStepsPerLook = 1000;  // at the request
  while (!stop_request.made()) {
    const double end = clock_.relative(time);
    Timer* timer = due_timer(end);
    double stop = timer ? clock_.relative(timer->start, timer->count, timer->interval) : end;
    const double kick_time = next_kick();
    const bool kicks = kick_time < kNever && kick_time <= stop;
    if (kicks) stop = kick_time;
    const Halt halt = advance(stop, collisions, std::min(steps, counts_.steps() + kStepsPerLook));
    if (halt == Halt::Limit && (counts_.collisions() >= collisions || counts_.steps() >= steps)) {
      return false;
    }
    if (halt != Halt::Time) continue;
    if (stop == kNever) return true;
    now_ = std::max(now_, stop);
    if (kicks) {
      kick();
    } else if (timer) {
      fire(*timer);
    } else {
      return true;
    }
  }
  return false;
}

template <int D>
void Simulation<D>::every(double start, double interval, std::function<void(double)> action,
                          std::uint64_t done) {
  timers_.push_back({start, interval, done, std::move(action)});
}

template <int D>
typename Simulation<D>::Timer* Simulation<D>::due_timer(double stop) {
  Timer* due = nullptr;
  for (Timer& timer : timers_) {
    if (timer.interval == 0.0 && timer.count > 0) continue;
    const double time = clock_.relative(timer.start, timer.count, timer.interval);
    if (time > stop || (due && time == stop)) continue;
    stop = time;
    due = &timer;
  }
  return due;
}

template <int D>
void Simulation<D>::fire(Timer& timer) {
  const double time = timer.start + static_cast<double>(timer.count) * timer.interval;
  ++timer.count;
  timer.action(time);
}

template <int D>
void Simulation<D>::process(Event event) {
  checks_.clock_steps_back = std::max(checks_.clock_steps_back, now_ - event.time);
  now_ = std::max(now_, event.time);
  if (event.partner >= kCellBorder) {
    enter_next_cell(event.particle);
  } else if (event.partner >= kWall) {
    hit_wall(event.particle, static_cast<int>(event.partner - kWall));
  } else if (plans_[event.particle].partner_flight != particles_[event.partner].flight.number) {
    ++counts_.stale;
    prediction_.plan({event.particle, &plans_[event.particle]}, now_);
    schedule(event.particle);
  } else {
    collide(event.particle, event.partner);
  }
}

template <int D>
double Simulation<D>::next_kick() const {
  if (!model_.bulk_drive) return kNever;
  return clock_.relative(kick_origin_, kicks_since_origin_ + 1, model_.bulk_drive->interval);
}

template <int D>
void Simulation<D>::stop_at_collapse() const {
  throw standstill<D>(model_, *watchdog_, time(), temperature());
}

template <int D>
void Simulation<D>::stop_at_divergence() const {
  throw divergence<D>(model_, time(), temperature());
}

template <int D>
RunState<D> Simulation<D>::save() const {
  RunState<D> saved;
  saved.gravity = model_.gravity;
  saved.wall_motions = wall_motions<D>(model_);
  saved.phase_shifts = boundary_.phase_shifts();
  saved.base = clock_.base();
  saved.now = now_;
  saved.flights.reserve(particles_.size());
  for (const Particle<D>& particle : particles_) saved.flights.push_back(particle.flight);
  saved.spins.assign(spins_.begin(), spins_.end());
  saved.last_collisions.assign(last_collisions_.begin(), last_collisions_.end());
  saved.remainders.assign(remainders_.begin(), remainders_.end());
  saved.until_base_moves = until_base_moves_;
  if (watchdog_) saved.mean_collision_time = watchdog_->mean_collision_time();
  saved.start_speed = start_speed_;
  saved.kick_interval = kick_interval<D>(model_);
  saved.kick_origin = kick_origin_;
  saved.kicks_since_origin = kicks_since_origin_;
  saved.counts = counts_;
  saved.checks = checks_;
  return saved;
}

template <int D>
std::vector<Vec<D>> Simulation<D>::positions() const {
  std::vector<Vec<D>> positions;
  positions.reserve(particles_.size());
  for (const Particle<D>& particle : particles_) {
    Vec<D> r = particle.flight.at(now_, model_.gravity);
    r -= model_.image_index(r).cwiseProduct(model_.box);
    for (int axis = 0; axis < D; ++axis) {
      // A position a rounding error below 0 wraps to the far end of the box, which is position 0.
      if (model_.periodic(axis) && r[axis] == model_.box[axis]) r[axis] = 0.0;
    }
    positions.push_back(r);
  }
  return positions;
}

template <int D>
State<D> Simulation<D>::state() const {
  State<D> state;
  state.positions = positions();
  state.velocities.reserve(particles_.size());
  for (const Particle<D>& particle : particles_) {
    state.velocities.push_back(particle.flight.velocity_at(now_, model_.gravity));
  }
  state.spins.assign(spins_.begin(), spins_.end());
  return state;
}

template <int D>
std::uint64_t Simulation<D>::state_hash() const {
  return clatter::state_hash<D>(state());
}

template <int D>
double Simulation<D>::kinetic_energy() const {
  double twice = 0.0;
  for (const Particle<D>& particle : particles_) {
    twice += particle.flight.velocity_at(now_, model_.gravity).squaredNorm();
  }
  return 0.5 * twice;
}

template <int D>
double Simulation<D>::temperature() const {
  const auto count = static_cast<double>(particles_.size());
  return count > 0.0 ? 2.0 * kinetic_energy() / (D * count) : 0.0;
}

template <int D>
double Simulation<D>::spin_energy() const {
  double squares = 0.0;
  for (const Spin<D>& spin : spins_) squares += spin.squaredNorm();
  return 0.5 * moment_of_inertia(model_.inertia, model_.diameter) * squares;
}

template <int D>
double Simulation<D>::deepest_overlap(const StopRequest& stop) const {
  double deepest = 0.0;
  for (std::uint32_t i = 0; i < particles_.size(); ++i) {
    stop.check();
    const Vec<D> r = particles_[i].flight.at(now_, model_.gravity);
    near_.visit(i, plans_[i].cell, [&](std::uint32_t j, const Vec<D>& wrap) {
      if (j <= i) return;
      const Vec<D> image = particles_.image(j) - particles_.image(i) - wrap;
      const Vec<D> x =
          r - particles_[j].flight.at(now_, model_.gravity) + image.cwiseProduct(model_.box);
      deepest = std::max(deepest, 1.0 - x.norm() / model_.diameter);
    });
    for (int side = 0; side < 2 * D; ++side) {
      if (!model_.walls[side]) continue;
      const double place = boundary_.touching_place(side, now_);
      const double beyond = Boundary<D>::inward(side) * (place - r[side / 2]);
      deepest = std::max(deepest, beyond / model_.diameter);
    }
  }
  return deepest;
}

// Prefetches data of coming events in stages. A small gas fetches the plans of the next bucket
// only. A larger gas first fetches particles and plans, and one bucket later the cell lists that
// the events read or change. The largest gases then fetch the particles on these lists. Each stage
// finds in the cache the data that the stage before fetched.
template <int D>
void Simulation<D>::prefetch_ahead() {
  prefetched_bucket_ = queue_.bucket();
  if (particles_.size() < kPrefetchListsFrom) {
    queue_.look_ahead(1, [&](const Event& event) { prefetch(plans_[event.particle]); });
    return;
  }
  const bool neighbours = particles_.size() >= kPrefetchNeighboursFrom;
  queue_.look_ahead(neighbours ? 3 : 2, [&](const Event& event) {
    prefetch(particles_[event.particle]);
    prefetch(plans_[event.particle]);
    if (event.partner >= kWall) return;
    prefetch(particles_[event.partner]);
    prefetch(plans_[event.partner]);
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
    visit_searches(event, [this](std::uint32_t particle, const IntVec<D>& cell) {
      const NearListView list = near_.near(particle, cell);
      for (int k = 0; k < list.capacity; ++k) {
        const Neighbour neighbour = list.neighbours[k];
        if (neighbour != kNobody) prefetch(particles_[particle_of<D>(neighbour)]);
      }
    });
  });
}

// Visits the particles of an event that search for partners, and their cells.
template <int D>
template <typename Visit>
void Simulation<D>::visit_searches(const Event& event, const Visit& visit) const {
  const IntVec<D>& cell = plans_[event.particle].cell;
  if (event.partner >= kCellBorder) {
    visit(event.particle, near_.cell_after(cell, event.partner));
    return;
  }
  visit(event.particle, cell);
  if (event.partner < kWall) visit(event.partner, plans_[event.partner].cell);
}

template class Simulation<2>;
template class Simulation<3>;

}  // namespace clatter
