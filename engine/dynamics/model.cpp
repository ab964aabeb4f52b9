#include "engine/dynamics/model.h"

#include <algorithm>

namespace clatter {

template <int D>
Model<D> model_of(const Scene& scene, std::uint64_t seed) {
  Model<D> model;
  model.box = scene.box;
  std::copy_n(scene.walls.begin(), model.walls.size(), model.walls.begin());
  model.restitution = scene.particles.restitution;
  model.roughness = scene.particles.roughness;
  model.inertia = scene.particles.inertia;
  model.spins = scene.spins();
  model.gravity = scene.gravity ? Vec<D>(*scene.gravity) : Vec<D>(Vec<D>::Zero());
  model.bulk_drive = scene.bulk_drive;
  model.contact_time = scene.contact_time;
  model.seed = seed;
  return model;
}

template Model<2> model_of(const Scene&, std::uint64_t);
template Model<3> model_of(const Scene&, std::uint64_t);

}  // namespace clatter
