#pragma once

#include "engine/scene/enum_names.h"
#include "engine/scene/key_rules.h"
#include "engine/scene/key_table.h"
#include "engine/scene/limits.h"
#include "engine/scene/scene_input.h"

// The keys of walls, particles and bulk driving, see scene_keys.h.

namespace clatter {

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

}  // namespace clatter
