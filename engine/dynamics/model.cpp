#include "engine/dynamics/model.h"

namespace clatter {

Model<2> model_of(const Scene& scene, std::uint64_t seed) {
  Model<2> model;
  model.box = scene.box;
  model.walls = scene.walls;
  model.restitution = scene.disks.restitution;
  model.seed = seed;
  return model;
}

}  // namespace clatter
