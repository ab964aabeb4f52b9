#pragma once

#include <array>
#include <cstdint>
#include <memory>
#include <optional>
#include <vector>

#include "engine/dynamics/run_state.h"
#include "engine/physics/state.h"
#include "engine/publish/command.h"
#include "engine/publish/frame.h"

namespace clatter {

/// A run of disks or of spheres, and the frames that show it. Its frames, like its scene, are the
/// same types in two dimensions and in three.
class WatchedRun {
 public:
  virtual ~WatchedRun() = default;

  /// Simulation time.
  virtual double time() const = 0;
  /// Events since time 0.
  virtual const EventCounts& counts() const = 0;
  /// All particles at time().
  virtual AnyState state() const = 0;

  /// As ScheduledRun::run_until.
  virtual bool run_until(double time, std::uint64_t collisions, std::uint64_t steps) = 0;
  /// As ScheduledRun::settle.
  virtual void settle() = 0;
  /// As ScheduledRun::change.
  virtual void change(const std::vector<Override>& laws) = 0;
  /// As ScheduledRun::show.
  virtual void show(const View& view) = 0;

  /// The profile of frames from now on.
  virtual void show_profile(Profiled what) = 0;
  /// Frames have the collisions of this particle from now on; absent, or no particle: of none.
  virtual void pick(std::optional<std::uint32_t> particle) = 0;
  /// Fills in the frame's snapshot, sums and scene; also the hash of the state where `halted`.
  virtual void tell(Frame& frame, bool halted) = 0;
  /// The particles that collided last, if any have.
  virtual const std::optional<std::array<std::uint32_t, 2>>& partners() const = 0;
};

/// The run that a scene and a seed ask for, at time 0. Throws UserError as ScheduledRun does.
std::unique_ptr<WatchedRun> watched_run(const Scene& scene, std::uint64_t seed);

}  // namespace clatter
