#pragma once

#include <chrono>
#include <condition_variable>
#include <mutex>
#include <utility>
#include <vector>

namespace clatter {

/// What one thread asks of another, in order. Who waits sleeps.
template <class T>
class CommandQueue {
 public:
  using Clock = std::chrono::steady_clock;

  /// Asks for something; after close() nothing is taken any more.
  void push(T command) {
    {
      const std::lock_guard lock(mutex_);
      commands_.push_back(std::move(command));
    }
    changed_.notify_one();
  }
  /// Whoever waits comes back, now and from now on.
  void close() {
    {
      const std::lock_guard lock(mutex_);
      closed_ = true;
    }
    changed_.notify_one();
  }

  /// All that has been asked for since the last call.
  std::vector<T> take() {
    const std::lock_guard lock(mutex_);
    return std::exchange(commands_, {});
  }
  /// Whether something has been asked for, or nothing will be any more.
  bool pending() {
    const std::lock_guard lock(mutex_);
    return is_pending();
  }
  /// Waits until pending().
  void wait() {
    std::unique_lock lock(mutex_);
    changed_.wait(lock, [this] { return is_pending(); });
  }
  /// Waits until pending(), but no longer than to a time.
  void wait_until(Clock::time_point time) {
    std::unique_lock lock(mutex_);
    changed_.wait_until(lock, time, [this] { return is_pending(); });
  }
  /// Whether close() has been called.
  bool closed() {
    const std::lock_guard lock(mutex_);
    return closed_;
  }

 private:
  bool is_pending() const { return closed_ || !commands_.empty(); }

  std::mutex mutex_;
  std::condition_variable changed_;
  std::vector<T> commands_;
  bool closed_ = false;
};

}  // namespace clatter
