#pragma once

#include <vector>

#include "engine/scene/view.h"

namespace clatter {

/// The times of frames: frame k is k/fps seconds after the first one. In the film, the simulation
/// time passes with `speed` times the factor of the pace.
struct FrameTimes {
  double from = 0.0;               ///< simulation time of the first frame
  double speed = 1.0;              ///< simulation time per second of film, at the factor 1
  double fps = 30.0;               ///< frames per second of film
  long count = 1;                  ///< of the whole film, including parts made elsewhere
  std::vector<PaceKey> pace = {};  ///< in order of time; empty: the factor is 1

  /// Simulation time of a frame.
  double of(long frame) const;
  /// Simulation time of the last frame.
  double last() const { return of(count - 1); }
  /// Simulation time after so many seconds of film.
  double time_after(double seconds) const;
  /// Seconds of film from the first frame to a simulation time.
  double seconds_at(double time) const;
  /// Simulation time per second of film at a simulation time.
  double speed_at(double time) const;
  /// The largest speed_at() of any time.
  double largest_speed() const;
};

}  // namespace clatter
