#pragma once

#include <array>
#include <limits>
#include <optional>
#include <string_view>

#include "engine/scene/scene.h"

// Every key of the scene file, in the order in which it is written, told once. A visitor passes
// over the keys to list, read or write them (key_lister.h, key_reader.h, key_writer.h); it has
//   value(key, variable, limits, presence)   for numbers, flags, text and arrays of numbers,
//   value(key, optional, limits, presence)   for a number that may be absent,
//   choice(key, variable, names, presence)   for enumerations and fields, optional ones, and lists
//                                            of them,
//   table(key, function)                     for a table whose keys the function passes over,
//   table(key, optional, function)           for one that may be absent,
//   list(key, items, function)               for an array of tables,
//   settings(key, overrides)                 for a table of any keys.

namespace clatter {

/// The numbers that a key allows, from `lowest` (itself excluded where `above` is set) to
/// `highest`, which may be infinite.
struct Limits {
  double lowest = -std::numeric_limits<double>::max();
  double highest = std::numeric_limits<double>::max();
  bool above = false;

  /// Whether the number lies within; NaN never does.
  bool allow(double number) const {
    return (above ? number > lowest : number >= lowest) && number <= highest;
  }
};

/// Numbers from `lowest` to `highest`, both among them.
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
/// Numbers from `lowest` on, infinity among them.
constexpr Limits at_least_or_infinite(double lowest) {
  return {.lowest = lowest, .highest = std::numeric_limits<double>::infinity()};
}

/// Speeds and temperatures stop where their squares and the times between collisions still are
/// ordinary numbers; box sides where a position still has a rounding error of 1e-10 diameters; a
/// wall's phase where it is as precise in its period; inertia where spins are not faster than
/// speeds by more than they have room for.
inline constexpr double kMaxSpeed = 1e15;
inline constexpr double kMaxTemperature = 1e30;
inline constexpr double kMaxAcceleration = 1e15;
inline constexpr double kMaxLength = 1e6;
inline constexpr double kMaxFrequency = 1e15;
inline constexpr double kMaxPhase = 1e6;
inline constexpr double kMinInertia = 1e-9;
/// Limits of the times of [view] and of its speed: so many of one fit into another, and the clock
/// can count them.
inline constexpr double kMinViewTime = 1e-30;
inline constexpr double kMaxViewTime = 1e30;
/// Most samples of the snapshot estimator that an averaging window holds.
inline constexpr double kMaxWindowSamples = 1e6;
/// Limits of the camera: a picture as wide as a thousandth of a particle or a thousand boxes, and
/// as far away.
inline constexpr double kMinCameraWidth = 1e-3;
inline constexpr double kMaxCameraWidth = 1e9;
/// A wall that gives more than it gets (theory 4.1) has a restitution above 1.
inline constexpr double kMaxWallRestitution = 10.0;

/// Whether a table must, may or must not have a key.
struct Presence {
  enum Kind { Required, Optional, Forbidden };
  Kind kind = Optional;
  const char* reason = "";  ///< where forbidden: "has no meaning ..."
  const char* advice = "";  ///< what to do then
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

inline constexpr Presence kNotBesideFollow = {Presence::Forbidden, "has no meaning beside follow",
                                              "remove one of the two"};

/// What an enumerator is called in scene files.
template <class E>
struct Named {
  std::string_view name;
  E value;
};

/// The first name of an enumerator or field in a list of pairs of name and value; empty where it
/// has none.
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

inline constexpr std::array<Named<ColourBy>, 5> kColourings = {{{"none", ColourBy::None},
                                                                {"speed", ColourBy::Speed},
                                                                {"velocity_x", ColourBy::VelocityX},
                                                                {"velocity_y", ColourBy::VelocityY},
                                                                {"spin", ColourBy::Spin}}};

inline constexpr std::array<Named<Palette>, 3> kPalettes = {
    {{"viridis", Palette::Viridis}, {"inferno", Palette::Inferno}, {"cividis", Palette::Cividis}}};

/// What arrows may show.
inline constexpr std::array<Named<Quantity>, 2> kArrows = {
    {{traits_of(Quantity::Velocity).name, Quantity::Velocity},
     {traits_of(Quantity::HeatFlux).name, Quantity::HeatFlux}}};

inline constexpr std::array<Named<Theme>, 3> kThemes = {
    {{"dark", Theme::Dark}, {"light", Theme::Light}, {"projector", Theme::Projector}}};

inline constexpr std::array<Named<Axis>, 3> kAxes = {
    {{"x", Axis::X}, {"y", Axis::Y}, {"z", Axis::Z}}};

inline constexpr std::array<Named<Estimator>, 2> kEstimators = {
    {{"exact", Estimator::Exact}, {"snapshot", Estimator::Snapshot}}};

inline constexpr std::array<Named<Kernel>, 2> kKernels = {
    {{"box", Kernel::Box}, {"gaussian", Kernel::Gaussian}}};

inline constexpr std::array<Named<Ramp>, 1> kRamps = {{{"linear", Ramp::Linear}}};

/// What a scene file says: the scene, and the keys that are resolved when it is read.
struct SceneInput {
  int schema = 1;            ///< version of the format
  std::optional<int> count;  ///< the number of particles, given by exactly one of these two
  std::optional<double>
      packing_fraction;  ///< phi: area_fraction of disks, volume_fraction of spheres
  bool spins = true;     ///< whether the keys of spins are allowed
  Scene scene;

  /// The dotted key of the packing fraction.
  std::string_view packing_key() const {
    return scene.dimension() == 2 ? "particles.area_fraction" : "particles.volume_fraction";
  }
  /// Of a key that spins give its meaning.
  Presence spin_key() const { return spins ? kOptional : kNotWithoutSpins; }
};

/// The keys of rough partners, particles or walls.
template <class Visitor>
void visit_roughness(Visitor& io, Roughness& roughness, Presence presence) {
  io.value("friction", roughness.friction, at_least_or_infinite(0.0), presence);
  io.value("tangential_restitution", roughness.tangential_restitution, between(-1.0, 1.0),
           presence);
}

/// The keys of one wall; which of them it may have depends on its kind.
template <class Visitor>
void visit_wall(Visitor& io, Wall& wall) {
  io.choice("kind", wall.kind, kWallKinds, kRequired);
  const bool driven = wall.kind == WallKind::Driven;
  const bool thermal = wall.kind == WallKind::Thermal;
  const Presence of_touch = thermal ? kNotOfWall : kOptional;
  const Presence of_motion = wall.moves() ? kRequired : kNotOfWall;
  io.value("restitution", wall.restitution, between(0.0, kMaxWallRestitution), of_touch);
  visit_roughness(io, wall.roughness, of_touch);
  io.value("drive_speed", wall.drive_speed, between(0.0, kMaxSpeed),
           driven ? kRequired : kNotOfWall);
  io.value("temperature", wall.temperature, between(0.0, kMaxTemperature),
           thermal ? kRequired : kNotOfWall);
  io.value("stroke", wall.stroke, between(0.0, kMaxLength), of_motion);
  io.value("frequency", wall.frequency, between(0.0, kMaxFrequency), of_motion);
  io.value("phase", wall.phase, between(-kMaxPhase, kMaxPhase),
           wall.moves() ? kOptional : kNotOfWall);
}

/// The keys of [particles.start]; which of them it may have depends on its layout.
template <class Visitor>
void visit_start(Visitor& io, Start& start, Presence spin_key) {
  io.choice("layout", start.layout, kLayouts);
  const bool from_file = start.layout == Layout::File;
  io.value("file", start.file, Limits{}, from_file ? kRequired : kNotWithoutFile);
  io.value("temperature", start.temperature, between(0.0, kMaxTemperature),
           from_file ? kNotBesideFile : kOptional);
  io.value("spin_temperature", start.spin_temperature, between(0.0, kMaxTemperature),
           from_file ? kNotBesideFile : spin_key);
}

/// The keys of [particles]; count and packing fraction are resolved when the whole scene is known.
template <class Visitor>
void visit_particles(Visitor& io, SceneInput& input) {
  constexpr double kLargestCount = std::numeric_limits<int>::max();
  Particles& particles = input.scene.particles;
  io.value("count", input.count, between(0, kLargestCount));
  io.value(input.packing_key().substr(std::string_view("particles.").size()),
           input.packing_fraction, between(0.0, 1.0));
  io.value("restitution", particles.restitution, between(0.0, 1.0));
  visit_roughness(io, particles.roughness, kOptional);
  io.value("inertia", particles.inertia, between(kMinInertia, 1.0), input.spin_key());
  io.table("start", [&](auto& io) { visit_start(io, particles.start, input.spin_key()); });
}

/// The keys of [bulk_drive], where there is one.
template <class Visitor>
void visit_bulk_drive(Visitor& io, BulkDrive& drive, Presence spin_key) {
  io.value("interval", drive.interval, above(0.0), kRequired);
  io.value("kick_speed", drive.kick_speed, between(0.0, kMaxSpeed), kRequired);
  io.value("kick_spin", drive.kick_spin, between(0.0, kMaxSpeed), spin_key);
}

/// The keys of [measure] in a box of so many dimensions; those of snapshots and of the Gaussian
/// only with these.
template <class Visitor>
void visit_measure(Visitor& io, Measure& measure, int dimension) {
  io.value("burn_in", measure.burn_in, at_least(0.0));
  io.value("duration", measure.duration, above(0.0));
  io.value("series_interval", measure.series_interval, above(0.0));
  io.choice("fields", measure.fields, measured_names(dimension));
  io.value("cells", measure.cells, between(1, 2000));
  io.choice("profile_axis", measure.profile_axis, kAxes);
  io.choice("estimator", measure.estimator, kEstimators);
  const bool exact = measure.estimator == Estimator::Exact;
  io.value("interval", measure.interval, above(0.0), exact ? kNotOfExact : kRequired);
  io.choice("kernel", measure.kernel, kKernels);
  const bool box = measure.kernel == Kernel::Box;
  io.value("width", measure.width, above(0.0), box ? kNotOfBox : kRequired);
}

/// The keys of one of [[view.camera]].
template <class Visitor>
void visit_camera(Visitor& io, CameraKey& key) {
  io.value("time", key.time, at_least(0.0));
  io.value("follow", key.follow, at_least(0.0));
  io.value("centre", key.centre, between(-kMaxCameraWidth, kMaxCameraWidth),
           key.follow ? kNotBesideFollow : kOptional);
  io.value("width", key.width, between(kMinCameraWidth, kMaxCameraWidth));
}

/// The keys of [view] in a box of so many dimensions; the list comes last, because in a file it
/// stands below the other keys.
template <class Visitor>
void visit_view(Visitor& io, View& view, int dimension) {
  io.choice("colour_by", view.colour_by, kColourings);
  io.choice("field", view.field, field_names(dimension));
  const Limits times = between(kMinViewTime, kMaxViewTime);
  io.value("window", view.window, times);
  io.choice("estimator", view.estimator, kEstimators);
  const bool exact = view.estimator == Estimator::Exact;
  io.value("interval", view.interval, between(view.window / kMaxWindowSamples, view.window),
           exact ? kNotOfExact : kRequired);
  io.value("speed", view.speed, times);
  io.choice("palette", view.palette, kPalettes);
  const Limits colours = between(-ColourRange::kLargestEnd, ColourRange::kLargestEnd);
  io.value("range", view.range, colours);
  io.choice("field_palette", view.field_palette, kPalettes);
  io.value("field_range", view.field_range, colours);
  io.choice("arrows", view.arrows, kArrows);
  io.choice("theme", view.theme, kThemes);
  io.value("background", view.background, Limits{});
  io.value("grid", view.grid);
  io.value("overlay", view.overlay);
  io.value("trails", view.trails, times);
  io.value("card", view.card, times);
  io.list("camera", view.camera, [](auto& io, CameraKey& key) { visit_camera(io, key); });
}

/// The keys of one of [[change]].
template <class Visitor>
void visit_change(Visitor& io, Change& change) {
  io.value("time", change.time, at_least(0.0), kRequired);
  io.settings("set", change.set);
  io.choice("ramp", change.ramp, kRamps);
  io.value("until", change.until, above(change.time), change.ramp ? kRequired : kNotWithoutRamp);
}

/// All keys of a scene file.
template <class Visitor>
void visit_scene(Visitor& io, SceneInput& input) {
  Scene& scene = input.scene;
  io.value("schema", input.schema, between(1, 1));
  io.value("title", scene.title);
  io.value("caption", scene.caption);
  io.value("goal", scene.goal);
  io.value("try_this", scene.try_this);
  // A side of one diameter leaves a particle between walls no room to move, and across a periodic
  // side the particle touches its own image.
  io.table("box", [&](auto& io) {
    io.value("size", scene.box, Limits{.lowest = 1.0, .highest = kMaxLength, .above = true});
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
    io.value("acceleration", acceleration, between(-kMaxAcceleration, kMaxAcceleration), kRequired);
  });
  io.table("bulk_drive", scene.bulk_drive,
           [&](auto& io, BulkDrive& drive) { visit_bulk_drive(io, drive, input.spin_key()); });
  io.table("collapse", [&](auto& io) { io.value("contact_time", scene.contact_time, above(0.0)); });
  const int dimension = scene.dimension();
  io.table("measure", [&](auto& io) { visit_measure(io, scene.measure, dimension); });
  io.table("view", [&](auto& io) { visit_view(io, scene.view, dimension); });
  io.list("change", scene.changes, [](auto& io, Change& change) { visit_change(io, change); });
}

}  // namespace clatter
