#include "app/view/stopwatch.h"

namespace clatter {

void Stopwatch::press(double time, Clock::time_point now) {
  if (!started_) {
    started_ = {time, now};
  } else if (!stopped_) {
    stopped_ = read(time, now);
  } else {
    clear();
  }
}

Stopwatch::Reading Stopwatch::read(double time, Clock::time_point now) const {
  if (stopped_) return *stopped_;
  if (!started_) return {};
  return {time - started_->time, std::chrono::duration<double>(now - started_->moment).count()};
}

}  // namespace clatter
