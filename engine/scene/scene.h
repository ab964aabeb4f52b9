#pragma once

#include <array>
#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "engine/physics/lattice.h"
#include "engine/physics/state.h"
#include "engine/physics/wall_motion.h"
#include "engine/scene/field.h"
#include "engine/vec.h"

namespace clatter {

/// How rough a partner in a collision is, Sec. 2; smooth where both are absent.
struct Roughness {
  std::optional<double> friction;  ///< mu >= 0, may be infinite; absent beside the other: infinite
  std::optional<double> tangential_restitution;  ///< beta_0, -1..1; absent beside the other: 1

  /// Mu and beta_0 in force; 0 and -1 where both are absent.
  double friction_in_force() const;
  double tangential_restitution_in_force() const;
  /// Whether a touch can change a spin: mu > 0 and beta_0 > -1.
  bool any() const;
};

/// What a wall does to the particles that touch it, Sec. 3.1.
enum class WallKind {
  Static,      ///< reflects with its restitution
  Driven,      ///< adds drive_speed to the normal velocity: the saw-tooth limit, Eqs. (2.17), (3.1)
  Thermal,     ///< forgets the incoming velocity and emits at its temperature
  Sawtooth,    ///< moves inwards by its stroke at constant speed, jumps back, and again
  Sinusoidal,  ///< swings by half its stroke to either side of its place
};

/// One wall of the box.
struct Wall {
  WallKind kind = WallKind::Static;
  double restitution = 1.0;  ///< alpha_w >= 0, of all but thermal walls; may exceed 1
  Roughness roughness = {};  ///< of all but thermal walls
  double drive_speed =
      0.0;  ///< v_dr >= 0 of a driven wall, the gain in normal velocity, Eq. (2.17)
  double temperature = 1.0;  ///< T_w >= 0 of a thermal wall
  double stroke = 0.0;       ///< whole travel of a saw-tooth or sinusoidal wall, >= 0
  double frequency = 0.0;    ///< of its motion, in periods per time unit, >= 0
  double phase = 0.0;        ///< of its motion at time 0, in periods

  /// Whether the wall changes its place.
  bool moves() const { return kind == WallKind::Sawtooth || kind == WallKind::Sinusoidal; }
  /// The motion of one that moves, its phase at simulation time 0; others stay at rest.
  WallMotion motion() const;
  /// How far into the box it is at time 0.
  double start_travel() const;
  /// How far into the box its motion takes it.
  double innermost_travel() const;
  /// How far out of the box its motion takes it.
  double outermost_travel() const { return kind == WallKind::Sinusoidal ? 0.5 * stroke : 0.0; }
};

/// The sides of the box: axis is side / 2, and the odd ones lie at the axis' far end.
enum Side { kLeft, kRight, kBottom, kTop };

/// Names of the sides in scene files, indexed by Side.
inline constexpr std::array<const char*, 4> kSideNames = {"left", "right", "bottom", "top"};

/// How the particles are placed at time 0.
enum class Layout { Random, Lattice, File };

/// Positions and velocities at time 0.
struct Start {
  Layout layout = Layout::Random;
  std::string file;     ///< of layout File: a CSV, see state_file.h, or its name in the gallery
  State<2> state = {};  ///< of layout File: what the file says
  double temperature = 1.0;  ///< T >= 0, met exactly for N >= 2: Gaussian velocities, mean removed;
                             ///< of layout File: that of the state
  double spin_temperature = 0.0;  ///< T_rot = I <omega^2> >= 0, met exactly where spins exist
};

/// The particles; their diameter and mass are the units of length and mass.
struct Particles {
  int count = 0;             ///< N >= 0; resolved from area_fraction where the scene gives that
  double restitution = 1.0;  ///< alpha, 0..1
  Roughness roughness = {};
  double inertia = 0.5;  ///< q = 4I/(m a^2), 0..1: 1/2 for a uniform disk, 2/5 for a sphere
  Start start;
};

/// Homogeneous driving: every particle is kicked at once, again and again, Sec. 3.2.
struct BulkDrive {
  double interval = 1.0;    ///< time between kicks, > 0
  double kick_speed = 0.0;  ///< standard deviation of a kick per velocity component; mean removed
  double kick_spin = 0.0;   ///< standard deviation of the change of spin
};

/// How particles come to count in fields: their flights exactly, or where they are now and then.
enum class Estimator { Exact, Snapshot };

/// Over what a particle spreads in fields, Sec. 4: the cell that it is in, or a Gaussian.
enum class Kernel { Box, Gaussian };

/// An axis of the box.
enum class Axis { X, Y };

/// What `clatter measure` averages.
struct Measure {
  double burn_in = 100.0;               ///< time before averages start, >= 0
  double duration = 1000.0;             ///< time averaged over, > 0
  double series_interval = 1.0;         ///< spacing of temperature_series, > 0
  std::vector<Field> fields;            ///< profiles and residuals asked for; empty: none
  std::array<int, 2> cells = {20, 20};  ///< field cells along x and y, each >= 1
  Axis profile_axis = Axis::X;          ///< along which profiles go
  Estimator estimator = Estimator::Exact;
  double interval = 1.0;  ///< between samples of the snapshot estimator, > 0
  Kernel kernel = Kernel::Box;
  double width = 1.0;  ///< standard deviation of the Gaussian per axis, > 0
};

/// What a particle's colour shows.
enum class ColourBy { None, Speed, VelocityX, VelocityY, Spin };

/// The colour maps for magnitudes.
enum class Palette { Viridis, Inferno, Cividis };

/// The colours of all that does not show a value.
enum class Theme { Dark, Light, Projector };

/// A colour in sRGB.
struct Rgb {
  std::uint8_t red = 0;
  std::uint8_t green = 0;
  std::uint8_t blue = 0;

  bool operator==(const Rgb&) const = default;
};

/// From which value to which a colour scale reaches.
struct ColourRange {
  enum Kind {
    Auto,    ///< follows what is shown, in round steps
    Locked,  ///< as it finds it first, and so from then on: a heatmap after its first whole window
    Given    ///< the ends
  };
  Kind kind = Auto;
  std::array<double, 2> ends = {0.0, 1.0};  ///< low < high, of Given

  bool operator==(const ColourRange&) const = default;
};

/// What the camera is aimed at from a time on; between two of these it goes from one to the other.
struct CameraKey {
  double time = 0.0;            ///< simulation time, >= 0
  std::optional<Vec2> centre;   ///< world point in the middle; absent: that of the whole picture
  std::optional<int> follow;    ///< number of the particle in the middle, in place of a centre
  std::optional<double> width;  ///< world units across, > 0; absent: as the whole picture has
};

/// What is drawn.
struct View {
  ColourBy colour_by = ColourBy::Speed;
  std::optional<Field>
      field;            ///< the heatmap below the particles; absent: none, and nothing is averaged
  double window = 5.0;  ///< averaging time of the live field, > 0
  Estimator estimator = Estimator::Exact;  ///< of the live field
  double interval = 0.1;  ///< between samples of the snapshot estimator, > 0 and at most the window
  double speed = 1.0;     ///< simulation time per second of film, > 0
  Palette palette = Palette::Viridis;    ///< of the particles' magnitudes
  ColourRange range;                     ///< of the particles' colours; locked: as first shown
  std::optional<Palette> field_palette;  ///< of the heatmap's magnitudes; absent: as palette
  ColourRange field_range;               ///< of the heatmap's colours
  std::optional<Quantity> arrows;        ///< one of kArrows, averaged as the heatmap; absent: none
  Theme theme = Theme::Dark;             ///< of background, letters, walls and lines
  std::optional<Rgb> background;         ///< absent: that of the theme
  bool grid = false;              ///< lines over the box, as far apart as the scale bar is long
  bool overlay = true;            ///< time, title, colour bar, scale bar
  std::optional<double> trails;   ///< time that particles' paths reach back, > 0; absent: none
  std::optional<double> card;     ///< seconds of film that begin with the title, > 0; absent: none
  std::vector<CameraKey> camera;  ///< in order of time; empty: the whole box, always

  /// Whether it shows what has to be averaged over time.
  bool shows_averages() const { return field || arrows; }
  /// Whether another view averages the same in the same way.
  bool averages_like(const View& other) const {
    return field == other.field && arrows == other.arrows && window == other.window &&
           estimator == other.estimator && interval == other.interval;
  }
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
  Vec2 box = {20.0,
              25.0};  ///< Lx, Ly in particle diameters; particles touch walls with their surface
  Particles particles;
  std::array<std::optional<Wall>, 4> walls;  ///< indexed by Side; a pair absent: periodic
  std::optional<Vec2> gravity;               ///< acceleration; absent: none
  std::optional<BulkDrive> bulk_drive;       ///< absent: none
  std::optional<double> contact_time;        ///< t_c > 0 of the TC model, section 4; absent: off
  Measure measure;
  View view;
  std::vector<Change> changes;  ///< in any order; those of one time come in the order given

  /// Whether particles spin: they or any wall are rough.
  bool spins() const;
  /// Whether the box is periodic along an axis (0: x, 1: y).
  bool periodic(int axis) const { return !walls[2 * axis]; }
  /// phi = N pi / (4 Lx Ly).
  double area_fraction() const;
  /// How far into the box the near walls of both axes move at most.
  Vec2 clear_corner() const;
  /// The size of that part of the box, from clear_corner() on, which no wall's motion reaches.
  Vec2 clear_box() const;
  /// The room for the start state: that part of the box, with its corner at the origin.
  Room start_room() const { return {clear_box(), {periodic(0), periodic(1)}}; }
};

}  // namespace clatter
