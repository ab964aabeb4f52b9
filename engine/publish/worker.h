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

/// The engine's thread: runs a gas at its speed, executes commands and publishes frames. It sleeps
/// when it has nothing to do. Errors become messages in frames.
class Worker {
 public:
  /// Publishes `frames_per_second` frames while a gas plays, and one after each batch of commands.
  /// After each frame the thread calls `on_publish`.
  explicit Worker(
      double frames_per_second, std::function<void()> on_publish = [] {});
  Worker(const Worker&) = delete;
  Worker& operator=(const Worker&) = delete;
  /// Ends the thread after its current task.
  ~Worker();

  /// Sends a command and returns at once. The engine executes it between two slices of the run.
  void send(Command command) { commands_.push(std::move(command)); }
  /// The frames, to be read by one thread.
  TripleBuffer<Frame>& frames() { return frames_; }
  /// Asks the thread to end; returns whether it has ended within `time`.
  bool stop_within(std::chrono::milliseconds time);

 private:
  void work(double frames_per_second, const std::function<void()>& on_publish);

  CommandQueue<Command> commands_;
  TripleBuffer<Frame> frames_;
  std::mutex mutex_;
  std::condition_variable ended_changed_;
  bool ended_ = false;
  std::thread thread_;  // last member: it uses the others
};

}  // namespace clatter
