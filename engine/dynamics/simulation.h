#pragma once

#include <cstdint>
#include <deque>
#include <functional>
#include <vector>

#include "engine/dynamics/cell_grid.h"
#include "engine/dynamics/clock.h"
#include "engine/dynamics/disk.h"
#include "engine/dynamics/event_queue.h"
#include "engine/dynamics/large_array.h"
#include "engine/dynamics/model.h"
#include "engine/dynamics/observer.h"
#include "engine/dynamics/prediction.h"

namespace clatter {

/// How many events of each kind have happened.
struct EventCounts {
  std::uint64_t disk_disk = 0;
  std::uint64_t disk_wall = 0;
  std::uint64_t cell_crossings = 0;
  std::uint64_t stale = 0;  ///< predictions found out of date because the partner met another first

  /// Collisions with disks and with walls.
  std::uint64_t collisions() const { return disk_disk + disk_wall; }
};

/// What a run checks of itself at every event.
struct RunChecks {
  double deepest_overlap = 0.0;  ///< of colliding disks at contact, as a share of the diameter
  /// Largest time by which an event came before the one processed last: 0 but for the rounding with
  /// which a move of the base may exchange events that coincide.
  double clock_steps_back = 0.0;
};

/// Disks in a box, moved from collision to collision. A disk's stored state changes only in its own
/// physical events, and every contact time is a function of two stored states; so the same model
/// and start give the same bits however often and by whom the run is watched or halted.
template <int D>
class Simulation {
 public:
  /// Starts at simulation time `start_time`. Throws PhysicalStop where disks of the state overlap
  /// each other or a wall.
  Simulation(const Model<D>& model, const State<D>& state, double start_time = 0.0);
  Simulation(const Simulation&) = delete;
  Simulation& operator=(const Simulation&) = delete;

  /// Processes every event up to and at a simulation time, timers included, and returns true; or
  /// halts before, right after the collision, once `collisions` with disks and walls have happened
  /// since the start, and returns false.
  bool run_until(double time, std::uint64_t collisions = kNoLimit);

  /// Calls action(time) at start, start + interval, start + 2 interval, ... once run_until() gets
  /// there, after the physical events of the same time. interval = 0: once.
  void every(double start, double interval, std::function<void(double)> action);
  /// Tells an observer, which outlives the simulation, of every event from now on.
  void add_observer(Observer<D>& observer) { observers_.push_back(&observer); }

  /// Simulation time up to which events have been processed.
  double time() const { return clock_.absolute(now_); }
  /// The same on the moving base, as observers see it.
  double base_time() const { return now_; }
  /// All disks evaluated at time(), wrapped into the box; nothing is advanced.
  State<D> state() const;
  /// Hash of state(), in original order: equal for equal runs.
  std::uint64_t state_hash() const;
  /// Kinetic energy of all disks.
  double kinetic_energy() const;
  /// Deepest overlap of any two disks or of a disk and a wall at time(), as a share of the
  /// diameter; 0: none. Looks at all of them.
  double deepest_overlap() const;

  /// The laws of the run.
  const Model<D>& model() const { return model_; }
  /// [N] stored states, in original order; each since the disk's last physical event.
  const LargeArray<Disk<D>>& disks() const { return disks_; }
  /// Events since the start.
  const EventCounts& counts() const { return counts_; }
  /// What the run has checked of itself since the start.
  const RunChecks& checks() const { return checks_; }

  /// For run_until: however many collisions there are.
  static constexpr std::uint64_t kNoLimit = ~std::uint64_t{0};

 private:
  struct Timer {
    double start;
    double interval;
    std::uint64_t count;  // times it has fired
    std::function<void(double)> action;
  };

  /// Why advance() came back.
  enum class Halt { Time, Collisions, BaseMoved };

  Halt advance(double stop, std::uint64_t collisions);
  Timer* due_timer(double stop);
  void fire(Timer& timer);
  void process(const Event& event);
  void collide(std::uint32_t first, std::uint32_t second);
  void hit_wall(std::uint32_t number, int side);
  void enter_next_cell(std::uint32_t number);
  void renew_flight(Disk<D>& disk, const Vec<D>& position, const Vec<D>& velocity);
  void schedule(std::uint32_t disk);
  void plan_all();
  void move_base();
  void fetch_ahead();
  void report_collision(std::array<std::uint32_t, 2> disks, std::array<Vec<D>, 2> position,
                        const Vec<D>& separation, const Vec<D>& impulse,
                        std::array<Vec<D>, 2> velocity) const;
  Vec<D> velocity_after_wall(std::uint32_t number, int side) const;

  Model<D> model_;
  Clock clock_;
  double now_ = 0.0;  // on the clock's base
  LargeArray<Disk<D>> disks_;
  LargeArray<Plan<D>> plans_;
  CellGrid<D> grid_;
  Prediction<D> prediction_;
  EventQueue queue_;
  std::uint64_t until_base_moves_;  // physical events left
  std::uint64_t fetched_bucket_ = 0;
  std::vector<Observer<D>*> observers_;
  std::deque<Timer> timers_;  // stay where they are while an action adds others
  EventCounts counts_;
  RunChecks checks_;
};

extern template class Simulation<2>;

}  // namespace clatter
