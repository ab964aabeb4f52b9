#include "engine/scene/scene.h"

#include <numbers>

namespace clatter {

double Scene::area_fraction() const {
  return disks.count * std::numbers::pi / (4.0 * box.x() * box.y());
}

}  // namespace clatter
