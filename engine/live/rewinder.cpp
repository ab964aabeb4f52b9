#include "engine/live/rewinder.h"

#include <algorithm>
#include <cmath>
#include <utility>

namespace clatter {

static std::size_t bytes_of(const Frame& frame) {
  const Snapshot& gas = frame.snapshot;
  const auto numbers = gas.positions.size() + gas.velocities.size() + gas.spins.size();
  std::size_t beside = 0;
  for (const Frame& other : frame.others) beside += bytes_of(other);
  return beside + sizeof(Frame) + static_cast<std::size_t>(numbers) * sizeof(double) +
         gas.flights.size() * (sizeof(FlightPiece) + 9 * sizeof(double)) +
         gas.angles.size() * sizeof(double) + gas.orientations.size() * sizeof(Eigen::Quaterniond);
}

Rewinder::Rewinder(WatchedRun& run, double interval)
    : run_(run),
      start_(run.time()),
      interval_(interval),
      last_(static_cast<std::uint64_t>(std::ceil(start_ / interval))) {
  begin_stretch();
}

double Rewinder::time_of(std::uint64_t number) const {
  return number < last_ ? start_ - static_cast<double>(number) * interval_ : 0.0;
}

double Rewinder::number_at(double time) const {
  return std::round((start_ - time) / interval_);
}

void Rewinder::begin_stretch() {
  count_ = first_ <= last_ ? std::min<std::uint64_t>(longest_, last_ + 1 - first_) : 0;
  there_ = false;
}

void Rewinder::work(const StopRequest& pause) {
  constexpr std::uint64_t kSteps = 4096;
  if (!busy()) return;
  const double time = time_of(first_ + count_ - 1 - making_.size());
  if (!std::exchange(there_, true)) run_.go_back(time);
  const std::uint64_t steps = run_.counts().steps() + kSteps;
  if (run_.time() < time && !run_.run_until(time, kNoLimit, steps, pause)) return;
  run_.fill(making_.emplace_back(), false);
}

std::optional<Frame> Rewinder::take(double time) {
  constexpr std::size_t kMost = 60, kBytes = 32'000'000;
  if (ready_.empty() && count_ > 0 && !busy()) {
    ready_ = std::exchange(making_, {});
    next_ = first_;
    first_ += count_;
    longest_ =
        std::clamp<std::size_t>(kBytes / bytes_of(ready_.back()), 1, std::min(kMost, 2 * longest_));
    begin_stretch();
  }
  if (ready_.empty()) return std::nullopt;
  while (ready_.size() > 1 && static_cast<double>(next_) < number_at(time)) {
    ready_.pop_back();
    ++next_;
  }
  Frame frame = std::move(ready_.back());
  ready_.pop_back();
  ++next_;
  return frame;
}

}  // namespace clatter
