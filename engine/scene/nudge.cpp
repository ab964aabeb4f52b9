#include "engine/scene/nudge.h"

#include <string>

#include "engine/scene/enum_names.h"
#include "engine/scene/scene.h"
#include "engine/scene/text.h"

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

}  // namespace clatter
