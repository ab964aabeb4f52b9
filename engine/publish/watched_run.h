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

/// A run of disks or spheres, and its frames. Frames and scene have the same types in two and three
/// dimensions.
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
  virtual void change(const std::vector<Override>& laws, double delay) = 0;
  /// As ScheduledRun::show.
  virtual void show(const View& view) = 0;

  /// Selects the profile of frames from now on. An axis that the box lacks is x.
  virtual void show_profile(Profiled what, Axis axis) = 0;
  /// Selects the particle whose collisions frames contain from now on. Absent, or a number that is
  /// too large: none.
  virtual void pick(std::optional<std::uint32_t> particle) = 0;
  /// Fills in the frame's snapshot, sums and scene; with `halted` also the state hash.
  virtual void tell(Frame& frame, bool halted) = 0;
  /// The particles that collided last, if any have.
  virtual const std::optional<std::array<std::uint32_t, 2>>& partners() const = 0;
};

/// The run of a scene and a seed, at time 0. Throws UserError if the machine has not enough memory.
std::unique_ptr<WatchedRun> watched_run(const Scene& scene, std::uint64_t seed);
/// The same from the start state of the scene, made before by a StartMaker.
std::unique_ptr<WatchedRun> watched_run(const Scene& scene, std::uint64_t seed, AnyState start);

}  // namespace clatter
