#include "engine/scene/scene_checks.h"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <set>

#include "engine/dimension.h"
#include "engine/error.h"
#include "engine/physics/lattice.h"
#include "engine/physics/theory.h"
#include "engine/scene/act_checks.h"
#include "engine/scene/enum_names.h"
#include "engine/scene/limits.h"
#include "engine/scene/marked_text.h"
#include "engine/scene/scene_document.h"
#include "engine/text.h"

namespace clatter {

static std::string wall_path(int side) {
  return std::string("walls.") + kSideNames[side];
}

/// Throws if a wall has no opposite wall.
static void check_pairs(const Scene& scene, const toml::table& root, const std::string& file) {
  for (int side = 0; side < 2 * scene.dimension(); ++side) {
    if (!scene.walls[side] || scene.walls[side ^ 1]) continue;
    const std::string path = wall_path(side);
    throw UserError(place_of(root, path, file), "[" + path + "] has no wall opposite",
                    "add [" + wall_path(side ^ 1) + "], or remove this one for a periodic axis");
  }
}

/// Largest speed of a wall's motion.
static double top_speed(const Wall& wall) {
  const double speed = wall.stroke * wall.frequency;
  return wall.kind == WallKind::Sinusoidal ? std::numbers::pi * speed : speed;
}

/// Throws if a wall's surface would move across the wall.
static void check_surfaces(const Scene& scene, const toml::table& root, const std::string& file) {
  for (int side = 0; side < 2 * scene.dimension(); ++side) {
    const auto& wall = scene.walls[side];
    const auto axis = static_cast<std::size_t>(side / 2);
    if (!wall || wall->surface_velocity[axis] == 0.0) continue;
    throw UserError(
        place_of(root, wall_path(side) + ".surface_velocity", file),
        "the surface would move across its wall, along " + std::string(kAxes[axis].name),
        "set this component to 0: the surface slides along the wall");
  }
}

static void check_speeds(const Scene& scene, const toml::table& root, const std::string& file) {
  for (int side = 0; side < 2 * scene.dimension(); ++side) {
    const auto& wall = scene.walls[side];
    if (!wall || !wall->moves() || top_speed(*wall) <= kMaxSpeed) continue;
    throw UserError(
        place_of(root, wall_path(side) + ".frequency", file),
        "the wall would move at a speed of " + number_text(top_speed(*wall)),
        "lower its stroke or its frequency: walls move at " + number_text(kMaxSpeed) + " at most");
  }
}

/// Throws if a side of the box, or the room between moving walls, is too short for a particle.
static void check_room(const Scene& scene, const toml::table& root, const std::string& file) {
  const double largest = scene.largest_diameter();
  for (int axis = 0; axis < scene.dimension(); ++axis) {
    const double room = scene.clear_box()[axis];
    if (room > largest) continue;
    if (scene.box[axis] <= largest) {
      throw UserError(place_of(root, "box.size", file),
                      "the side " + number_text(scene.box[axis]) +
                          " of the box is not longer than the largest diameter, " +
                          number_text(largest),
                      "choose a longer side, or smaller particles");
    }
    const int near = 2 * axis, far = near + 1;
    const bool far_goes_farther =
        scene.walls[far]->innermost_travel() > scene.walls[near]->innermost_travel();
    throw UserError(place_of(root, wall_path(far_goes_farther ? far : near) + ".stroke", file),
                    "where the walls move farthest in, " + number_text(room) +
                        " diameters are left between them",
                    "choose a smaller stroke or a larger box, so that it is more than " +
                        (largest == 1.0 ? std::string("one") : number_text(largest)));
  }
}

static void check_colour(const Scene& scene, const toml::table& root, const std::string& file) {
  const ColourBy colour_by = scene.view.colour_by;
  if ((colour_by == ColourBy::VelocityZ || colour_by == ColourBy::Depth) &&
      scene.dimension() == 2) {
    throw UserError(place_of(root, "view.colour_by", file),
                    "disks have no velocity along z and no depth",
                    "choose another quantity, or give box.size a third number");
  }
  const bool of_mixtures = colour_by == ColourBy::Species || colour_by == ColourBy::Diameter;
  if (of_mixtures && scene.species.empty()) {
    throw UserError(place_of(root, "view.colour_by", file),
                    "the particles have no species, and are alike",
                    "choose another quantity, or give the scene [[species]]");
  }
  if (colour_by != ColourBy::Spin || scene.spins()) return;
  throw UserError(place_of(root, "view.colour_by", file),
                  std::string("the colour \"spin\" ") + kNotWithoutSpins.reason,
                  "choose another, or make the particles or a wall rough");
}

/// Throws if a field or an observable of spins is requested and no particle spins.
static void check_fields(const Scene& scene, const toml::table& root, const std::string& file) {
  if (scene.spins()) return;
  const auto refuse = [&](const char* path) {
    throw UserError(place_of(root, path, file),
                    std::string("a field of spins ") + kNotWithoutSpins.reason,
                    "choose another, or make the particles or a wall rough");
  };
  if (scene.measure.observes(ObservableKind::SpinDistribution)) {
    throw UserError(place_of(root, "measure.observables", file),
                    std::string("\"spin_distribution\" ") + kNotWithoutSpins.reason,
                    "remove it, or make the particles or a wall rough");
  }
  if (std::ranges::any_of(scene.measure.fields, of_spins)) refuse("measure.fields");
  if (scene.view.field && of_spins(*scene.view.field)) refuse("view.field");
}

/// Throws if a field of species is requested in a gas without any.
static void check_drag(const Scene& scene, const toml::table& root, const std::string& file) {
  const bool drag = std::ranges::any_of(
      scene.measure.fields, [](Field field) { return of_species_alone(field.quantity); });
  if (!drag || !scene.species.empty()) return;
  throw UserError(place_of(root, "measure.fields", file),
                  "\"drag\" is the force on a species by the others, and there is none",
                  "add [[species]], or remove it");
}

/// Throws if a Gaussian kernel is used with the exact estimator, or is too narrow for the cells.
static void check_kernel(const Scene& scene, const toml::table& root, const std::string& file) {
  const Measure& measure = scene.measure;
  if (measure.kernel == Kernel::Box) return;
  if (measure.estimator == Estimator::Exact) {
    throw UserError(place_of(root, "measure.kernel", file),
                    "the Gaussian kernel has no meaning for the exact estimator",
                    "set measure.estimator = \"snapshot\" and measure.interval, or remove it");
  }
  for (int axis = 0; axis < scene.dimension(); ++axis) {
    const double cell = scene.box[axis] / measure.cells[static_cast<std::size_t>(axis)];
    if (2.0 * measure.width >= cell) continue;
    throw UserError(place_of(root, "measure.width", file),
                    "the Gaussian falls between the centres of cells of " + number_text(cell),
                    "choose at least " + number_text(0.5 * cell) + ", or more cells");
  }
}

/// Throws if the box has no wave vectors, or too many.
static void check_wave_vectors(const Scene& scene, const toml::table& root,
                               const std::string& file) {
  constexpr double kMostWaves = 1e4;  // along the longest axis
  double longest = 0.0;
  for (int axis = 0; axis < scene.dimension(); ++axis) {
    if (scene.periodic(axis)) longest = std::max(longest, scene.box[axis]);
  }
  if (longest == 0.0) {
    throw UserError(place_of(root, "measure.observables", file),
                    "\"structure_factor\" needs a periodic axis",
                    "remove it, or two opposite walls");
  }
  const double largest = 2.0 * std::numbers::pi * kMostWaves / longest;
  if (scene.measure.structure_factor.range <= largest) return;
  throw UserError(place_of(root, "measure.structure_factor.range", file),
                  "there would be more than 1e4 waves along the box",
                  "choose at most " + number_text(largest));
}

/// Throws unless a region has a volume in the box. Absent corners are at `lower` and `upper` as
/// shares of the box.
static void check_region(const Scene& scene, const RegionSettings& region, const std::string& table,
                         double lower, double upper, const toml::table& root,
                         const std::string& file) {
  const auto check_corner = [&](const std::optional<VecX>& corner, const std::string& key) {
    if (!corner || corner->size() == scene.dimension()) return;
    throw UserError(place_of(root, table + key, file),
                    "the corner has " + std::to_string(corner->size()) + " numbers",
                    "give " + std::to_string(scene.dimension()) + ", as in box.size");
  };
  check_corner(region.lower, ".lower");
  check_corner(region.upper, ".upper");
  const VecX low = region.lower.value_or(lower * scene.box);
  const VecX high = region.upper.value_or(upper * scene.box);
  for (int axis = 0; axis < scene.dimension(); ++axis) {
    if (low[axis] < high[axis] && high[axis] <= scene.box[axis]) continue;
    throw UserError(place_of(root, table + (region.upper ? ".upper" : ".lower"), file),
                    "the region from " + number_text(low[axis]) + " to " + number_text(high[axis]) +
                        " along " + std::string(kAxes[static_cast<std::size_t>(axis)].name) +
                        " is not in the box",
                    "choose lower < upper, both from 0 to " + number_text(scene.box[axis]));
  }
}

/// Throws if an observable of distances is requested of a mixture of sizes, for which it is not
/// made.
static void check_equal_diameters(const Scene& scene, const toml::table& root,
                                  const std::string& file) {
  const double largest = scene.largest_diameter();
  const bool equal = std::ranges::all_of(scene.species, [&](const Species& species) {
    return species.smallest_diameter() == largest;
  });
  if (equal) return;
  const auto refuse = [&](const char* problem, const char* fix) {
    throw UserError(place_of(root, "measure.observables", file), problem, fix);
  };
  if (scene.measure.observes(ObservableKind::RadialDistributionProfile)) {
    refuse(
        "\"radial_distribution_profile\" is for particles of one diameter, and the species have "
        "several",
        "remove it, or give all species one diameter");
  }
  const bool walled =
      std::ranges::any_of(scene.walls, [](const auto& wall) { return wall.has_value(); });
  if (walled && scene.measure.observes(ObservableKind::RadialDistribution)) {
    refuse("\"radial_distribution\" of species of several diameters needs a box without walls",
           "remove it or the walls, or give all species one diameter");
  }
}

/// Throws if two fields of a mixture would have the same name in files.
static void check_species_fields(const Scene& scene, const toml::table& root,
                                 const std::string& file) {
  std::vector<Field> fields = all_fields(scene.dimension());
  std::erase_if(fields, [&](Field field) {
    return std::ranges::find(scene.measure.fields, field) == scene.measure.fields.end();
  });
  std::set<std::string> names;
  for (const Field field : fields) names.insert(name_of(field));
  for (const Species& species : scene.species) {
    for (const Field field : fields) {
      const std::string name = name_of(field, species.name);
      if (!has_species(field.quantity) || names.insert(name).second) continue;
      throw UserError(place_of(root, "measure.fields", file),
                      "of the species '" + species.name + "' a field would have the name \"" +
                          name + "\", which another one has",
                      "choose another name of the species");
    }
  }
}

/// Throws if the box is too small for the observables, or a longest lag is shorter than its
/// interval.
static void check_observables(const Scene& scene, const toml::table& root,
                              const std::string& file) {
  const Measure& measure = scene.measure;
  const double diameter = scene.largest_diameter();
  const auto check_range = [&](ObservableKind kind, const char* key, double range) {
    if (!measure.observes(kind) || range > diameter) return;
    throw UserError(place_of(root, key, file),
                    "the range " + number_text(range) + " is not above the largest diameter",
                    "choose more than " + number_text(diameter));
  };
  check_range(ObservableKind::RadialDistribution, "measure.radial_distribution.range",
              measure.radial_distribution.range);
  check_range(ObservableKind::RadialDistributionProfile,
              "measure.radial_distribution_profile.range",
              measure.radial_distribution_profile.range);
  for (int axis = 0; axis < scene.dimension(); ++axis) {
    const double longest =
        scene.periodic(axis) ? 0.5 * scene.box[axis] : scene.box[axis] - diameter;
    for (const ObservableKind kind :
         {ObservableKind::RadialDistribution, ObservableKind::RadialDistributionProfile}) {
      if (!measure.observes(kind) || longest > diameter) continue;
      throw UserError(place_of(root, "measure.observables", file),
                      "the box is too small for the distances of \"" +
                          std::string(name_of(kind, kObservables)) + '"',
                      "remove it, or choose sides above " + number_text(2.0 * diameter));
    }
  }
  const auto check_lags = [&](const std::string& name, const TimeCorrelationSettings& settings) {
    constexpr double kMostIntervals = 1e7;
    const Place place = place_of(root, "measure." + name + ".longest", file);
    if (settings.longest < settings.interval) {
      throw UserError(
          place, "the longest lag is shorter than the interval " + number_text(settings.interval),
          "choose a longer lag, or a shorter interval");
    }
    if (settings.longest > kMostIntervals * settings.interval) {
      throw UserError(place, "the longest lag has more than 1e7 intervals",
                      "choose a lag of at most " + number_text(kMostIntervals * settings.interval) +
                          ", or an interval of at least " +
                          number_text(settings.longest / kMostIntervals));
    }
  };
  check_lags("mean_squared_displacement", measure.mean_squared_displacement);
  check_lags("velocity_autocorrelation", measure.velocity_autocorrelation);
  check_lags("bond_order", measure.bond_order.lags_in_time);
  if (measure.observes(ObservableKind::BondOrder) && scene.dimension() == 3) {
    throw UserError(place_of(root, "measure.observables", file), "\"bond_order\" is for disks only",
                    "remove it");
  }
  if (measure.observes(ObservableKind::Mixing) && scene.species.size() < 2) {
    throw UserError(place_of(root, "measure.observables", file),
                    "\"mixing\" is for mixtures, and the scene has fewer than two species",
                    "remove it, or give the scene two [[species]]");
  }
  if (measure.observes(ObservableKind::StructureFactor)) check_wave_vectors(scene, root, file);
  check_region(scene, measure.velocity_distribution.region, "measure.velocity_distribution", 0.0,
               1.0, root, file);
  check_region(scene, measure.probe.region, "measure.probe", 0.25, 0.75, root, file);
  constexpr double kMostCells = 1e7;
  const auto check_cells = [&](ObservableKind kind, const CellSettings& settings,
                               const std::string& table) {
    if (!measure.observes(kind) || settings.number_of_cells(scene.box) <= kMostCells) return;
    throw UserError(place_of(root, "measure." + table + ".cell", file),
                    "the box has more than 1e7 cells of " + number_text(settings.cell),
                    "choose larger cells");
  };
  check_cells(ObservableKind::LocalDensity, measure.local_density, "local_density");
  check_cells(ObservableKind::Mixing, measure.mixing, "mixing");
}

/// Throws unless the times of a list increase.
template <class Key>
static void check_order(const std::vector<Key>& keys, const char* list, const char* time,
                        const toml::table& root, const std::string& file) {
  for (std::size_t k = 1; k < keys.size(); ++k) {
    if (keys[k].time > keys[k - 1].time) continue;
    throw UserError(
        place_of(root, list, file),
        time + number_text(keys[k].time) + " comes after " + number_text(keys[k - 1].time),
        "give each time once, in order");
  }
}

/// Throws unless the camera's times increase, and its positions have the dimension of the box.
static void check_camera(const Scene& scene, const toml::table& root, const std::string& file) {
  const std::vector<CameraKey>& keys = scene.view.camera;
  for (const CameraKey& key : keys) {
    if (!key.centre || key.centre->size() == scene.dimension()) continue;
    throw UserError(
        place_of(root, "view.camera", file),
        "the centre of the camera has " + std::to_string(key.centre->size()) + " numbers",
        "give " + std::to_string(scene.dimension()) + ", as in box.size");
  }
  check_order(keys, "view.camera", "the camera's time ", root, file);
}

/// Throws unless the pace of films has its times in order.
static void check_pace(const Scene& scene, const toml::table& root, const std::string& file) {
  check_order(scene.view.pace, "view.pace", "the time ", root, file);
}

/// Throws unless the marks of all captions are complete.
static void check_captions(const Scene& scene, const toml::table& root, const std::string& file) {
  for (std::size_t k = 0; k < scene.view.captions.size(); ++k) {
    const std::string problem = marked_text(scene.view.captions[k].text).problem;
    if (problem.empty()) continue;
    const Place list = place_of(root, "view.captions", file);
    const Place place =
        from_override(list) ? list : place_of(*root["view"]["captions"][k].node(), file);
    throw UserError(place, "in the text of a caption " + problem,
                    "write T_x, v^2 or T_{refined}, and a backslash before a plain _ or ^");
  }
}

/// Throws if the box does not have the axis of the profiles, or of the normal of the plane.
static void check_axes(const Scene& scene, const toml::table& root, const std::string& file) {
  const auto check = [&](const std::string& key, Axis axis) {
    if (static_cast<int>(axis) < scene.dimension()) return;
    throw UserError(place_of(root, key, file),
                    "'" + key + "' cannot be \"z\" of a box of two dimensions",
                    "choose \"x\" or \"y\", or give box.size a third number");
  };
  check("measure.profile_axis", scene.measure.profile_axis);
  check("measure.plane_current.axis", scene.measure.plane_current.axis);
  check("measure.radial_distribution_profile.axis", scene.measure.radial_distribution_profile.axis);
}

/// Throws if films have too many plots, or those of species, dividers or observables without them.
static void check_plots(const Scene& scene, const toml::table& root, const std::string& file) {
  for (const FilmPlot plot : {FilmPlot::SpeciesTemperature, FilmPlot::Mixing}) {
    const std::size_t fewest = plot == FilmPlot::Mixing ? 2 : 1;
    if (scene.species.size() >= fewest || !std::ranges::count(scene.view.plots, plot)) continue;
    throw UserError(place_of(root, "view.plots", file),
                    '"' + std::string(name_of(plot, kFilmPlots)) + "\" is for mixtures",
                    "remove it, or give the scene more [[species]]");
  }
  const auto has = [&](FilmPlot plot) { return std::ranges::count(scene.view.plots, plot) > 0; };
  if (has(FilmPlot::Compartments) && !divider_of(scene)) {
    throw UserError(place_of(root, "view.plots", file),
                    "\"compartments\" is for a box that something divides",
                    "remove it, or add [piston], or a [[partition]] between two walls");
  }
  if (has(FilmPlot::Piston) && !scene.piston) {
    throw UserError(place_of(root, "view.plots", file), "\"piston\" is for a free piston",
                    "remove it, or add the table [piston]");
  }
  for (const FilmPlot plot : scene.view.plots) {
    const auto observable = observable_of(plot);
    if (!observable || scene.measure.observes(*observable)) continue;
    const std::string name = '"' + std::string(name_of(plot, kFilmPlots)) + '"';
    throw UserError(place_of(root, "view.plots", file), name + " is a plot of an observable",
                    "remove it, or add " + name + " to measure.observables");
  }
  if (scene.view.plots.size() <= View::kMostPlots) return;
  throw UserError(place_of(root, "view.plots", file),
                  "films have at most " + std::to_string(View::kMostPlots) + " plots",
                  "remove some of view.plots");
}

/// Throws if a sheared box has something, or a measurement, that sliding images cannot have.
static void check_shear(const Scene& scene, const toml::table& root, const std::string& file) {
  if (!scene.shear_rate) return;
  const auto refuse = [&](const std::string& key, const std::string& problem,
                          const std::string& advice) {
    throw UserError(place_of(root, key, file), problem, advice);
  };
  for (int side = 0; side < 4; ++side) {
    if (!scene.walls[side]) continue;
    refuse(wall_path(side), "a sheared box has no walls across the flow or its gradient",
           "remove the walls across x and y, or [shear]: walls can slide by surface_velocity");
  }
  for (int side = 4; side < 2 * scene.dimension(); ++side) {
    const auto& wall = scene.walls[side];
    if (!wall || (wall->kind != WallKind::Thermal && !wall->roughness.any())) continue;
    refuse(wall_path(side), "a thermal or rough wall would hold up the flow of a sheared box",
           "choose a smooth wall of another kind");
  }
  if (scene.has_fixtures() || scene.piston) {
    refuse(scene.piston              ? "piston"
           : scene.obstacles.empty() ? "partition"
                                     : "obstacle",
           "a sheared box has no bodies at rest: its images slide", "remove it, or [shear]");
  }
  if (scene.gravity && scene.gravity->norm() > 0.0) {
    refuse("gravity", "a sheared box has no gravity: the flow would not stay",
           "remove [gravity], or [shear]");
  }
  constexpr double kLeastLength = 1.2, kLeastHeight = 2.0;  // largest diameters
  const double length = kLeastLength * scene.largest_diameter();
  const double height = kLeastHeight * scene.largest_diameter();
  if (scene.box[0] < length || scene.box[1] < height) {
    refuse("box.size", "the box is too small to be sheared",
           "choose a first side of at least " + number_text(length) +
               " and a second side of at least " + number_text(height));
  }
  const Measure& measure = scene.measure;
  const View& view = scene.view;
  const bool drawn = view.field && is_residual(*view.field);
  if (drawn || std::ranges::any_of(measure.fields, is_residual)) {
    refuse(drawn ? "view.field" : "measure.fields",
           "the balances of cells do not include the shear",
           drawn ? "choose an average" : "remove \"balance\"");
  }
  if (measure.kernel == Kernel::Gaussian) {
    refuse("measure.kernel", "a Gaussian does not reach across the sheared border",
           "remove it: the box kernel has exact averages");
  }
  if (measure.observes(ObservableKind::StructureFactor)) {
    refuse("measure.observables", "a sheared box has other wave vectors at each time",
           "remove \"structure_factor\"");
  }
  if (measure.observes(ObservableKind::PlaneCurrent) && measure.plane_current.axis == Axis::X) {
    refuse("measure.observables", "the flow of a sheared box crosses a plane across x",
           "set measure.plane_current.axis to \"y\", or remove \"plane_current\"");
  }
}

void check_scene(const Scene& scene, const toml::table& root, const std::string& file) {
  check_pairs(scene, root, file);
  check_speeds(scene, root, file);
  check_surfaces(scene, root, file);
  check_shear(scene, root, file);
  check_room(scene, root, file);
  check_colour(scene, root, file);
  check_axes(scene, root, file);
  check_fields(scene, root, file);
  check_kernel(scene, root, file);
  check_equal_diameters(scene, root, file);
  check_drag(scene, root, file);
  check_species_fields(scene, root, file);
  check_observables(scene, root, file);
  check_camera(scene, root, file);
  check_pace(scene, root, file);
  check_captions(scene, root, file);
  check_plots(scene, root, file);
}

void check_followed(const Scene& scene, const toml::table& root, const std::string& file) {
  for (const CameraKey& key : scene.view.camera) {
    if (!key.follow || *key.follow < scene.particles.count) continue;
    throw UserError(place_of(root, "view.camera", file),
                    "there is no particle " + std::to_string(*key.follow) + " to follow",
                    particle_numbers(scene.particles.count));
  }
}

void check_change_tables(const Scene& scene, const toml::table& root, const std::string& file) {
  const auto place_in = [&](std::size_t number, const std::string& key) {
    const toml::table& item = *(*root["change"].as_array())[number].as_table();
    return key.empty() ? place_of(item, file) : place_of(item, key, file);
  };
  for (std::size_t number = 0; number < scene.changes.size(); ++number) {
    const Change& change = scene.changes[number];
    const auto place = [&](const std::string& key) { return place_in(number, key); };
    if (change.set.empty() && !change.acts()) {
      throw UserError(place(""), "a change needs 'set', 'nudge', 'puff', 'piston' or 'reverse'",
                      "give new values of keys, a nudge, a puff, a position of the piston, or "
                      "reverse = true");
    }
    if (change.reverse) {
      if (scene.shear_rate) {
        throw UserError(place("reverse"), "the velocities of a sheared gas cannot be reversed",
                        "remove this change, or [shear]");
      }
      if (!change.set.empty() || change.ramp || change.nudge || change.puff || change.piston) {
        throw UserError(place("reverse"), "'reverse' has no other key beside time",
                        "give it a [[change]] of its own");
      }
      continue;
    }
    if (change.puff) {
      if (!change.set.empty() || change.ramp || change.nudge) {
        throw UserError(place("puff"), "a puff has no other key beside time",
                        "give the puff a [[change]] of its own");
      }
      check_puff(*change.puff, scene,
                 [&](std::string_view key) { return place("puff." + std::string(key)); });
    }
    if (change.nudge && change.ramp) {
      throw UserError(place("ramp"), "a nudge has no ramp: it acts at one time",
                      "give the nudge a [[change]] of its own");
    }
  }
  check_nudges(scene, [&](std::size_t number, std::string_view key) {
    return place_in(number, "nudge" + std::string(key.empty() ? "" : ".") + std::string(key));
  });
  check_pistons(scene, [&](std::size_t number, std::string_view key) {
    return place_in(number, std::string(key));
  });
}

/// The number of particles from either of the scene's two keys; absent without both.
static std::optional<double> asked_count(const SceneInput& input) {
  if (input.count) return *input.count;
  if (!input.packing_fraction) return std::nullopt;
  const Scene& scene = input.scene;
  const double of_one = packing_fraction(scene.dimension(), 1.0 / scene.box.prod());
  return std::round(*input.packing_fraction / of_one);
}

static int count_of_file(const SceneInput& input, const Place& place) {
  const Start& start = input.scene.particles.start;
  const auto count = static_cast<int>(particle_count(start.state));
  const auto asked = asked_count(input);
  if (!asked || *asked == count) return count;
  throw UserError(place,
                  "this asks for " + number_text(*asked) + " particles, and " + start.file +
                      " has " + std::to_string(count),
                  "remove the key, or choose the file that you mean");
}

int resolve_count(const SceneInput& input, const toml::table& root, const std::string& file) {
  const Scene& scene = input.scene;
  const std::string packing(input.packing_key());
  const std::string advice = "give exactly one of 'particles.count' and '" + packing + "'";
  const Place place = place_of(root, input.count ? "particles.count" : packing, file);
  if (input.count && input.packing_fraction) {
    throw UserError(place_of(root, packing, file),
                    "both 'particles.count' and '" + packing + "' are given", advice);
  }
  if (scene.particles.start.layout == Layout::File) return count_of_file(input, place);
  const auto count = asked_count(input);
  if (!count) {
    throw UserError(place_of(root, "particles", file), "the number of particles is missing",
                    advice);
  }
  const int capacity = with_dimension(scene.dimension(), [&](auto dimension) {
    return lattice_capacity(scene.start_room<dimension>());
  });
  if (*count > capacity) {
    const bool walls_move = scene.clear_box() != scene.box;
    throw UserError(place,
                    (input.count ? std::to_string(*input.count) : number_text(*count)) +
                        " particles have no place on a lattice in the box" +
                        (walls_move ? " where its walls move farthest in" : ""),
                    "give at most " + std::to_string(capacity) +
                        ", or the places of more in a file, with particles.start.file");
  }
  return static_cast<int>(*count);
}

}  // namespace clatter
