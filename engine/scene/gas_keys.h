#pragma once

#include "engine/scene/enum_names.h"
#include "engine/scene/key_rules.h"
#include "engine/scene/key_table.h"
#include "engine/scene/limits.h"
#include "engine/scene/scene_input.h"

// The keys of walls, particles, species and bulk driving, see scene_keys.h.

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

inline constexpr auto kOtherRoughnessKeys = key_table(
    kRunCommands,
    {{"friction", "1",
      "Coulomb's coefficient of friction. Without a value that of all species. 0 is smooth."},
     {"tangential_restitution", "1",
      "Ratio of the tangential velocities of a contact that sticks. Without a value that of all "
      "species."}});

/// The keys of a roughness, as far as it differs for some species.
template <class Visitor>
void visit_other_roughness(Visitor& io, Roughness& roughness, Presence presence) {
  io.value(kOtherRoughnessKeys.at("friction"), roughness.friction, at_least_or_infinite(0.0),
           presence);
  io.value(kOtherRoughnessKeys.at("tangential_restitution"), roughness.tangential_restitution,
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
      "at that time."},
     {"surface_velocity", "a/t",
      "Velocity of the surface along the wall. It drags particles that the wall emits, and those "
      "that meet friction. The component across the wall is 0."}});

/// The keys of one wall of a box. Its kind determines which of them are allowed.
template <class Visitor>
void visit_wall(Visitor& io, Wall& wall, int dimension) {
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
  VecX surface = VecX::Zero(dimension);
  std::copy_n(wall.surface_velocity.begin(), dimension, surface.begin());
  io.value(kWallKeys.at("surface_velocity"), surface, between(-kMaxSpeed, kMaxSpeed));
  std::copy_n(surface.begin(), dimension, wall.surface_velocity.begin());
}

inline constexpr auto kSpeciesWallKeys = key_table(
    kRunCommands,
    {{"restitution", "1", "Restitution of the wall for this species."},
     {"drive_speed", "a/t", "Gain in normal velocity of this species at each bounce."},
     {"temperature", "m a^2/t^2", "Temperature of the particles of this species that leave."}});

/// The keys of a wall as one species meets it. The kind of the wall determines which are allowed.
template <class Visitor>
void visit_species_wall(Visitor& io, SpeciesWall& differences, const Wall& wall) {
  const bool thermal = wall.kind == WallKind::Thermal;
  const Presence of_touch = thermal ? kNotOfWall : kOptional;
  io.value(kSpeciesWallKeys.at("restitution"), differences.restitution,
           between(0.0, kMaxWallRestitution), of_touch);
  visit_other_roughness(io, differences.roughness, of_touch);
  io.value(kSpeciesWallKeys.at("drive_speed"), differences.drive_speed, between(0.0, kMaxSpeed),
           wall.kind == WallKind::Driven ? kOptional : kNotOfWall);
  io.value(kSpeciesWallKeys.at("temperature"), differences.temperature,
           between(0.0, kMaxTemperature), thermal ? kOptional : kNotOfWall);
}

inline constexpr auto kFixtureKeys = key_table(
    kRunCommands,
    {{"name", "",
      "Name in results, of letters, digits, `_` and `-`. Without a value the kind and a number."},
     {"present", "", "Whether it is there. A change to false removes it during a run."},
     {"restitution", "1", "Ratio of the normal velocities after and before a bounce."},
     {"drive_speed", "a/t",
      "Gain in normal velocity at each bounce. Without a value the surface is at rest."},
     {"temperature", "m a^2/t^2",
      "Temperature of the particles that leave. Without a value the surface reflects."}});

/// The keys of the law of an obstacle or a partition.
template <class Visitor>
void visit_fixture_law(Visitor& io, FixtureLaw& law, const std::vector<std::string>& species) {
  SpeciesWall& all = law.of_all;
  io.value(kFixtureKeys.at("temperature"), all.temperature, between(0.0, kMaxTemperature));
  const bool thermal = all.temperature.has_value();
  const Presence of_touch = thermal ? kNotOfThermal : kOptional;
  io.value(kFixtureKeys.at("restitution"), all.restitution, between(0.0, kMaxWallRestitution),
           of_touch);
  visit_roughness(io, all.roughness, of_touch);
  io.value(kFixtureKeys.at("drive_speed"), all.drive_speed, between(0.0, kMaxSpeed), of_touch);
  law.of_species.resize(species.size());
  io.table("species", [&](auto& io) {
    for (std::size_t k = 0; k < species.size(); ++k) {
      io.table(species[k], [&](auto& io) {
        SpeciesWall& one = law.of_species[k];
        io.value(kSpeciesWallKeys.at("restitution"), one.restitution,
                 between(0.0, kMaxWallRestitution), of_touch);
        visit_other_roughness(io, one.roughness, of_touch);
        io.value(kSpeciesWallKeys.at("drive_speed"), one.drive_speed, between(0.0, kMaxSpeed),
                 all.drive_speed ? of_touch : kNotWithoutDrive);
        io.value(kSpeciesWallKeys.at("temperature"), one.temperature, between(0.0, kMaxTemperature),
                 thermal ? kOptional : kNotWithoutTemperature);
      });
    }
  });
}

inline constexpr auto kObstacleKeys = key_table(
    kRunCommands,
    {{"kind", "", "Shape: a ball (in 2D a disk), a polygon in 2D, or a box along the axes."},
     {"centre", "a", "Centre of a ball."},
     {"radius", "a", "Radius of a ball."},
     {"corners", "a", "Corners of a polygon, in order around it."},
     {"from", "a", "Lowest corner of a box."},
     {"to", "a", "Highest corner of a box."}});

/// The keys of one item of [[obstacle]]. Its kind determines which of them are allowed.
template <class Visitor>
void visit_obstacle(Visitor& io, Obstacle& obstacle, int dimension,
                    const std::vector<std::string>& species) {
  for (VecX* place : {&obstacle.centre, &obstacle.from, &obstacle.to}) {
    if (place->size() != dimension) *place = VecX::Zero(dimension);
  }
  const Limits place = between(-kMaxLength, 2.0 * kMaxLength);
  const auto of = [&](ObstacleKind kind) {
    return obstacle.kind == kind ? kRequired : kNotOfObstacle;
  };
  io.value(kFixtureKeys.at("name"), obstacle.name, Limits{});
  io.choice(kObstacleKeys.at("kind"), obstacle.kind, kObstacleKinds, kRequired);
  io.value(kObstacleKeys.at("centre"), obstacle.centre, place, of(ObstacleKind::Ball));
  io.value(kObstacleKeys.at("radius"), obstacle.radius,
           Limits{.lowest = 0.0, .highest = kMaxLength, .above = true}, of(ObstacleKind::Ball));
  io.value(kObstacleKeys.at("corners"), obstacle.corners, place, of(ObstacleKind::Polygon));
  io.value(kObstacleKeys.at("from"), obstacle.from, place, of(ObstacleKind::Box));
  io.value(kObstacleKeys.at("to"), obstacle.to, place, of(ObstacleKind::Box));
  io.value(kFixtureKeys.at("present"), obstacle.present);
  visit_fixture_law(io, obstacle.law, species);
}

inline constexpr auto kPartitionKeys = key_table(
    kRunCommands,
    {{"axis", "", "Axis at right angles to the partition."},
     {"position", "a", "Position along this axis. The partition has no thickness."},
     {"passes", "", "Names of species that do not see the partition: it is a membrane."}});
inline constexpr auto kHoleKeys = key_table(
    kRunCommands, {{"from", "a",
                    "Lower end of the hole along the other axis. In 3D along the other two, "
                    "in order."},
                   {"to", "a", "Upper end of the hole, in the same way."}});

inline constexpr auto kValveKeys = key_table(
    kRunCommands,
    {{"faster_than", "a/t", "Least speed of the particles that pass. Without a value any speed."},
     {"slower_than", "a/t", "Speed below which particles pass. Without a value any speed."},
     {"from", "",
      "Side from which particles pass: left is the lower one along the axis. Without "
      "a value both."}});

/// The keys of one item of [[partition]].
template <class Visitor>
void visit_partition(Visitor& io, Partition& partition, int dimension,
                     const std::vector<std::string>& species) {
  io.value(kFixtureKeys.at("name"), partition.name, Limits{});
  io.choice(kPartitionKeys.at("axis"), partition.axis, kAxes);
  io.value(kPartitionKeys.at("position"), partition.position, between(0.0, kMaxLength), kRequired);
  io.value(kPartitionKeys.at("passes"), partition.passes, between(0, kMaxSpecies));
  io.value(kFixtureKeys.at("present"), partition.present);
  visit_fixture_law(io, partition.law, species);
  io.list("holes", partition.holes, [&](auto& io, Hole& hole) {
    hole.from.resize(static_cast<std::size_t>(dimension - 1));
    hole.to.resize(hole.from.size());
    io.value(kHoleKeys.at("from"), hole.from, between(0.0, kMaxLength), kRequired);
    io.value(kHoleKeys.at("to"), hole.to, between(0.0, kMaxLength), kRequired);
    io.table("valve", hole.valve, [](auto& io, HoleValve& valve) {
      io.value(kValveKeys.at("faster_than"), valve.faster_than, between(0.0, kMaxSpeed));
      io.value(kValveKeys.at("slower_than"), valve.slower_than, between(0.0, kMaxSpeed));
      io.choice(kValveKeys.at("from"), valve.from, kPartitionSides);
    });
  });
}

inline constexpr auto kPistonKeys = key_table(
    kRunCommands,
    {{"axis", "", "Axis along which the piston slides, between two walls."},
     {"position", "a", "Position of its middle at time 0."},
     {"mass", "m", "Mass of the piston."},
     {"thickness", "a", "Thickness along the axis."},
     {"speed", "a/t", "Velocity along the axis at time 0."},
     {"force", "m a/t^2",
      "Constant force on the piston along the axis: a weight. Gravity acts on particles alone."},
     {"pinned", "",
      "Whether the piston is held at rest. A change during a run pins it or sets it free."},
     {"restitution", "1", "Ratio of the normal relative velocities after and before a hit."}});

/// The keys of [piston], if the table exists.
template <class Visitor>
void visit_piston(Visitor& io, Piston& piston, const std::vector<std::string>& species) {
  io.choice(kPistonKeys.at("axis"), piston.axis, kAxes);
  io.value(kPistonKeys.at("position"), piston.position, between(0.0, kMaxLength), kRequired);
  io.value(kPistonKeys.at("mass"), piston.mass, between(kMinMass, kMaxMass), kRequired);
  io.value(kPistonKeys.at("thickness"), piston.thickness, between(0.0, kMaxLength));
  io.value(kPistonKeys.at("speed"), piston.speed, between(-kMaxSpeed, kMaxSpeed));
  io.value(kPistonKeys.at("force"), piston.force, between(-kMaxAcceleration, kMaxAcceleration));
  io.value(kPistonKeys.at("pinned"), piston.pinned);
  SpeciesWall& all = piston.law.of_all;
  io.value(kPistonKeys.at("restitution"), all.restitution, between(0.0, 1.0));
  visit_roughness(io, all.roughness, kOptional);
  piston.law.of_species.resize(species.size());
  io.table("species", [&](auto& io) {
    for (std::size_t k = 0; k < species.size(); ++k) {
      io.table(species[k], [&](auto& io) {
        SpeciesWall& one = piston.law.of_species[k];
        io.value(kSpeciesWallKeys.at("restitution"), one.restitution, between(0.0, 1.0));
        visit_other_roughness(io, one.roughness, kOptional);
      });
    }
  });
}

inline constexpr auto kStartKeys = key_table(
    kRunCommands,
    {{"layout", "",
      "Positions at time 0. random: without order, by a method that suits the number of particles. "
      "insertion: random by the methods for small gases. Also a lattice, or a file."},
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
    {{"count", "1",
      "Number of particles. A scene has this key, a fraction, or species with their own."},
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
      "Moment of inertia, as q = 4I/(m a^2). A uniform disk has 0.5, a uniform sphere 0.4."},
     {"count_left", "1",
      "Number of particles that start on the lower side of the piston, or of the first partition "
      "between walls. Without a value those beside a piston divide as the free lengths, and those "
      "beside a partition are anywhere."}});

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
  io.value(kParticleKeys.at("count_left"), particles.count_left, between(0, kMaxCount));
  io.table("start", [&](auto& io) { visit_start(io, particles.start, input.spin_key()); });
}

inline constexpr auto kPolydispersityKeys = key_table(
    kRunCommands,
    {{"kind", "",
      "Distribution of the diameters. A uniform one reaches from 1 - `width` to 1 + `width` times "
      "the diameter. The others are cut at 3 standard deviations."},
     {"width", "1",
      "Half the range of a uniform distribution, or the standard deviation, over the mean "
      "diameter."}});

inline constexpr auto kSpeciesKeys = key_table(
    kRunCommands,
    {{"name", "",
      "Name of the species, of letters, digits, `_` and `-`, without `error` as its last word."},
     {"count", "1", "Number of its particles. A species has either this key or a fraction."},
     {"area_fraction", "1", "Share of the box that its disks fill."},
     {"volume_fraction", "1", "Share of the box that its spheres fill."},
     {"diameter", "a", "Diameter of its particles. Of unequal ones the mean."},
     {"mass", "m", "Mass of a particle with this diameter. Without a value the density sets it."},
     {"density", "m/a^D",
      "Mass over the D-th power of the diameter. At 1 all species are of one "
      "material, and a particle of diameter 1 has mass 1."},
     {"inertia", "1",
      "Moment of inertia, as q = 4I/(m d^2). Without a value that of "
      "`[particles]`."},
     {"count_left", "1",
      "Number of its particles that start on the lower side of the piston, or of the first "
      "partition between walls. Without a value those beside a piston, or beside a species with a "
      "value, divide as the free lengths."},
     {"colour", "", "Colour in pictures, as \"#rrggbb\". Without a value one of the palette."}});

/// The keys of one item of [[species]]. Its count is resolved after the whole scene is read.
template <class Visitor>
void visit_species(Visitor& io, SpeciesInput& input, int dimension, Presence spin_key) {
  Species& species = input.species;
  io.value(kSpeciesKeys.at("name"), species.name, Limits{}, kRequired);
  io.value(kSpeciesKeys.at("count"), input.count, between(0, kMaxCount));
  io.value(dimension == 2 ? kSpeciesKeys.at("area_fraction") : kSpeciesKeys.at("volume_fraction"),
           input.packing_fraction, between(0.0, 1.0));
  io.value(kSpeciesKeys.at("diameter"), species.diameter, between(kMinDiameter, kMaxDiameter));
  io.value(kSpeciesKeys.at("mass"), species.mass, between(kMinMass, kMaxMass));
  io.value(kSpeciesKeys.at("density"), species.density, between(kMinMass, kMaxMass),
           species.mass ? kNotBesideMass : kOptional);
  io.value(kSpeciesKeys.at("inertia"), species.inertia, between(kMinInertia, 1.0), spin_key);
  io.table("polydispersity", species.polydispersity, [](auto& io, Polydispersity& spread) {
    io.choice(kPolydispersityKeys.at("kind"), spread.kind, kSpreads);
    io.value(kPolydispersityKeys.at("width"), spread.width,
             Limits{.lowest = 0.0, .highest = 1.0, .above = true}, kRequired);
  });
  io.value(kSpeciesKeys.at("count_left"), species.count_left, between(0, kMaxCount));
  io.value(kSpeciesKeys.at("colour"), species.colour, Limits{});
}

inline constexpr auto kPairKeys = key_table(
    kRunCommands, {{"species", "", "Names of two species, in either order, or twice the same."},
                   {"restitution", "1",
                    "Restitution of their collisions. Without a value that of "
                    "`[particles]`."}});

/// The keys of one item of [[pair]].
template <class Visitor>
void visit_pair(Visitor& io, SpeciesPair& pair) {
  io.value(kPairKeys.at("species"), pair.species, between(2, 2), kRequired);
  io.value(kPairKeys.at("restitution"), pair.restitution, between(0.0, 1.0));
  visit_other_roughness(io, pair.roughness, kOptional);
}

inline constexpr auto kBulkDriveKeys = key_table(
    kRunCommands,
    {{"interval", "t", "Time between two kicks. A kick acts on all particles at once."},
     {"kick_speed", "a/t",
      "Standard deviation of a kick, per component of the velocity. The mean kick is removed."},
     {"kick_spin", "1/t", "Standard deviation of the kick of a spin."},
     {"law", "",
      "Dependence of kicks on the mass m. `kick_speed` is that of mass 1. It is the same for all "
      "masses, or falls as m^(-1/2) at equal power, or as 1/m at equal momentum."}});

/// The keys of [bulk_drive], if the table exists.
template <class Visitor>
void visit_bulk_drive(Visitor& io, BulkDrive& drive, Presence spin_key) {
  io.value(kBulkDriveKeys.at("interval"), drive.interval, above(0.0), kRequired);
  io.value(kBulkDriveKeys.at("kick_speed"), drive.kick_speed, between(0.0, kMaxSpeed), kRequired);
  io.value(kBulkDriveKeys.at("kick_spin"), drive.kick_spin, between(0.0, kMaxSpeed), spin_key);
  io.choice(kBulkDriveKeys.at("law"), drive.law, kKickLaws);
}

}  // namespace clatter
