#include "app/view/lecture.h"

namespace clatter {

// The slider of a wall that drives the gas; empty: it drives nothing.
static std::string drive_of(const Wall& wall) {
  switch (wall.kind) {
    case WallKind::Driven:
      return "drive_speed";
    case WallKind::Thermal:
      return "temperature";
    case WallKind::Sawtooth:
    case WallKind::Sinusoidal:
      return "frequency";
    case WallKind::Static:
      break;
  }
  return {};
}

std::vector<std::string> usual_sliders(const Scene& scene) {
  std::vector<std::string> names;
  if (scene.particles.restitution < 1.0) names.emplace_back("particles.restitution");
  for (std::size_t side = 0; side < scene.walls.size(); ++side) {
    if (!scene.walls[side]) continue;
    const std::string drive = drive_of(*scene.walls[side]);
    if (!drive.empty()) names.push_back(std::string("walls.") + kSideNames[side] + '.' + drive);
  }
  if (scene.bulk_drive) names.emplace_back("bulk_drive.kick_speed");
  for (int axis = 0; scene.gravity && axis < scene.dimension(); ++axis) {
    if ((*scene.gravity)[axis] != 0.0) {
      names.push_back(std::string("gravity.acceleration.") + "xyz"[axis]);
    }
  }
  if (scene.particles.restitution == 1.0) names.emplace_back("particles.restitution");
  if (scene.particles.start.layout != Layout::File && scene.species.empty())
    names.emplace_back("particles.count");
  if (names.size() > Lecture::kMostSliders) names.resize(Lecture::kMostSliders);
  return names;
}

}  // namespace clatter
