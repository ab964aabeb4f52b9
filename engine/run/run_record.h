#pragma once

#include <cstddef>
#include <cstdint>
#include <memory>
#include <vector>

#include "engine/dynamics/run_state.h"
#include "engine/picture/rotations.h"
#include "engine/run/tally.h"
#include "engine/scene/scene.h"

// Time travel. The window's run keeps a RunRecord: a SavedState after every so much work of the
// engine, and where a change of laws replaces a future. At the limit of its memory the record
// removes every second state. A jump continues from the nearest state before its time and replays
// the rest with its changes, so it has the bits of the first pass. Commands wait meanwhile, and a frame follows at the end. A state has
// the laws at its time; the Schedule from there has the later changes. The head is the latest time
// of the run, and looks into the past leave it. A change in the past ends the future there: states
// and changes after it become the other future, which exchange_futures swaps back. To play
// backwards, Rewinder replays stretches of the run forwards and keeps their frames. While it shows
// one stretch in reverse, it makes the stretch before. A state includes what the watchdog of a
// collapse has seen, so a replay stops where the run did.

namespace clatter {

/// Work of the engine for these events, in events of one particle. A kick of bulk driving is an
/// event of every particle.
inline std::uint64_t work_of(const EventCounts& counts, std::size_t particles) {
  return counts.collisions() + counts.cell_crossings + counts.stale + counts.kicks * particles;
}

/// A state of a run between two events. With the later changes of the scene it determines the
/// future of the run.
template <int D>
struct SavedState {
  double time = 0.0;  ///< simulation time, all events up to it are processed
  RunState<D> run;
  std::shared_ptr<const Scene> laws;   ///< at `time`, without changes and start state
  double changed_until = 0.0;          ///< `laws` have all changes up to and at this time
  std::vector<Rotation<D>> rotations;  ///< [N] of the view; empty: no spins
  Tally tally;                         ///< from the run's start to `time`
  bool stopped = false;                ///< whether the run stopped here by itself

  /// Size in memory, without the laws, which many states share.
  std::size_t bytes() const;
  /// work_of() all events from the run's start to this state.
  std::uint64_t work() const { return work_of(run.counts, run.flights.size()); }
};

/// The states that a run keeps to show its past: a state at every so much work of the engine. At
/// the limit of its memory the record removes every second state, so that the distances between
/// states double. The first and the last state remain, and states where the run stopped. Copies of
/// a record share its states, and each counts them as its own.
template <int D>
class RunRecord {
 public:
  /// States in order of time.
  using States = std::vector<std::shared_ptr<const SavedState<D>>>;

  /// A record with states of at most `budget` bytes in all, except for those that remain.
  explicit RunRecord(std::size_t budget) : budget_(budget) {}

  /// Whether the run has done so much work since the last state that it needs another one.
  bool due(std::uint64_t work) const;
  /// Adds a state at the end. It replaces a last state of the same time.
  void add(SavedState<D> state);
  /// Removes all states from a time on, and returns them. The record may be empty afterwards.
  States cut(double time);
  /// Adds the result of cut() again.
  void append(const States& states);

  /// The last state at or before a time; the first state if there is none. Requires a state.
  const SavedState<D>& before(double time) const;
  /// The first state after a time, or at this time after so many collisions; nullptr: none.
  const SavedState<D>* after(double time, std::uint64_t collisions) const;
  /// The times of all states where the run stopped by itself.
  std::vector<double> stops() const;
  /// Approximate work between two successive states; some are closer.
  std::uint64_t spacing() const { return spacing_; }
  /// Size of all states in memory.
  std::size_t bytes() const { return bytes_; }

 private:
  void push(std::shared_ptr<const SavedState<D>> state);
  void thin_out();

  std::size_t budget_;
  std::size_t bytes_ = 0;
  std::uint64_t spacing_ = 0;  // set by the first state
  States states_;
};

extern template struct SavedState<2>;
extern template struct SavedState<3>;
extern template class RunRecord<2>;
extern template class RunRecord<3>;

}  // namespace clatter
