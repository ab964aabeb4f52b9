#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <memory>
#include <optional>
#include <vector>

#include "engine/dynamics/run_state.h"
#include "engine/live/command.h"
#include "engine/live/frame.h"
#include "engine/physics/state.h"

namespace clatter {

/// Usual memory of the record of a run, bytes.
inline constexpr std::size_t kRecordBytes = 256'000'000;

/// A collision of two particles in the past of a run.
struct PreviousCollision {
  double time = 0.0;  ///< settled_time() of the collision
  std::array<std::uint32_t, 2> partners = {};
};

/// A run of disks or spheres, and its frames. Frames and scene have the same types in two and three
/// dimensions.
class WatchedRun {
 public:
  virtual ~WatchedRun() = default;

  /// Simulation time.
  virtual double time() const = 0;
  /// Events since time 0.
  virtual const EventCounts& counts() const = 0;
  /// 2 for disks, 3 for spheres.
  virtual int dimension() const = 0;
  /// The scene with the present laws, without its changes.
  virtual const Scene& laws() const = 0;
  /// All particles at time(), in a sheared box without the velocity of the flow.
  virtual AnyState state() const = 0;

  /// A copy of the run at its present time, with the same past and the same changes. Its profiles
  /// and observables restart, it picks no particle, records no clicks and has no other future.
  /// Recorded states are shared.
  virtual std::unique_ptr<WatchedRun> copy() = 0;

  /// As Simulation::prepare.
  virtual bool prepare(const StopRequest& pause) = 0;
  /// As ScheduledRun::run_until.
  virtual bool run_until(double time, std::uint64_t collisions, std::uint64_t steps,
                         const StopRequest& pause = {}) = 0;
  /// As ScheduledRun::settle.
  virtual void settle() = 0;
  /// As ScheduledRun::change. In the past it begins another future: the user's changes after the
  /// present time are removed, those of the scene remain. The old future is kept for
  /// exchange_futures(), as long as there is memory for it.
  virtual void change(const std::vector<Override>& laws, double delay) = 0;
  /// As ScheduledRun::nudge, and in the past as change(). The nudge is after time 0 if there is a
  /// delay.
  virtual void nudge(const Nudge& nudge, double delay) = 0;
  /// As ScheduledRun::puff, and in the past as change(). The puff is after time 0 if there is a
  /// delay.
  virtual void puff(const Puff& puff, double delay) = 0;
  /// As ScheduledRun::reverse, and in the past as change(). It is after time 0 if there is a delay.
  virtual void reverse(double delay) = 0;
  /// As ScheduledRun::move_piston, and in the past as change(). The stroke is after time 0 if there
  /// is a delay.
  virtual void move_piston(double position, double duration, double delay) = 0;
  /// Replaces all changes of the run. `from` > 0 is the simulation time of the first difference.
  /// Another future begins there, and the old one is kept, as by change(). Goes to a state from
  /// which run_until() soon reaches the returned time, at which this future begins. Throws
  /// UserError if the run has no such time.
  virtual double replace_changes(std::vector<Change> changes, double from) = 0;
  /// Replaces the future after the last change in the past by the one before that change, and keeps
  /// the present one. Goes to a state from which run_until() soon reaches the returned time: the
  /// present time, or that of the change if it is earlier. Throws UserError if there is no other
  /// future.
  virtual double exchange_futures() = 0;
  /// Moves a change to another simulation time > 0, as by replace_changes(). Throws UserError if
  /// there is no such change after time 0, if strokes of the piston would overlap, or if a nudge
  /// would come before its particle.
  virtual double move_change(std::size_t number, double time) = 0;
  /// Latest simulation time that the run has reached.
  virtual double head() const = 0;
  /// Goes to a state at or before a simulation time between 0 and head(), from which run_until()
  /// soon reaches this time. The bits are those of the run so far. Averages, profiles and
  /// observables restart, unless the run is just before this time.
  virtual void go_back(double time) = 0;
  /// Searches the last collision of particles before the present state. A collision at the present
  /// time does not count. Returns false at a request to pause; the next call continues. Meanwhile
  /// and afterwards the run is elsewhere in its past, so that go_back() must follow.
  virtual bool search_back(const StopRequest& pause) = 0;
  /// The collision that search_back() has found; absent: there is none.
  virtual std::optional<PreviousCollision> previous_collision() const = 0;
  /// As ScheduledRun::show.
  virtual void show(const View& view) = 0;

  /// Selects the profile of frames from now on. An axis that the box lacks is x.
  virtual void show_profile(Profiled what, Axis axis) = 0;
  /// Begins or ends the record of clicks.
  virtual void listen(bool on) = 0;
  /// The clicks since the last call, at most kMostClicks. Empty unless they are recorded.
  virtual std::vector<Click> take_clicks() = 0;
  /// Selects the particle whose collisions frames contain from now on. Absent, or a number that is
  /// too large: none.
  virtual void pick(std::optional<std::uint32_t> particle) = 0;
  /// Fills in the frame's snapshot, sums and scene; with `halted` also the state hash. The next
  /// collision of the picked particle is searched for some milliseconds.
  virtual void fill(Frame& frame, bool halted) = 0;
  /// Whether fill() may yet find the next collision of the picked particle, if it is called again.
  virtual bool looks_ahead() const = 0;
  /// The particles that collided last, if any have.
  virtual const std::optional<std::array<std::uint32_t, 2>>& partners() const = 0;
};

/// The run of a scene and a seed, at time 0. Its record of past states has at most `record_bytes`,
/// see RunRecord. Throws UserError if the machine has not enough memory.
std::unique_ptr<WatchedRun> watched_run(const Scene& scene, std::uint64_t seed,
                                        std::size_t record_bytes = kRecordBytes);
/// The same from the start state of the scene, made before by a StartMaker. prepare() must complete
/// before it runs.
std::unique_ptr<WatchedRun> watched_run(const Scene& scene, std::uint64_t seed, AnyState start,
                                        std::size_t record_bytes = kRecordBytes);

}  // namespace clatter
