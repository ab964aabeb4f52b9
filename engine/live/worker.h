#pragma once

#include <chrono>
#include <condition_variable>
#include <functional>
#include <memory>
#include <mutex>
#include <thread>

#include "engine/live/command.h"
#include "engine/live/command_queue.h"
#include "engine/live/frame.h"
#include "engine/live/triple_buffer.h"

namespace clatter {

class EngineWork;

/// The ends of the channels between an engine and its user: commands to it, and frames from it.
class EngineLink {
 public:
  /// Sends a command and returns at once. The engine executes it between two slices of the run.
  void send(Command command) { commands_.push(std::move(command)); }
  /// The frames, to be read by one thread.
  TripleBuffer<Frame>& frames() { return frames_; }

 protected:
  EngineLink() = default;
  ~EngineLink() = default;

  CommandQueue<Command> commands_;
  TripleBuffer<Frame> frames_;
};

/// The engine on the thread of its user, where threads are missing. It works only in work().
class SlicedWorker : public EngineLink {
 public:
  SlicedWorker();
  SlicedWorker(const SlicedWorker&) = delete;
  SlicedWorker& operator=(const SlicedWorker&) = delete;
  ~SlicedWorker();

  /// Executes the commands sent, and advances a gas that moves by its speed times the real time
  /// since the last call. Publishes a frame after both. It returns after about `budget`, except
  /// that a command may take longer. A delay is dropped, as by Pace.
  void work(std::chrono::milliseconds budget);
  /// Whether work() has something to do.
  bool busy();

 private:
  std::unique_ptr<EngineWork> work_;
  std::chrono::steady_clock::time_point last_;
};

/// The engine's thread: runs a gas at its speed, executes commands and publishes frames. It sleeps
/// when it has nothing to do. Errors become messages in frames.
class Worker : public EngineLink {
 public:
  /// Publishes `frames_per_second` frames while a gas plays, and one after each batch of commands.
  /// After each frame the thread calls `on_publish`.
  explicit Worker(
      double frames_per_second, std::function<void()> on_publish = [] {});
  Worker(const Worker&) = delete;
  Worker& operator=(const Worker&) = delete;
  /// Ends the thread after its current task.
  ~Worker();

  /// Asks the thread to end; returns whether it has ended within `time`.
  bool stop_within(std::chrono::milliseconds time);

 private:
  void work(double frames_per_second, const std::function<void()>& on_publish);

  std::mutex mutex_;
  std::condition_variable ended_changed_;
  bool ended_ = false;
  std::thread thread_;  // last member: it uses the others
};

}  // namespace clatter
