#include "engine/scene/piston.h"

#include <algorithm>
#include <cmath>
#include <vector>

#include "engine/physics/theory.h"
#include "engine/scene/limits.h"
#include "engine/scene/text.h"

namespace clatter {

double least_piston_position(const Scene& scene) {
  constexpr double kDiameter = 1.0;
  return scene.box[0] - scene.clear_box()[0] + kDiameter;
}

// Numbers of the changes with a stroke, in order of their times.
static std::vector<std::size_t> strokes_of(const std::vector<Change>& changes) {
  std::vector<std::size_t> strokes;
  for (std::size_t number = 0; number < changes.size(); ++number) {
    if (changes[number].piston) strokes.push_back(number);
  }
  std::stable_sort(strokes.begin(), strokes.end(),
                   [&](std::size_t a, std::size_t b) { return changes[a].time < changes[b].time; });
  return strokes;
}

void check_pistons(const Scene& scene,
                   const std::function<Place(std::size_t, std::string_view)>& place_of) {
  double end = 0.0, position = scene.box[0];
  for (const std::size_t number : strokes_of(scene.changes)) {
    const Change& change = scene.changes[number];
    const auto place = [&](std::string_view key) { return place_of(number, key); };
    if (!change.set.empty() || change.ramp || change.nudge || change.puff) {
      throw UserError(place("piston"), "a piston has no other key beside time and until",
                      "give the piston a [[change]] of its own");
    }
    if (scene.periodic(0)) {
      throw UserError(place("piston"), "the piston is the right wall, which the box lacks",
                      "add [walls.left] and [walls.right], or remove the piston");
    }
    const double least = least_piston_position(scene), most = scene.box[0];
    if (!(*change.piston > least && *change.piston <= most)) {
      throw UserError(place("piston"),
                      "the piston would move to x = " + number_text(*change.piston),
                      "choose a number above " + number_text(least) + ", up to " +
                          number_text(most) + ", the size of the box");
    }
    if (change.time < end) {
      throw UserError(place("time"),
                      "the piston would begin to move at t = " + number_text(change.time) +
                          ", before its stroke until t = " + number_text(end) + " has ended",
                      "let it begin at t = " + number_text(end) + " or later");
    }
    const double speed = std::fabs(*change.piston - position) / (change.until - change.time);
    if (speed > kMaxSpeed) {
      throw UserError(place("until"), "the piston would move at a speed of " + number_text(speed),
                      "choose a later time: walls move at " + number_text(kMaxSpeed) + " at most");
    }
    end = change.until;
    position = *change.piston;
  }
}

PistonPlan piston_plan(const std::vector<Change>& changes, double time, double position) {
  PistonPlan plan{time, position};
  for (const std::size_t number : strokes_of(changes)) {
    const Change& stroke = changes[number];
    if (stroke.time <= plan.time && plan.time < stroke.until) plan = {stroke.until, *stroke.piston};
  }
  return plan;
}

double compressed_fraction(const Scene& scene) {
  double position = scene.box[0];
  for (const Change& change : scene.changes) {
    position = std::min(position, change.piston.value_or(position));
  }
  return packing_fraction(scene.dimension(),
                          static_cast<double>(final_count(scene)) / scene.box.prod()) *
         scene.box[0] / position;
}

}  // namespace clatter
