#pragma once

#include <cstdint>
#include <functional>
#include <list>
#include <memory>
#include <optional>
#include <utility>
#include <vector>

#include "engine/dynamics/boundary.h"
#include "engine/dynamics/clock.h"
#include "engine/dynamics/event_loop.h"
#include "engine/dynamics/foresight.h"
#include "engine/dynamics/observer.h"
#include "engine/dynamics/regular_times.h"
#include "engine/dynamics/run_state.h"
#include "engine/laws/model.h"
#include "engine/physics/state.h"
#include "engine/stop_request.h"

namespace clatter {

/// Event-driven simulation of particles in a box. A particle's stored state changes only in its own
/// physical events, and every contact time is a function of two stored states. So the same model
/// and start give the same bits, independent of observers and halts.
template <int D>
class Simulation {
 public:
  /// Starts at simulation time `start_time`. Throws PhysicalStop if particles of the state overlap
  /// each other or a wall, or are outside of the box. Throws Interrupted.
  Simulation(const Model<D>& model, State<D> state, double start_time = 0.0,
             const StopRequest& stop = {});
  /// Continues a saved run under the laws of `model`. Under the same laws the result has the same
  /// bits as the uninterrupted run. If the interval of kicks differs, kicks are counted from now.
  /// A wall whose frequency differs continues at its place, and one that begins to move has its
  /// phase now. Throws PhysicalStop if a wall now overlaps a particle. Throws Interrupted.
  Simulation(const Model<D>& model, RunState<D> saved, const StopRequest& stop = {});
  /// Starts as above, but prepare() must complete before deepest_overlap(). run_until() completes
  /// it.
  struct InParts {};
  Simulation(InParts, const Model<D>& model, State<D> state, double start_time = 0.0);
  /// Continues as above, in the same way.
  Simulation(InParts, const Model<D>& model, RunState<D> saved);
  Simulation(const Simulation&) = delete;
  Simulation& operator=(const Simulation&) = delete;

  /// Continues from another saved run under other laws, as a new simulation would. prepare() must
  /// complete, as after the constructors InParts. Observers and timers remain and have no report of
  /// it. Their owners must replace those that depend on the former time or particles.
  void restart(const Model<D>& model, RunState<D> saved);
  /// Changes the laws now, in one pass over the particles. If flights do not continue, as under
  /// another gravity or motion of a wall, all events are planned again. A changed interval of kicks
  /// and changed walls: see above. All events up to now must have been processed, as after
  /// run_until(). Throws PhysicalStop if a wall would overlap a particle; nothing then has changed.
  void set_laws(const Model<D>& model);
  /// Particles enter at rest at these positions, with the highest numbers. `grains` says what they
  /// are in a mixture, and is empty otherwise. Throws PhysicalStop if one overlaps another particle
  /// or a wall; the run then cannot continue.
  void add_particles(const std::vector<Vec<D>>& positions, const std::vector<Grain>& grains = {});

  /// Prepares the particles in parts for the run. Returns false at a request to pause, and true
  /// once all is done. Throws PhysicalStop as the constructors do.
  bool prepare(const StopRequest& pause);
  /// Uses up to so many threads from now on, if runs_in_tiles() and, for a watched gas,
  /// watched_runs_in_tiles(). The run has the same bits with any number of threads.
  void use_threads(int threads);
  /// The same for a gas of any size, with these sizes of its tiles.
  void use_threads(int threads, const TileSizes& sizes);
  /// The tiles; null: the gas runs as a whole on one thread.
  const Foresight<D>* foresight() const { return foresight_.get(); }
  /// Number of the tiles that run the gas now; 0: it runs as a whole.
  std::size_t tiles() const { return in_tiles_ && foresight_ ? foresight_->tiles() : 0; }

  /// Processes every event up to and at a simulation time, timers included, and returns true. Halts
  /// earlier and returns false once the run has had `collisions` with particles and walls, or
  /// `steps` of any kind (EventCounts::steps), since its start. A stop request halts it
  /// within a thousand steps or a window of tiles, and before the next timer or kick. Throws
  /// PhysicalStop at inelastic collapse or if speeds diverge; the state then is valid, at the last
  /// collision.
  bool run_until(double time, std::uint64_t collisions = kNoLimit, std::uint64_t steps = kNoLimit,
                 const StopRequest& stop_request = {});

  /// Calls action(time) at start, start + interval, start + 2 interval, ... when run_until()
  /// reaches these times, after the physical events and kicks of the same time. interval = 0: once.
  /// A continued run skips the first `done` times. `owner` names the timer for end_timers().
  void every(double start, double interval, std::function<void(double)> action,
             std::uint64_t done = 0, const void* owner = nullptr);
  /// Ends all timers of an owner. An action must not end its own timer.
  void end_timers(const void* owner);
  /// Whether the next of these times should have been long ago. A run would catch up with all that
  /// are missing.
  bool is_overdue(double start, double interval, std::uint64_t done) const;
  /// Throws PhysicalStop if a nudge would make a particle too fast.
  void check(const Nudge& nudge) const { loop_.velocities_after(nudge); }
  /// Changes velocities now. All events up to now must have been processed, as after run_until().
  /// Throws PhysicalStop if a particle would be too fast; the state then is unchanged.
  void nudge(const Nudge& nudge);
  /// Changes the signs of all velocities and spins now, as at a nudge.
  void reverse();
  /// Gives the particles of a puff, which are at rest, their velocities now. As at a nudge, all
  /// events up to now must have been processed.
  void start_puff(const std::vector<NewVelocity<D>>& velocities);
  /// Counts a change of laws of the scene, see EventCounts.
  void count_law_change() { loop_.count_law_change(); }
  /// Moves the rest position of the right wall, a piston, from its present place to `position` on
  /// the x axis, at constant velocity from `start`, the time now, to `end`. All events up to now
  /// must have been processed.
  void move_piston(double position, double start, double end);
  /// The state that determines the run's future, together with the model and the timers.
  RunState<D> save() const;
  /// Reports every event from now on to an observer, which must outlive the simulation or be
  /// removed, see Observation.
  void add_observer(Observer<D>& observer) { loop_.add_observer(observer); }
  /// Reports nothing to an observer from now on.
  void remove_observer(const Observer<D>& observer) { loop_.remove_observer(observer); }

  /// Simulation time up to which events have been processed.
  double time() const { return clock_.absolute(base_time()); }
  /// The same on the moving base, as observers see it.
  double base_time() const { return loop_.now(); }
  /// [N] positions of all particles at time(), wrapped into the box, in original order.
  std::vector<Vec<D>> positions() const;
  /// All particles evaluated at time(), wrapped into the box; nothing is advanced.
  State<D> state() const;
  /// Hash of state(), in original order: equal for equal runs.
  std::uint64_t state_hash() const;
  /// Whether particles have sizes and masses of their own.
  bool is_mixture() const { return !loop_.grains().empty(); }
  /// What a particle is.
  const Grain& grain(std::uint32_t number) const { return loop_.grain(number); }
  /// Calls visit(flight, mass) for each particle. The mass is a double or a UnitMass.
  template <class Visit>
  void for_masses(const Visit& visit) const {
    if (is_mixture()) {
      std::size_t i = 0;
      for (const Particle<D>& particle : particles()) {
        visit(particle.flight, loop_.grains()[i++].mass);
      }
    } else {
      for (const Particle<D>& particle : particles()) visit(particle.flight, UnitMass());
    }
  }
  /// Mass of all particles.
  double mass() const;
  /// Kinetic energy of all particles' centres at time().
  double kinetic_energy() const;
  /// T = (1/DN) sum m v^2 at time(); 0 without particles.
  double temperature() const;
  /// Kinetic energy of all spins, sum of I omega^2 / 2.
  double spin_energy() const;
  /// The box and its images at time().
  Domain<D> domain() const { return domain_at(base_time()); }
  /// The same at a time on the base.
  Domain<D> domain_at(double time) const { return boundary_.domain().at(time); }
  /// The velocity of a flight at a time on the base, in a sheared box without that of the flow.
  [[gnu::always_inline]] Vec<D> peculiar_at(const Flight<D>& flight, double time) const {
    const Vec<D> velocity = flight.velocity_at(time, model_.gravity);
    if (!model_.shear_rate) return velocity;
    return boundary_.domain().peculiar(flight.at(time, model_.gravity), velocity);
  }
  /// The acceleration of this velocity: gravity, or -G v_y along x (theory 14.1).
  Vec<D> peculiar_acceleration(const Flight<D>& flight) const {
    if (!model_.shear_rate) return model_.gravity;
    return -*model_.shear_rate * flight.v[1] * Vec<D>::Unit(0);
  }
  /// Displacement, velocity and acceleration of a wall at time(), from its rest position along its
  /// inward normal.
  WallState wall(int side) const { return boundary_.wall(side, base_time()); }
  /// Displacement of the piston's rest position from the end of the box at time().
  double piston_travel() const {
    return boundary_.piston() ? boundary_.piston()->travel(time()) : 0.0;
  }
  /// The flight of the free piston; null: there is none.
  const PistonFlight* free_piston() const { return loop_.piston(); }
  /// Deepest overlap of two particles, or of a particle and a wall, at time(), as a share of the
  /// diameter; 0: none. Checks all particles. Throws Interrupted.
  double deepest_overlap(const StopRequest& stop = {}) const;

  /// The laws of the run.
  const Model<D>& model() const { return model_; }
  /// [N] stored states, in original order; each since the particle's last physical event.
  const ParticleArray<D>& particles() const { return loop_.particles(); }
  /// [N] angular velocities, in original order; empty without spins.
  const LargeArray<Spin<D>>& spins() const { return loop_.spins(); }
  /// Events since the start.
  const EventCounts& counts() const { return loop_.counts(); }
  /// Extremes of the run's checks since the start.
  const RunChecks& checks() const { return loop_.checks(); }

 private:
  struct Timer {
    RegularTimes times;
    std::uint64_t count;  // times it has fired
    std::function<void(double)> action;
    const void* owner;  // null: none

    double next() const { return times.of(count); }
  };

  struct Preparation {
    RunState<D> saved;  // the start, without its particles
    typename EventLoop<D>::Preparation loop;
  };

  RunState<D> save_without_particles() const;
  void set_kicks();
  void make_tiles();
  Timer* due_timer(double stop);
  void fire(Timer& timer);
  bool kick_is_due(double stop) const;
  double next_kick() const;
  void move_base();
  bool compresses() const;
  Heat heat() const;
  void allow_speed(double speed);
  void set_velocities(const std::vector<NewVelocity<D>>& velocities,
                      std::uint64_t EventCounts::*count);
  double bearable_overlap() const;
  void look_anew();
  void look_for_room(double elapsed, std::uint64_t collisions);
  void attend_to(typename EventLoop<D>::Halt halt);
  void choose_way();
  void leave_tiles();
  typename EventLoop<D>::Halt advance(double stop, std::uint64_t collisions, std::uint64_t steps,
                                      const StopRequest& stop_request);
  bool advance_window(double stop, std::uint64_t collisions, std::uint64_t steps,
                      const StopRequest& stop_request);
  typename EventLoop<D>::Halt follow_foresight(double stop, std::uint64_t collisions,
                                               std::uint64_t steps,
                                               const StopRequest& stop_request);

  Model<D> model_;
  Clock clock_;
  Boundary<D> boundary_;
  double start_speed_ = 0.0;      // see RunState
  RegularTimes kick_times_{0.0};  // the first is the time from which kicks are counted
  std::uint64_t kicks_since_origin_ = 0;
  std::list<Timer> timers_;  // keep their addresses while an action adds timers
  EventLoop<D> loop_;
  std::unique_ptr<Preparation> preparation_;  // null: complete
  std::unique_ptr<Foresight<D>> foresight_;   // null: one thread, or a small gas
  int threads_ = 1;                           // of foresight_
  TileSizes tile_sizes_;
  bool in_tiles_ = false;          // whether foresight_ finds the events now
  int failures_ = 0;               // bases in succession on which tiles had no certificate
  int until_tried_ = 0;            // moves of the base before tiles are tried again
  bool watched_in_tiles_ = false;  // whether tiles also run a gas that is watched
  bool way_is_open_ = false;       // whether choose_way() is due
  double looked_for_ = 0.0;        // time and collisions since the last look for room
  std::uint64_t looked_at_ = 0;
  bool crowded_ = false;  // whether the watchdog looks for particles without room
};

/// Keeps an observer at a simulation from now on, until the end of its own life. The simulation
/// must outlive it.
template <int D>
class Observation {
 public:
  /// Adds the observer to the simulation.
  Observation(Simulation<D>& simulation, Observer<D>& observer)
      : simulation_(simulation), observer_(observer) {
    simulation.add_observer(observer);
  }
  ~Observation() { simulation_.remove_observer(observer_); }
  Observation(const Observation&) = delete;
  Observation& operator=(const Observation&) = delete;

 private:
  Simulation<D>& simulation_;
  Observer<D>& observer_;
};

/// Timers of a simulation that end with this object. The simulation must outlive it.
template <int D>
class Timers {
 public:
  /// No timers yet.
  explicit Timers(Simulation<D>& simulation) : simulation_(simulation) {}
  ~Timers() { simulation_.end_timers(this); }
  Timers(const Timers&) = delete;
  Timers& operator=(const Timers&) = delete;

  /// Adds a timer, see Simulation::every.
  void every(double start, double interval, std::function<void(double)> action,
             std::uint64_t done = 0) {
    simulation_.every(start, interval, std::move(action), done, this);
  }

 private:
  Simulation<D>& simulation_;
};

extern template class Simulation<2>;
extern template class Simulation<3>;

}  // namespace clatter
