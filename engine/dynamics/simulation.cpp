#include "engine/dynamics/simulation.h"

#include <algorithm>
#include <cmath>
#include <utility>

#include "engine/dynamics/collapse.h"
#include "engine/dynamics/prefetch.h"
#include "engine/dynamics/run_start.h"
#include "engine/dynamics/state_hash.h"
#include "engine/physics/theory.h"

namespace clatter {

template <int D>
Simulation<D>::Simulation(const Model<D>& model, State<D> state, double start_time,
                          const StopRequest& stop)
    : Simulation(model, first_state<D>(model, std::move(state), start_time), stop) {}

template <int D>
Simulation<D>::Simulation(const Model<D>& model, RunState<D> saved, const StopRequest& stop)
    : Simulation(InParts(), model, std::move(saved)) {
  if (!prepare(stop)) throw Interrupted();
}

template <int D>
Simulation<D>::Simulation(InParts, const Model<D>& model, State<D> state, double start_time)
    : Simulation(InParts(), model, first_state<D>(model, std::move(state), start_time)) {}

// A smooth contact keeps spins, so particles keep them under smooth laws.
template <int D>
static Model<D> with_spins(Model<D> model, bool spins) {
  model.spins = model.spins || spins;
  return model;
}

template <int D>
Simulation<D>::Simulation(InParts, const Model<D>& model, RunState<D> saved)
    : model_(model), boundary_(model_, clock_), loop_(model_, boundary_) {
  restart(model, std::move(saved));
}

template <int D>
void Simulation<D>::restart(const Model<D>& model, RunState<D> saved) {
  model_ = with_spins(model, !saved.spins.empty());
  clock_ = Clock(saved.base);
  boundary_.restart(clock_, phase_shifts<D>(model_, saved), saved.piston,
                    shear_phase<D>(model_, saved));
  start_speed_ = saved.start_speed;
  kick_times_ = RegularTimes(saved.kick_origin, saved.kick_interval);
  kicks_since_origin_ = saved.kicks_since_origin;
  restart_changed_flights<D>(model_, saved);
  loop_.restart(std::move(saved));
  set_kicks();
  preparation_ = std::make_unique<Preparation>(Preparation{std::move(saved), {}});
  look_anew();
  in_tiles_ = false;
  if (foresight_) make_tiles();
}

// Kicks with another interval are counted from now.
template <int D>
void Simulation<D>::set_kicks() {
  if (kick_times_.interval() == model_.kick_interval()) return;
  kick_times_ = RegularTimes(time(), model_.kick_interval());
  kicks_since_origin_ = 0;
}

// Whether tiles can run a gas. Each hit of a free piston changes the contacts of particles far
// apart, particles that pass a valve have new flights without a collision, and images of a sheared
// box slide along those of others.
template <int D>
static bool suits_tiles(const Model<D>& model) {
  return !model.free_piston && !model.shear_rate &&
         std::ranges::all_of(model.fixtures,
                             [](const Fixture<D>& fixture) { return fixture.valves.empty(); });
}

template <int D>
void Simulation<D>::set_laws(const Model<D>& model) {
  prepare({});
  const RunState<D> present = save_without_particles();
  const Model<D> next = with_spins(model, !spins().empty());
  const bool goes_on = keeps_flights<D>(model_, next);
  const Boundary<D> boundary(next, clock_, phase_shifts<D>(next, present), boundary_.piston(),
                             shear_phase<D>(next, present));
  if (!goes_on) {
    const double overlap = loop_.deepest_overlap_with(boundary);
    if (overlap > bearable_overlap()) throw overlap_at_start<D>(next, present, overlap);
    const FixtureImages<D> fixtures(next.fixtures, next.domain());
    if (fixtures.any()) {
      if (const auto met = loop_.overlapping(fixtures, bearable_overlap())) {
        throw fixture_in_particle<D>(next, met->second, met->first, time());
      }
    }
  }
  loop_.for_observers([&](Observer<D>& observer) { observer.before_laws(next); });
  model_ = next;
  boundary_.restart(clock_, boundary.phase_shifts(), boundary.piston(), boundary.shear_phase());
  set_kicks();
  loop_.set_laws(goes_on, present, start_speed_);
  look_anew();
  if (!suits_tiles(model_)) foresight_.reset();
  if (in_tiles_) {
    way_is_open_ = true;  // events that tiles have found had the former laws
  } else if (!goes_on) {
    loop_.plan_again();
  }
  loop_.for_observers([](Observer<D>& observer) { observer.on_laws(); });
}

template <int D>
void Simulation<D>::add_particles(const std::vector<Vec<D>>& positions,
                                  const std::vector<Grain>& grains) {
  RunState<D> next = save();
  next.watchdog.reset();
  next.grains.insert(next.grains.end(), grains.begin(), grains.end());
  for (const Vec<D>& position : positions) {
    next.flights.push_back({position, boundary_.domain().flow(position), next.now, 0});
  }
  loop_.for_observers([&](Observer<D>& observer) { observer.before_laws(model_); });
  restart(model_, std::move(next));
  prepare({});
  loop_.for_observers([](Observer<D>& observer) { observer.on_laws(); });
}

// Overlaps that the run has already accepted at contacts are accepted at a restart too.
template <int D>
double Simulation<D>::bearable_overlap() const {
  return kStartRounding + checks().deepest_overlap;
}

template <int D>
bool Simulation<D>::prepare(const StopRequest& pause) {
  if (!preparation_) return true;
  auto& [saved, work] = *preparation_;
  if (!loop_.place(work, pause) || !loop_.compare(work, pause)) return false;
  if (work.deepest_overlap > bearable_overlap()) {
    throw overlap_at_start<D>(model_, saved, work.deepest_overlap);
  }
  if (!loop_.plan(work, pause)) return false;
  preparation_.reset();
  return true;
}

template <int D>
void Simulation<D>::move_base() {
  clock_.advance(loop_.now());
  boundary_.move_base(clock_);
  loop_.move_base();
  choose_way();
}

// Chooses how events are found from now to the next move of the base. There all plans are made
// again anyway, so a change of the way costs nothing.
template <int D>
void Simulation<D>::choose_way() {
  if (in_tiles_) failures_ = 0;
  const bool allowed = foresight_ && (watched_in_tiles_ || !loop_.is_watched());
  in_tiles_ = allowed && --until_tried_ <= 0;
  if (in_tiles_) {
    loop_.drop_plans();
    foresight_->restart(loop_.now());
  } else {
    loop_.plan_again();
  }
}

// Continues without tiles. In a gas that clusters or collapses, tiles may fail again and again, so
// they are tried ever more rarely.
template <int D>
void Simulation<D>::leave_tiles() {
  constexpr int kMostDoublings = 6;
  in_tiles_ = false;
  failures_ = std::min(failures_ + 1, kMostDoublings);
  until_tried_ = 1 << failures_;
  loop_.plan_again();
}

template <int D>
void Simulation<D>::use_threads(int threads) {
  if (!runs_in_tiles(D, particles().size(), threads)) {
    foresight_.reset();
    way_is_open_ = in_tiles_;
    return;
  }
  const auto count = static_cast<double>(particles().size());
  const double density = count * std::pow(model_.diameter, D) / model_.box.prod();
  use_threads(threads, tile_sizes(particles().size(), packing_fraction(D, density), threads));
  watched_in_tiles_ = watched_runs_in_tiles(threads);
}

template <int D>
void Simulation<D>::use_threads(int threads, const TileSizes& sizes) {
  threads_ = threads;
  tile_sizes_ = sizes;
  watched_in_tiles_ = true;
  make_tiles();
}

// The way is chosen at the next event.
template <int D>
void Simulation<D>::make_tiles() {
  foresight_.reset();
  if (suits_tiles(model_)) {
    foresight_ = std::make_unique<Foresight<D>>(model_, boundary_, loop_.grains(),
                                                particles().size(), threads_, tile_sizes_);
    if (foresight_->tiles() < 2) foresight_.reset();
  }
  until_tried_ = 0;
  way_is_open_ = foresight_ || in_tiles_;
}

template <int D>
typename EventLoop<D>::Halt Simulation<D>::advance(double stop, std::uint64_t collisions,
                                                   std::uint64_t steps,
                                                   const StopRequest& stop_request) {
  return in_tiles_ ? follow_foresight(stop, collisions, steps, stop_request)
                   : loop_.advance(stop, collisions, steps);
}

// Advances by a whole window of the tiles, if nothing needs its events in order. Returns false if
// that is impossible. At a stop request the window may be incomplete.
template <int D>
bool Simulation<D>::advance_window(double stop, std::uint64_t collisions, std::uint64_t steps,
                                   const StopRequest& stop_request) {
  constexpr double kReserve = 1.2;  // a window may have more events than expected
  if (loop_.is_watched() || model_.contact_time || !foresight_->events().empty()) return false;
  if (counts().collisions() >= collisions || counts().steps() >= steps) return false;
  const std::uint64_t most = std::min(
      {loop_.until_base_moves(), collisions - counts().collisions(), steps - counts().steps()});
  if (static_cast<double>(most) < kReserve * foresight_->typical_window()) return false;
  const double horizon = std::min(stop, next_kick());
  return foresight_->fits_before(horizon) &&
         foresight_->advance(loop_, horizon, most, stop_request) != Foresight<D>::Outcome::Failed;
}

template <int D>
typename EventLoop<D>::Halt Simulation<D>::follow_foresight(double stop, std::uint64_t collisions,
                                                            std::uint64_t steps,
                                                            const StopRequest& stop_request) {
  using Halt = typename EventLoop<D>::Halt;
  constexpr std::size_t kAhead = 12;  // events whose particles are prefetched
  const auto is_next = [this](const ForeseenEvent<D>& event) { return loop_.is_next(event); };
  while (counts().collisions() < collisions && counts().steps() < steps) {
    const ForeseenEvent<D>* next = foresight_->events().next(is_next);
    if (!next) {
      if (foresight_->covers(stop)) return Halt::Time;
      const auto outcome =
          foresight_->look_ahead(loop_.gas(), next_kick(), loop_.until_base_moves(), stop_request);
      if (outcome == Foresight<D>::Outcome::Done) continue;
      if (outcome == Foresight<D>::Outcome::Failed) leave_tiles();
      return Halt::Limit;
    }
    if (next->event.time > stop) return Halt::Time;
    foresight_->events().look_past(
        kAhead, [this](const ForeseenEvent<D>& later) { loop_.prefetch_particles(later.event); });
    const Halt halt = loop_.process_foreseen(*next);
    foresight_->events().pop();
    if (halt != Halt::Limit) return halt;
  }
  return Halt::Limit;
}

template <int D>
double Simulation<D>::deepest_overlap(const StopRequest& stop) const {
  typename EventLoop<D>::Preparation work;
  if (!in_tiles_) {
    if (!loop_.compare(work, stop)) throw Interrupted();
    return work.deepest_overlap;
  }
  EventLoop<D> placed(model_, boundary_, save());
  if (!placed.place(work, stop) || !placed.compare(work, stop)) throw Interrupted();
  return work.deepest_overlap;
}

// Collisions that follow each other within the rounding of positions have no end, because the
// particles have no room. The watchdog then finds the pair: it compares the time of collisions with
// the time in which a particle crosses the box. In a collapse the watchdog knows a longer mean
// time between collisions.
template <int D>
void Simulation<D>::look_for_room(double elapsed, std::uint64_t collisions) {
  constexpr std::uint64_t kCollisionsPerLook = 200;
  constexpr double kRounding = 4.0 * std::numeric_limits<double>::epsilon();
  constexpr double kFaster = 1e3;  // a collapse makes collisions faster than before
  looked_for_ += elapsed;
  looked_at_ += collisions;
  if (looked_at_ < kCollisionsPerLook) return;
  // In a longer box the rounding of positions is carried on.
  const double rounding = kRounding * std::min(model_.box.maxCoeff(), kLongBox * model_.diameter);
  const auto crowded = [&](double speed) {
    return looked_for_ * speed <= rounding * static_cast<double>(looked_at_);
  };
  // The temperature takes time, and is needed only if usual particles have no room.
  const double usual = usual_speed<D>(model_, start_speed_);
  const double speed = crowded(usual) ? std::max(usual, std::sqrt(D * temperature())) : usual;
  if (!crowded_ && speed > 0.0 && crowded(speed)) {
    const auto& watchdog = loop_.watchdog();
    crowded_ = !watchdog || watchdog->mean_collision_time() * static_cast<double>(looked_at_) <=
                                kFaster * looked_for_;
    if (crowded_) loop_.watch_closely(model_.box.maxCoeff() / speed);
  }
  looked_for_ = 0.0;
  looked_at_ = 0;
}

// Under other laws or with other particles, those of before do not count.
template <int D>
void Simulation<D>::look_anew() {
  looked_for_ = 0.0;
  looked_at_ = 0;
  crowded_ = false;
}

// The base moves before the run stops, so that the state is valid.
template <int D>
void Simulation<D>::attend_to(typename EventLoop<D>::Halt halt) {
  if (loop_.base_due()) move_base();
  if (halt == EventLoop<D>::Halt::Diverges) {
    // The limit of a gas with a piston holds only while it moves in.
    const bool diverges = fastest_speed<D>(model_, start_speed_, false) < kNever || compresses();
    if (diverges) throw divergence<D>(model_, time(), heat(), compresses());
    allow_speed(loop_.fastest_now());
  }
  if (halt == EventLoop<D>::Halt::StandsStill) {
    if (crowded_) throw crowding<D>(model_, *loop_.watchdog(), time());
    throw standstill<D>(model_, *loop_.watchdog(), time(), heat(), compresses());
  }
}

template <int D>
Heat Simulation<D>::heat() const {
  const double all = mass();
  return {temperature(), all > 0.0 ? std::sqrt(2.0 * kinetic_energy() / all) : 0.0};
}

// Whether the piston moves into the box now.
template <int D>
bool Simulation<D>::compresses() const {
  const std::optional<PistonStroke>& piston = boundary_.piston();
  return piston && piston->moves_at(time()) && piston->velocity() > 0.0;
}

template <int D>
bool Simulation<D>::run_until(double time, std::uint64_t collisions, std::uint64_t steps,
                              const StopRequest& stop_request) {
  using Halt = typename EventLoop<D>::Halt;
  constexpr std::uint64_t kStepsPerLook = 1000;  // at the request
  if (!prepare(stop_request)) return false;
  if (std::exchange(way_is_open_, false)) choose_way();
  while (!stop_request.made()) {
    Timer* timer = due_timer(time);
    const bool kicks = kick_is_due(timer ? timer->next() : time);
    const double stop = kicks ? next_kick() : clock_.relative(timer ? timer->next() : time);
    if (in_tiles_ && advance_window(stop, collisions, steps, stop_request)) continue;
    const double since = base_time();
    const std::uint64_t before = counts().collisions();
    const Halt halt =
        advance(stop, collisions, std::min(steps, counts().steps() + kStepsPerLook), stop_request);
    look_for_room(base_time() - since, counts().collisions() - before);
    attend_to(halt);
    if (halt == Halt::Limit && (counts().collisions() >= collisions || counts().steps() >= steps)) {
      return false;
    }
    if (halt != Halt::Time) continue;
    if (stop == kNever) return true;
    loop_.skip_to(stop);
    if (kicks) {
      loop_.kick();
      ++kicks_since_origin_;
      move_base();
    } else if (timer) {
      fire(*timer);
    } else {
      return true;
    }
  }
  return false;
}

template <int D>
void Simulation<D>::nudge(const Nudge& nudge) {
  set_velocities(loop_.velocities_after(nudge), &EventCounts::nudges);
}

template <int D>
void Simulation<D>::reverse() {
  loop_.reverse();
  move_base();
}

template <int D>
void Simulation<D>::start_puff(const std::vector<NewVelocity<D>>& velocities) {
  set_velocities(velocities, &EventCounts::puffs);
}

// The base moves, as at a kick, because all particles' plans may be wrong.
template <int D>
void Simulation<D>::set_velocities(const std::vector<NewVelocity<D>>& velocities,
                                   std::uint64_t EventCounts::*count) {
  for (const NewVelocity<D>& next : velocities) allow_speed(next.velocity.norm());
  loop_.nudge(velocities, count);
  move_base();
}

// Raises the speed limit as if the run had started with a particle of this speed.
template <int D>
void Simulation<D>::allow_speed(double speed) {
  start_speed_ = std::max(start_speed_, speed);
  loop_.allow_start_speed(start_speed_);
}

// The base moves, as at a nudge.
template <int D>
void Simulation<D>::move_piston(double position, double start, double end) {
  const std::optional<PistonStroke>& before = boundary_.piston();
  const PistonStroke stroke{before ? before->travel(start) : 0.0, model_.box[0] - position, start,
                            end};
  boundary_.begin(stroke);
  loop_.begin_stroke();
  allow_speed(std::max(2.0 * std::fabs(stroke.velocity()), loop_.fastest_now()));
  move_base();
}

template <int D>
void Simulation<D>::every(double start, double interval, std::function<void(double)> action,
                          std::uint64_t done, const void* owner) {
  timers_.push_back({RegularTimes(start, interval), done, std::move(action), owner});
}

template <int D>
void Simulation<D>::end_timers(const void* owner) {
  timers_.remove_if([&](const Timer& timer) { return timer.owner == owner; });
}

template <int D>
bool Simulation<D>::is_overdue(double start, double interval, std::uint64_t done) const {
  constexpr double kLate = 1e-6;  // of the time
  return !(RegularTimes(start, interval).of(done) >= time() * (1.0 - kLate));
}

// Times that are equal as doubles are at once: an interval of 0.1 is due three times until 0.3,
// however the digits beyond double precision compare. Kicks keep these digits. So neither timers
// nor ends of runs change the state at a time.
template <int D>
typename Simulation<D>::Timer* Simulation<D>::due_timer(double stop) {
  Timer* due = nullptr;
  for (Timer& timer : timers_) {
    if (timer.times.interval() == 0.0 && timer.count > 0) continue;
    if (timer.next() > stop || (due && timer.next() == stop)) continue;
    stop = timer.next();
    due = &timer;
  }
  return due;
}

template <int D>
bool Simulation<D>::kick_is_due(double stop) const {
  return model_.bulk_drive && kick_times_.of(kicks_since_origin_ + 1) <= stop;
}

template <int D>
void Simulation<D>::fire(Timer& timer) {
  timer.action(timer.times.of(timer.count++));
}

template <int D>
double Simulation<D>::next_kick() const {
  if (!model_.bulk_drive) return kNever;
  return clock_.relative(kick_times_.exactly(kicks_since_origin_ + 1));
}

template <int D>
RunState<D> Simulation<D>::save() const {
  RunState<D> saved = save_without_particles();
  loop_.save_to(saved);
  return saved;
}

template <int D>
RunState<D> Simulation<D>::save_without_particles() const {
  RunState<D> saved;
  saved.gravity = model_.gravity;
  saved.wall_motions = wall_motions<D>(model_);
  saved.phase_shifts = boundary_.phase_shifts();
  saved.shear_rate = model_.shear_rate;
  saved.shear_phase = boundary_.shear_phase();
  saved.piston = boundary_.piston();
  saved.base = clock_.base();
  saved.start_speed = start_speed_;
  saved.kick_interval = model_.kick_interval();
  saved.kick_origin = kick_times_.start();
  saved.kicks_since_origin = kicks_since_origin_;
  saved.now = loop_.now();
  return saved;
}

template <int D>
std::vector<Vec<D>> Simulation<D>::positions() const {
  const Domain<D> domain = this->domain();
  std::vector<Vec<D>> positions;
  positions.reserve(particles().size());
  for (const Particle<D>& particle : particles()) {
    Vec<D> r = domain.wrapped(particle.flight.at(base_time(), model_.gravity));
    for (int axis = 0; axis < D; ++axis) {
      // A position a rounding error below 0 wraps to the far end of the box, which is position 0.
      // In a sheared box the place there would be another one.
      if (!domain.periodic[axis] || r[axis] != domain.box[axis]) continue;
      r[axis] = domain.sheared && axis == 1 ? std::nextafter(r[axis], 0.0) : 0.0;
    }
    positions.push_back(r);
  }
  return positions;
}

template <int D>
State<D> Simulation<D>::state() const {
  State<D> state;
  state.positions = positions();
  state.velocities.reserve(particles().size());
  const Domain<D> domain = this->domain();
  for (const Particle<D>& particle : particles()) {
    Vec<D> velocity = particle.flight.velocity_at(base_time(), model_.gravity);
    if (domain.sheared) {
      const Vec<D> position = particle.flight.at(base_time(), model_.gravity);
      velocity[0] -= domain.velocity_x(domain.image_at(position));
    }
    state.velocities.push_back(velocity);
  }
  state.spins.assign(spins().begin(), spins().end());
  state.grains.reserve(loop_.grains().size());
  loop_.grains().for_each([&](const Grain& grain) { state.grains.push_back(grain); });
  if (const PistonFlight* piston = free_piston()) {
    state.piston = {piston->at(base_time()), piston->velocity_at(base_time())};
  }
  return state;
}

template <int D>
std::uint64_t Simulation<D>::state_hash() const {
  return clatter::state_hash<D>(state());
}

template <int D>
double Simulation<D>::mass() const {
  double mass = 0.0;
  loop_.grains().for_each([&](const Grain& grain) { mass += grain.mass; });
  return is_mixture() ? mass : static_cast<double>(particles().size());
}

template <int D>
double Simulation<D>::kinetic_energy() const {
  double twice = 0.0;
  for_masses([&](const Flight<D>& flight, double mass) {
    twice += mass * peculiar_at(flight, base_time()).squaredNorm();
  });
  return 0.5 * twice;
}

template <int D>
double Simulation<D>::temperature() const {
  const auto count = static_cast<double>(particles().size());
  return count > 0.0 ? 2.0 * kinetic_energy() / (D * count) : 0.0;
}

template <int D>
double Simulation<D>::spin_energy() const {
  double twice = 0.0;
  for (std::uint32_t i = 0; i < spins().size(); ++i) {
    twice += grain(i).moment_of_inertia() * spins()[i].squaredNorm();
  }
  return 0.5 * twice;
}

template class Simulation<2>;
template class Simulation<3>;

}  // namespace clatter
