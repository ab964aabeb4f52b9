#include "engine/publish/watched_run.h"

#include <utility>

#include "engine/dynamics/memory.h"
#include "engine/initial/start_state.h"
#include "engine/measure/totals.h"
#include "engine/publish/live_observables.h"
#include "engine/publish/live_profile.h"
#include "engine/publish/moving_sum.h"
#include "engine/publish/scheduled_run.h"

namespace clatter {

namespace {

template <int D>
class RunOf : public WatchedRun {
 public:
  RunOf(const Scene& scene, std::uint64_t seed, State<D> start);
  RunOf(const RunOf&) = delete;
  RunOf& operator=(const RunOf&) = delete;

  double time() const override { return run_.simulation().time(); }
  const EventCounts& counts() const override { return run_.simulation().counts(); }
  AnyState state() const override { return run_.simulation().state(); }
  bool run_until(double time, std::uint64_t collisions, std::uint64_t steps) override {
    return run_.run_until(time, collisions, steps);
  }
  void settle() override { run_.settle(); }
  void change(const std::vector<Override>& laws, double delay) override {
    run_.change(laws, delay);
  }
  void show(const View& view) override;
  void show_profile(Profiled what, Axis axis) override;
  void pick(std::optional<std::uint32_t> particle) override;
  void tell(Frame& frame, bool halted) override;
  const std::optional<std::array<std::uint32_t, 2>>& partners() const override {
    return last_.partners;
  }

 private:
  struct LastCollision : Observer<D> {
    void on_collision(const PairCollision<D>& collision) override {
      partners = {{collision.particles[0].particle, collision.particles[1].particle}};
    }
    std::optional<std::array<std::uint32_t, 2>> partners;
  };

  void observe(Simulation<D>& simulation);
  void observe_requested(Simulation<D>& simulation, double window);
  void close_window();
  std::optional<ParticleCollision> next_collision(bool halted);
  std::optional<ContactTimeError> contact_time_error() const;

  ScheduledRun<D> run_;
  std::optional<Totals<D>> totals_;
  LastCollision last_;
  std::optional<std::uint32_t> picked_;
  std::optional<CollisionWatch<D>> picked_collisions_;  // of the picked particle
  std::optional<ParticleCollision> last_collision_;  // its last collision before a change of laws
  std::optional<CollisionLookahead<D>> lookahead_;   // of the picked particle, from its first frame
  std::uint64_t steps_told_ = 0;                     // the run's steps at the last frame
  Profiled profiled_ = Profiled::Nothing;
  Axis profile_axis_ = Axis::X;
  std::optional<LiveProfile<D>> profile_;  // if profiled_ is Fields
  std::optional<LiveResiduals<D>> residuals_;
  std::unique_ptr<LiveObservables<D>> observables_;  // absent: the scene has none
  bool same_laws_ = false;  // the next simulation has the laws of the present one
  Tally tally_;
  Tally tally_at_laws_;  // at the last change of laws
  std::shared_ptr<const Scene> started_;
  std::shared_ptr<const Scene> scene_;  // of the last frame
};

template <int D>
RunOf<D>::RunOf(const Scene& scene, std::uint64_t seed, State<D> start)
    : run_(scene, seed, std::move(start)), started_(std::make_shared<const Scene>(scene)) {
  tally_.temperature_integral = Vec<D>::Zero();
  tally_at_laws_ = tally_;
  run_.show(scene.view);
  run_.on_change = [this](Simulation<D>& next) {
    close_window();
    observe(next);
    scene_.reset();
  };
  observe(run_.simulation());
}

template <int D>
void RunOf<D>::observe(Simulation<D>& simulation) {
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
  const double window = run_.laws().view.window / kWindowParts;
  if (profiled_ == Profiled::Fields) profile_.emplace(simulation, window, profile_axis_);
  if (profiled_ == Profiled::Balances) residuals_.emplace(simulation, window, profile_axis_);
  observe_requested(simulation, window);
}

template <int D>
void RunOf<D>::observe_requested(Simulation<D>& simulation, double window) {
  const Measure& measure = run_.laws().measure;
  if (measure.observables.empty()) return;
  observables_ = same_laws_ ? std::make_unique<LiveObservables<D>>(simulation, *observables_)
                            : std::make_unique<LiveObservables<D>>(simulation, measure, window);
}

template <int D>
void RunOf<D>::show(const View& view) {
  same_laws_ = true;
  run_.show(view);
  same_laws_ = false;
}

template <int D>
void RunOf<D>::pick(std::optional<std::uint32_t> particle) {
  if (particle && *particle >= run_.simulation().particles().size()) particle.reset();
  picked_ = particle;
  last_collision_.reset();
  picked_collisions_->watch(particle);
  lookahead_.reset();
}

template <int D>
void RunOf<D>::show_profile(Profiled what, Axis axis) {
  if (static_cast<int>(axis) >= D) axis = Axis::X;
  if (what == profiled_ && axis == profile_axis_) return;
  profiled_ = what;
  profile_axis_ = axis;
  same_laws_ = true;
  run_.renew();
  same_laws_ = false;
}

template <int D>
void RunOf<D>::close_window() {
  const WindowTotals<D> window = totals_->close_window();
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

template <int D>
std::optional<ContactTimeError> RunOf<D>::contact_time_error() const {
  const double dissipated = tally_.dissipated - tally_at_laws_.dissipated;
  const auto collisions = static_cast<double>(tally_.collisions - tally_at_laws_.collisions);
  if (!run_.laws().contact_time || !(dissipated > 0.0)) return std::nullopt;
  const double undissipated = tally_.undissipated - tally_at_laws_.undissipated;
  const auto elastic = static_cast<double>(tally_.elasticised - tally_at_laws_.elasticised);
  return ContactTimeError{undissipated / dissipated, elastic / collisions};
}

// While the run plays, the lookahead takes about as many steps as the run. While it is halted,
// there is time for more steps: most particles collide within a few collisions per particle.
template <int D>
std::optional<ParticleCollision> RunOf<D>::next_collision(bool halted) {
  constexpr std::uint64_t kHeadStart = 5000;
  const Simulation<D>& simulation = run_.simulation();
  const std::uint64_t steps = simulation.counts().steps();
  const std::uint64_t since = steps - std::exchange(steps_told_, steps);
  if (!picked_) return std::nullopt;
  if (!lookahead_) lookahead_.emplace(simulation, *picked_);
  const std::uint64_t most =
      halted ? 100 * (simulation.particles().size() + 100) : 2 * since + kHeadStart;
  return lookahead_->next_after(simulation.time(), most);
}

template <int D>
void RunOf<D>::tell(Frame& frame, bool halted) {
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
  frame.observables.reset();
  if (observables_ && profiled_ != Profiled::Nothing) {
    frame.observables = observables_->tables(halted);
  }
  frame.seed = run_.seed();
  frame.contact_time_error = contact_time_error();
  frame.ledger_residual = totals_->ledger_residual();
  frame.deepest_overlap = run_.simulation().checks().deepest_overlap;
  frame.last_collision = picked_collisions_->last() ? picked_collisions_->last() : last_collision_;
  frame.next_collision = next_collision(halted);
  frame.state_hash.reset();
  if (halted) frame.state_hash = run_.simulation().state_hash();
}

}  // namespace

std::unique_ptr<WatchedRun> watched_run(const Scene& scene, std::uint64_t seed, AnyState start) {
  return std::visit(
      [&]<int D>(State<D>& state) -> std::unique_ptr<WatchedRun> {
        return std::make_unique<RunOf<D>>(scene, seed, std::move(state));
      },
      start);
}

std::unique_ptr<WatchedRun> watched_run(const Scene& scene, std::uint64_t seed) {
  require_memory(scene);
  StartMaker maker(scene, seed);
  maker.advance();
  return watched_run(scene, seed, maker.take());
}

}  // namespace clatter
