#include "engine/run/scheduled_run.h"

#include <fmt/format.h>

#include <cmath>
#include <limits>
#include <utility>

#include "engine/error.h"
#include "engine/initial/memory.h"
#include "engine/initial/puff_particles.h"
#include "engine/initial/start_state.h"
#include "engine/picture/snapshot.h"
#include "engine/scene/act_checks.h"

namespace clatter {

template <int D>
std::unique_ptr<Simulation<D>> simulation_of(const Scene& scene, std::uint64_t seed,
                                             const StopRequest& stop) {
  require_memory(scene);
  return std::make_unique<Simulation<D>>(model_of<D>(scene, seed),
                                         start_state<D>(scene, seed, stop), 0.0, stop);
}

template <int D>
ScheduledRun<D>::ScheduledRun(const Scene& scene, std::uint64_t seed, const StopRequest& stop)
    : schedule_(scene), seed_(seed), simulation_(simulation_of<D>(scene, seed, stop)) {}

template <int D>
ScheduledRun<D>::ScheduledRun(const Scene& scene, std::uint64_t seed, State<D> start)
    : schedule_(scene),
      seed_(seed),
      simulation_(std::make_unique<Simulation<D>>(typename Simulation<D>::InParts(),
                                                  model_of<D>(scene, seed), std::move(start))) {}

template <int D>
ScheduledRun<D>::ScheduledRun(const Scene& scene, std::uint64_t seed, const RunState<D>& saved,
                              const StopRequest& stop)
    : schedule_(scene), seed_(seed) {
  schedule_.skip_to(Clock(saved.base).absolute(saved.now), saved.counts.changes());
  simulation_ = std::make_unique<Simulation<D>>(model_of<D>(schedule_.laws(), seed), saved, stop);
}

template <int D>
void ScheduledRun<D>::use_threads(int threads) {
  threads_ = threads;
  simulation_->use_threads(threads);
}

template <int D>
Scene ScheduledRun<D>::present_scene() const {
  Scene present = scene();
  if (present.particles.start.layout != Layout::File) {
    present.particles.count = static_cast<int>(simulation_->particles().size());
    for (Species& one : present.species) one.count = 0;
    for (std::uint32_t i = 0; i < simulation_->particles().size(); ++i) {
      if (!present.species.empty()) ++present.species[simulation_->grain(i).species].count;
    }
  }
  return present;
}

template <int D>
bool ScheduledRun<D>::run_until(double time, std::uint64_t collisions, std::uint64_t steps,
                                const StopRequest& stop) {
  while (schedule_.next() <= time) {
    if (!simulation_->run_until(schedule_.next(), collisions, steps, stop)) return false;
    advance(schedule_);
  }
  return simulation_->run_until(time, collisions, steps, stop);
}

template <int D>
void ScheduledRun<D>::halt_at(double time) {
  try {
    run_until(time);
  } catch (const PhysicalStop&) {
    // A halt needs no report of the stop, and other laws may let the run continue.
  }
}

double settled_time(double time) {
  constexpr double kRoundings = 4.0 * std::numeric_limits<double>::epsilon();
  return time * (1.0 + kRoundings);
}

template <int D>
void ScheduledRun<D>::settle() {
  halt_at(settled_time(simulation_->time()));
}

// The multiple of a power of ten, as large as possible, in the `span` that begins at a time.
static double round_time(double time, double span) {
  const double power = std::floor(std::log10(span));
  // A quotient by a power of ten is the double next to the decimal number; a product is not.
  const double per = std::pow(10.0, std::fabs(power));
  const auto multiple = [&](double count) { return power < 0.0 ? count / per : count * per; };
  const double count = std::round(power < 0.0 ? time * per : time / per);
  return multiple(count) >= time ? multiple(count) : multiple(count + 1.0);
}

template <int D>
void ScheduledRun<D>::halt_within(double delay) {
  if (delay > 0.0) {
    halt_at(round_time(simulation_->time(), delay));
  } else {
    settle();
  }
}

// The longest period of a wall that moves; 0: none does.
static double longest_period(const Scene& scene) {
  double period = 0.0;
  for (const std::optional<Wall>& wall : scene.walls) {
    const bool moves = wall && wall->stroke > 0.0 && wall->frequency > 0.0;
    if (moves) period = std::max(period, 1.0 / wall->frequency);
  }
  return period;
}

// A moving wall with another stroke is at another place, where a particle may be. Then the change
// is tried again at later moments of the wall's period.
template <int D>
void ScheduledRun<D>::change(const std::vector<Override>& laws, double delay) {
  constexpr int kMoments = 16;  // of a period
  halt_within(delay);
  const double between = longest_period(this->laws()) / kMoments;
  for (int moment = 0;; ++moment) {
    try {
      return change_here(laws);
    } catch (const PhysicalStop&) {
      if (moment == kMoments || between == 0.0) throw;
    }
    halt_at(round_time(simulation_->time() + 0.5 * between, 0.5 * between));
  }
}

template <int D>
void ScheduledRun<D>::change_here(const std::vector<Override>& laws) {
  make({.time = simulation_->time(), .set = laws});
}

template <int D>
void ScheduledRun<D>::nudge(const Nudge& nudge, double delay) {
  check_nudge(nudge, laws(), static_cast<std::int64_t>(simulation_->particles().size()));
  halt_within(delay);
  make({.time = simulation_->time(), .nudge = nudge});
}

template <int D>
void ScheduledRun<D>::puff(const Puff& puff, double delay) {
  check_puff(puff, laws());
  halt_within(delay);
  Puff fitting = puff;
  fitting.count = static_cast<int>(puff_particles(simulation_->save(), puff, laws(), seed_).size());
  if (fitting.count == 0) {
    throw UserError({}, "there is no room for a particle", "choose another place or radius");
  }
  make({.time = simulation_->time(), .puff = fitting});
}

template <int D>
void ScheduledRun<D>::reverse(double delay) {
  halt_within(delay);
  make({.time = simulation_->time(), .reverse = true});
}

// A stroke that begins later is only added to the changes to come.
template <int D>
void ScheduledRun<D>::move_piston(double position, double duration, double delay) {
  const auto free_from = [this] {
    return piston_plan(schedule_.changes(), simulation_->time(), 0.0).time;
  };
  const auto checked = [&](double time) {
    Scene scene = schedule_.scene();
    scene.changes.push_back({.time = time, .piston = position, .until = time + duration});
    check_pistons(scene);
    return scene.changes.back();
  };
  if (free_from() <= simulation_->time()) {
    checked(simulation_->time());
    halt_within(delay);
  } else {
    settle();
  }
  const double start = free_from();
  const Change stroke = checked(start);
  if (start > simulation_->time()) {
    schedule_.add(stroke);
  } else {
    make(stroke);
  }
}

// Adds a change at the present time to those of the scene. A run of the scene up to this time also
// ends by run_until(), which rounds the time on the base that a nudge has moved.
template <int D>
void ScheduledRun<D>::make(const Change& change) {
  Schedule changed = schedule_;
  changed.add(change);
  advance(std::move(changed));
  halt_at(change.time);
}

// Makes the next change of `schedule`, which then replaces that of the run. A nudge is an event of
// the simulation, so that observers see it. A stroke of the piston is one too, so that averages
// continue. The particles of a puff enter at rest, and then have a nudge, so that the energy
// balance includes it.
template <int D>
void ScheduledRun<D>::advance(Schedule schedule) {
  const Change change = schedule.coming();
  if (change.nudge) simulation_->check(*change.nudge);
  schedule.advance();
  if (!change.set.empty()) {
    const bool averages_go_on = change.ramp.has_value();
    if (shown_ && averages_go_on) shown_->before_laws();
    simulation_->set_laws(model_of<D>(schedule.laws(), seed_));
    if (!change.acts()) simulation_->count_law_change();
    if (shown_) shown_->on_laws(averages_go_on);
  }
  if (change.nudge) simulation_->nudge(*change.nudge);
  if (change.piston) simulation_->move_piston(*change.piston, change.time, change.until);
  if (change.puff) enter(*change.puff);
  if (change.reverse) simulation_->reverse();
  schedule_ = std::move(schedule);
}

template <int D>
void ScheduledRun<D>::enter(const Puff& puff) {
  const std::vector<PuffParticle<D>> particles =
      puff_particles(simulation_->save(), puff, laws(), seed_);
  if (static_cast<int>(particles.size()) < puff.count) {
    throw PhysicalStop(
        fmt::format("the puff at t = {:.9g} has room for {} of {} particles; give "
                    "fewer, or a larger radius",
                    simulation_->time(), particles.size(), puff.count));
  }
  auto next = static_cast<std::uint32_t>(simulation_->particles().size());
  std::vector<Vec<D>> positions;
  std::vector<NewVelocity<D>> velocities;
  std::vector<Grain> grains;
  for (const auto& [position, velocity, grain] : particles) {
    positions.push_back(position);
    velocities.push_back({next++, velocity});
    if (!laws().species.empty()) grains.push_back(grain);
  }
  simulation_->add_particles(positions, grains);
  simulation_->use_threads(threads_);
  if (shown_) shown_->on_laws(false);
  simulation_->start_puff(velocities);
}

template <int D>
void ScheduledRun<D>::show(const View& view, double exposure) {
  view_ = view;
  exposure_ = exposure;
  shown_ = std::make_unique<ViewObservers<D>>(*simulation_, view, exposure, shown_.get());
}

template <int D>
void ScheduledRun<D>::show(const View& view, const std::string& saved, double exposure) {
  if (saved.empty()) return show(view, exposure);
  view_ = view;
  exposure_ = exposure;
  shown_ = std::make_unique<ViewObservers<D>>(*simulation_, view, exposure,
                                              ArchiveReader(saved, "what is shown"));
}

template <int D>
std::string ScheduledRun<D>::save_shown() const {
  return shown_ ? shown_->save() : "";
}

template <int D>
void ScheduledRun<D>::set_changes(std::vector<Change> changes) {
  Scene scene = schedule_.laws();
  scene.changes = std::move(changes);
  schedule_ = Schedule(scene, simulation_->time());
}

template <int D>
void ScheduledRun<D>::return_to(const Scene& scene, double changed_until, const RunState<D>& state,
                                const std::vector<Rotation<D>>& rotations) {
  Schedule schedule(scene, changed_until);
  simulation_->restart(model_of<D>(schedule.laws(), seed_), state);
  simulation_->use_threads(threads_);
  if (shown_) {
    shown_ = std::make_unique<ViewObservers<D>>(*simulation_, view_, exposure_);
    shown_->set_rotations(rotations);
  }
  schedule_ = std::move(schedule);
}

template <int D>
std::vector<Rotation<D>> ScheduledRun<D>::rotations() const {
  return shown_ ? shown_->rotations() : std::vector<Rotation<D>>();
}

// Adds the piston to the bodies of a snapshot: a box, or without thickness a partition.
static void show_piston(const Piston& piston, double place, Snapshot& snapshot) {
  if (piston.thickness == 0.0) {
    Partition& body = snapshot.partitions.emplace_back();
    body.axis = piston.axis;
    body.position = place;
    body.law = piston.law;
    return;
  }
  Obstacle& body = snapshot.obstacles.emplace_back();
  body.kind = ObstacleKind::Box;
  body.centre = body.from = VecX::Zero(snapshot.box.size());
  body.to = snapshot.box;
  const int axis = static_cast<int>(piston.axis);
  body.from[axis] = place - 0.5 * piston.thickness;
  body.to[axis] = place + 0.5 * piston.thickness;
  body.law = piston.law;
}

template <int D>
Snapshot ScheduledRun<D>::snapshot() {
  Snapshot snapshot = snapshot_of(*simulation_);
  snapshot.species = laws().species;
  for (const Obstacle& one : laws().obstacles) {
    if (one.present) snapshot.obstacles.push_back(one);
  }
  for (const Partition& one : laws().partitions) {
    if (one.present) snapshot.partitions.push_back(one);
  }
  if (snapshot.free_piston) show_piston(*laws().piston, *snapshot.free_piston, snapshot);
  if (shown_) shown_->publish(snapshot);
  return snapshot;
}

template std::unique_ptr<Simulation<2>> simulation_of(const Scene&, std::uint64_t,
                                                      const StopRequest&);
template std::unique_ptr<Simulation<3>> simulation_of(const Scene&, std::uint64_t,
                                                      const StopRequest&);
template class ScheduledRun<2>;
template class ScheduledRun<3>;

}  // namespace clatter
