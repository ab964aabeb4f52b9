#pragma once

#include <cstdint>
#include <memory>
#include <string>
#include <vector>

#include "engine/dynamics/simulation.h"
#include "engine/picture/snapshot.h"
#include "engine/picture/view_observers.h"
#include "engine/scene/schedule.h"

// Changes of laws happen at a given time, after its events: ScheduledRun calls
// Simulation::set_laws. A law that does not touch flights, as restitution or the temperature of a
// wall, costs one pass over the particles. Under another gravity or motion of a wall all flights
// begin at the change, and all events are planned again. Observers hear of a change before it, with
// the old flights, and after it (before_laws, on_laws). An Observation and Timers end with their
// owner. A Schedule turns the [[change]] tables of a scene into times and laws, for every command
// and for the window. The window records changes by hand; a replay gives the same bits. A Nudge of
// a change is an event of the simulation, after its laws. Observers see it as kicks of particles,
// so ledger, balances and averages continue. The base moves at it. The state counts the steps of
// all changes, so that a resumed run makes each of them once. The particles of a Puff enter at rest
// (Simulation::add_particles), and a nudge then sets their velocities. A stroke of the piston is an
// event of the same kind: the state keeps the last PistonStroke, which Boundary adds to the motion
// of the right wall. A contact is found in the frame of the stroke, or after its end. The box and
// its cells keep their size. The window's undo of a nudge, puff or stroke replaces the changes of
// the run by those without it (WatchedRun::replace_changes).

namespace clatter {

/// The simulation of a scene and a seed, at time 0. Throws UserError if the machine has not enough
/// memory. Throws Interrupted.
template <int D>
std::unique_ptr<Simulation<D>> simulation_of(const Scene& scene, std::uint64_t seed,
                                             const StopRequest& stop = {});

/// The time a few rounding errors after a time. All events that belong to the time are before it.
double settled_time(double time);

/// A simulation with the changes of its scene, and the observers of its view.
template <int D>
class ScheduledRun {
 public:
  /// Starts a run as the scene describes. Throws Interrupted.
  ScheduledRun(const Scene& scene, std::uint64_t seed, const StopRequest& stop = {});
  /// Starts a run as the scene describes, from its start state made before. prepare() must complete
  /// before it runs.
  ScheduledRun(const Scene& scene, std::uint64_t seed, State<D> start);
  /// Continues a saved run. The scene's changes up to its time are in force. Throws Interrupted.
  ScheduledRun(const Scene& scene, std::uint64_t seed, const RunState<D>& saved,
               const StopRequest& stop = {});

  ScheduledRun(ScheduledRun&&) = default;
  ScheduledRun& operator=(ScheduledRun&&) = delete;

  /// As Simulation::prepare.
  bool prepare(const StopRequest& pause) { return simulation_->prepare(pause); }
  /// As Simulation::use_threads, also for another number of particles to come.
  void use_threads(int threads);
  /// The simulation.
  Simulation<D>& simulation() { return *simulation_; }
  const Simulation<D>& simulation() const { return *simulation_; }  ///< the same
  /// The scene with the current laws, without its changes.
  const Scene& laws() const { return schedule_.laws(); }
  /// The scene with the current laws, and all its changes.
  Scene scene() const { return schedule_.scene(); }
  /// The same with the present number of particles. That of a start state from a file remains.
  Scene present_scene() const;
  /// Seed of every random number of the run.
  std::uint64_t seed() const { return seed_; }

  /// As Simulation::run_until, with the scene's changes up to and at `time`. Throws PhysicalStop
  /// also if the gas cannot continue under new laws; the old laws then remain.
  bool run_until(double time, std::uint64_t collisions = kNoLimit, std::uint64_t steps = kNoLimit,
                 const StopRequest& stop = {});
  /// Runs to settled_time() of the present time. Afterwards all events up to simulation().time()
  /// are processed, independent of the way in which the run was halted. At a PhysicalStop it halts
  /// silently; the next run_until() throws it.
  void settle();
  /// Settles, then changes laws at the simulation's time and adds the change to the scene's
  /// changes. Throws UserError or PhysicalStop if the change is impossible; the old laws then
  /// remain. First it runs for up to `delay`, to the time with the fewest digits in it, if no
  /// physical stop prevents it. While a moving wall with another stroke would overlap a particle,
  /// it runs on, for up to about a period of the wall.
  void change(const std::vector<Override>& laws, double delay = 0.0);
  /// The same where the run is, as by a [[change]] of the scene. To be called after run_until() has
  /// returned true or after settle().
  void change_here(const std::vector<Override>& laws);
  /// Nudges particles as change() changes laws, and adds the nudge to the scene's changes. Throws
  /// UserError or PhysicalStop if the nudge is impossible; nothing then changes.
  void nudge(const Nudge& nudge, double delay = 0.0);

  /// Adds as many particles of a puff as find room, as change() changes laws. Adds the puff with
  /// this number to the scene's changes. Throws UserError if none finds room or the puff is
  /// impossible, and PhysicalStop if one is too fast; nothing then changes.
  void puff(const Puff& puff, double delay = 0.0);
  /// Changes the signs of all velocities and spins, as change() changes laws, and adds this to the
  /// scene's changes.
  void reverse(double delay = 0.0);
  /// Moves the piston to a position in a duration, > 0, and adds the stroke to the scene's changes.
  /// The stroke begins at the end of those that are on their way, or within `delay`. Throws
  /// UserError if it is impossible; nothing then changes.
  void move_piston(double position, double duration, double delay = 0.0);

  /// Adds to later snapshots the averages, flights and angles that the view needs. Averages
  /// restart at each change of laws, and continue during a ramp. `exposure` >= 0 is the exposure
  /// time of a picture, in simulation time.
  void show(const View& view, double exposure = 0.0);
  /// The same, continued from the result of save_shown() at this time of a run with the same scene,
  /// view and exposure. An empty `saved` starts new averages.
  void show(const View& view, const std::string& saved, double exposure = 0.0);
  /// Current state of the view's observers, for a checkpoint; empty: none.
  std::string save_shown() const;
  /// Replaces the changes of the scene. Those up to the simulation's time have no effect. To be
  /// called after run_until() has returned true or after settle().
  void set_changes(std::vector<Change> changes);
  /// Continues from another state of the run. `scene` has the laws at that state and all changes,
  /// of which those after `changed_until` are to come. `rotations` are rotations() at that state.
  /// Averages and flights of the view restart. Owners of other observers must replace these, see
  /// Simulation::restart. run_until() completes the preparation of the particles.
  void return_to(const Scene& scene, double changed_until, const RunState<D>& state,
                 const std::vector<Rotation<D>>& rotations);
  /// [N] rotations of the particles that the view shows; empty: none.
  std::vector<Rotation<D>> rotations() const;
  /// The gas at the simulation's time.
  Snapshot snapshot();

 private:
  void halt_at(double time);
  void halt_within(double delay);
  void make(const Change& change);
  void advance(Schedule schedule);
  void enter(const Puff& puff);

  Schedule schedule_;
  std::uint64_t seed_;
  int threads_ = 1;
  std::unique_ptr<Simulation<D>> simulation_;
  View view_;
  double exposure_ = 0.0;
  std::unique_ptr<ViewObservers<D>> shown_;  // absent: no view
};

}  // namespace clatter
