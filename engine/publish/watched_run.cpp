#include "engine/publish/watched_run.h"

namespace clatter {

WatchedRun::WatchedRun(const Scene& scene, std::uint64_t seed)
    : run_(scene, seed), started_(std::make_shared<const Scene>(scene)) {
  run_.show(scene.view);
  run_.on_change = [this](Simulation<2>& next) {
    close_window();
    observe(next);
    scene_.reset();
  };
  observe(run_.simulation());
}

void WatchedRun::observe(Simulation<2>& simulation) {
  totals_.emplace(simulation);
  simulation.add_observer(*totals_);
  simulation.add_observer(last_);
}

void WatchedRun::close_window() {
  const WindowTotals<2> window = totals_->close_window();
  tally_.time += window.duration;
  tally_.temperature_integral += window.duration * window.temperature;
  tally_.walls_in += window.walls_in;
  tally_.bulk_in += window.bulk_in;
  tally_.gravity_in += window.gravity_in;
  tally_.dissipated += window.dissipated;
  tally_.collisions += static_cast<std::uint64_t>(window.collisions);
}

void WatchedRun::tell(Frame& frame, bool halted) {
  close_window();
  if (!scene_) scene_ = std::make_shared<const Scene>(run_.scene());
  frame.snapshot = run_.snapshot();
  frame.tally = tally_;
  frame.scene = scene_;
  frame.started = started_;
  frame.seed = run_.seed();
  frame.ledger_residual = totals_->ledger_residual();
  frame.deepest_overlap = run_.simulation().checks().deepest_overlap;
  frame.state_hash.reset();
  if (halted) frame.state_hash = run_.simulation().state_hash();
}

}  // namespace clatter
