#pragma once

#include <condition_variable>
#include <deque>
#include <exception>
#include <functional>
#include <mutex>
#include <thread>
#include <vector>

namespace clatter {

/// A bounded queue of jobs and the threads that do them, beside the one that adds. After a job has
/// thrown, no other begins.
class WorkQueue {
 public:
  /// At most `capacity` jobs wait; with one thread they are done in order.
  WorkQueue(int threads, std::size_t capacity);
  WorkQueue(const WorkQueue&) = delete;
  WorkQueue& operator=(const WorkQueue&) = delete;
  /// Drops the jobs that wait and ends when those begun have ended.
  ~WorkQueue();

  /// Adds a job, once there is room; throws what a job threw.
  void add(std::function<void()> job);
  /// Waits until all jobs are done; throws what a job threw.
  void drain();
  /// Ends when all jobs are done, for good; throws what a job threw.
  void finish();

 private:
  void work();
  void close_and_join();

  const std::size_t capacity_;
  std::mutex mutex_;
  std::condition_variable job_or_end_;  ///< the threads wait for it
  std::condition_variable room_;        ///< add() waits for it
  std::condition_variable idle_;        ///< drain() waits for it
  std::deque<std::function<void()>> jobs_;
  int under_way_ = 0;  ///< jobs that have begun and not ended
  std::exception_ptr error_;
  bool closed_ = false;
  std::vector<std::thread> threads_;
};

}  // namespace clatter
