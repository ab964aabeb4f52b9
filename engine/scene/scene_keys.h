#pragma once

#include <array>
#include <limits>
#include <optional>
#include <string_view>

#include "engine/scene/key_table.h"
#include "engine/scene/scene.h"

// The keys of the scene file, each defined once, in the order of the file. A table before each
// block has their units and meanings. A visitor visits the keys to list, read, write or document
// them (key_lister.h, key_reader.h, key_writer.h, key_docs.cpp). It has the members
//   value(key, variable, limits, presence)   for numbers, flags, text and arrays of numbers,
//   value(key, optional, limits, presence)   for a number that may be absent,
//   choice(key, variable, names, presence)   for enumerations and fields, optional ones, and lists
//                                            of them,
//   table(key, function)                     for a table whose keys the function visits,
//   table(key, optional, function)           for a table that may be absent,
//   list(key, items, function)               for an array of tables,
//   settings(key, overrides)                 for a table of any keys.

namespace clatter {

/// The allowed numbers of a key, from `lowest` to `highest`, which may be infinite. `above`
/// excludes `lowest` itself.
struct Limits {
  double lowest = -std::numeric_limits<double>::max();
  double highest = std::numeric_limits<double>::max();
  bool above = false;

  /// Whether a number is within the limits; false for NaN.
  bool allow(double number) const {
    return (above ? number > lowest : number >= lowest) && number <= highest;
  }
};

/// Numbers from `lowest` to `highest`, both included.
constexpr Limits between(double lowest, double highest) {
  return {.lowest = lowest, .highest = highest};
}
/// Finite numbers from `lowest` on.
constexpr Limits at_least(double lowest) {
  return {.lowest = lowest};
}
/// Finite numbers greater than `lowest`.
constexpr Limits above(double lowest) {
  return {.lowest = lowest, .above = true};
}
/// Numbers from `lowest` on, infinity included.
constexpr Limits at_least_or_infinite(double lowest) {
  return {.lowest = lowest, .highest = std::numeric_limits<double>::infinity()};
}

/// Limits of values. Squares of speeds, temperatures and times between collisions must not overflow
/// or underflow. Positions in the largest box have a rounding error of 1e-10 diameters, and phases
/// of walls have the same precision in periods. The smallest inertia limits the ratio of spins to
/// speeds.
inline constexpr double kMaxCount = std::numeric_limits<int>::max();
inline constexpr double kMaxSpeed = 1e15;
inline constexpr double kMaxTemperature = 1e30;
inline constexpr double kMaxAcceleration = 1e15;
inline constexpr double kMaxLength = 1e6;
inline constexpr double kMaxFrequency = 1e15;
inline constexpr double kMaxPhase = 1e6;
inline constexpr double kMinInertia = 1e-9;
/// Limits of the times and the speed of [view]: the clock can count their multiples.
inline constexpr double kMinViewTime = 1e-30;
inline constexpr double kMaxViewTime = 1e30;
/// Maximum number of snapshots in an averaging window.
inline constexpr double kMaxWindowSamples = 1e6;
/// Limits of the width of pictures, and of the camera's distance from the origin: a thousandth of a
/// particle, and a thousand of the largest boxes.
inline constexpr double kMinCameraWidth = 1e-3;
inline constexpr double kMaxCameraWidth = 1e9;
/// Limits of the angles of the camera, in degrees. Paths may turn several times.
inline constexpr double kMaxAzimuth = 36000.0;
inline constexpr double kMaxElevation = 90.0;
inline constexpr double kMaxViewAngle = 120.0;
inline constexpr double kMaxVolume = 1e3;
/// Maximum factor of velocities in a nudge.
inline constexpr double kMaxScale = 1e3;
inline constexpr Limits kAzimuths = between(-kMaxAzimuth, kMaxAzimuth);
inline constexpr Limits kElevations = between(-kMaxElevation, kMaxElevation);
/// A wall that adds energy (theory 4.1) has a restitution above 1.
inline constexpr double kMaxWallRestitution = 10.0;

/// Whether a table must, may or must not have a key.
struct Presence {
  enum Kind { Required, Optional, Forbidden };
  Kind kind = Optional;
  const char* reason = "";  ///< if forbidden: "has no meaning ..."
  const char* advice = "";  ///< the fix
};
inline constexpr Presence kRequired = {Presence::Required};
inline constexpr Presence kOptional = {Presence::Optional};
inline constexpr Presence kNotOfWall = {Presence::Forbidden, "has no meaning for this kind of wall",
                                        "remove it or choose another kind"};
inline constexpr Presence kNotWithoutFile = {Presence::Forbidden,
                                             "has no meaning without layout = \"file\"",
                                             "remove it, or set particles.start.layout = \"file\""};
inline constexpr Presence kNotBesideFile = {
    Presence::Forbidden, "has no meaning beside layout = \"file\": the file has the velocities",
    "remove it, or choose another layout"};
inline constexpr Presence kNotWithoutSpins = {
    Presence::Forbidden, "has no meaning where nothing spins",
    "remove it, or make the particles or a wall rough: give friction above 0, or "
    "tangential_restitution above -1"};

inline constexpr Presence kNotWithoutRamp = {Presence::Forbidden, "has no meaning without a ramp",
                                             "remove it, or set ramp = \"linear\""};
inline constexpr Presence kNotOfExact = {
    Presence::Forbidden, "has no meaning for the exact estimator, which counts flights as a whole",
    "remove it, or set estimator = \"snapshot\""};
inline constexpr Presence kNotOfBox = {Presence::Forbidden,
                                       "has no meaning for the box kernel: cells have their size",
                                       "remove it, or set measure.kernel = \"gaussian\""};

inline constexpr Presence kNotObserved = {
    Presence::Forbidden, "has no meaning without its observable",
    "remove it, or add the name of the table to measure.observables"};

inline constexpr Presence kNotBesideParticle = {
    Presence::Forbidden, "has no meaning for one particle",
    "remove it, or give centre and radius of a region instead of particle"};
inline constexpr Presence kOneOfNudge = {Presence::Forbidden,
                                         "contradicts another key: a nudge has one of scale, add "
                                         "and set",
                                         "remove one of the two"};
inline constexpr Presence kNotBesideFollow = {Presence::Forbidden, "has no meaning beside follow",
                                              "remove one of the two"};

/// Name of an enumerator in scene files.
template <class E>
struct Named {
  std::string_view name;
  E value;
};

/// The first name of an enumerator or field in a list of pairs of name and value; empty without a
/// name.
template <class E, class Names>
constexpr std::string_view name_of(E chosen, const Names& names) {
  for (const auto& [name, value] : names) {
    if (value == chosen) return name;
  }
  return {};
}

inline constexpr std::array<Named<Layout>, 3> kLayouts = {
    {{"random", Layout::Random}, {"lattice", Layout::Lattice}, {"file", Layout::File}}};

inline constexpr std::array<Named<WallKind>, 5> kWallKinds = {
    {{"static", WallKind::Static},
     {"driven", WallKind::Driven},
     {"thermal", WallKind::Thermal},
     {"sawtooth", WallKind::Sawtooth},
     {"sinusoidal", WallKind::Sinusoidal}}};

inline constexpr std::array<Named<ColourBy>, 7> kColourings = {{{"none", ColourBy::None},
                                                                {"speed", ColourBy::Speed},
                                                                {"velocity_x", ColourBy::VelocityX},
                                                                {"velocity_y", ColourBy::VelocityY},
                                                                {"velocity_z", ColourBy::VelocityZ},
                                                                {"spin", ColourBy::Spin},
                                                                {"depth", ColourBy::Depth}}};

inline constexpr std::array<Named<Palette>, 3> kPalettes = {
    {{"viridis", Palette::Viridis}, {"inferno", Palette::Inferno}, {"cividis", Palette::Cividis}}};
inline constexpr std::array<Named<FieldPalette>, 5> kFieldPalettes = {
    {{"blue", FieldPalette::Blue},
     {"grey", FieldPalette::Grey},
     {"viridis", FieldPalette::Viridis},
     {"inferno", FieldPalette::Inferno},
     {"cividis", FieldPalette::Cividis}}};
inline constexpr std::array<Named<FieldStyle>, 2> kFieldStyles = {
    {{"smooth", FieldStyle::Smooth}, {"cells", FieldStyle::Cells}}};

/// Quantities that arrows can show.
inline constexpr std::array<Named<Quantity>, 2> kArrows = {
    {{traits_of(Quantity::Velocity).name, Quantity::Velocity},
     {traits_of(Quantity::HeatFlux).name, Quantity::HeatFlux}}};

inline constexpr std::array<Named<Theme>, 3> kThemes = {
    {{"dark", Theme::Dark}, {"light", Theme::Light}, {"projector", Theme::Projector}}};

inline constexpr std::array<Named<LecturePlot>, 5> kLecturePlots = {
    {{"none", LecturePlot::None},
     {"temperature", LecturePlot::Temperature},
     {"energy", LecturePlot::Energy},
     {"velocities", LecturePlot::Velocities},
     {"profile", LecturePlot::Profile}}};

inline constexpr std::array<Named<Axis>, 3> kAxes = {
    {{"x", Axis::X}, {"y", Axis::Y}, {"z", Axis::Z}}};

inline constexpr std::array<Named<Estimator>, 2> kEstimators = {
    {{"exact", Estimator::Exact}, {"snapshot", Estimator::Snapshot}}};

inline constexpr std::array<Named<Kernel>, 2> kKernels = {
    {{"box", Kernel::Box}, {"gaussian", Kernel::Gaussian}}};

inline constexpr std::array<Named<ObservableKind>, 17> kObservables = {
    {{"radial_distribution", ObservableKind::RadialDistribution},
     {"velocity_distribution", ObservableKind::VelocityDistribution},
     {"free_flights", ObservableKind::FreeFlights},
     {"collisions", ObservableKind::Collisions},
     {"wall_hits", ObservableKind::WallHits},
     {"mean_squared_displacement", ObservableKind::MeanSquaredDisplacement},
     {"velocity_autocorrelation", ObservableKind::VelocityAutocorrelation},
     {"structure_factor", ObservableKind::StructureFactor},
     {"clusters", ObservableKind::Clusters},
     {"bond_order", ObservableKind::BondOrder},
     {"wall_power", ObservableKind::WallPower},
     {"plane_current", ObservableKind::PlaneCurrent},
     {"local_density", ObservableKind::LocalDensity},
     {"spin_distribution", ObservableKind::SpinDistribution},
     {"probe", ObservableKind::Probe},
     {"collision_counts", ObservableKind::CollisionCounts},
     {"radial_distribution_profile", ObservableKind::RadialDistributionProfile}}};

inline constexpr std::array<Named<Ramp>, 1> kRamps = {{{"linear", Ramp::Linear}}};

/// Content of a scene file: the scene, and the keys that are resolved when it is read.
struct SceneInput {
  int schema = 1;            ///< version of the format
  std::optional<int> count;  ///< number of particles; not together with the fraction
  std::optional<double>
      packing_fraction;  ///< phi: area_fraction of disks, volume_fraction of spheres
  bool spins = true;     ///< whether the keys of spins are allowed
  Scene scene;

  /// The dotted key of the packing fraction.
  std::string_view packing_key() const {
    return scene.dimension() == 2 ? "particles.area_fraction" : "particles.volume_fraction";
  }
  /// Presence of keys that only spins need.
  Presence spin_key() const { return spins ? kOptional : kNotWithoutSpins; }
};

/// The commands that run a gas.
inline constexpr std::string_view kRunCommands = "view render measure";

inline constexpr auto kRoughnessKeys = key_table(
    kRunCommands,
    {{"friction", "1",
      "Coulomb's coefficient of friction. Without a value it is inf beside "
      "`tangential_restitution`, and 0 otherwise."},
     {"tangential_restitution", "1",
      "Ratio of the tangential velocities after and before a contact that sticks, with opposite "
      "sign. -1 is smooth, 1 is perfectly rough. Without a value it is 1 beside `friction`, and "
      "-1 otherwise."}});

/// The keys of roughness, of particles or walls.
template <class Visitor>
void visit_roughness(Visitor& io, Roughness& roughness, Presence presence) {
  io.value(kRoughnessKeys.at("friction"), roughness.friction, at_least_or_infinite(0.0), presence);
  io.value(kRoughnessKeys.at("tangential_restitution"), roughness.tangential_restitution,
           between(-1.0, 1.0), presence);
}

inline constexpr auto kWallKeys = key_table(
    kRunCommands,
    {{"kind", "",
      "Action of the wall. A static wall reflects. A driven wall adds speed. A thermal wall emits "
      "at its temperature. The other two move."},
     {"restitution", "1",
      "Ratio of the normal velocities after and before a bounce, relative to the wall. A value "
      "above 1 adds energy."},
     {"drive_speed", "a/t", "Gain in normal velocity at each bounce."},
     {"temperature", "m a^2/t^2", "Temperature of the particles that leave the wall."},
     {"stroke", "a", "Whole travel of the motion."},
     {"frequency", "1/t",
      "Periods of the motion per time unit. A change of the frequency during a run keeps the "
      "position of the wall."},
     {"phase", "1",
      "Phase of the motion in periods, at time 0. For a wall that begins to move later, the phase "
      "at that time."}});

/// The keys of one wall. Its kind determines which of them are allowed.
template <class Visitor>
void visit_wall(Visitor& io, Wall& wall) {
  io.choice(kWallKeys.at("kind"), wall.kind, kWallKinds, kRequired);
  const bool driven = wall.kind == WallKind::Driven;
  const bool thermal = wall.kind == WallKind::Thermal;
  const Presence of_touch = thermal ? kNotOfWall : kOptional;
  const Presence of_motion = wall.moves() ? kRequired : kNotOfWall;
  io.value(kWallKeys.at("restitution"), wall.restitution, between(0.0, kMaxWallRestitution),
           of_touch);
  visit_roughness(io, wall.roughness, of_touch);
  io.value(kWallKeys.at("drive_speed"), wall.drive_speed, between(0.0, kMaxSpeed),
           driven ? kRequired : kNotOfWall);
  io.value(kWallKeys.at("temperature"), wall.temperature, between(0.0, kMaxTemperature),
           thermal ? kRequired : kNotOfWall);
  io.value(kWallKeys.at("stroke"), wall.stroke, between(0.0, kMaxLength), of_motion);
  io.value(kWallKeys.at("frequency"), wall.frequency, between(0.0, kMaxFrequency), of_motion);
  io.value(kWallKeys.at("phase"), wall.phase, between(-kMaxPhase, kMaxPhase),
           wall.moves() ? kOptional : kNotOfWall);
}

inline constexpr auto kStartKeys = key_table(
    kRunCommands,
    {{"layout", "", "Positions at time 0: random, on a lattice, or from a file."},
     {"file", "", "Name of the CSV file with the state at time 0, relative to the scene file."},
     {"temperature", "m a^2/t^2",
      "Temperature at time 0. Velocities are Gaussian with zero mean, and scaled to this value."},
     {"spin_temperature", "m a^2/t^2", "Temperature of the spins at time 0."}});

/// The keys of [particles.start]. The layout determines which of them are allowed.
template <class Visitor>
void visit_start(Visitor& io, Start& start, Presence spin_key) {
  io.choice(kStartKeys.at("layout"), start.layout, kLayouts);
  const bool from_file = start.layout == Layout::File;
  io.value(kStartKeys.at("file"), start.file, Limits{}, from_file ? kRequired : kNotWithoutFile);
  io.value(kStartKeys.at("temperature"), start.temperature, between(0.0, kMaxTemperature),
           from_file ? kNotBesideFile : kOptional);
  io.value(kStartKeys.at("spin_temperature"), start.spin_temperature, between(0.0, kMaxTemperature),
           from_file ? kNotBesideFile : spin_key);
}

inline constexpr auto kParticleKeys = key_table(
    kRunCommands,
    {{"count", "1", "Number of particles. A scene has either this key or a fraction."},
     {"area_fraction", "1",
      "Share of the box that the disks fill. The number of disks is rounded to the nearest "
      "integer."},
     {"volume_fraction", "1",
      "Share of the box that the spheres fill. The number of spheres is rounded to the nearest "
      "integer."},
     {"restitution", "1",
      "Ratio of the normal relative velocities after and before a collision of two particles. 1 is "
      "elastic."},
     {"inertia", "1",
      "Moment of inertia, as q = 4I/(m a^2). A uniform disk has 0.5, a uniform sphere 0.4."}});

/// The keys of [particles]. Count and packing fraction are resolved after the whole scene is read.
template <class Visitor>
void visit_particles(Visitor& io, SceneInput& input) {
  Particles& particles = input.scene.particles;
  io.value(kParticleKeys.at("count"), input.count, between(0, kMaxCount));
  const bool disks = input.scene.dimension() == 2;
  io.value(disks ? kParticleKeys.at("area_fraction") : kParticleKeys.at("volume_fraction"),
           input.packing_fraction, between(0.0, 1.0));
  io.value(kParticleKeys.at("restitution"), particles.restitution, between(0.0, 1.0));
  visit_roughness(io, particles.roughness, kOptional);
  io.value(kParticleKeys.at("inertia"), particles.inertia, between(kMinInertia, 1.0),
           input.spin_key());
  io.table("start", [&](auto& io) { visit_start(io, particles.start, input.spin_key()); });
}

inline constexpr auto kBulkDriveKeys = key_table(
    kRunCommands,
    {{"interval", "t", "Time between two kicks. A kick acts on all particles at once."},
     {"kick_speed", "a/t",
      "Standard deviation of a kick, per component of the velocity. The mean kick is removed."},
     {"kick_spin", "1/t", "Standard deviation of the kick of a spin."}});

/// The keys of [bulk_drive], if the table exists.
template <class Visitor>
void visit_bulk_drive(Visitor& io, BulkDrive& drive, Presence spin_key) {
  io.value(kBulkDriveKeys.at("interval"), drive.interval, above(0.0), kRequired);
  io.value(kBulkDriveKeys.at("kick_speed"), drive.kick_speed, between(0.0, kMaxSpeed), kRequired);
  io.value(kBulkDriveKeys.at("kick_spin"), drive.kick_spin, between(0.0, kMaxSpeed), spin_key);
}

inline constexpr auto kMeasureKeys = key_table(
    "measure",
    {{"burn_in", "t", "Time before averages start."},
     {"duration", "t", "Time over which averages are taken."},
     {"series_interval", "t",
      "Spacing of the series of temperatures. The series starts at time 0."},
     {"fields", "", "Fields that are averaged, and residuals of the balance equations."},
     {"cells", "1", "Number of cells along each axis, for fields."},
     {"profile_axis", "",
      "Axis of the profiles. With gravity the default is its axis. z is for spheres only."},
     {"estimator", "", "Estimator of the fields. It integrates every flight, or takes snapshots."},
     {"interval", "t", "Time between snapshots."},
     {"kernel", "",
      "Weight of a particle in the cells. A box counts it in its own cell. A Gaussian needs "
      "snapshots."},
     {"width", "a", "Standard deviation of the Gaussian, per axis. At least half a cell."},
     {"observables", "", "Quantities that are measured besides means and fields."}});

inline constexpr auto kRadialDistributionKeys = key_table(
    "measure",
    {{"interval", "t", "Time between samples of the distances of all pairs."},
     {"range", "a",
      "Largest distance. In small boxes it is half the shortest period, or the shortest distance "
      "between walls."},
     {"bins", "1", "Number of equal bins between contact and `range`."}});

inline constexpr auto kVelocityDistributionKeys = key_table(
    "measure", {{"interval", "t", "Time between samples of all velocities."},
                {"range", "1", "Largest velocity component, in units of the thermal speed."},
                {"bins", "1", "Number of equal bins between -`range` and `range`."},
                {"lower", "a",
                 "Lower corner of the region of the particles. Without a value it is that of the "
                 "box."},
                {"upper", "a",
                 "Upper corner of the region of the particles. Without a value it is that of the "
                 "box."}});

inline constexpr auto kStructureFactorKeys = key_table(
    "measure",
    {{"interval", "t", "Time between samples."},
     {"range", "1/a", "Largest wave number."},
     {"bins", "1", "Number of shells of equal width between 0 and `range`."},
     {"vectors", "1", "Largest number of wave vectors in a shell, in spread directions."}});

inline constexpr auto kClusterKeys = key_table(
    "measure", {{"interval", "t", "Time between samples."},
                {"range", "a", "Largest distance of the centres of connected particles."}});

inline constexpr auto kBondOrderKeys =
    key_table("measure", {{"range", "a", "Largest distance of the centres of neighbours."}});

inline constexpr auto kSpinDistributionKeys = key_table(
    "measure", {{"interval", "t", "Time between samples of all spins."},
                {"range", "1", "Largest spin component, in units of the root mean square."},
                {"bins", "1", "Number of equal bins between -`range` and `range`."}});

inline constexpr auto kWallPowerKeys =
    key_table("measure", {{"interval", "t", "Time over which the power is averaged."}});

inline constexpr auto kPlaneCurrentKeys =
    key_table("measure", {{"interval", "t", "Time over which the crossings are counted."},
                          {"axis", "", "Normal of the plane. z is for spheres only."},
                          {"position", "1", "Position of the plane, as a share of the box."}});

inline constexpr auto kLocalDensityKeys =
    key_table("measure", {{"interval", "t", "Time between samples."},
                          {"cell", "a", "Shortest edge of the cells, which fill the box."}});

inline constexpr auto kProbeKeys = key_table(
    "measure", {{"interval", "t", "Time between samples."},
                {"lower", "a",
                 "Lower corner of the region. Without a value it is at 1/4 of each side of the "
                 "box."},
                {"upper", "a",
                 "Upper corner of the region. Without a value it is at 3/4 of each side of the "
                 "box."}});

inline constexpr auto kCollisionCountKeys =
    key_table("measure", {{"interval", "t", "Time over which the collisions are counted."}});

inline constexpr auto kRadialProfileKeys = key_table(
    "measure",
    {{"interval", "t", "Time between samples of the distances of all pairs."},
     {"range", "a",
      "Largest distance. In small boxes it is half the shortest period, or the shortest distance "
      "between walls."},
     {"bins", "1", "Number of equal bins between contact and `range`."},
     {"axis", "", "Normal of the slabs. z is for spheres only."},
     {"slabs", "1", "Number of equal slabs of the region of the centres."}});

inline constexpr auto kTimeCorrelationKeys = key_table(
    "measure", {{"interval", "t", "Shortest lag. All particles are sampled at this interval."},
                {"longest", "t", "Longest lag."},
                {"lags", "1",
                 "Number of lags of equal spacing. Longer lags have a spacing larger by this "
                 "factor, and so on."}});

/// The keys of a correlation in time.
template <class Visitor>
void visit_time_correlation(Visitor& io, TimeCorrelationSettings& settings, Presence presence) {
  io.value(kTimeCorrelationKeys.at("interval"), settings.interval, above(0.0), presence);
  io.value(kTimeCorrelationKeys.at("longest"), settings.longest, above(0.0), presence);
  io.value(kTimeCorrelationKeys.at("lags"), settings.lags, between(2, 1000), presence);
}

/// The keys of a region.
template <const auto& keys, class Visitor>
void visit_region(Visitor& io, RegionSettings& region, Presence presence) {
  io.value(keys.at("lower"), region.lower, at_least(0.0), presence);
  io.value(keys.at("upper"), region.upper, above(0.0), presence);
}

/// The keys of a distribution.
template <const auto& keys, class Visitor, class Settings>
void visit_distribution(Visitor& io, Settings& settings, Presence presence) {
  io.value(keys.at("interval"), settings.interval, above(0.0), presence);
  io.value(keys.at("range"), settings.range, above(0.0), presence);
  io.value(keys.at("bins"), settings.bins, between(2, 100'000), presence);
}

/// The tables of the observables in [measure]. Each requires its observable.
template <class Visitor>
void visit_observables(Visitor& io, Measure& measure) {
  io.choice(kMeasureKeys.at("observables"), measure.observables, kObservables);
  const auto presence_of = [&](ObservableKind kind) {
    return measure.observes(kind) ? kOptional : kNotObserved;
  };
  io.table("radial_distribution", [&](auto& io) {
    const Presence presence = presence_of(ObservableKind::RadialDistribution);
    RadialDistributionSettings& settings = measure.radial_distribution;
    io.value(kRadialDistributionKeys.at("interval"), settings.interval, above(0.0), presence);
    io.value(kRadialDistributionKeys.at("range"), settings.range, above(1.0), presence);
    io.value(kRadialDistributionKeys.at("bins"), settings.bins, between(10, 100'000), presence);
  });
  io.table("velocity_distribution", [&](auto& io) {
    const Presence presence = presence_of(ObservableKind::VelocityDistribution);
    visit_distribution<kVelocityDistributionKeys>(io, measure.velocity_distribution, presence);
    visit_region<kVelocityDistributionKeys>(io, measure.velocity_distribution.region, presence);
  });
  io.table("spin_distribution", [&](auto& io) {
    visit_distribution<kSpinDistributionKeys>(io, measure.spin_distribution,
                                              presence_of(ObservableKind::SpinDistribution));
  });
  io.table("mean_squared_displacement", [&](auto& io) {
    visit_time_correlation(io, measure.mean_squared_displacement,
                           presence_of(ObservableKind::MeanSquaredDisplacement));
  });
  io.table("velocity_autocorrelation", [&](auto& io) {
    visit_time_correlation(io, measure.velocity_autocorrelation,
                           presence_of(ObservableKind::VelocityAutocorrelation));
  });
  io.table("structure_factor", [&](auto& io) {
    const Presence presence = presence_of(ObservableKind::StructureFactor);
    StructureFactorSettings& settings = measure.structure_factor;
    io.value(kStructureFactorKeys.at("interval"), settings.interval, above(0.0), presence);
    io.value(kStructureFactorKeys.at("range"), settings.range, above(0.0), presence);
    io.value(kStructureFactorKeys.at("bins"), settings.bins, between(1, 10'000), presence);
    io.value(kStructureFactorKeys.at("vectors"), settings.vectors, between(1, 100), presence);
  });
  io.table("clusters", [&](auto& io) {
    const Presence presence = presence_of(ObservableKind::Clusters);
    io.value(kClusterKeys.at("interval"), measure.clusters.interval, above(0.0), presence);
    io.value(kClusterKeys.at("range"), measure.clusters.range, above(1.0), presence);
  });
  io.table("bond_order", [&](auto& io) {
    const Presence presence = presence_of(ObservableKind::BondOrder);
    visit_time_correlation(io, measure.bond_order.lags_in_time, presence);
    io.value(kBondOrderKeys.at("range"), measure.bond_order.range, above(1.0), presence);
  });
  io.table("wall_power", [&](auto& io) {
    io.value(kWallPowerKeys.at("interval"), measure.wall_power.interval, above(0.0),
             presence_of(ObservableKind::WallPower));
  });
  io.table("plane_current", [&](auto& io) {
    const Presence presence = presence_of(ObservableKind::PlaneCurrent);
    PlaneCurrentSettings& settings = measure.plane_current;
    io.value(kPlaneCurrentKeys.at("interval"), settings.interval, above(0.0), presence);
    io.choice(kPlaneCurrentKeys.at("axis"), settings.axis, kAxes, presence);
    io.value(kPlaneCurrentKeys.at("position"), settings.position, between(0.0, 1.0), presence);
  });
  io.table("local_density", [&](auto& io) {
    const Presence presence = presence_of(ObservableKind::LocalDensity);
    io.value(kLocalDensityKeys.at("interval"), measure.local_density.interval, above(0.0),
             presence);
    io.value(kLocalDensityKeys.at("cell"), measure.local_density.cell, above(0.0), presence);
  });
  io.table("probe", [&](auto& io) {
    const Presence presence = presence_of(ObservableKind::Probe);
    io.value(kProbeKeys.at("interval"), measure.probe.interval, above(0.0), presence);
    visit_region<kProbeKeys>(io, measure.probe.region, presence);
  });
  io.table("collision_counts", [&](auto& io) {
    io.value(kCollisionCountKeys.at("interval"), measure.collision_counts.interval, above(0.0),
             presence_of(ObservableKind::CollisionCounts));
  });
  io.table("radial_distribution_profile", [&](auto& io) {
    const Presence presence = presence_of(ObservableKind::RadialDistributionProfile);
    RadialProfileSettings& settings = measure.radial_distribution_profile;
    io.value(kRadialProfileKeys.at("interval"), settings.interval, above(0.0), presence);
    io.value(kRadialProfileKeys.at("range"), settings.range, above(1.0), presence);
    io.value(kRadialProfileKeys.at("bins"), settings.bins, between(2, 1000), presence);
    io.choice(kRadialProfileKeys.at("axis"), settings.axis, kAxes, presence);
    io.value(kRadialProfileKeys.at("slabs"), settings.slabs, between(1, 200), presence);
  });
}

/// The keys of [measure] in a box of this dimension. Keys of snapshots and of the Gaussian kernel
/// require these.
template <class Visitor>
void visit_measure(Visitor& io, Measure& measure, int dimension) {
  io.value(kMeasureKeys.at("burn_in"), measure.burn_in, at_least(0.0));
  io.value(kMeasureKeys.at("duration"), measure.duration, above(0.0));
  io.value(kMeasureKeys.at("series_interval"), measure.series_interval, above(0.0));
  io.choice(kMeasureKeys.at("fields"), measure.fields, measured_names(dimension));
  io.value(kMeasureKeys.at("cells"), measure.cells, between(1, 2000));
  io.choice(kMeasureKeys.at("profile_axis"), measure.profile_axis, kAxes);
  io.choice(kMeasureKeys.at("estimator"), measure.estimator, kEstimators);
  const bool exact = measure.estimator == Estimator::Exact;
  io.value(kMeasureKeys.at("interval"), measure.interval, above(0.0),
           exact ? kNotOfExact : kRequired);
  io.choice(kMeasureKeys.at("kernel"), measure.kernel, kKernels);
  const bool box = measure.kernel == Kernel::Box;
  io.value(kMeasureKeys.at("width"), measure.width, above(0.0), box ? kNotOfBox : kRequired);
  visit_observables(io, measure);
}

inline constexpr auto kCameraKeys = key_table(
    "render",
    {{"time", "t", "Simulation time at which the camera has this position. Times increase."},
     {"follow", "1", "Number of the particle in the middle of the picture, from 0."},
     {"centre", "a",
      "Point in the middle of the picture. Without a value it is the centre of the box."},
     {"width", "a", "Width of the picture. Without a value the whole box is visible."},
     {"azimuth", "deg",
      "Of spheres: as in [view], at this time. Without a value it is that angle."},
     {"elevation", "deg",
      "Of spheres: as in [view], at this time. Without a value it is that angle."}});

/// The keys of one item of [[view.camera]].
template <class Visitor>
void visit_camera(Visitor& io, CameraKey& key, int dimension) {
  io.value(kCameraKeys.at("time"), key.time, at_least(0.0));
  io.value(kCameraKeys.at("follow"), key.follow, between(0, kMaxCount));
  io.value(kCameraKeys.at("centre"), key.centre, between(-kMaxCameraWidth, kMaxCameraWidth),
           key.follow ? kNotBesideFollow : kOptional);
  io.value(kCameraKeys.at("width"), key.width, between(kMinCameraWidth, kMaxCameraWidth));
  if (dimension == 3) {
    io.value(kCameraKeys.at("azimuth"), key.azimuth, kAzimuths);
    io.value(kCameraKeys.at("elevation"), key.elevation, kElevations);
  }
}

inline constexpr auto kCaptionKeys = key_table(
    "view render",
    {{"text", "",
      "Text over the picture. `_` and `^` lower and raise the next letter or the letters in "
      "braces: "
      "`T_x`, `v^2`, `T_{refined}`. A backslash before such a mark writes the mark."},
     {"from", "t",
      "Simulation time at which the text appears. Without a value it is there from the beginning."},
     {"to", "t",
      "Simulation time at which the text has disappeared. Without a value it stays to the end."}});

/// The keys of one item of [[view.captions]].
template <class Visitor>
void visit_caption(Visitor& io, Caption& caption) {
  io.value(kCaptionKeys.at("text"), caption.text, Limits{}, kRequired);
  io.value(kCaptionKeys.at("from"), caption.from, at_least(0.0));
  io.value(kCaptionKeys.at("to"), caption.to, above(caption.from.value_or(0.0)));
}

inline constexpr auto kSlabKeys = key_table(
    "view render", {{"axis", "", "Axis perpendicular to the planes."},
                    {"from", "a", "Position of the first plane."},
                    {"to", "a", "Position of the second plane. It is larger than `from`."}});

/// The keys of [view.slab].
template <class Visitor>
void visit_slab(Visitor& io, Slab& slab) {
  io.choice(kSlabKeys.at("axis"), slab.axis, kAxes, kRequired);
  io.value(kSlabKeys.at("from"), slab.from, between(-kMaxLength, kMaxLength), kRequired);
  io.value(kSlabKeys.at("to"), slab.to,
           Limits{.lowest = slab.from, .highest = kMaxLength, .above = true}, kRequired);
}

inline constexpr auto kSliceKeys =
    key_table("view render", {{"axis", "", "Axis perpendicular to the slice."},
                              {"position", "a", "Position of the slice on this axis."}});

/// The keys of one item of [[view.slices]].
template <class Visitor>
void visit_slice(Visitor& io, Slice& slice) {
  io.choice(kSliceKeys.at("axis"), slice.axis, kAxes, kRequired);
  io.value(kSliceKeys.at("position"), slice.position, between(0.0, kMaxLength), kRequired);
}

inline constexpr auto kLectureKeys = key_table(
    "view", {{"sliders", "",
              "Names of the sliders, as `?embed` has them. Most are keys. An empty list stands for "
              "the restitution and the drive of the scene."},
             {"plot", "",
              "The large plot: the temperature, the energy balance, the distribution of velocities "
              "or the profile."}});

/// The keys of [view.lecture].
template <class Visitor>
void visit_lecture(Visitor& io, Lecture& lecture) {
  io.value(kLectureKeys.at("sliders"), lecture.sliders, between(0, Lecture::kMostSliders));
  io.choice(kLectureKeys.at("plot"), lecture.plot, kLecturePlots);
}

inline constexpr auto kViewKeys = key_table(
    "view render",
    {{"colour_by", "", "Quantity that colours the particles. Spin needs rough particles or walls."},
     {"field", "", "Field of the heatmap below the particles. Without a value there is none."},
     {"window", "t", "Averaging time of the heatmap and the arrows."},
     {"estimator", "", "Estimator of the heatmap and the arrows, as in `measure`."},
     {"interval", "t",
      "Time between snapshots. Its range follows the `window`. The values shown are for the "
      "default window."},
     {"speed", "t/s", "Simulation time per second of film or window."},
     {"palette", "", "Colours of the particles. Quantities with a sign are blue and red."},
     {"range", "",
      "Range of the particles' colours. auto follows the picture in the window. Films keep the "
      "range of their first averaging window. locked keeps the first range."},
     {"field_palette", "",
      "Hues of the heatmap. Zero has the colour of the background. Particles stand out from all "
      "hues. Quantities with a sign are blue and red."},
     {"field_style", "",
      "Drawing of the heatmap. smooth interpolates between cells. cells gives each cell the colour "
      "of its exact value, and hatches cells without a value. A volume has cells."},
     {"field_range", "",
      "Range of the heatmap's colours. auto follows the picture in the window. Films keep the "
      "range of their first averaging window. locked keeps the range of the first whole window."},
     {"arrows", "", "Field of the arrows. Without a value there are none."},
     {"theme", "",
      "Colours of background, letters, walls and lines. It does not change the size of letters."},
     {"background", "", "Colour of the background. Without a value the theme sets it."},
     {"grid", "", "Grid lines over the box. Their spacing is the length of the scale bar."},
     {"overlay", "", "Title, captions, time, colour bar and scale bar."},
     {"trails", "t", "Duration of the particles' trails. Without a value: none."},
     {"card", "s",
      "Time of title and caption at the start of a film, while the gas moves. They fade out in the "
      "last half second. Without a value: none.",
      "render"},
     {"azimuth", "deg",
      "Of spheres: direction of the viewer, as an angle about the y axis. 0 is along z, 90 along "
      "x."},
     {"elevation", "deg", "Of spheres: height of the viewer, as an angle above the xz plane."},
     {"view_angle", "deg", "Of spheres: horizontal angle of view. 0 is a parallel projection."},
     {"volume", "1/a",
      "Of spheres: draws the heatmap as a volume, like glowing fog. The number is its extinction "
      "coefficient at the end of the colour range. Smaller magnitudes are more transparent, and "
      "cells without a value are empty. 0: no volume. With a volume there is no default slice."}});

/// The keys of [view] in a box of this dimension. The list comes last, because a file has it below
/// the other keys.
template <class Visitor>
void visit_view(Visitor& io, View& view, int dimension) {
  io.choice(kViewKeys.at("colour_by"), view.colour_by, kColourings);
  io.choice(kViewKeys.at("field"), view.field, field_names(dimension));
  const Limits times = between(kMinViewTime, kMaxViewTime);
  io.value(kViewKeys.at("window"), view.window, times);
  io.choice(kViewKeys.at("estimator"), view.estimator, kEstimators);
  const bool exact = view.estimator == Estimator::Exact;
  io.value(kViewKeys.at("interval"), view.interval,
           between(view.window / kMaxWindowSamples, view.window), exact ? kNotOfExact : kRequired);
  io.value(kViewKeys.at("speed"), view.speed, times);
  io.choice(kViewKeys.at("palette"), view.palette, kPalettes);
  const Limits colours = between(-ColourRange::kLargestEnd, ColourRange::kLargestEnd);
  io.value(kViewKeys.at("range"), view.range, colours);
  io.choice(kViewKeys.at("field_palette"), view.field_palette, kFieldPalettes);
  io.choice(kViewKeys.at("field_style"), view.field_style, kFieldStyles);
  io.value(kViewKeys.at("field_range"), view.field_range, colours);
  io.choice(kViewKeys.at("arrows"), view.arrows, kArrows);
  io.choice(kViewKeys.at("theme"), view.theme, kThemes);
  io.value(kViewKeys.at("background"), view.background, Limits{});
  io.value(kViewKeys.at("grid"), view.grid);
  io.value(kViewKeys.at("overlay"), view.overlay);
  io.value(kViewKeys.at("trails"), view.trails, times);
  io.value(kViewKeys.at("card"), view.card, times);
  if (dimension == 3) {
    io.value(kViewKeys.at("azimuth"), view.azimuth, kAzimuths);
    io.value(kViewKeys.at("elevation"), view.elevation, kElevations);
    io.value(kViewKeys.at("view_angle"), view.view_angle, between(0.0, kMaxViewAngle));
    io.value(kViewKeys.at("volume"), view.volume, between(0.0, kMaxVolume));
    io.table("slab", view.slab, [](auto& io, Slab& slab) { visit_slab(io, slab); });
    io.list("slices", view.slices, [](auto& io, Slice& slice) { visit_slice(io, slice); });
  }
  io.table("lecture", [&](auto& io) { visit_lecture(io, view.lecture); });
  io.list("captions", view.captions,
          [](auto& io, Caption& caption) { visit_caption(io, caption); });
  io.list("camera", view.camera,
          [&](auto& io, CameraKey& key) { visit_camera(io, key, dimension); });
}

inline constexpr auto kNudgeKeys = key_table(
    kRunCommands,
    {{"particle", "1", "Number of the particle, from 0. Without a value there is a region."},
     {"centre", "a",
      "Centre of the region, in the box. The particles with their centres in it change."},
     {"radius", "a", "Radius of the region, a disk or a ball. It continues across periodic sides."},
     {"scale", "1",
      "Factor of the velocities relative to the mean velocity of the region. Above 1 it heats, "
      "below 1 it cools. The momentum remains."},
     {"add", "a/t", "Velocity that is added to each velocity."},
     {"set", "a/t", "New velocity of each particle."}});

/// The keys of [change.nudge].
template <class Visitor>
void visit_nudge(Visitor& io, Nudge& nudge) {
  const Limits speeds = between(-kMaxSpeed, kMaxSpeed);
  io.value(kNudgeKeys.at("particle"), nudge.particle, between(0, kMaxCount));
  const Presence of_region = nudge.particle ? kNotBesideParticle : kOptional;
  io.value(kNudgeKeys.at("centre"), nudge.centre, at_least(0.0), of_region);
  io.value(kNudgeKeys.at("radius"), nudge.radius,
           Limits{.lowest = 0.0, .highest = kMaxLength, .above = true}, of_region);
  io.value(kNudgeKeys.at("scale"), nudge.scale, between(0.0, kMaxScale), of_region);
  io.value(kNudgeKeys.at("add"), nudge.add, speeds, nudge.scale ? kOneOfNudge : kOptional);
  io.value(kNudgeKeys.at("set"), nudge.set, speeds,
           nudge.scale || nudge.add ? kOneOfNudge : kOptional);
}

inline constexpr auto kChangeKeys = key_table(
    kRunCommands,
    {{"time", "t", "Simulation time of the change."},
     {"set", "", "Keys and their new values. Only keys that can change in a run are allowed."},
     {"ramp", "",
      "Transition of numbers to their new values. Without a value the change is immediate."},
     {"until", "t", "Simulation time at which the ramp ends. It is later than `time`."}});

/// The keys of one item of [[change]].
template <class Visitor>
void visit_change(Visitor& io, Change& change) {
  io.value(kChangeKeys.at("time"), change.time, at_least(0.0), kRequired);
  io.settings(kChangeKeys.at("set"), change.set);
  io.choice(kChangeKeys.at("ramp"), change.ramp, kRamps);
  io.value(kChangeKeys.at("until"), change.until, above(change.time),
           change.ramp ? kRequired : kNotWithoutRamp);
  io.table("nudge", change.nudge, [](auto& io, Nudge& nudge) { visit_nudge(io, nudge); });
}

inline constexpr auto kSceneKeys = key_table(
    kRunCommands, {{"schema", "1", "Version of the format."},
                   {"title", "", "Title in pictures, in the gallery and in results."},
                   {"caption", "", "One line about the effect to watch."},
                   {"goal", "", "The aim of the scene as a lesson.", "view"},
                   {"try_this", "", "Proposal for an experiment in the window.", "view"}});
inline constexpr auto kBoxKeys = key_table(
    kRunCommands, {{"size", "a", "Sides of the box. Two numbers make disks, three make spheres."}});
inline constexpr auto kGravityKeys =
    key_table(kRunCommands, {{"acceleration", "a/t^2", "Acceleration of all particles."}});
inline constexpr auto kCollapseKeys = key_table(
    kRunCommands,
    {{"contact_time", "t",
      "Contact time t_c. A collision is elastic if one of its partners collided less than t_c "
      "before. Without a value: off."}});

/// All keys of a scene file.
template <class Visitor>
void visit_scene(Visitor& io, SceneInput& input) {
  Scene& scene = input.scene;
  io.value(kSceneKeys.at("schema"), input.schema, between(1, 1));
  io.value(kSceneKeys.at("title"), scene.title);
  io.value(kSceneKeys.at("caption"), scene.caption);
  io.value(kSceneKeys.at("goal"), scene.goal);
  io.value(kSceneKeys.at("try_this"), scene.try_this);
  // Sides must exceed one diameter: a particle between walls needs room to move, and a particle
  // must not touch its own periodic image.
  io.table("box", [&](auto& io) {
    io.value(kBoxKeys.at("size"), scene.box,
             Limits{.lowest = 1.0, .highest = kMaxLength, .above = true});
  });
  io.table("particles", [&](auto& io) { visit_particles(io, input); });
  io.table("walls", [&](auto& io) {
    for (int side = 0; side < 2 * scene.dimension(); ++side) {
      io.table(kSideNames[side], scene.walls[side],
               [](auto& io, Wall& wall) { visit_wall(io, wall); });
    }
  });
  io.table("gravity", scene.gravity, [&](auto& io, VecX& acceleration) {
    if (acceleration.size() == 0) acceleration = VecX::Zero(scene.dimension());
    io.value(kGravityKeys.at("acceleration"), acceleration,
             between(-kMaxAcceleration, kMaxAcceleration), kRequired);
  });
  io.table("bulk_drive", scene.bulk_drive,
           [&](auto& io, BulkDrive& drive) { visit_bulk_drive(io, drive, input.spin_key()); });
  io.table("collapse", [&](auto& io) {
    io.value(kCollapseKeys.at("contact_time"), scene.contact_time, above(0.0));
  });
  const int dimension = scene.dimension();
  io.table("measure", [&](auto& io) { visit_measure(io, scene.measure, dimension); });
  io.table("view", [&](auto& io) { visit_view(io, scene.view, dimension); });
  io.list("change", scene.changes, [](auto& io, Change& change) { visit_change(io, change); });
}

}  // namespace clatter
