#pragma once

#include <condition_variable>
#include <deque>
#include <exception>
#include <functional>
#include <mutex>
#include <thread>
#include <vector>

namespace clatter {

/// A bounded queue of jobs with worker threads. After a job has thrown, no further job starts.
class WorkQueue {
 public:
  /// Starts `threads` threads. At most `capacity` jobs wait. One thread runs the jobs in order.
  WorkQueue(int threads, std::size_t capacity);
  WorkQueue(const WorkQueue&) = delete;
  WorkQueue& operator=(const WorkQueue&) = delete;
  /// Drops waiting jobs, and waits for running ones.
  ~WorkQueue();

  /// Adds a job, after waiting for room. Throws the exception of an earlier job.
  void add(std::function<void()> job);
  /// Waits until all jobs are done. Throws the exception of a job.
  void drain();
  /// Waits until all jobs are done, and ends the threads. Throws the exception of a job.
  void finish();

 private:
  void work();
  void close_and_join();

  const std::size_t capacity_;
  std::mutex mutex_;
  std::condition_variable job_or_end_;  ///< for the threads
  std::condition_variable room_;        ///< for add()
  std::condition_variable idle_;        ///< for drain()
  std::deque<std::function<void()>> jobs_;
  int under_way_ = 0;  ///< number of running jobs
  std::exception_ptr error_;
  bool closed_ = false;
  std::vector<std::thread> threads_;
};

}  // namespace clatter
