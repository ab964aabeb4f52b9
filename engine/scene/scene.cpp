#include "engine/scene/scene.h"

#include "engine/physics/theory.h"

namespace clatter {

double Scene::packing_fraction() const {
  return clatter::packing_fraction(dimension(), particles.count / box.prod());
}

VecX Scene::clear_corner() const {
  VecX corner = VecX::Zero(dimension());
  for (int axis = 0; axis < dimension(); ++axis) {
    if (const auto& wall = walls[2 * axis]) corner[axis] = wall->innermost_travel();
  }
  return corner;
}

VecX Scene::clear_box() const {
  VecX size = box - clear_corner();
  for (int axis = 0; axis < dimension(); ++axis) {
    if (const auto& wall = walls[2 * axis + 1]) size[axis] -= wall->innermost_travel();
  }
  return size;
}

bool View::hides(OverlayPart part) const {
  return std::ranges::find(overlay_hides, part) != overlay_hides.end();
}

bool View::hide_spins() {
  const bool colours = colour_by == ColourBy::Spin;
  const bool maps = field && of_spins(*field);
  if (colours) colour_by = ColourBy::Speed;
  if (maps) field.reset();
  return colours || maps;
}

bool Scene::spins() const {
  bool any = particles.roughness.any();
  for (const auto& wall : walls) any = any || (wall && wall->roughness.any());
  return any;
}

Scene default_scene(int dimension) {
  Scene scene;
  if (dimension == 2) return scene;
  scene.box = Vec<3>(20.0, 20.0, 20.0);
  scene.particles.inertia = 0.4;
  scene.measure.cells = {20, 20, 20};
  return scene;
}

std::optional<double> Measure::sampling_interval(ObservableKind kind) const {
  switch (kind) {
    case ObservableKind::RadialDistribution:
      return radial_distribution.interval;
    case ObservableKind::VelocityDistribution:
      return velocity_distribution.interval;
    case ObservableKind::MeanSquaredDisplacement:
      return mean_squared_displacement.interval;
    case ObservableKind::VelocityAutocorrelation:
      return velocity_autocorrelation.interval;
    case ObservableKind::StructureFactor:
      return structure_factor.interval;
    case ObservableKind::Clusters:
      return clusters.interval;
    case ObservableKind::BondOrder:
      return bond_order.lags_in_time.interval;
    case ObservableKind::WallPower:
      return wall_power.interval;
    case ObservableKind::PlaneCurrent:
      return plane_current.interval;
    case ObservableKind::LocalDensity:
      return local_density.interval;
    case ObservableKind::SpinDistribution:
      return spin_distribution.interval;
    case ObservableKind::Probe:
      return probe.interval;
    case ObservableKind::CollisionCounts:
      return collision_counts.interval;
    case ObservableKind::RadialDistributionProfile:
      return radial_distribution_profile.interval;
    case ObservableKind::FreeFlights:
    case ObservableKind::Collisions:
    case ObservableKind::WallHits:
      break;
  }
  return {};
}

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
