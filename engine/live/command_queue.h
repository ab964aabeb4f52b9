#pragma once

#include <chrono>
#include <condition_variable>
#include <mutex>
#include <utility>
#include <vector>

namespace clatter {

/// Queue of commands from one thread to another, in order. A waiting thread sleeps.
template <class T>
class CommandQueue {
 public:
  using Clock = std::chrono::steady_clock;

  /// Adds a command.
  void push(T command) {
    {
      const std::lock_guard lock(mutex_);
      commands_.push_back(std::move(command));
    }
    changed_.notify_one();
  }
  /// Ends all waits, now and from now on.
  void close() {
    {
      const std::lock_guard lock(mutex_);
      closed_ = true;
    }
    changed_.notify_one();
  }

  /// Removes and returns the commands since the last call.
  std::vector<T> take() {
    const std::lock_guard lock(mutex_);
    return std::exchange(commands_, {});
  }
  /// Whether there are commands, or the queue is closed.
  bool pending() {
    const std::lock_guard lock(mutex_);
    return is_pending();
  }
  /// Waits until pending().
  void wait() {
    std::unique_lock lock(mutex_);
    changed_.wait(lock, [this] { return is_pending(); });
  }
  /// Waits until pending(), at most until `time`.
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
