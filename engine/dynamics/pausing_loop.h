#pragma once

#include <cstddef>

#include "engine/stop_request.h"

namespace clatter {

/// A loop over indices that can pause and continue later.
class PausingLoop {
 public:
  /// Calls visit(index) for the indices up to `count` that remain. Returns false at a request to
  /// pause.
  template <typename Visit>
  bool advance(std::size_t count, const StopRequest& pause, const Visit& visit) {
    for (; next_ < count; ++next_) {
      if (next_ % kStepsPerQuestion == 0 && pause.made()) return false;
      visit(next_);
    }
    return true;
  }

 private:
  std::size_t next_ = 0;
};

}  // namespace clatter
