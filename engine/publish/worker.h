#pragma once

#include <condition_variable>
#include <functional>
#include <memory>
#include <mutex>
#include <thread>

#include "engine/publish/command.h"
#include "engine/publish/command_queue.h"
#include "engine/publish/frame.h"
#include "engine/publish/triple_buffer.h"

namespace clatter {

/// The engine's thread: runs a gas at its speed, does what it is asked for, publishes frames. It
/// sleeps where it has nothing to do; what goes wrong becomes a frame's message.
class Worker {
 public:
  /// Publishes so many frames per second while a gas plays, and one after each command; then calls
  /// `on_publish`, on its thread.
  explicit Worker(
      double frames_per_second, std::function<void()> on_publish = [] {});
  Worker(const Worker&) = delete;
  Worker& operator=(const Worker&) = delete;
  /// Ends the thread once the engine has done what it is at.
  ~Worker();

  /// Asks for something; at once, and done soon: between two slices of the run.
  void send(Command command) { commands_.push(std::move(command)); }
  /// The frames, to be read by one thread.
  TripleBuffer<Frame>& frames() { return frames_; }
  /// Asks the thread to end, and tells whether it has within a time.
  bool stop_within(std::chrono::milliseconds time);

 private:
  void work(double frames_per_second, const std::function<void()>& on_publish);

  CommandQueue<Command> commands_;
  TripleBuffer<Frame> frames_;
  std::mutex mutex_;
  std::condition_variable ended_changed_;
  bool ended_ = false;
  std::thread thread_;  // last: it uses the others
};

}  // namespace clatter
