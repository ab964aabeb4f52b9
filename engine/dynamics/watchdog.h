#pragma once

#include <cstddef>
#include <cstdint>
#include <deque>
#include <map>
#include <utility>
#include <vector>

#include "engine/dynamics/event.h"

// Inelastic collapse is detected by the Watchdog. It compares the time of many collisions with the
// mean time between a particle's collisions, and ends the run with a PhysicalStop. It does not
// change the run; Simulation::save() gives the state there, as at any other time.

namespace clatter {

/// Collisions of one pair within 10^-6 mean collision times that are a collapse.
inline constexpr std::uint64_t kMaxPerPair = 10'000;
/// The same for particles that seem to have no room.
inline constexpr std::uint64_t kFewPerPair = 200;

/// What a watchdog has seen so far. Times are on the moving base.
struct WatchdogState {
  std::uint64_t most_per_pair = kMaxPerPair;  ///< collisions of one pair that are a collapse
  std::uint64_t look_interval = 0;            ///< collisions between the last check and the next
  std::uint64_t until_look = 0;               ///< collisions before the next check
  double look_start = 0.0;

  // The current window, and the mean times of earlier windows.
  double window_start = 0.0;
  std::uint64_t collisions = 0;
  std::uint64_t participations = 0;  ///< a pair collision counts twice
  double longest_early = 0.0;        ///< longest mean time at the checks of the first window
  std::deque<double> means = {};

  // The suspected collapse: its start, and the collisions in it.
  bool suspicious = false;
  double still_since = 0.0;
  double still_mean = 0.0;
  std::uint64_t still_collisions = 0;
  std::map<std::pair<std::uint32_t, std::uint32_t>, std::uint64_t> pairs = {};
};

/// Visits all members, in order, for checkpoints.
template <class Archive>
void visit(Archive& io, WatchdogState& state) {
  auto& [most_per_pair, look_interval, until_look, look_start, window_start, collisions,
         participations, longest_early, means, suspicious, still_since, still_mean,
         still_collisions, pairs] = state;
  io(most_per_pair, look_interval, until_look, look_start, window_start, collisions, participations,
     longest_early, means, suspicious, still_since, still_mean, still_collisions);
  std::vector<std::uint64_t> numbers;  // three for each pair
  for (const auto& [pair, count] : pairs) {
    numbers.insert(numbers.end(), {pair.first, pair.second, count});
  }
  io(numbers);
  io.require(until_look > 0 && until_look <= look_interval && numbers.size() % 3 == 0);
  pairs.clear();
  for (std::size_t k = 0; k + 2 < numbers.size(); k += 3) {
    pairs[{static_cast<std::uint32_t>(numbers[k]), static_cast<std::uint32_t>(numbers[k + 1])}] =
        numbers[k + 2];
  }
}

/// Detects runs in which collisions continue but time does not advance: inelastic collapse, grains
/// that come to rest, speeds that diverge. It compares the time of many collisions with the mean
/// time between a particle's collisions, so it needs no unit. It does not change the run.
class Watchdog {
 public:
  /// Watches a run of so many particles from a time on the moving base. A continued run passes its
  /// known mean collision time.
  Watchdog(std::size_t particles, double time, double mean_collision_time = 0.0,
           std::uint64_t most_per_pair = kMaxPerPair);
  /// Continues to watch a run of so many particles.
  Watchdog(std::size_t particles, const WatchdogState& state);

  /// Records a particle's collision with a partner: as Event::partner. Returns true at a
  /// collapse: 1000 N collisions, or `most_per_pair` of one pair, within 10^-6 mean collision
  /// times.
  bool sees_collapse(double time, std::uint32_t particle, std::uint32_t partner) {
    state_.participations += partner < kPiece ? 2 : 1;
    if (state_.suspicious) ++state_.pairs[{particle, partner}];
    return --state_.until_look == 0 && look(time);
  }

  /// All times on the base have become smaller by `shift`.
  void on_base_moved(double shift);

  /// The pair with the most collisions during the collapse, as in sees_collapse.
  std::pair<std::uint32_t, std::uint32_t> busiest_pair() const;
  /// Mean time between a particle's collisions with particles and walls, outside of a collapse. The
  /// longest mean of recent windows; 0: not known yet.
  double mean_collision_time() const {
    return state_.suspicious ? state_.still_mean : longest_known_mean();
  }
  /// What it has seen, for a checkpoint.
  const WatchdogState& state() const { return state_; }

 private:
  bool look(double time);
  double mean_of_window(double time) const;
  double longest_known_mean() const;
  bool too_many() const;

  double particles_;
  std::uint64_t window_;            // collisions over which a mean time is taken
  std::uint64_t longest_interval_;  // collisions between later checks
  WatchdogState state_;
};

}  // namespace clatter
