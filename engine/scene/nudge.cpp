#include "engine/scene/nudge.h"

#include <string>

#include "engine/scene/enum_names.h"
#include "engine/scene/scene.h"
#include "engine/scene/text.h"

namespace clatter {

// Whether the number of particles is unknown, because the file of the start state was not read.
static bool is_uncounted(const Scene& scene) {
  const Start& start = scene.particles.start;
  return start.layout == Layout::File && particle_count(start.state) == 0;
}

void check_nudge(const Nudge& nudge, const Scene& scene,
                 const std::function<Place(std::string_view key)>& place_of) {
  const int dimension = scene.dimension();
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
  const auto check_size = [&](std::string_view key, const std::optional<VecX>& vector) {
    if (!vector || vector->size() == dimension) return;
    throw UserError(place_of(key),
                    "'" + std::string(key) + "' of the nudge has " +
                        std::to_string(vector->size()) + " numbers",
                    "give " + std::to_string(dimension) + ", as in box.size");
  };
  check_size("centre", nudge.centre);
  check_size("add", nudge.add);
  check_size("set", nudge.set);
  for (int axis = 0; nudge.centre && axis < dimension; ++axis) {
    const double place = (*nudge.centre)[axis], side = scene.box[axis];
    if (place >= 0.0 && place <= side) continue;
    throw UserError(place_of("centre"),
                    "the centre of the nudge is outside of the box, at " + number_text(place) +
                        " along " + std::string(kAxes[static_cast<std::size_t>(axis)].name),
                    "choose a number from 0 to " + number_text(side));
  }
  if (nudge.particle && *nudge.particle >= scene.particles.count && !is_uncounted(scene)) {
    throw UserError(place_of("particle"), "there is no particle " + std::to_string(*nudge.particle),
                    particle_numbers(scene.particles.count));
  }
}

}  // namespace clatter
