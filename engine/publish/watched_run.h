#pragma once

#include <array>
#include <optional>

#include "engine/measure/totals.h"
#include "engine/publish/command.h"
#include "engine/publish/frame.h"
#include "engine/publish/live_profile.h"
#include "engine/publish/scheduled_run.h"

namespace clatter {

/// A run and what frames tell of it.
class WatchedRun {
 public:
  /// From the scene's start.
  WatchedRun(const Scene& scene, std::uint64_t seed);
  WatchedRun(const WatchedRun&) = delete;
  WatchedRun& operator=(const WatchedRun&) = delete;

  /// The run itself.
  ScheduledRun& run() { return run_; }
  /// What frames have profiles of from now on.
  void show_profile(Profiled what);
  /// Frames tell the collisions of this particle from now on; absent, or no particle: of none.
  void pick(std::optional<std::uint32_t> particle);
  /// Fills in what it knows; a hash where `halted`.
  void tell(Frame& frame, bool halted);
  /// The particles that collided last, if any have.
  const std::optional<std::array<std::uint32_t, 2>>& partners() const { return last_.partners; }

 private:
  struct LastCollision : Observer<2> {
    void on_collision(const PairCollision<2>& collision) override {
      partners = {{collision.particles[0].particle, collision.particles[1].particle}};
    }
    std::optional<std::array<std::uint32_t, 2>> partners;
  };

  void observe(Simulation<2>& simulation);
  void close_window();
  std::optional<ParticleCollision> next_collision(bool halted);
  std::optional<ContactTimeError> contact_time_error() const;

  ScheduledRun run_;
  std::optional<Totals<2>> totals_;
  LastCollision last_;
  std::optional<std::uint32_t> picked_;
  std::optional<CollisionWatch> picked_collisions_;  // of that particle
  std::optional<ParticleCollision> last_collision_;  // its last before laws changed
  std::optional<CollisionLookahead> lookahead_;  // of that particle, once frames have told of it
  std::uint64_t steps_told_ = 0;                 // of the run, by the last frame
  Profiled profiled_ = Profiled::Nothing;
  std::optional<LiveProfile> profile_;  // of that
  std::optional<LiveResiduals> residuals_;
  Tally tally_;
  Tally tally_at_laws_;  // when those in force came
  std::shared_ptr<const Scene> started_;
  std::shared_ptr<const Scene> scene_;  // as told last
};

}  // namespace clatter
