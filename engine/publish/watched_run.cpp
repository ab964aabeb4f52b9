#include "engine/publish/watched_run.h"

#include <utility>

#include "engine/publish/moving_sum.h"

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
  tally_at_laws_ = tally_;
  simulation.add_observer(*totals_);
  simulation.add_observer(last_);
  if (picked_collisions_ && picked_collisions_->last())
    last_collision_ = picked_collisions_->last();
  simulation.add_observer(picked_collisions_.emplace(simulation, picked_));
  lookahead_.reset();
  profile_.reset();
  residuals_.reset();
  const double window = run_.scene().view.window / kWindowParts;
  if (profiled_ == Profiled::Fields) profile_.emplace(simulation, window);
  if (profiled_ == Profiled::Balances) residuals_.emplace(simulation, window);
}

void WatchedRun::pick(std::optional<std::uint32_t> particle) {
  if (particle && *particle >= run_.simulation().particles().size()) particle.reset();
  picked_ = particle;
  last_collision_.reset();
  picked_collisions_->watch(particle);
  lookahead_.reset();
}

void WatchedRun::show_profile(Profiled what) {
  if (what == profiled_) return;
  profiled_ = what;
  run_.renew();
}

void WatchedRun::close_window() {
  const WindowTotals<2> window = totals_->close_window();
  tally_.time += window.duration;
  tally_.temperature_integral += window.duration * window.temperature;
  tally_.walls_in += window.walls_in;
  tally_.bulk_in += window.bulk_in;
  tally_.gravity_in += window.gravity_in;
  tally_.dissipated += window.dissipated;
  tally_.undissipated += window.undissipated;
  tally_.collisions += static_cast<std::uint64_t>(window.collisions);
  tally_.elasticised += static_cast<std::uint64_t>(window.elasticised);
}

std::optional<ContactTimeError> WatchedRun::contact_time_error() const {
  const double dissipated = tally_.dissipated - tally_at_laws_.dissipated;
  const auto collisions = static_cast<double>(tally_.collisions - tally_at_laws_.collisions);
  if (!run_.scene().contact_time || !(dissipated > 0.0)) return std::nullopt;
  const double undissipated = tally_.undissipated - tally_at_laws_.undissipated;
  const auto elastic = static_cast<double>(tally_.elasticised - tally_at_laws_.elasticised);
  return ContactTimeError{undissipated / dissipated, elastic / collisions};
}

// While the run goes on the scout takes about as many steps as it does; where it halts there is
// time for more, for most particles collide while all the others do so a few times.
std::optional<ParticleCollision> WatchedRun::next_collision(bool halted) {
  constexpr std::uint64_t kHeadStart = 5000;
  const Simulation<2>& simulation = run_.simulation();
  const std::uint64_t steps = simulation.counts().steps();
  const std::uint64_t since = steps - std::exchange(steps_told_, steps);
  if (!picked_) return std::nullopt;
  if (!lookahead_) lookahead_.emplace(simulation, *picked_);
  const std::uint64_t most =
      halted ? 100 * (simulation.particles().size() + 100) : 2 * since + kHeadStart;
  return lookahead_->next_after(simulation.time(), most);
}

void WatchedRun::tell(Frame& frame, bool halted) {
  close_window();
  if (!scene_) scene_ = std::make_shared<const Scene>(run_.scene());
  frame.snapshot = run_.snapshot();
  frame.tally = tally_;
  frame.scene = scene_;
  frame.started = started_;
  frame.profile.reset();
  if (profile_) frame.profile = profile_->profile();
  frame.residuals.reset();
  if (residuals_) frame.residuals = residuals_->profile();
  frame.seed = run_.seed();
  frame.contact_time_error = contact_time_error();
  frame.ledger_residual = totals_->ledger_residual();
  frame.deepest_overlap = run_.simulation().checks().deepest_overlap;
  frame.last_collision = picked_collisions_->last() ? picked_collisions_->last() : last_collision_;
  frame.next_collision = next_collision(halted);
  frame.state_hash.reset();
  if (halted) frame.state_hash = run_.simulation().state_hash();
}

}  // namespace clatter
