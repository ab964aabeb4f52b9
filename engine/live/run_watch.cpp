#include "engine/live/run_watch.h"

#include <chrono>
#include <utility>

namespace clatter {

template <int D>
RunWatch<D>::RunWatch(ScheduledRun<D>& run)
    : run_(run),
      totals_(run.simulation()),
      picked_collisions_(run.simulation(), std::nullopt),
      own_(run.simulation(), *this),
      of_totals_(run.simulation(), *totals_),
      of_last_(run.simulation(), last_),
      of_picked_(run.simulation(), picked_collisions_) {
  begin_averages();
}

template <int D>
void RunWatch<D>::before_laws(const Model<D>&) {
  close_window();
}

template <int D>
void RunWatch<D>::on_laws() {
  tally_at_laws_ = tally_;
  lookahead_.reset();
  begin_averages();
}

template <int D>
void RunWatch<D>::begin_profile() {
  profile_.reset();
  residuals_.reset();
  Simulation<D>& simulation = run_.simulation();
  if (profiled_ == Profiled::Fields) profile_.emplace(simulation, window(), profile_axis_);
  // The balances of cells do not include the shear.
  if (profiled_ == Profiled::Balances && !simulation.model().shear_rate)
    residuals_.emplace(simulation, window(), profile_axis_);
}

template <int D>
void RunWatch<D>::begin_averages() {
  begin_profile();
  const Measure& measure = run_.laws().measure;
  if (measure.observables.empty()) return;
  observables_ = std::make_unique<LiveObservables<D>>(run_.simulation(), measure, window());
}

template <int D>
void RunWatch<D>::close_window() {
  add(tally_, totals_->close_window());
}

template <int D>
void RunWatch<D>::return_to(const Tally& tally) {
  totals_.emplace(run_.simulation());
  tally_ = tally_at_laws_ = tally;
  steps_told_ = run_.simulation().counts().steps();
  last_.forget();
  picked_collisions_.watch(picked_);
  lookahead_.reset();
  begin_averages();
}

template <int D>
void RunWatch<D>::show_profile(Profiled what, Axis axis) {
  if (static_cast<int>(axis) >= D) axis = Axis::X;
  if (what == profiled_ && axis == profile_axis_) return;
  profiled_ = what;
  profile_axis_ = axis;
  begin_profile();
}

template <int D>
void RunWatch<D>::listen(bool on) {
  if (on == (clicks_ != nullptr)) return;
  clicks_ = on ? std::make_unique<ClickRecorder<D>>(run_.simulation(), kMostClicks) : nullptr;
}

template <int D>
void RunWatch<D>::pick(std::optional<std::uint32_t> particle) {
  if (particle && *particle >= run_.simulation().particles().size()) particle.reset();
  picked_ = particle;
  picked_collisions_.watch(particle);
  lookahead_.reset();
}

template <int D>
std::optional<ContactTimeError> RunWatch<D>::contact_time_error() const {
  const double dissipated = tally_.dissipated - tally_at_laws_.dissipated;
  const auto collisions = static_cast<double>(tally_.collisions - tally_at_laws_.collisions);
  if (!run_.laws().contact_time || !(dissipated > 0.0)) return std::nullopt;
  const double undissipated = tally_.undissipated - tally_at_laws_.undissipated;
  const auto elastic = static_cast<double>(tally_.elasticised - tally_at_laws_.elasticised);
  return ContactTimeError{undissipated / dissipated, elastic / collisions};
}

// While the run plays, the lookahead takes about as many steps as the run. While it is halted, the
// search continues at the next frame.
template <int D>
std::optional<ParticleCollision> RunWatch<D>::next_collision(bool halted) {
  constexpr std::uint64_t kHeadStart = 5000;
  constexpr std::chrono::milliseconds kSlice{10};
  const auto due = std::chrono::steady_clock::now() + kSlice;
  const Simulation<D>& simulation = run_.simulation();
  const std::uint64_t steps = simulation.counts().steps();
  const std::uint64_t since = steps - std::exchange(steps_told_, steps);
  // A particle of a puff is not yet there before it.
  if (!picked_ || *picked_ >= simulation.particles().size()) return std::nullopt;
  if (!lookahead_ || !lookahead_->follows(simulation)) lookahead_.emplace(simulation, *picked_);
  const std::uint64_t most = halted ? longest_search() : 2 * since + kHeadStart;
  return lookahead_->next_after(simulation.time(), most,
                                [due] { return std::chrono::steady_clock::now() >= due; });
}

template <int D>
bool RunWatch<D>::looks_ahead() const {
  return lookahead_ && lookahead_->searches() &&
         lookahead_->steps() < run_.simulation().counts().steps() + longest_search();
}

template <int D>
void RunWatch<D>::fill(Frame& frame, bool halted) {
  close_window();
  frame.tally = tally_;
  frame.profile = profile_ ? std::optional(profile_->profile()) : std::nullopt;
  frame.residuals = residuals_ ? std::optional(residuals_->profile()) : std::nullopt;
  frame.observables.reset();
  if (observables_ && profiled_ != Profiled::Nothing) {
    frame.observables = observables_->tables(halted);
  }
  frame.contact_time_error = contact_time_error();
  frame.ledger_residual = totals_->ledger_residual();
  frame.last_collision = picked_collisions_.last();
  frame.next_collision = next_collision(halted);
}

template class RunWatch<2>;
template class RunWatch<3>;

}  // namespace clatter
