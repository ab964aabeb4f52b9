#include "engine/dynamics/model.h"

namespace clatter {

Model<2> model_of(const Scene& scene, std::uint64_t seed) {
  Model<2> model;
  model.box = scene.box;
  model.walls = scene.walls;
  model.restitution = scene.particles.restitution;
  model.roughness = scene.particles.roughness;
  model.inertia = scene.particles.inertia;
  model.spins = scene.spins();
  model.gravity = scene.gravity.value_or(Vec2::Zero());
  model.bulk_drive = scene.bulk_drive;
  model.contact_time = scene.contact_time;
  model.seed = seed;
  return model;
}

}  // namespace clatter
