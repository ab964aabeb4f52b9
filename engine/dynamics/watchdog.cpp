#include "engine/dynamics/watchdog.h"

#include <algorithm>

namespace clatter {

static constexpr double kCollapseSpan = 1e-6;  // mean collision times
static constexpr std::uint64_t kMaxPerParticle = 1000;
static constexpr std::uint64_t kMaxPerPair = 10'000;
static constexpr std::uint64_t kFirstLook = 64;  // collisions; later intervals double
static constexpr std::size_t kWindows =
    10;  // number of windows kept; their longest mean time counts

Watchdog::Watchdog(std::size_t particles, double time, double mean_collision_time)
    : particles_(static_cast<double>(particles)),
      window_(std::max<std::uint64_t>(1, kMaxPerParticle * particles)),
      longest_interval_(std::min(kMaxPerPair, window_)),
      look_interval_(std::min(kFirstLook, longest_interval_)),
      until_look_(look_interval_),
      look_start_(time),
      window_start_(time),
      longest_early_(mean_collision_time) {}

void Watchdog::on_base_moved(double shift) {
  look_start_ -= shift;
  window_start_ -= shift;
  still_since_ -= shift;
}

double Watchdog::mean_of_window(double time) const {
  return particles_ * (time - window_start_) / static_cast<double>(participations_);
}

double Watchdog::longest_known_mean() const {
  return means_.empty() ? longest_early_ : std::ranges::max(means_);
}

// The first checks follow each other closely, so that a collapse soon after the start does not
// enter the mean time.
//
// Pairs are counted only after a first suspicion. A normal run then pays for one check every 10^4
// collisions.
bool Watchdog::look(double time) {
  const std::uint64_t seen = look_interval_;
  look_interval_ = std::min(2 * seen, longest_interval_);
  until_look_ = look_interval_;
  collisions_ += seen;
  if (means_.empty()) longest_early_ = std::max(longest_early_, mean_of_window(time));
  if (suspicious_ && time - still_since_ > kCollapseSpan * still_mean_) {
    suspicious_ = false;
    pairs_.clear();
  }
  if (suspicious_) {
    still_collisions_ += seen;
  } else if (const double mean = std::max(mean_of_window(time), longest_known_mean());
             time - look_start_ <= kCollapseSpan * mean) {
    suspicious_ = true;
    still_since_ = look_start_;
    still_mean_ = mean;
    still_collisions_ = 0;
  }
  look_start_ = time;
  if (collisions_ >= window_) {
    means_.push_back(means_.empty() ? longest_early_ : mean_of_window(time));
    if (means_.size() > kWindows) means_.pop_front();
    window_start_ = time;
    collisions_ = participations_ = 0;
  }
  return suspicious_ && too_many();
}

bool Watchdog::too_many() const {
  return still_collisions_ >= window_ ||
         std::ranges::any_of(pairs_, [](const auto& pair) { return pair.second > kMaxPerPair; });
}

std::pair<std::uint32_t, std::uint32_t> Watchdog::busiest_pair() const {
  const auto fewer = [](const auto& a, const auto& b) { return a.second < b.second; };
  return std::ranges::max_element(pairs_, fewer)->first;
}

}  // namespace clatter
