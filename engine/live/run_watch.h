#pragma once

#include <cstdint>
#include <memory>
#include <optional>
#include <vector>

#include "engine/live/collision_lookahead.h"
#include "engine/live/frame.h"
#include "engine/live/last_collision.h"
#include "engine/live/live_observables.h"
#include "engine/live/live_profile.h"
#include "engine/measure/totals.h"
#include "engine/run/scheduled_run.h"

namespace clatter {

/// All that the frames of a run measure: its tally, the collisions of the picked particle, averages
/// and observables, and the clicks of its collisions.
template <int D>
class RunWatch final : private Observer<D> {
 public:
  /// Watches a run from now on. `run` must outlive this object.
  explicit RunWatch(ScheduledRun<D>& run);
  RunWatch(const RunWatch&) = delete;
  RunWatch& operator=(const RunWatch&) = delete;

  /// Adds what happened since the last call to the tally.
  void close_window();
  /// From the run's start to the last close_window().
  const Tally& tally() const { return tally_; }
  /// The run has gone to another state, with this tally. Averages restart.
  void return_to(const Tally& tally);

  /// Frames have this profile, along an axis, from now on.
  void show_profile(Profiled what, Axis axis);
  /// The same profile as another watch.
  void show_profile_of(const RunWatch& other) {
    show_profile(other.profiled_, other.profile_axis_);
  }
  /// Begins or ends to record clicks.
  void listen(bool on);
  /// The clicks since the last call; empty: nobody listens.
  std::vector<Click> take_clicks() { return clicks_ ? clicks_->take() : std::vector<Click>(); }
  /// Frames have the last and next collision of this particle; absent: of none.
  void pick(std::optional<std::uint32_t> particle);
  /// Whether the search for the next collision of the picked particle continues.
  bool looks_ahead() const;
  /// The last collision of two particles, and the search for one before a time.
  LastCollision<D>& last_collision() { return last_; }
  /// The same of a watch that does not change.
  const LastCollision<D>& last_collision() const { return last_; }

  /// Writes the measured parts of a frame.
  void fill(Frame& frame, bool halted);

 private:
  void before_laws(const Model<D>& next) override;
  void on_laws() override;
  double window() const { return run_.laws().view.window / kWindowParts; }
  void begin_profile();
  void begin_averages();
  // Steps of the search for the next collision of the picked particle. Most particles collide
  // within a few collisions per particle.
  std::uint64_t longest_search() const {
    return 100 * (run_.simulation().particles().size() + 100);
  }
  std::optional<ParticleCollision> next_collision(bool halted);
  std::optional<ContactTimeError> contact_time_error() const;

  ScheduledRun<D>& run_;
  std::optional<Totals<D>> totals_;
  Tally tally_ = empty_tally(D);
  Tally tally_at_laws_ = tally_;  // at the last change of laws
  LastCollision<D> last_{run_};
  std::optional<std::uint32_t> picked_;
  CollisionWatch<D> picked_collisions_;             // of the picked particle
  std::optional<CollisionLookahead<D>> lookahead_;  // of the picked particle, from its first frame
  std::uint64_t steps_told_ = 0;                    // the run's steps at the last frame
  Profiled profiled_ = Profiled::Nothing;
  Axis profile_axis_ = Axis::X;
  std::optional<LiveProfile<D>> profile_;  // if profiled_ is Fields
  std::optional<LiveResiduals<D>> residuals_;
  std::unique_ptr<LiveObservables<D>> observables_;  // absent: the scene has none
  std::unique_ptr<ClickRecorder<D>> clicks_;         // absent: nobody listens
  Observation<D> own_, of_totals_, of_last_, of_picked_;
};

extern template class RunWatch<2>;
extern template class RunWatch<3>;

}  // namespace clatter
