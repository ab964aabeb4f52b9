#include "app/film/frame_times.h"

#include "engine/live/pace.h"

namespace clatter {

double FrameTimes::of(long frame) const {
  return PaceCurve(pace).time_after(from, static_cast<double>(frame) * (speed / fps));
}

double FrameTimes::time_after(double seconds) const {
  return PaceCurve(pace).time_after(from, seconds * speed);
}

double FrameTimes::seconds_at(double time) const {
  return PaceCurve(pace).playing_time(from, time) / speed;
}

double FrameTimes::speed_at(double time) const {
  return speed * PaceCurve(pace).factor_at(time);
}

double FrameTimes::largest_speed() const {
  return speed * PaceCurve(pace).largest_factor();
}

}  // namespace clatter
