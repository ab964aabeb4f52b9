#include "engine/scene/puff.h"

#include "engine/scene/nudge.h"
#include "engine/scene/scene.h"

namespace clatter {

void check_puff(const Puff& puff, const Scene& scene,
                const std::function<Place(std::string_view key)>& place_of) {
  check_size(puff.centre, scene, "puff", "centre", place_of("centre"));
  if (puff.velocity) check_size(*puff.velocity, scene, "puff", "velocity", place_of("velocity"));
  check_centre(puff.centre, scene, "puff", place_of("centre"));
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

}  // namespace clatter
