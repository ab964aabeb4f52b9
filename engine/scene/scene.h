#pragma once

#include <algorithm>
#include <array>
#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "engine/laws/acts.h"
#include "engine/laws/model.h"
#include "engine/laws/wall.h"
#include "engine/physics/lattice.h"
#include "engine/physics/state.h"
#include "engine/scene/field.h"
#include "engine/scene/observable_settings.h"
#include "engine/scene/obstacle.h"
#include "engine/scene/species.h"
#include "engine/scene/view.h"
#include "engine/vec.h"

namespace clatter {

/// Placement of the particles at time 0.
enum class Layout {
  Random,     ///< without order, by a method that fits the number of particles
  Insertion,  ///< as Random, but never by Growth
  Lattice,
  File
};

/// Positions and velocities at time 0.
struct Start {
  Layout layout = Layout::Random;
  std::string file;     ///< of layout File: a CSV, see state_file.h, or its name in the gallery
  AnyState state = {};  ///< of layout File: the file's content
  double temperature = 1.0;       ///< T >= 0, exact for N >= 2: Gaussian velocities, mean removed;
                                  ///< of layout File: temperature of the state
  double spin_temperature = 0.0;  ///< T_rot = I <omega^2> >= 0, exact if particles spin
};

/// The particles; their diameter and mass are the units of length and mass. In a mixture the laws
/// are those of species that have no others.
struct Particles {
  int count = 0;  ///< N >= 0; from the packing fraction if the scene has that; of all species
  double restitution = 1.0;  ///< alpha, 0..1
  Roughness roughness = {};
  double inertia = 0.5;  ///< q = 4I/(m a^2), 0..1: 1/2 for a uniform disk, 2/5 for a uniform sphere
  /// Number of them that start below the divider of the scene, without species; absent: see
  /// count_left().
  std::optional<int> count_left = {};
  Start start;
};

/// Coarse-graining kernel of fields (theory 8): the cell of the particle, or a Gaussian.
enum class Kernel { Box, Gaussian };

/// Settings of `clatter measure`.
struct Measure {
  double burn_in = 100.0;             ///< time before averages start, >= 0
  double duration = 1000.0;           ///< averaging time, > 0
  double series_interval = 1.0;       ///< spacing of temperature_series, > 0
  std::vector<Field> fields;          ///< requested profiles and residuals; empty: none
  std::vector<int> cells = {20, 20};  ///< [D] field cells along each axis, each >= 1
  Axis profile_axis = Axis::X;        ///< axis of the profiles
  Estimator estimator = Estimator::Exact;
  double interval = 1.0;  ///< between samples of the snapshot estimator, > 0
  Kernel kernel = Kernel::Box;
  double width = 1.0;  ///< standard deviation of the Gaussian per axis, > 0
  std::vector<ObservableKind> observables = {};  ///< requested observables; empty: none
  RadialDistributionSettings radial_distribution = {};
  VelocityDistributionSettings velocity_distribution = {};
  TimeCorrelationSettings mean_squared_displacement = {.interval = 1.0, .longest = 100.0};
  TimeCorrelationSettings velocity_autocorrelation = {};
  StructureFactorSettings structure_factor = {};
  ClusterSettings clusters = {};
  BondOrderSettings bond_order = {};
  WallPowerSettings wall_power = {};
  PlaneCurrentSettings plane_current = {};
  CellSettings local_density = {};
  DistributionSettings spin_distribution = {};
  ProbeSettings probe = {};
  CollisionCountSettings collision_counts = {};
  RadialProfileSettings radial_distribution_profile = {};
  CellSettings mixing = {};

  /// Whether an observable is requested.
  bool observes(ObservableKind kind) const {
    return std::ranges::find(observables, kind) != observables.end();
  }
  /// Time between the samples of an observable; absent: it follows events.
  std::optional<double> sampling_interval(ObservableKind kind) const;
};

/// A key of the scene file and its new TOML value, from `--set` on the command line or from a
/// change.
struct Override {
  std::string key;    ///< dotted: "walls.left.drive_speed"
  std::string value;  ///< as TOML

  bool operator==(const Override&) const = default;
};

/// Course of numbers to their new values.
enum class Ramp { Linear };

/// A change of laws, of velocities or of the number of particles, or a stroke of the piston, during
/// a run. It comes after the events of the same time.
struct Change {
  double time = 0.0;               ///< simulation time, >= 0
  std::vector<Override> set = {};  ///< keys that may change live, all at once; empty: none
  std::optional<Ramp> ramp = {};   ///< absent: the values hold from `time` on
  /// Position on the x axis to which the rest position of the right wall moves, at constant
  /// velocity from `time` to `until`; absent: the wall does not move.
  std::optional<double> piston = {};
  double until = 0.0;               ///< of a ramp or the piston: the time at which it ends, > time
  std::optional<Nudge> nudge = {};  ///< of velocities, after the change of laws; absent: none
  std::optional<Puff> puff = {};    ///< particles that enter the gas; absent: none
  bool reverse = false;             ///< whether all velocities and spins change their signs

  /// Whether it acts on the particles or the piston, so that it happens once.
  bool acts() const { return nudge || piston || puff || reverse; }

  bool operator==(const Change&) const = default;
};

/// A complete, validated description of a run: the content of the scene file, with counts resolved
/// and without derived values.
struct Scene {
  std::string title;
  std::string caption;   ///< one line about the effect to watch
  std::string goal;      ///< learning goal
  std::string try_this;  ///< an experiment in the window, and its result
  /// Lx, Ly and, for spheres, Lz in particle diameters. Walls touch the surfaces of particles, not
  /// their centres.
  VecX box = Vec2(20.0, 25.0);
  Particles particles;
  std::vector<Species> species;              ///< of a mixture; empty: the particles are alike
  std::vector<SpeciesPair> pairs;            ///< laws that differ; no two of the same species
  std::array<std::optional<Wall>, 6> walls;  ///< indexed by Side; a pair absent: periodic
  /// [6][S] of each wall as each species meets it; the inner lists are empty without species
  std::array<std::vector<SpeciesWall>, 6> species_walls;
  std::vector<Obstacle> obstacles;      ///< bodies at rest
  std::vector<Partition> partitions;    ///< thin walls across the box
  std::optional<Piston> piston;         ///< that slides freely; absent: none
  std::optional<VecX> gravity;          ///< acceleration; absent: none
  std::optional<double> shear_rate;     ///< of a sheared box; absent: not sheared
  std::optional<BulkDrive> bulk_drive;  ///< absent: none
  std::optional<double> contact_time;   ///< t_c > 0 of the TC model (theory 5.3); absent: off
  Measure measure;
  View view;
  std::vector<Change> changes;  ///< in any order; changes of the same time apply in this order

  /// Whether particles spin: the particles or any wall are rough.
  bool spins() const;
  /// 2: disks, 3: spheres.
  int dimension() const { return static_cast<int>(box.size()); }
  /// Whether the box is periodic along an axis (0: x, 1: y, 2: z).
  bool periodic(int axis) const { return !walls[2 * axis]; }
  /// The view of a gas with these species, for this scene. A field of a species becomes that of the
  /// species of the same name. Without one there is no heatmap.
  View adapted(View of_other, const std::vector<Species>& others) const;
  /// Share of the box that the particles fill: N pi / (4 Lx Ly) for disks of diameter 1,
  /// N pi / (6 Lx Ly Lz) for spheres.
  double packing_fraction() const;
  /// Upper limit of the diameters; 1 without species.
  double largest_diameter() const;
  /// What particle `number` of `of` particles of a species is, see Species::diameter_of(). Of
  /// unequal diameters d it has the mass m_s (d/d_s)^D.
  Grain grain(std::size_t species, int number, int of) const;
  /// Contact law of two species, by their numbers; without species that of [particles].
  PairLaw pair_law(std::size_t first, std::size_t second) const;
  /// The wall at a side as a species meets it. The side must have one.
  Wall wall(int side, std::size_t species) const;
  /// Whether there are obstacles or partitions.
  bool has_fixtures() const { return !obstacles.empty() || !partitions.empty(); }
  /// Largest displacement into the box of the near wall of each axis.
  VecX clear_corner() const;
  /// The size of the part of the box that no wall's motion reaches. It begins at clear_corner().
  VecX clear_box() const;
  /// The room for the start state: this part of the box, with its corner at the origin.
  template <int D>
  Room<D> start_room() const;
};

/// The obstacles, then the partitions of a valid scene, for a model.
template <int D>
std::vector<Fixture<D>> fixtures_of(const Scene& scene);

/// A body that divides the box along an axis with walls.
struct Divider {
  int axis = 0;
  double position = 0.0;   ///< of its middle
  double thickness = 0.0;  ///< along the axis
};
/// The piston, or the first partition at right angles to an axis with walls; absent: there is none.
std::optional<Divider> divider_of(const Scene& scene);

/// Whether a scene says how many particles start on each side of its divider.
bool starts_divided(const Scene& scene);

/// Number of particles of a species that start below the divider; without species that of all
/// particles. Without a value in the scene they divide as the free lengths.
int count_left(const Scene& scene, std::size_t species);

/// Share of the box that no obstacle covers, by points on a lattice: accurate to some 1e-3.
double free_share(const Scene& scene);

template <int D>
Room<D> Scene::start_room() const {
  Room<D> room{.box = clear_box(), .walled = {}, .diameter = largest_diameter()};
  for (int axis = 0; axis < D; ++axis) room.walled[axis] = !periodic(axis);
  return room;
}

/// The room on one side of the divider of a scene for its start, where walls move farthest in.
template <int D>
struct StartSide {
  Vec<D> corner;  ///< the lower corner of the room
  Room<D> room;
};
/// The lower (0) or upper (1) side of the divider. Its room may have no positive length.
template <int D>
StartSide<D> start_side(const Scene& scene, int side);

/// The laws of a scene of D dimensions, for the random numbers of a seed.
template <int D>
Model<D> model_of(const Scene& scene, std::uint64_t seed);

/// A scene in two or three dimensions with all defaults and without particles.
Scene default_scene(int dimension);

}  // namespace clatter
