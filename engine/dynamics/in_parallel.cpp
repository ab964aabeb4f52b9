#include "engine/dynamics/in_parallel.h"

#include <algorithm>
#include <atomic>
#include <exception>
#include <system_error>
#include <thread>
#include <vector>

namespace clatter {

std::size_t in_parallel(std::size_t threads, std::size_t count,
                        const std::function<void(std::size_t, std::size_t)>& work,
                        const StopRequest& stop) {
  std::atomic<std::size_t> next{0};
  std::vector<std::exception_ptr> errors(threads);
  const auto take = [&](std::size_t thread) {
    try {
      for (std::size_t k; (k = next.fetch_add(1)) < count;) {
        work(k, thread);
        if (stop.made()) break;
      }
    } catch (...) {
      errors[thread] = std::current_exception();
      next = count;
    }
  };
  std::vector<std::thread> others;
  try {
    for (std::size_t thread = 1; thread < std::min(threads, count); ++thread) {
      others.emplace_back(take, thread);
    }
  } catch (const std::system_error&) {
    // The system has no more threads; those that run do all the work.
  }
  take(0);
  for (std::thread& thread : others) thread.join();
  for (const std::exception_ptr& error : errors) {
    if (error) std::rethrow_exception(error);
  }
  return std::min(next.load(), count);
}

}  // namespace clatter
