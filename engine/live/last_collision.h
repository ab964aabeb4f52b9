#pragma once

#include <array>
#include <cstdint>
#include <optional>

#include "engine/live/watched_run.h"
#include "engine/run/scheduled_run.h"

namespace clatter {

/// Observer that keeps the last collision of two particles, and the last one before a given time.
template <int D>
class LastCollision : public Observer<D> {
 public:
  /// `run` must outlive this object.
  explicit LastCollision(const ScheduledRun<D>& run) : run_(run) {}

  void on_collision(const PairCollision<D>& collision) override {
    partners_ = {{collision.particles[0].particle, collision.particles[1].particle}};
    if (const double time = run_.simulation().time(); time < before_) {
      found_ = {settled_time(time), *partners_};
    }
  }
  /// Forgets the partners of the last collision.
  void forget() { partners_.reset(); }
  /// Searches, from now on, for the last collision before a simulation time.
  void search_before(double time) {
    before_ = time;
    found_.reset();
  }
  /// Partners of the last collision; absent: none since forget().
  const std::optional<std::array<std::uint32_t, 2>>& partners() const { return partners_; }
  /// The result of the search; absent: no collision yet.
  const std::optional<PreviousCollision>& found() const { return found_; }

 private:
  const ScheduledRun<D>& run_;
  std::optional<std::array<std::uint32_t, 2>> partners_;
  double before_ = 0.0;
  std::optional<PreviousCollision> found_;
};

}  // namespace clatter
