#pragma once

#include <cstddef>
#include <cstdint>
#include <deque>
#include <memory>
#include <string_view>
#include <vector>

#include "engine/scene/scene.h"

namespace clatter {

/// Whether a key may change during a run: keys of collisions, existing walls, gravity, bulk driving
/// and the contact time.
bool may_change_live(std::string_view key);

/// The laws and acts of a scene in time, from its `changes`. A ramp has equal steps, so that all
/// commands and the window change the same laws at the same times.
class Schedule {
 public:
  /// At the scene's start, before all changes.
  explicit Schedule(const Scene& scene);
  /// With the laws of a scene at a time. Only changes after this time are to come.
  Schedule(const Scene& scene, double time);

  /// The scene with the current laws, without its changes.
  const Scene& laws() const { return laws_; }
  /// The scene with the current laws and all its changes.
  Scene scene() const;
  /// All changes of the scene.
  std::vector<Change> changes() const;
  /// Simulation time of the next change; infinite: never.
  double next() const;
  /// The change of the next step. It exists if next() is finite.
  const Change& coming() const { return (*changes_)[next_change()]; }
  /// Makes the next change of laws, if it has any. Throws UserError if the result is invalid, or
  /// needs another gas or box.
  void advance();
  /// Makes all steps up to and at the simulation time of a run that has had so many. A step at this
  /// time that the run has not had stays, with all after it.
  void skip_to(double time, std::uint64_t steps = ~std::uint64_t{0});
  /// Adds a change at the current time or later.
  void add(const Change& change);

  /// Index of the next step's change.
  std::size_t next_change() const { return steps_.front().change; }

  /// Number of steps of a ramp.
  static constexpr int kRampSteps = 64;

 private:
  struct Step {
    double time;
    std::size_t change;
    int part;  // of kRampSteps

    // Changes of the same time apply in their order.
    bool operator<(const Step& other) const {
      return time != other.time ? time > other.time : change > other.change;
    }
  };

  void plan(std::size_t number, double after);
  void put(const Step& step);
  void change_to(const std::vector<Override>& settings);

  Scene laws_;
  // All changes are the first `count_` of this list. Copies of a schedule share the list, and the
  // first that adds a change extends it.
  std::shared_ptr<std::deque<Change>> changes_;
  std::size_t count_ = 0;
  std::vector<Step> steps_;  // future steps, a heap with the earliest in front
};

}  // namespace clatter
