#include "engine/dynamics/watchdog.h"

#include <algorithm>

namespace clatter {

static constexpr double kCollapseSpan = 1e-6;  // mean collision times
static constexpr std::uint64_t kMaxPerParticle = 1000;
static constexpr std::uint64_t kFirstLook = 64;  // collisions; later intervals double
static constexpr std::size_t kWindows =
    10;  // number of windows kept; their longest mean time counts

Watchdog::Watchdog(std::size_t particles, const WatchdogState& state)
    : particles_(static_cast<double>(particles)),
      window_(std::max<std::uint64_t>(1, kMaxPerParticle * particles)),
      longest_interval_(std::min(kMaxPerPair, window_)),
      state_(state) {}

Watchdog::Watchdog(std::size_t particles, double time, double mean_collision_time,
                   std::uint64_t most_per_pair)
    : Watchdog(particles, {.most_per_pair = most_per_pair,
                           .look_start = time,
                           .window_start = time,
                           .longest_early = mean_collision_time}) {
  state_.look_interval = state_.until_look = std::min(kFirstLook, longest_interval_);
}

void Watchdog::on_base_moved(double shift) {
  state_.look_start -= shift;
  state_.window_start -= shift;
  state_.still_since -= shift;
}

double Watchdog::mean_of_window(double time) const {
  return particles_ * (time - state_.window_start) / static_cast<double>(state_.participations);
}

double Watchdog::longest_known_mean() const {
  return state_.means.empty() ? state_.longest_early : std::ranges::max(state_.means);
}

// The first checks follow each other closely, so that a collapse soon after the start does not
// enter the mean time.
//
// Pairs are counted only after a first suspicion. A normal run then pays for one check every 10^4
// collisions.
bool Watchdog::look(double time) {
  const std::uint64_t seen = state_.look_interval;
  state_.look_interval = std::min(2 * seen, longest_interval_);
  state_.until_look = state_.look_interval;
  state_.collisions += seen;
  if (state_.means.empty())
    state_.longest_early = std::max(state_.longest_early, mean_of_window(time));
  if (state_.suspicious && time - state_.still_since > kCollapseSpan * state_.still_mean) {
    state_.suspicious = false;
    state_.pairs.clear();
  }
  if (state_.suspicious) {
    state_.still_collisions += seen;
  } else if (const double mean = std::max(mean_of_window(time), longest_known_mean());
             time - state_.look_start <= kCollapseSpan * mean) {
    state_.suspicious = true;
    state_.still_since = state_.look_start;
    state_.still_mean = mean;
    state_.still_collisions = 0;
  }
  state_.look_start = time;
  if (state_.collisions >= window_) {
    state_.means.push_back(state_.means.empty() ? state_.longest_early : mean_of_window(time));
    if (state_.means.size() > kWindows) state_.means.pop_front();
    state_.window_start = time;
    state_.collisions = state_.participations = 0;
  }
  return state_.suspicious && too_many();
}

bool Watchdog::too_many() const {
  return state_.still_collisions >= window_ ||
         std::ranges::any_of(
             state_.pairs, [this](const auto& pair) { return pair.second > state_.most_per_pair; });
}

std::pair<std::uint32_t, std::uint32_t> Watchdog::busiest_pair() const {
  const auto fewer = [](const auto& a, const auto& b) { return a.second < b.second; };
  return std::ranges::max_element(state_.pairs, fewer)->first;
}

}  // namespace clatter
