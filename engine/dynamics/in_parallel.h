#pragma once

#include <cstddef>
#include <functional>

#include "engine/stop_request.h"

namespace clatter {

/// Calls work(k, thread) for k = 0 ... count - 1 on up to `threads` threads. They have the numbers
/// 0 ... threads - 1, the caller's has 0. At a stop request each thread completes its call. Returns
/// the number of calls. An error of a call is thrown again when all threads have ended.
std::size_t in_parallel(std::size_t threads, std::size_t count,
                        const std::function<void(std::size_t k, std::size_t thread)>& work,
                        const StopRequest& stop = {});

}  // namespace clatter
