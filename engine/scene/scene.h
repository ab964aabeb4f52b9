#pragma once

#include <array>
#include <optional>
#include <string>
#include <vector>

#include "engine/physics/lattice.h"
#include "engine/physics/state.h"
#include "engine/scene/field.h"
#include "engine/scene/view.h"
#include "engine/scene/wall.h"
#include "engine/vec.h"

namespace clatter {

/// How the particles are placed at time 0.
enum class Layout { Random, Lattice, File };

/// Positions and velocities at time 0.
struct Start {
  Layout layout = Layout::Random;
  std::string file;     ///< of layout File: a CSV, see state_file.h, or its name in the gallery
  AnyState state = {};  ///< of layout File: what the file says
  double temperature = 1.0;  ///< T >= 0, met exactly for N >= 2: Gaussian velocities, mean removed;
                             ///< of layout File: that of the state
  double spin_temperature = 0.0;  ///< T_rot = I <omega^2> >= 0, met exactly where spins exist
};

/// The particles; their diameter and mass are the units of length and mass.
struct Particles {
  int count = 0;             ///< N >= 0; resolved from area_fraction where the scene gives that
  double restitution = 1.0;  ///< alpha, 0..1
  Roughness roughness = {};
  double inertia = 0.5;  ///< q = 4I/(m a^2), 0..1: 1/2 for a uniform disk, 2/5 for a uniform sphere
  Start start;
};

/// Homogeneous driving: every particle is kicked at once, again and again (theory 5.1).
struct BulkDrive {
  double interval = 1.0;    ///< time between kicks, > 0
  double kick_speed = 0.0;  ///< standard deviation of a kick per velocity component; mean removed
  double kick_spin = 0.0;   ///< standard deviation of the change of spin
};

/// Over what a particle spreads in fields (theory 8): the cell that it is in, or a Gaussian.
enum class Kernel { Box, Gaussian };

/// An axis of the box.
enum class Axis { X, Y, Z };

/// What `clatter measure` averages.
struct Measure {
  double burn_in = 100.0;             ///< time before averages start, >= 0
  double duration = 1000.0;           ///< time averaged over, > 0
  double series_interval = 1.0;       ///< spacing of temperature_series, > 0
  std::vector<Field> fields;          ///< profiles and residuals asked for; empty: none
  std::vector<int> cells = {20, 20};  ///< [D] field cells along each axis, each >= 1
  Axis profile_axis = Axis::X;        ///< along which profiles go
  Estimator estimator = Estimator::Exact;
  double interval = 1.0;  ///< between samples of the snapshot estimator, > 0
  Kernel kernel = Kernel::Box;
  double width = 1.0;  ///< standard deviation of the Gaussian per axis, > 0
};

/// A key of the scene file set to a TOML value: of a `--set` on the command line, or of a change.
struct Override {
  std::string key;    ///< dotted: "walls.left.drive_speed"
  std::string value;  ///< as TOML
};

/// How numbers go to their new values.
enum class Ramp { Linear };

/// Laws that come into force while a run goes on, after the events of the same time.
struct Change {
  double time = 0.0;               ///< simulation time, >= 0
  std::vector<Override> set = {};  ///< keys that may change live, all at once
  std::optional<Ramp> ramp = {};   ///< absent: the values hold from `time` on
  double until = 0.0;              ///< of a ramp: the time at which it has arrived, > time
};

/// A complete, validated description of a run: what the scene file says, resolved, nothing derived.
struct Scene {
  std::string title;
  std::string caption;   ///< what to watch, in a line
  std::string goal;      ///< what there is to learn
  std::string try_this;  ///< what to do to it in the window, and what then happens
  /// Lx, Ly and, of spheres, Lz in particle diameters; particles touch walls with their surface.
  VecX box = Vec2(20.0, 25.0);
  Particles particles;
  std::array<std::optional<Wall>, 6> walls;  ///< indexed by Side; a pair absent: periodic
  std::optional<VecX> gravity;               ///< acceleration; absent: none
  std::optional<BulkDrive> bulk_drive;       ///< absent: none
  std::optional<double> contact_time;        ///< t_c > 0 of the TC model (theory 5.3); absent: off
  Measure measure;
  View view;
  std::vector<Change> changes;  ///< in any order; those of one time come in the order given

  /// Whether particles spin: they or any wall are rough.
  bool spins() const;
  /// 2: disks, 3: spheres.
  int dimension() const { return static_cast<int>(box.size()); }
  /// Whether the box is periodic along an axis (0: x, 1: y, 2: z).
  bool periodic(int axis) const { return !walls[2 * axis]; }
  /// Share of the box that the particles fill: N pi / (4 Lx Ly) of disks, N pi / (6 Lx Ly Lz) of
  /// spheres.
  double packing_fraction() const;
  /// How far into the box the near walls of all axes move at most.
  VecX clear_corner() const;
  /// The size of that part of the box, from clear_corner() on, which no wall's motion reaches.
  VecX clear_box() const;
  /// The room for the start state: that part of the box, with its corner at the origin.
  template <int D>
  Room<D> start_room() const;
};

template <int D>
Room<D> Scene::start_room() const {
  Room<D> room{.box = clear_box()};
  for (int axis = 0; axis < D; ++axis) room.walled[axis] = !periodic(axis);
  return room;
}

/// A scene without particles in two or three dimensions, whose other members are the defaults
/// there.
Scene default_scene(int dimension);

}  // namespace clatter
