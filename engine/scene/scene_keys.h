#pragma once

#include "engine/scene/change_keys.h"
#include "engine/scene/gas_keys.h"
#include "engine/scene/measure_keys.h"
#include "engine/scene/view_keys.h"

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

inline constexpr auto kSceneKeys = key_table(
    kRunCommands, {{"schema", "1", "Version of the format."},
                   {"title", "", "Title in pictures, in the gallery and in results."},
                   {"caption", "", "One line about the effect to watch."},
                   {"goal", "", "The aim of the scene as a lesson.", "view"},
                   {"try_this", "", "Proposal for an experiment in the window.", "view"}});
inline constexpr auto kBoxKeys = key_table(
    kRunCommands,
    {{"size", "a",
      "Sides of the box. Two numbers make disks, three make spheres. Each side exceeds the largest "
      "diameter."}});
inline constexpr auto kGravityKeys =
    key_table(kRunCommands, {{"acceleration", "a/t^2", "Acceleration of all particles."}});
inline constexpr auto kShearKeys = key_table(
    kRunCommands,
    {{"rate", "1/t",
      "Velocity gradient of the flow, which is along x and grows along y. Needs a box that is "
      "periodic along x and y."}});
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
  // must not touch its own periodic image. The diameters of species are not known yet.
  io.table("box", [&](auto& io) {
    io.value(kBoxKeys.at("size"), scene.box,
             Limits{.lowest = input.species_names.empty() ? 1.0 : 0.0,
                    .highest = kMaxLength,
                    .above = true});
  });
  io.table("particles", [&](auto& io) { visit_particles(io, input); });
  const int dimension = scene.dimension();
  io.list("species", input.species, [&](auto& io, SpeciesInput& species) {
    visit_species(io, species, dimension, input.spin_key());
  });
  io.list("pair", scene.pairs, [](auto& io, SpeciesPair& pair) { visit_pair(io, pair); });
  io.table("walls", [&](auto& io) {
    for (int side = 0; side < 2 * dimension; ++side) {
      io.table(kSideNames[side], scene.walls[side], [&](auto& io, Wall& wall) {
        visit_wall(io, wall, dimension);
        auto& differences = scene.species_walls[static_cast<std::size_t>(side)];
        differences.resize(input.species_names.size());
        io.table("species", [&](auto& io) {
          for (std::size_t k = 0; k < differences.size(); ++k) {
            io.table(input.species_names[k],
                     [&](auto& io) { visit_species_wall(io, differences[k], wall); });
          }
        });
      });
    }
  });
  io.list("obstacle", scene.obstacles, [&](auto& io, Obstacle& obstacle) {
    visit_obstacle(io, obstacle, dimension, input.species_names);
  });
  io.list("partition", scene.partitions, [&](auto& io, Partition& partition) {
    visit_partition(io, partition, dimension, input.species_names);
  });
  io.table("piston", scene.piston,
           [&](auto& io, Piston& piston) { visit_piston(io, piston, input.species_names); });
  io.table("gravity", scene.gravity, [&](auto& io, VecX& acceleration) {
    if (acceleration.size() == 0) acceleration = VecX::Zero(scene.dimension());
    io.value(kGravityKeys.at("acceleration"), acceleration,
             between(-kMaxAcceleration, kMaxAcceleration), kRequired);
  });
  io.table("shear", scene.shear_rate, [&](auto& io, double& rate) {
    io.value(kShearKeys.at("rate"), rate, between(-kMaxShearRate, kMaxShearRate), kRequired);
  });
  io.table("bulk_drive", scene.bulk_drive,
           [&](auto& io, BulkDrive& drive) { visit_bulk_drive(io, drive, input.spin_key()); });
  io.table("collapse", [&](auto& io) {
    io.value(kCollapseKeys.at("contact_time"), scene.contact_time, above(0.0));
  });
  io.table("measure", [&](auto& io) { visit_measure(io, scene.measure, dimension); });
  io.table("view", [&](auto& io) { visit_view(io, scene.view, dimension, input.species_names); });
  io.list("change", scene.changes,
          [&](auto& io, Change& change) { visit_change(io, change, input.species_names); });
}

}  // namespace clatter
