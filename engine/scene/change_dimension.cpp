#include "engine/scene/change_dimension.h"

#include <algorithm>
#include <cmath>

#include "engine/scene/field.h"
#include "engine/scene/scene_file.h"

namespace clatter {

namespace {

VecX changed_box(const Scene& scene, int dimension) {
  const double shortest = 2.0 * scene.largest_diameter();  // of all sides
  VecX box(dimension);
  for (int axis = 0; axis < dimension; ++axis) box[axis] = scene.box[std::min(axis, 1)];
  const double filled = std::min(scene.packing_fraction(), kMostFilled);
  if (filled > 0.0) {
    Scene in_box = scene;
    in_box.box = box;
    const double now = in_box.packing_fraction();
    box *= std::pow(now / filled, 1.0 / dimension);
  }
  box *= std::max(1.0, shortest / box.minCoeff());
  return (10.0 * box.array()).round() / 10.0;
}

bool has_axis(const Override& setting, int dimension) {
  for (const char* const table : {"gravity", "obstacle.", "partition."}) {
    if (setting.key.starts_with(table)) return false;
  }
  for (int side = 2 * dimension; side < 6; ++side) {
    if (setting.key.starts_with(std::string("walls.") + kSideNames[side])) return false;
  }
  return true;
}

// Removes settings without meaning from the scheduled changes. Returns whether there were any.
bool remove_settings(std::vector<Change>& changes, int dimension) {
  std::size_t removed = 0;
  for (Change& change : changes) {
    removed += std::erase_if(
        change.set, [&](const Override& setting) { return !has_axis(setting, dimension); });
    removed += change.nudge.has_value();
    change.nudge.reset();
    removed += change.piston.has_value();
    removed += change.puff.has_value();
  }
  std::erase_if(changes, [](const Change& c) { return c.set.empty() && !c.reverse; });
  return removed > 0;
}

VecX with_depth(const VecX& place, double depth) {
  VecX deep(3);
  deep << place.head<2>(), depth;
  return deep;
}

// Gives a ball the middle of the depth, and a box all of it.
void change_obstacle(Obstacle& obstacle, const VecX& ratio, double depth, bool flat) {
  constexpr double kShare = 0.45;  // of the depth: balls do not reach their images
  for (VecX* place : {&obstacle.centre, &obstacle.from, &obstacle.to}) {
    *place = VecX(place->head<2>().cwiseProduct(ratio));
  }
  obstacle.radius *= ratio.minCoeff();
  if (flat) return;
  obstacle.radius = std::min(obstacle.radius, kShare * depth);
  obstacle.centre = with_depth(obstacle.centre, 0.5 * depth);
  obstacle.from = with_depth(obstacle.from, 0.0);
  obstacle.to = with_depth(obstacle.to, depth);
}

// Gives holes all of the depth. Without a depth holes may meet; then the first one stays.
void change_partition(Partition& partition, const VecX& ratio, const VecX& box) {
  const int across = static_cast<int>(partition.axis), along = 1 - across;
  partition.position *= ratio[across];
  std::vector<Hole> holes;
  for (Hole hole : partition.holes) {
    hole.from = {hole.from[0] * ratio[along]};
    hole.to = {std::min(hole.to[0] * ratio[along], box[along])};
    const bool meets = std::ranges::any_of(holes, [&](const Hole& other) {
      return hole.from[0] <= other.to[0] && other.from[0] <= hole.to[0];
    });
    if (meets) continue;
    if (box.size() == 3) {
      hole.from.push_back(0.0);
      hole.to.push_back(box[2]);
    }
    holes.push_back(hole);
  }
  partition.holes = holes;
}

// Gives fixtures their places in the changed box. Fixtures that have none are removed; then all
// keep their names. Returns whether there were any.
bool change_fixtures(Scene& made, const VecX& former_box) {
  const bool flat = made.dimension() == 2;
  const VecX ratio = made.box.head<2>().cwiseQuotient(former_box.head<2>());
  const double depth = flat ? 0.0 : made.box[2];
  for (std::size_t k = 0; k < made.obstacles.size(); ++k) {
    made.obstacles[k].name = obstacle_name(made.obstacles[k], k);
    change_obstacle(made.obstacles[k], ratio, depth, flat);
  }
  for (std::size_t k = 0; k < made.partitions.size(); ++k) {
    made.partitions[k].name = partition_name(made.partitions[k], k);
  }
  std::size_t removed = 0;
  if (flat) {
    removed +=
        std::erase_if(made.partitions, [](const Partition& one) { return one.axis == Axis::Z; });
  } else {
    removed += std::erase_if(made.obstacles,
                             [](const Obstacle& one) { return one.kind == ObstacleKind::Polygon; });
  }
  for (Partition& one : made.partitions) change_partition(one, ratio, made.box);
  return removed > 0;
}

bool is_among(Field field, const std::vector<NamedField>& names) {
  return std::ranges::find(names, field, &NamedField::second) != names.end();
}

}  // namespace

ChangedDimension change_dimension(const Scene& scene, int dimension) {
  ChangedDimension changed{scene, {}};
  Scene& made = changed.scene;
  const auto remove_if = [&](bool meaningless, const char* key, const auto& remove) {
    if (!meaningless) return;
    remove();
    changed.removed.emplace_back(key);
  };
  made.box = changed_box(scene, dimension);
  for (auto& wall : made.walls) {
    if (wall && dimension == 2) wall->surface_velocity[2] = 0.0;
  }
  const bool flat = dimension == 2;
  remove_if(change_fixtures(made, scene.box), "obstacle or partition", [] {});
  remove_if(flat && made.piston && made.piston->axis == Axis::Z, "piston",
            [&] { made.piston.reset(); });
  if (made.piston && made.piston->axis != Axis::Z) {
    const int axis = static_cast<int>(made.piston->axis);
    made.piston->position *= made.box[axis] / scene.box[axis];
    made.piston->thickness *= made.box[axis] / scene.box[axis];
  }
  if (!divider_of(made)) {
    made.particles.count_left.reset();
    for (Species& species : made.species) species.count_left.reset();
    std::erase(made.view.plots, FilmPlot::Compartments);
  }
  if (!made.piston) {
    std::erase(made.view.plots, FilmPlot::Piston);
    for (Change& change : made.changes) {
      std::erase_if(change.set, [](const Override& one) { return one.key.starts_with("piston."); });
    }
  }

  Start& start = made.particles.start;
  remove_if(start.layout == Layout::File, "particles.start.file",
            [&] { start = Start{.file = "", .temperature = start.temperature}; });
  const double usual_inertia = default_scene(scene.dimension()).particles.inertia;
  if (made.particles.inertia == usual_inertia) {
    made.particles.inertia = default_scene(dimension).particles.inertia;
  }
  for (const Side side : {kBack, kFront}) {
    const std::string key = std::string("walls.") + kSideNames[side];
    remove_if(flat && made.walls[side], key.c_str(), [&] { made.walls[side].reset(); });
  }
  if (made.gravity) {
    VecX along = VecX::Zero(dimension);
    along.head<2>() = scene.gravity->head<2>();
    remove_if(flat && scene.gravity->z() != 0.0, "gravity.acceleration along z", [] {});
    made.gravity = along;
  }

  Measure& measure = made.measure;
  measure.cells.resize(static_cast<std::size_t>(dimension), measure.cells[1]);
  remove_if(flat && measure.profile_axis == Axis::Z, "measure.profile_axis",
            [&] { measure.profile_axis = Axis::X; });
  remove_if(flat && measure.plane_current.axis == Axis::Z, "measure.plane_current.axis",
            [&] { measure.plane_current.axis = Axis::X; });
  remove_if(flat && measure.radial_distribution_profile.axis == Axis::Z,
            "measure.radial_distribution_profile.axis",
            [&] { measure.radial_distribution_profile.axis = Axis::X; });
  const auto remove_region = [&](RegionSettings& region, const char* key) {
    remove_if(region.lower || region.upper, key, [&] { region = {}; });
  };
  remove_region(measure.velocity_distribution.region, "region of measure.velocity_distribution");
  remove_region(measure.probe.region, "region of measure.probe");
  remove_if(!flat && measure.observes(ObservableKind::BondOrder),
            "\"bond_order\" in measure.observables",
            [&] { std::erase(measure.observables, ObservableKind::BondOrder); });
  const auto measured = measured_names(dimension);
  const auto unknown = [&](Field field) { return !is_among(field, measured); };
  remove_if(std::ranges::any_of(measure.fields, unknown), "measure.fields",
            [&] { std::erase_if(measure.fields, unknown); });

  View& view = made.view;
  remove_if(flat && (view.colour_by == ColourBy::VelocityZ || view.colour_by == ColourBy::Depth),
            "view.colour_by", [&] { view.colour_by = ColourBy::Speed; });
  remove_if(view.field && !is_among(*view.field, field_names(dimension, names_of(made.species))),
            "view.field", [&] { view.field.reset(); });
  remove_if(flat && view.slab, "view.slab", [&] { view.slab.reset(); });
  remove_if(flat && !view.slices.empty(), "view.slices", [&] { view.slices.clear(); });
  remove_if(flat && view.volume > 0.0, "view.volume", [&] { view.volume = 0.0; });
  remove_if(!flat && view.tiling, "view.tiling", [&] { view.tiling = false; });
  remove_if(!view.camera.empty(), "view.camera", [&] { view.camera.clear(); });
  remove_if(remove_settings(made.changes, dimension), "change", [] {});
  made = with_settings(made, {});
  return changed;
}

}  // namespace clatter
