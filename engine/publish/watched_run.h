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
  /// Frames tell the collisions of this disk from now on; absent, or no disk: of none.
  void pick(std::optional<std::uint32_t> disk);
  /// Fills in what it knows; a hash where `halted`.
  void tell(Frame& frame, bool halted);
  /// The disks that collided last, if any have.
  const std::optional<std::array<std::uint32_t, 2>>& partners() const { return last_.partners; }

 private:
  struct LastCollision : Observer<2> {
    void on_collision(const PairCollision<2>& collision) override {
      partners = {{collision.disks[0].disk, collision.disks[1].disk}};
    }
    std::optional<std::array<std::uint32_t, 2>> partners;
  };

  void observe(Simulation<2>& simulation);
  void close_window();
  std::optional<Encounter> next_encounter(bool halted);
  std::optional<ContactTimeError> contact_time_error() const;

  ScheduledRun run_;
  std::optional<Totals<2>> totals_;
  LastCollision last_;
  std::optional<std::uint32_t> picked_;
  std::optional<EncounterWatch> encounters_;  // of that disk
  std::optional<Encounter> encounter_;        // its last before laws changed
  std::optional<Scout> scout_;                // of that disk, once frames have told of it
  std::uint64_t steps_told_ = 0;              // of the run, by the last frame
  Profiled profiled_ = Profiled::Nothing;
  std::optional<LiveProfile> profile_;  // of that
  std::optional<LiveResiduals> residuals_;
  Tally tally_;
  Tally tally_at_laws_;  // when those in force came
  std::shared_ptr<const Scene> started_;
  std::shared_ptr<const Scene> scene_;  // as told last
};

}  // namespace clatter
