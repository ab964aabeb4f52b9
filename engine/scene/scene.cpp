#include "engine/scene/scene.h"

#include <algorithm>
#include <cmath>

#include "engine/physics/theory.h"

namespace clatter {

double Scene::packing_fraction() const {
  double of_diameters = species.empty() ? particles.count : 0.0;  // sum of d^D
  for (const Species& one : species) of_diameters += one.count * one.mean_power(dimension());
  return clatter::packing_fraction(dimension(), of_diameters / box.prod());
}

View Scene::adapted(View of_other, const std::vector<Species>& others) const {
  if (shear_rate && of_other.field && is_residual(*of_other.field)) of_other.field.reset();
  if (!of_other.field || of_other.field->species == Field::kNone) return of_other;
  const auto number = static_cast<std::size_t>(of_other.field->species);
  const auto own =
      number < others.size() ? find_species(species, others[number].name) : std::nullopt;
  if (own) {
    of_other.field = of_other.field->of(*own);
  } else {
    of_other.field.reset();
  }
  return of_other;
}

double Scene::largest_diameter() const {
  double largest = species.empty() ? 1.0 : 0.0;
  for (const Species& one : species) largest = std::max(largest, one.largest_diameter());
  return largest;
}

Grain Scene::grain(std::size_t number_of_species, int number, int of) const {
  const Species& kind = species[number_of_species];
  const double diameter = kind.diameter_of(number, of);
  const double ratio = diameter / kind.diameter;
  const double volume = dimension() == 2 ? ratio * ratio : ratio * ratio * ratio;
  return {.radius = 0.5 * diameter,
          .mass = kind.mass_in(dimension()) * volume,
          .inertia = kind.inertia.value_or(particles.inertia),
          .species = static_cast<std::uint32_t>(number_of_species)};
}

PairLaw Scene::pair_law(std::size_t first, std::size_t second) const {
  PairLaw law{particles.restitution, particles.roughness};
  if (species.empty()) return law;
  const std::string &a = species[first].name, &b = species[second].name;
  for (const SpeciesPair& pair : pairs) {
    const bool same = (pair.species[0] == a && pair.species[1] == b) ||
                      (pair.species[0] == b && pair.species[1] == a);
    if (!same) continue;
    law.restitution = pair.restitution.value_or(law.restitution);
    law.roughness = with_differences(law.roughness, pair.roughness);
  }
  return law;
}

Wall Scene::wall(int side, std::size_t number) const {
  const auto& differences = species_walls[static_cast<std::size_t>(side)];
  if (number >= differences.size()) return *walls[static_cast<std::size_t>(side)];
  return wall_of_species(*walls[static_cast<std::size_t>(side)], differences[number]);
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
  const std::size_t kinds = std::max<std::size_t>(species.size(), 1);
  for (std::size_t a = 0; a < kinds; ++a) {
    for (std::size_t b = 0; b <= a; ++b) any = any || pair_law(a, b).roughness.any();
    for (int side = 0; side < 2 * dimension(); ++side) {
      any = any || (walls[side] && wall(side, a).roughness.any());
    }
    for (const Obstacle& one : obstacles) any = any || one.law.wall(a).roughness.any();
    for (const Partition& one : partitions) any = any || one.law.wall(a).roughness.any();
    any = any || (piston && piston->law.wall(a).roughness.any());
  }
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
    case ObservableKind::Mixing:
      return mixing.interval;
    case ObservableKind::FreeFlights:
    case ObservableKind::Collisions:
    case ObservableKind::WallHits:
      break;
  }
  return {};
}

template <int D>
static SpeciesLaws<D> species_laws(const Scene& scene) {
  SpeciesLaws<D> laws;
  for (std::size_t a = 0; a < scene.species.size(); ++a) {
    laws.names.push_back(scene.species[a].name);
    for (std::size_t b = 0; b < scene.species.size(); ++b) {
      laws.pairs.push_back(scene.pair_law(a, b));
    }
    auto& walls = laws.walls.emplace_back();
    for (int side = 0; side < 2 * D; ++side) {
      if (scene.walls[side]) walls[side] = scene.wall(side, a);
    }
  }
  return laws;
}

static FreePiston free_piston_of(const Scene& scene) {
  const Piston& piston = *scene.piston;
  FreePiston free{.axis = static_cast<int>(piston.axis),
                  .mass = piston.mass,
                  .thickness = piston.thickness,
                  .force = piston.force,
                  .pinned = piston.pinned,
                  .position = piston.position,
                  .speed = piston.speed,
                  .law = piston.law.wall()};
  for (std::size_t k = 0; k < scene.species.size(); ++k) {
    free.of_species.push_back(piston.law.wall(k));
  }
  return free;
}

std::optional<Divider> divider_of(const Scene& scene) {
  if (const auto& piston = scene.piston) {
    return Divider{static_cast<int>(piston->axis), piston->position, piston->thickness};
  }
  for (const Partition& partition : scene.partitions) {
    const int axis = static_cast<int>(partition.axis);
    if (!scene.periodic(axis)) return Divider{axis, partition.position, 0.0};
  }
  return std::nullopt;
}

bool starts_divided(const Scene& scene) {
  const bool given =
      scene.particles.count_left || std::ranges::any_of(scene.species, [](const Species& species) {
        return species.count_left.has_value();
      });
  return scene.piston || (given && divider_of(scene));
}

int count_left(const Scene& scene, std::size_t species) {
  const Divider divider = *divider_of(scene);
  const bool mixed = !scene.species.empty();
  const int count = mixed ? scene.species[species].count : scene.particles.count;
  const auto& given = mixed ? scene.species[species].count_left : scene.particles.count_left;
  if (given) return std::min(*given, count);
  const double low = scene.clear_corner()[divider.axis], size = scene.clear_box()[divider.axis];
  const double free = divider.position - 0.5 * divider.thickness - low;
  return static_cast<int>(std::lround(count * free / (size - divider.thickness)));
}

template <int D>
StartSide<D> start_side(const Scene& scene, int side) {
  const Divider divider = *divider_of(scene);
  StartSide<D> made{scene.clear_corner(), scene.start_room<D>()};
  double& low = made.corner[divider.axis];
  double& length = made.room.box[divider.axis];
  const double high = low + length;
  const double face = divider.position + (side == 0 ? -0.5 : 0.5) * divider.thickness;
  if (side == 1) low = face;
  length = (side == 0 ? face : high) - low;
  made.room.walled[divider.axis] = true;
  return made;
}

template StartSide<2> start_side(const Scene&, int);
template StartSide<3> start_side(const Scene&, int);

template <int D>
Model<D> model_of(const Scene& scene, std::uint64_t seed) {
  Model<D> model;
  model.box = scene.box;
  std::copy_n(scene.walls.begin(), model.walls.size(), model.walls.begin());
  model.diameter = scene.largest_diameter();
  model.restitution = scene.particles.restitution;
  model.roughness = scene.particles.roughness;
  model.inertia = scene.particles.inertia;
  if (!scene.species.empty()) model.species = species_laws<D>(scene);
  if (scene.has_fixtures()) model.fixtures = fixtures_of<D>(scene);
  if (scene.piston) model.free_piston = free_piston_of(scene);
  model.spins = scene.spins();
  model.gravity = scene.gravity ? Vec<D>(*scene.gravity) : Vec<D>(Vec<D>::Zero());
  model.shear_rate = scene.shear_rate;
  model.bulk_drive = scene.bulk_drive;
  model.contact_time = scene.contact_time;
  model.seed = seed;
  return model;
}

template Model<2> model_of(const Scene&, std::uint64_t);
template Model<3> model_of(const Scene&, std::uint64_t);

}  // namespace clatter
