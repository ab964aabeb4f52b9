#pragma once

#include <chrono>

namespace clatter::bench {

/// Seconds of work(): the least of three runs, which has the least disturbance by other processes.
template <typename Work>
double seconds(const Work& work) {
  double least = 1e300;
  for (int attempt = 0; attempt < 3; ++attempt) {
    const auto begin = std::chrono::steady_clock::now();
    work();
    const std::chrono::duration<double> taken = std::chrono::steady_clock::now() - begin;
    if (taken.count() < least) least = taken.count();
  }
  return least;
}

}  // namespace clatter::bench
