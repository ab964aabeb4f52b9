#include "engine/publish/scheduled_run.h"

#include <limits>
#include <utility>

#include "engine/dynamics/memory.h"
#include "engine/error.h"
#include "engine/initial/start_state.h"
#include "engine/publish/publish.h"

namespace clatter {

std::unique_ptr<Simulation<2>> simulation_of(const Scene& scene, std::uint64_t seed) {
  require_memory(scene);
  return std::make_unique<Simulation<2>>(model_of<2>(scene, seed), start_state<2>(scene, seed));
}

ScheduledRun::ScheduledRun(const Scene& scene, std::uint64_t seed)
    : schedule_(scene), seed_(seed), simulation_(simulation_of(scene, seed)) {}

ScheduledRun::ScheduledRun(const Scene& scene, std::uint64_t seed, const RunState<2>& saved)
    : schedule_(scene), seed_(seed) {
  schedule_.skip_to(Clock(saved.base).absolute(saved.now));
  simulation_ = std::make_unique<Simulation<2>>(model_of<2>(schedule_.scene(), seed), saved);
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
  try {
    run_until(simulation_->time() * (1.0 + kRoundings));
  } catch (const PhysicalStop&) {
    // Who only halts has no use for it, and other laws may let time go on.
  }
}

void ScheduledRun::change(const std::vector<Override>& laws) {
  settle();
  Schedule changed = schedule_;
  changed.add({.time = simulation_->time(), .set = laws});
  changed.advance();
  change_laws(std::move(changed));
}

void ScheduledRun::change_laws(Schedule changed) {
  go_on_as(
      std::make_unique<Simulation<2>>(model_of<2>(changed.scene(), seed_), simulation_->save()));
  schedule_ = std::move(changed);
}

// All that watches is handed over to another simulation with the particles where they are.
void ScheduledRun::go_on_as(std::unique_ptr<Simulation<2>> next) {
  if (on_change) on_change(*next);
  if (shown_) shown_ = std::make_unique<ViewObservers>(*next, view_, exposure_, shown_.get());
  simulation_ = std::move(next);
}

void ScheduledRun::renew() {
  go_on_as(std::make_unique<Simulation<2>>(simulation_->model(), simulation_->save()));
}

// Observers stay with their simulation, so that those of another view need another one.
void ScheduledRun::show(const View& view, double exposure) {
  view_ = view;
  exposure_ = exposure;
  if (shown_) {
    renew();
  } else {
    shown_ = std::make_unique<ViewObservers>(*simulation_, view, exposure);
  }
}

void ScheduledRun::show(const View& view, const std::string& saved, double exposure) {
  if (saved.empty()) return show(view, exposure);
  if (std::exchange(shown_, nullptr)) renew();
  view_ = view;
  exposure_ = exposure;
  shown_ = std::make_unique<ViewObservers>(*simulation_, view, exposure,
                                           ArchiveReader(saved, "what is shown"));
}

std::string ScheduledRun::save_shown() const {
  return shown_ ? shown_->save() : "";
}

Snapshot ScheduledRun::snapshot() {
  Snapshot snapshot = snapshot_of(*simulation_);
  if (shown_) shown_->publish(snapshot);
  return snapshot;
}

}  // namespace clatter
