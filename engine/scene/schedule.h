#pragma once

#include <cstddef>
#include <memory>
#include <string_view>
#include <vector>

#include "engine/scene/scene.h"

namespace clatter {

/// Whether a key is of a law that may change while a run goes on: of collisions, of the walls there
/// are, of gravity, of bulk driving, of the contact time.
bool may_change_live(std::string_view key);

/// A scene whose laws change in time as its `changes` say. A ramp goes in equal steps, so that
/// whoever plays it changes the same laws at the same times.
class Schedule {
 public:
  /// At the scene's start: no change has come into force.
  explicit Schedule(const Scene& scene);

  /// The scene with the laws now in force, without its changes.
  const Scene& laws() const { return laws_; }
  /// The scene with the laws now in force, and with all its changes.
  Scene scene() const;
  /// Simulation time at which other laws come into force; infinite: never.
  double next() const;
  /// Brings the laws of that time into force. Throws UserError where they make no scene, or need
  /// another gas or box.
  void advance();
  /// All laws up to and at a simulation time come into force.
  void skip_to(double time);
  /// One more change, of now or later.
  void add(const Change& change);

  /// Which of the scene's changes the next laws are of.
  std::size_t next_change() const { return steps_.front().change; }

  /// In how many steps a ramp goes.
  static constexpr int kRampSteps = 64;

 private:
  struct Step {
    double time;
    std::size_t change;
    int part;  // of kRampSteps

    // Changes of one time come in their order.
    bool operator<(const Step& other) const {
      return time != other.time ? time > other.time : change > other.change;
    }
  };

  void plan(std::size_t number);
  void put(const Step& step);
  void change_to(const std::vector<Override>& settings);

  Scene laws_;
  std::shared_ptr<const std::vector<Change>> changes_;  // shared by copies, which are made per law
  std::vector<Step> steps_;                             // to come, a heap with the soonest in front
};

}  // namespace clatter
