#pragma once

#include <chrono>
#include <cstdint>

namespace clatter {

/// Events per second of real time over about the last half second. The first rate follows after a
/// tenth of a second.
class EventRate {
 public:
  /// Takes the number of events so far.
  void count(std::uint64_t events) {
    constexpr std::chrono::milliseconds kFirst{100}, kLong{500};
    const auto now = Clock::now();
    if (since_ == Clock::time_point{}) {
      since_ = now;
      events_then_ = events;
    } else if (now - since_ > (per_second_ > 0.0 ? kLong : kFirst)) {
      per_second_ = static_cast<double>(events - events_then_) /
                    std::chrono::duration<double>(now - since_).count();
      since_ = now;
      events_then_ = events;
    }
  }
  /// Starts to count other events. The present rate remains until there is another one.
  void restart() { since_ = {}; }
  /// No events happen now.
  void halt() {
    restart();
    per_second_ = 0.0;
  }
  /// The rate, 1/s; 0 at first.
  double per_second() const { return per_second_; }

 private:
  using Clock = std::chrono::steady_clock;

  double per_second_ = 0.0;
  Clock::time_point since_{};
  std::uint64_t events_then_ = 0;
};

}  // namespace clatter
