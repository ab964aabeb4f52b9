#include "render/output/work_queue.h"

#include <utility>

#include "engine/system/signals.h"

namespace clatter {

WorkQueue::WorkQueue(int threads, std::size_t capacity) : capacity_(capacity) {
  for (int i = 0; i < threads; ++i) threads_.emplace_back([this] { work(); });
}

WorkQueue::~WorkQueue() {
  {
    const std::lock_guard lock(mutex_);
    jobs_.clear();
  }
  close_and_join();
}

void WorkQueue::add(std::function<void()> job) {
  std::unique_lock lock(mutex_);
  room_.wait(lock, [this] { return jobs_.size() < capacity_ || error_; });
  if (error_) std::rethrow_exception(error_);
  jobs_.push_back(std::move(job));
  job_or_end_.notify_one();
}

void WorkQueue::drain() {
  std::unique_lock lock(mutex_);
  idle_.wait(lock, [this] { return (jobs_.empty() && under_way_ == 0) || error_; });
  if (error_) std::rethrow_exception(error_);
}

void WorkQueue::finish() {
  close_and_join();
  if (error_) std::rethrow_exception(error_);
}

void WorkQueue::close_and_join() {
  {
    const std::lock_guard lock(mutex_);
    closed_ = true;
  }
  job_or_end_.notify_all();
  for (std::thread& thread : threads_) {
    if (thread.joinable()) thread.join();
  }
}

void WorkQueue::work() {
  block_signals();
  std::unique_lock lock(mutex_);
  for (;;) {
    job_or_end_.wait(lock, [this] { return !jobs_.empty() || closed_ || error_; });
    if (jobs_.empty() || error_) return;
    const std::function<void()> job = std::move(jobs_.front());
    jobs_.pop_front();
    ++under_way_;
    room_.notify_one();
    lock.unlock();
    try {
      job();
      lock.lock();
    } catch (...) {
      lock.lock();
      if (!error_) error_ = std::current_exception();
      room_.notify_all();
      job_or_end_.notify_all();
    }
    --under_way_;
    idle_.notify_all();
  }
}

}  // namespace clatter
