#pragma once

#include <array>
#include <limits>
#include <optional>
#include <string_view>

#include "engine/scene/scene.h"

// Every key of the scene file, in the order in which it is written, told once. A visitor passes
// over the keys to list, read or write them (key_lister.h, key_reader.h, key_writer.h); it has
//   value(key, variable, limits, presence)   for numbers, flags, text and arrays of numbers,
//   value(key, optional, limits)             for a number that may be absent,
//   choice(key, variable, names, presence)   for enumerations, optional ones, and lists of them,
//   table(key, function)                     for a table whose keys the function passes over,
//   table(key, optional, function)           for one that may be absent.

namespace clatter {

/// The numbers that a key allows, from `lowest` (itself excluded where `above` is set) to
/// `highest`.
struct Limits {
  double lowest = -std::numeric_limits<double>::max();
  double highest = std::numeric_limits<double>::max();
  bool above = false;

  /// Whether the number lies within; NaN and infinities never do.
  bool allow(double number) const {
    return (above ? number > lowest : number >= lowest) && number <= highest;
  }
};

constexpr Limits between(double lowest, double highest) {
  return {.lowest = lowest, .highest = highest};
}
constexpr Limits at_least(double lowest) {
  return {.lowest = lowest};
}
constexpr Limits above(double lowest) {
  return {.lowest = lowest, .above = true};
}

/// Speeds and temperatures stop where their squares and the times between collisions still are
/// ordinary numbers; box sides where a position still has a rounding error of 1e-10 diameters.
inline constexpr double kMostSpeed = 1e15;
inline constexpr double kMostTemperature = 1e30;
inline constexpr double kMostLength = 1e6;

/// Whether a table must, may or must not have a key.
enum class Presence { Required, Optional, Forbidden };

/// What an enumerator is called in scene files.
template <class E>
struct Named {
  std::string_view name;
  E value;
};

inline constexpr std::array<Named<Layout>, 2> kLayouts = {
    {{"random", Layout::Random}, {"lattice", Layout::Lattice}}};

inline constexpr std::array<Named<WallKind>, 3> kWallKinds = {
    {{"static", WallKind::Static}, {"driven", WallKind::Driven}, {"thermal", WallKind::Thermal}}};

inline constexpr std::array<Named<ColourBy>, 4> kColourings = {
    {{"none", ColourBy::None},
     {"speed", ColourBy::Speed},
     {"velocity_x", ColourBy::VelocityX},
     {"velocity_y", ColourBy::VelocityY}}};

inline constexpr std::array<Named<Palette>, 2> kPalettes = {
    {{"viridis", Palette::Viridis}, {"inferno", Palette::Inferno}}};

/// Heatmaps, one component each.
inline constexpr std::array<Named<Field>, 6> kHeatmaps = {{{"density", Field::Density},
                                                           {"velocity_x", Field::VelocityX},
                                                           {"velocity_y", Field::VelocityY},
                                                           {"temperature", Field::Temperature},
                                                           {"temperature_x", Field::TemperatureX},
                                                           {"temperature_y", Field::TemperatureY}}};

/// Measured fields; a name stands for all the components in its rows.
inline constexpr std::array<Named<Field>, 6> kProfiles = {{{"density", Field::Density},
                                                           {"velocity", Field::VelocityX},
                                                           {"velocity", Field::VelocityY},
                                                           {"temperature", Field::Temperature},
                                                           {"temperature_x", Field::TemperatureX},
                                                           {"temperature_y", Field::TemperatureY}}};

/// What a scene file says: the scene, and the keys that are resolved when it is read.
struct SceneInput {
  int schema = 1;                       ///< version of the format
  std::optional<int> count;             ///< the number of disks, given by exactly one of these two
  std::optional<double> area_fraction;  ///< phi
  Scene scene;
};

/// The keys of one wall; which of them it may have depends on its kind.
template <class Visitor>
void visit_wall(Visitor& io, Wall& wall) {
  using enum Presence;
  io.choice("kind", wall.kind, kWallKinds, Required);
  const bool driven = wall.kind == WallKind::Driven;
  const bool thermal = wall.kind == WallKind::Thermal;
  io.value("restitution", wall.restitution, between(0.0, 1.0), thermal ? Forbidden : Optional);
  io.value("drive_speed", wall.drive_speed, between(0.0, kMostSpeed),
           driven ? Required : Forbidden);
  io.value("temperature", wall.temperature, between(0.0, kMostTemperature),
           thermal ? Required : Forbidden);
}

template <class Visitor>
void visit_disks(Visitor& io, SceneInput& input) {
  constexpr double kMostDisks = std::numeric_limits<int>::max();
  Disks& disks = input.scene.disks;
  io.value("count", input.count, between(0, kMostDisks));
  io.value("area_fraction", input.area_fraction, between(0.0, 1.0));
  io.value("restitution", disks.restitution, between(0.0, 1.0));
  io.table("start", [&disks](auto& io) {
    io.choice("layout", disks.start.layout, kLayouts);
    io.value("temperature", disks.start.temperature, between(0.0, kMostTemperature));
  });
}

template <class Visitor>
void visit_measure(Visitor& io, Measure& measure) {
  io.value("burn_in", measure.burn_in, at_least(0.0));
  io.value("duration", measure.duration, above(0.0));
  io.value("series_interval", measure.series_interval, above(0.0));
  io.choice("fields", measure.fields, kProfiles);
  io.value("cells", measure.cells, between(1, 2000));
}

template <class Visitor>
void visit_view(Visitor& io, View& view) {
  io.choice("colour_by", view.colour_by, kColourings);
  io.choice("field", view.field, kHeatmaps);
  io.value("window", view.window, above(0.0));
  io.value("speed", view.speed, above(0.0));
  io.choice("palette", view.palette, kPalettes);
  io.value("range", view.range);
  io.value("overlay", view.overlay);
}

/// All keys of a scene file.
template <class Visitor>
void visit_scene(Visitor& io, SceneInput& input) {
  Scene& scene = input.scene;
  io.value("schema", input.schema, between(1, 1));
  io.value("title", scene.title);
  io.value("caption", scene.caption);
  // A side of one diameter leaves a disk between walls no room to move, and across a periodic
  // side the disk touches its own image.
  io.table("box", [&](auto& io) {
    io.value("size", scene.box, Limits{.lowest = 1.0, .highest = kMostLength, .above = true});
  });
  io.table("disks", [&](auto& io) { visit_disks(io, input); });
  io.table("walls", [&](auto& io) {
    for (int side = 0; side < 4; ++side) {
      io.table(kSideNames[side], scene.walls[side],
               [](auto& io, Wall& wall) { visit_wall(io, wall); });
    }
  });
  io.table("measure", [&](auto& io) { visit_measure(io, scene.measure); });
  io.table("view", [&](auto& io) { visit_view(io, scene.view); });
}

}  // namespace clatter
