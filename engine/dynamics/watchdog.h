#pragma once

#include <cstddef>
#include <cstdint>
#include <deque>
#include <map>
#include <utility>

#include "engine/dynamics/event.h"

namespace clatter {

/// Detects runs in which collisions continue but time does not advance: inelastic collapse, grains
/// that come to rest, speeds that diverge. It compares the time of many collisions with the mean
/// time between a particle's collisions, so it needs no unit. It does not change the run.
class Watchdog {
 public:
  /// Watches a run of so many particles from a time on the moving base. A continued run passes its
  /// known mean collision time.
  Watchdog(std::size_t particles, double time, double mean_collision_time = 0.0);

  /// Records a particle's collision with a partner: a particle or kWall + side. Returns true at a
  /// collapse: 1000 N collisions, or 10^4 of one pair, within 10^-6 mean collision times.
  bool sees_collapse(double time, std::uint32_t particle, std::uint32_t partner) {
    participations_ += partner < kWall ? 2 : 1;
    if (suspicious_) ++pairs_[{particle, partner}];
    return --until_look_ == 0 && look(time);
  }

  /// All times on the base have become smaller by `shift`.
  void on_base_moved(double shift);

  /// The pair with the most collisions during the collapse, as in sees_collapse.
  std::pair<std::uint32_t, std::uint32_t> busiest_pair() const;
  /// Mean time between a particle's collisions with particles and walls, outside of a collapse. The
  /// longest mean of recent windows; 0: not known yet.
  double mean_collision_time() const { return suspicious_ ? still_mean_ : longest_known_mean(); }

 private:
  bool look(double time);
  double mean_of_window(double time) const;
  double longest_known_mean() const;
  bool too_many() const;

  double particles_;
  std::uint64_t window_;            // collisions over which a mean time is taken
  std::uint64_t longest_interval_;  // collisions between later checks
  std::uint64_t look_interval_;     // collisions between this check and the next
  std::uint64_t until_look_;
  double look_start_;

  // The current window, and the mean times of earlier windows.
  double window_start_;
  std::uint64_t collisions_ = 0;
  std::uint64_t participations_ = 0;  // a pair collision counts twice
  double longest_early_ = 0.0;        // longest mean time at the checks of the first window
  std::deque<double> means_;

  // The suspected collapse: its start, and the collisions in it.
  bool suspicious_ = false;
  double still_since_ = 0.0;
  double still_mean_ = 0.0;
  std::uint64_t still_collisions_ = 0;
  std::map<std::pair<std::uint32_t, std::uint32_t>, std::uint64_t> pairs_;
};

}  // namespace clatter
