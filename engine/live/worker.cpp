#include "engine/live/worker.h"

#include <utility>

#include "engine/live/engine_work.h"

namespace clatter {

static constexpr double kFramesOfSlices = 60.0;  // per second; a single step has this duration
static constexpr std::size_t kRecordBytesOfSlices = kRecordBytes / 4;  // a page has less memory

SlicedWorker::SlicedWorker()
    : work_(std::make_unique<EngineWork>(kFramesOfSlices, commands_, frames_, kRecordBytesOfSlices,
                                         [] {})) {}

SlicedWorker::~SlicedWorker() = default;

void SlicedWorker::work(std::chrono::milliseconds budget) {
  constexpr std::chrono::milliseconds kLongest{100};
  const auto now = Pace::Clock::now();
  const auto elapsed = std::min<Pace::Clock::duration>(now - std::exchange(last_, now), kLongest);
  work_->run_slice(elapsed, now + budget);
}

bool SlicedWorker::busy() {
  return commands_.pending() || work_->busy();
}

Worker::Worker(double frames_per_second, std::function<void()> on_publish)
    : thread_([this, frames_per_second, on_publish = std::move(on_publish)] {
        work(frames_per_second, on_publish);
      }) {}

Worker::~Worker() {
  commands_.close();
  thread_.join();
}

void Worker::work(double frames_per_second, const std::function<void()>& on_publish) {
  EngineWork(frames_per_second, commands_, frames_, kRecordBytes, on_publish).run();
  {
    const std::lock_guard lock(mutex_);
    ended_ = true;
  }
  ended_changed_.notify_one();
}

bool Worker::stop_within(std::chrono::milliseconds time) {
  commands_.close();
  std::unique_lock lock(mutex_);
  return ended_changed_.wait_for(lock, time, [this] { return ended_; });
}

}  // namespace clatter
