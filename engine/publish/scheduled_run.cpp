#include "engine/publish/scheduled_run.h"

#include <limits>
#include <utility>

#include "engine/dynamics/memory.h"
#include "engine/dynamics/start.h"
#include "engine/error.h"
#include "engine/publish/publish.h"

namespace clatter {

std::unique_ptr<Simulation<2>> simulation_of(const Scene& scene, std::uint64_t seed) {
  require_memory(scene);
  return std::make_unique<Simulation<2>>(model_of(scene, seed), start_state(scene, seed));
}

ScheduledRun::ScheduledRun(const Scene& scene, std::uint64_t seed)
    : schedule_(scene), seed_(seed), simulation_(simulation_of(scene, seed)) {}

ScheduledRun::ScheduledRun(const Scene& scene, std::uint64_t seed, const Saved<2>& saved)
    : schedule_(scene), seed_(seed) {
  schedule_.skip_to(Clock(saved.base).absolute(saved.now));
  simulation_ = std::make_unique<Simulation<2>>(model_of(schedule_.scene(), seed), saved);
}

bool ScheduledRun::run_until(double time, std::uint64_t collisions, std::uint64_t steps) {
  while (schedule_.next() <= time) {
    if (!simulation_->run_until(schedule_.next(), collisions, steps)) return false;
    Schedule changed = schedule_;
    changed.advance();
    change_laws(std::move(changed));
  }
  return simulation_->run_until(time, collisions, steps);
}

void ScheduledRun::settle() {
  constexpr double kRoundings = 4.0 * std::numeric_limits<double>::epsilon();
  run_until(simulation_->time() * (1.0 + kRoundings));
}

void ScheduledRun::change(const std::vector<Override>& laws) {
  try {
    settle();
  } catch (const PhysicalStop&) {
    // Other laws are what lets time go on where it stands still.
  }
  Schedule changed = schedule_;
  changed.add({.time = simulation_->time(), .set = laws});
  changed.advance();
  change_laws(std::move(changed));
}

void ScheduledRun::change_laws(Schedule changed) {
  auto next =
      std::make_unique<Simulation<2>>(model_of(changed.scene(), seed_), simulation_->save());
  if (on_change) on_change(*next);
  if (field_) field_ = std::make_unique<LiveField>(*next, view_, std::move(*field_));
  simulation_ = std::move(next);
  schedule_ = std::move(changed);
}

void ScheduledRun::show(const View& view) {
  view_ = view;
  field_.reset();
  if (view.shows_averages()) field_ = std::make_unique<LiveField>(*simulation_, view);
}

Snapshot ScheduledRun::snapshot() {
  Snapshot snapshot = snapshot_of(*simulation_);
  if (field_) field_->publish(snapshot);
  return snapshot;
}

}  // namespace clatter
