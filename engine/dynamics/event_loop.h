#pragma once

#include <algorithm>
#include <cstdint>
#include <limits>
#include <optional>
#include <utility>
#include <vector>

#include "engine/dynamics/boundary.h"
#include "engine/dynamics/collapse.h"
#include "engine/dynamics/collision_rules.h"
#include "engine/dynamics/event_queue.h"
#include "engine/dynamics/grain_array.h"
#include "engine/dynamics/large_array.h"
#include "engine/dynamics/neighbourhood.h"
#include "engine/dynamics/observer.h"
#include "engine/dynamics/particle_states.h"
#include "engine/dynamics/pausing_loop.h"
#include "engine/dynamics/piston_motion.h"
#include "engine/dynamics/prediction.h"
#include "engine/dynamics/prefetch.h"
#include "engine/dynamics/run_state.h"
#include "engine/dynamics/tile_record.h"
#include "engine/dynamics/watchdog.h"
#include "engine/laws/acts.h"
#include "engine/laws/model.h"
#include "engine/stop_request.h"

namespace clatter {

/// Least number of physical events between two moves of the base.
inline constexpr std::uint64_t kMinEventsPerBase = 64;

/// The velocity of a particle after a nudge or puff, in a sheared box without that of the flow.
template <int D>
struct NewVelocity {
  std::uint32_t particle = 0;
  Vec<D> velocity;
};

/// Particles, their plans, and the calendar of their events, which it processes in order. Times are
/// on a base that it moves.
template <int D>
class EventLoop {
 public:
  /// Reason why advance() returned.
  enum class Halt { Time, Limit, BaseDue, Diverges, StandsStill };

  /// Takes the particles of a saved run; afterwards `saved` has none. `model` and `boundary` must
  /// outlive the loop.
  EventLoop(const Model<D>& model, const Boundary<D>& boundary, RunState<D>&& saved);
  /// Continues from another saved run under the present laws, with the same observers. Nothing is
  /// prepared.
  void restart(RunState<D>&& saved);
  /// An empty loop for tiles of the gas of another loop, see load().
  EventLoop(const Model<D>& model, const Boundary<D>& boundary);
  EventLoop(const EventLoop&) = delete;
  EventLoop& operator=(const EventLoop&) = delete;

  /// Takes the particles of `record` from the gas of another loop, at the time `start` on its base,
  /// and plans their events up to the time `end`. Orders them by cells. The run from there adds to
  /// the record. A particle that leaves the subdomain has no more events, and its flight gets a
  /// number that no flight of the gas has.
  /// `grains` are those of the other loop, `sizes` their grid_sizes().
  void load(const ParticleStates<D>& gas, const GrainArray& grains, const GridSizes& sizes,
            const Subdomain<D>& subdomain, TileRecord<D>& record, double start, double end);

  /// Work of place(), compare() and plan() that has been done.
  struct Preparation {
    PausingLoop placing, comparing, planning;
    std::optional<PausingLoop> fitted_placing;  ///< into cells that fit the crowding, if others do
    bool fitted = false;                        ///< whether the crowding is known
    double deepest_overlap = 0.0;               ///< as of Simulation::deepest_overlap
    FixtureImages<D> fixtures = FixtureImages<D>();  ///< while particles are compared
  };
  /// Puts all particles into cells. Returns false at a request to pause. Throws PhysicalStop if a
  /// particle is outside of the box.
  bool place(Preparation& work, const StopRequest& pause);
  /// Finds the deepest overlap of particles in cells. Returns false at a request to pause.
  bool compare(Preparation& work, const StopRequest& pause) const;
  /// Plans the next event of every particle. Returns false at a request to pause.
  bool plan(Preparation& work, const StopRequest& pause);
  /// Processes events up to and at a time on the base. Halts earlier once the counts have reached
  /// so many collisions or steps, or when the base is due to move. Also halts at a particle whose
  /// speed diverges and at inelastic collapse.
  Halt advance(double stop, std::uint64_t collisions, std::uint64_t steps);
  /// Whether the foreseen event begins with the current flights of its particles.
  bool is_next(const ForeseenEvent<D>& foreseen) const;
  /// Processes a foreseen event instead of a planned one. Returns Limit if nothing needs attention.
  Halt process_foreseen(const ForeseenEvent<D>& foreseen);
  /// Prefetches the particles of an event.
  void prefetch_particles(const Event& event) const {
    prefetch(gas_.particles[event.particle]);
    if (event.partner < kPiece) prefetch(gas_.particles[event.partner]);
  }
  /// Adds the current ways of all particles to the record of a tile.
  void note_all_strays();
  /// Whether all events are needed in order: by an observer, the watchdog or the speed limit.
  bool is_watched() const {
    return !observers_.empty() || watchdog_.has_value() || fastest_ < kNever;
  }
  /// Exchanges all particles' data with their data after a number of further collisions.
  void adopt(ParticleStates<D>& later, double time, std::uint64_t pair_collisions,
             std::uint64_t wall_collisions, const RunChecks& checks);
  /// Frees the memory of cells and plans.
  void drop_plans();
  /// Sets the time to a later one before the next event.
  void skip_to(double time) { now_ = std::max(now_, time); }
  /// Bulk driving kicks all particles. Then the base must move.
  void kick();
  /// The particles that a nudge changes, and their new velocities, in original order. Throws
  /// PhysicalStop if one is too fast.
  std::vector<NewVelocity<D>> velocities_after(const Nudge& nudge) const;
  /// Sets velocities as the result of a nudge or puff, and counts it. Then the base must move.
  void nudge(const std::vector<NewVelocity<D>>& velocities, std::uint64_t EventCounts::*count);
  /// Changes the signs of all velocities and spins, and counts a nudge. Then the base must move.
  void reverse();
  /// Notes that the piston begins a stroke. Then the base must move.
  void begin_stroke();
  /// Lets the watchdog begin anew, with this mean time between a particle's collisions. Few
  /// collisions of one pair are a collapse then.
  void watch_closely(double mean_collision_time) {
    watchdog_.emplace(gas_.particles.size(), now_, mean_collision_time, kFewPerPair);
  }
  /// Counts a change of laws.
  void count_law_change() { ++counts_.law_changes; }
  /// The speed of the fastest particle now.
  double fastest_now() const;
  /// Raises the speed above which speeds diverge to that of a run with this speed at its start.
  void allow_start_speed(double speed) {
    fastest_ = fastest_speed<D>(model_, speed, counts_.strokes > 0);
  }
  /// Whether the base must move before the next event: its number of events is reached, or a
  /// particle has become too fast for the precision of times.
  bool base_due() const { return until_base_moves_ == 0; }
  /// Physical events until the base moves.
  std::uint64_t until_base_moves() const { return until_base_moves_; }
  /// Makes the current time the base. The boundary has already moved its base. Plans are invalid
  /// until plan_again().
  void move_base();
  /// Plans the next events of all particles, in cells that fit the crowding.
  void plan_again();
  /// Takes the changed laws of the model, and restarts the watchdog. `start_speed` is that of
  /// RunState. Unless `keeps_flights`, all flights are replaced by flights from now on; `former`
  /// has the laws of the former ones. Plans are then invalid until plan_again().
  void set_laws(bool keeps_flights, const RunState<D>& former, double start_speed);
  /// Deepest overlap of a particle with the walls of `boundary` now, as a share of the diameter; 0:
  /// none.
  double deepest_overlap_with(const Boundary<D>& boundary) const;
  /// A particle and the number of a fixture that overlap by more than `bearable` diameters now;
  /// absent: none do.
  std::optional<std::pair<std::uint32_t, std::size_t>> overlapping(const FixtureImages<D>& fixtures,
                                                                   double bearable) const;
  /// Reports every event from now on to an observer.
  void add_observer(Observer<D>& observer) { observers_.push_back(&observer); }
  /// Reports nothing to an observer from now on.
  void remove_observer(const Observer<D>& observer) { std::erase(observers_, &observer); }
  /// Calls report(observer) for each observer. A call may remove observers, which have no later
  /// call, and add others.
  template <class Report>
  void for_observers(const Report& report) const;
  /// Adds the particles, times, counts and checks to a saved run.
  void save_to(RunState<D>& saved) const;

  /// Time on the base up to which events have been processed.
  double now() const { return now_; }
  /// All particles.
  const ParticleStates<D>& gas() const { return gas_; }
  /// [N] see Simulation::particles.
  const ParticleArray<D>& particles() const { return gas_.particles; }
  /// What each particle is; empty: all are Model::grain().
  const GrainArray& grains() const { return grains_; }
  /// What a particle is.
  const Grain& grain(std::uint32_t number) const {
    if (grains_.empty()) return alike_;
    return grains_.kinds().empty() ? grains_[number] : grains_.kinds()[gas_.particles.kind(number)];
  }
  /// [N] see Simulation::spins.
  const LargeArray<Spin<D>>& spins() const { return gas_.spins; }
  /// Events since the start of the run.
  const EventCounts& counts() const { return counts_; }
  /// Extremes since the start of the run.
  const RunChecks& checks() const { return checks_; }
  /// The flight of the free piston; null: there is none.
  const PistonFlight* piston() const { return piston_ ? &piston_->flight() : nullptr; }
  /// Detects collapse; absent if the gas cannot collapse or diverge.
  const std::optional<Watchdog>& watchdog() const { return watchdog_; }

 private:
  struct Motion {
    Vec<D> r;  // of the centre
    Vec<D> v;
  };

  /// What a particle touches that is no particle.
  struct Surface {
    int side;               // the Side; WallCollision::kNoSide for a fixture or the piston
    std::uint32_t fixture;  // number in the model, without a side
    Vec<D> normal;          // towards the particle
    Vec<D> point;           // of a fixture that is touched, at its place in the scene
    bool at_centre = false;  // see WallCollision
  };

  void process(Event event);
  Halt after(const Event& event, bool collided);
  void retire(std::uint32_t number);
  void note_stray(std::uint32_t number, const Vec<D>& position);
  bool note(const Event& event, const IntVec<D>& image);
  void collide(std::uint32_t first, std::uint32_t second, const IntVec<D>& image);
  void hit(std::uint32_t number, std::uint32_t partner, const IntVec<D>& image);
  void hit_wall(std::uint32_t number, int side);
  void hit_fixture(std::uint32_t number, std::uint32_t piece, const IntVec<D>& image);
  [[gnu::always_inline]] inline void bounce(std::uint32_t number, const Motion& at,
                                            const Surface& surface, const Wall& law,
                                            const WallState& motion);
  [[gnu::always_inline]] inline Arrival<D> arrival_of(std::uint32_t number, const Vec<D>& velocity);
  [[gnu::always_inline]] inline void depart(std::uint32_t number, const Motion& at,
                                            const Surface& surface, const Departure<D>& departure,
                                            bool elastic);
  Halt process_piston();
  void meet_valve(std::uint32_t number, const Motion& at, const Vec<D>& place,
                  const typename PieceLists<D>::Owned& opening);
  void hit_piston(std::uint32_t number);
  void fly_piston(PistonChange::Cause cause, double place, double velocity);
  void gather_piston();
  void set_piston_laws(bool report, bool gather);
  bool within_contact_time(std::uint32_t number) const;
  bool is_too_fast(std::uint32_t number) const;
  [[gnu::always_inline]] inline bool is_fast(double velocity) const;
  void enter_next_cell(std::uint32_t number);
  void lay_with_flow();
  Halt advance_to(double stop, std::uint64_t collisions, std::uint64_t steps);
  [[gnu::always_inline]] inline Motion motion_now(std::uint32_t number);
  void carry_remainder(std::uint32_t number, Vec<D>& position);
  [[gnu::always_inline]] inline void renew_flight(std::uint32_t number, const Vec<D>& position,
                                                  const Vec<D>& velocity);
  [[gnu::always_inline]] inline void schedule(std::uint32_t particle);
  void put_into_cell(std::size_t number);
  double deepest_overlap_of(std::size_t number, const FixtureImages<D>& fixtures) const;
  double overlap_with_walls(const Boundary<D>& boundary, std::uint32_t number,
                            const Vec<D>& position) const;
  void begin_watch(double start_speed, double mean_collision_time,
                   const std::optional<WatchdogState>& watchdog);
  bool is_current(const Event& event) const;
  void prefetch_ahead();
  template <typename Visit>
  void visit_searches(const Event& event, const Visit& visit) const;
  Spin<D> spin(std::uint32_t number) const;
  void set_alike();
  void add_spin(std::uint32_t number, const Spin<D>& gain);

  const Model<D>& model_;
  const Boundary<D>& boundary_;
  Domain<D> domain_;  // with the offset at time 0 of the base
  double now_;        // on the base
  ParticleStates<D> gas_;
  GrainArray grains_;        // [N]; empty: all particles are alike
  Grain alike_;              // of each particle then
  Partners alike_partners_;  // of each two particles then
  LargeArray<Plan<D>> plans_;
  Neighbourhood<D> near_;
  Prediction<D> prediction_;
  EventQueue queue_;
  double latest_ = std::numeric_limits<double>::max();  // time of the last events in the queue
  std::uint64_t until_base_moves_;                      // physical events left
  double fastest_;                                      // speed limit, see fastest_speed()
  std::optional<Watchdog> watchdog_;  // absent if the gas cannot collapse or diverge
  std::int64_t prefetched_bucket_ = 0;
  std::optional<PistonMotion<D>> piston_;  // absent: there is none
  std::vector<Observer<D>*> observers_;
  TileRecord<D>* record_ = nullptr;  // of a tile; null for the whole gas
  Vec<D> lower_ = Vec<D>::Zero();    // corner of the tile's subdomain
  EventCounts counts_;
  RunChecks checks_;
};

template <int D>
template <class Report>
void EventLoop<D>::for_observers(const Report& report) const {
  const std::vector<Observer<D>*> present = observers_;
  for (Observer<D>* observer : present) {
    if (std::ranges::find(observers_, observer) != observers_.end()) report(*observer);
  }
}

template <int D>
void EventLoop<D>::schedule(std::uint32_t particle) {
  const Plan<D>& plan = plans_[particle];
  if (plan.time <= latest_) queue_.push({plan.time, particle, plan.partner});
  if (piston_) piston_->renew(particle, plan.cell);
}

extern template class EventLoop<2>;
extern template class EventLoop<3>;

}  // namespace clatter
