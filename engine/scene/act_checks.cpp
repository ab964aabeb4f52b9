#include "engine/scene/act_checks.h"

#include <algorithm>
#include <cmath>
#include <string>

#include "engine/physics/theory.h"
#include "engine/scene/enum_names.h"
#include "engine/scene/limits.h"
#include "engine/text.h"

namespace clatter {

void check_size(const VecX& vector, const Scene& scene, std::string_view owner,
                std::string_view key, const Place& place) {
  if (vector.size() == scene.dimension()) return;
  throw UserError(place,
                  "'" + std::string(key) + "' of the " + std::string(owner) + " has " +
                      std::to_string(vector.size()) + " numbers",
                  "give " + std::to_string(scene.dimension()) + ", as in box.size");
}

void check_centre(const VecX& centre, const Scene& scene, std::string_view owner,
                  const Place& place) {
  for (int axis = 0; axis < scene.dimension(); ++axis) {
    const double side = scene.box[axis];
    if (centre[axis] >= 0.0 && centre[axis] <= side) continue;
    throw UserError(place,
                    "the centre of the " + std::string(owner) + " is outside of the box, at " +
                        number_text(centre[axis]) + " along " +
                        std::string(kAxes[static_cast<std::size_t>(axis)].name),
                    "choose a number from 0 to " + number_text(side));
  }
}

void check_nudge(const Nudge& nudge, const Scene& scene, std::int64_t count,
                 const std::function<Place(std::string_view key)>& place_of) {
  if (!nudge.particle && !nudge.centre) {
    throw UserError(place_of(""), "the nudge has no particles",
                    "give 'particle', or 'centre' and 'radius' of a region");
  }
  if (nudge.centre && !nudge.radius) {
    throw UserError(place_of(""), "the region of the nudge has no radius", "give 'radius'");
  }
  if (!nudge.scale && !nudge.add && !nudge.set) {
    throw UserError(place_of(""), "the nudge changes no velocity", "give 'scale', 'add' or 'set'");
  }
  const auto check = [&](std::string_view key, const std::optional<VecX>& vector) {
    if (vector) check_size(*vector, scene, "nudge", key, place_of(key));
  };
  check("centre", nudge.centre);
  check("add", nudge.add);
  check("set", nudge.set);
  if (nudge.centre) check_centre(*nudge.centre, scene, "nudge", place_of("centre"));
  if (nudge.particle && *nudge.particle >= count) {
    throw UserError(place_of("particle"), "there is no particle " + std::to_string(*nudge.particle),
                    particle_numbers(static_cast<int>(count)));
  }
}

void check_nudges(const Scene& scene,
                  const std::function<Place(std::size_t, std::string_view)>& place_of) {
  for (std::size_t number = 0; number < scene.changes.size(); ++number) {
    const std::optional<Nudge>& nudge = scene.changes[number].nudge;
    if (!nudge) continue;
    check_nudge(*nudge, scene, count_at(scene, number),
                [&](std::string_view key) { return place_of(number, key); });
  }
}

void check_puff(const Puff& puff, const Scene& scene,
                const std::function<Place(std::string_view key)>& place_of) {
  check_size(puff.centre, scene, "puff", "centre", place_of("centre"));
  if (puff.velocity) check_size(*puff.velocity, scene, "puff", "velocity", place_of("velocity"));
  check_centre(puff.centre, scene, "puff", place_of("centre"));
  if (puff.species.empty() || find_species(scene.species, puff.species)) return;
  throw UserError(place_of("species"), "there is no species " + in_quotes(puff.species),
                  scene.species.empty() ? "remove the key" : "give the name of one of [[species]]");
}

std::int64_t count_at(const Scene& scene, std::size_t change) {
  std::int64_t count = scene.particles.count;
  const double time = scene.changes[change].time;
  for (std::size_t k = 0; k < scene.changes.size(); ++k) {
    const Change& other = scene.changes[k];
    const bool before = other.time < time || (other.time == time && k < change);
    if (before && other.puff) count += other.puff->count;
  }
  return count;
}

std::int64_t final_count(const Scene& scene) {
  std::int64_t count = scene.particles.count;
  for (const Change& change : scene.changes) count += change.puff ? change.puff->count : 0;
  return count;
}

double least_piston_position(const Scene& scene) {
  return scene.box[0] - scene.clear_box()[0] + scene.largest_diameter();
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
    if (scene.piston && scene.piston->axis == Axis::X) {
      throw UserError(place("piston"), "the right wall would meet the free piston",
                      "remove the table [piston], or this change");
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
  const int dimension = scene.dimension();
  double volumes = scene.packing_fraction() * scene.box.prod();
  for (const Change& change : scene.changes) {
    if (!change.puff) continue;
    const std::size_t kind = find_species(scene.species, change.puff->species).value_or(0);
    const double power = scene.species.empty() ? 1.0 : scene.species[kind].mean_power(dimension);
    volumes += change.puff->count * packing_fraction(dimension, power);
  }
  return volumes / (scene.box.prod() / scene.box[0] * position);
}

}  // namespace clatter
