#pragma once

#include "engine/scene/enum_names.h"
#include "engine/scene/key_rules.h"
#include "engine/scene/key_table.h"
#include "engine/scene/limits.h"
#include "engine/scene/scene.h"

// The keys of changes during a run, see scene_keys.h.

namespace clatter {

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

inline constexpr auto kPuffKeys = key_table(
    kRunCommands,
    {{"count", "1", "Number of particles that enter the gas."},
     {"centre", "a",
      "Centre of the region, in the box. The new particles have their centres in it."},
     {"radius", "a", "Radius of the region, a disk or a ball. It continues across periodic sides."},
     {"temperature", "m a^2/t^2", "Temperature of the velocities, which are Gaussian."},
     {"velocity", "a/t", "Mean velocity of the new particles. Without a value it is 0."},
     {"species", "", "Species of the new particles in a mixture. Without a value the first."}});

/// The keys of [change.puff]. `species_names` are those of a mixture.
template <class Visitor>
void visit_puff(Visitor& io, Puff& puff, const std::vector<std::string>& species_names) {
  io.value(kPuffKeys.at("count"), puff.count, between(1, kMaxCount), kRequired);
  io.value(kPuffKeys.at("centre"), puff.centre, at_least(0.0), kRequired);
  io.value(kPuffKeys.at("radius"), puff.radius,
           Limits{.lowest = 0.0, .highest = kMaxLength, .above = true}, kRequired);
  io.value(kPuffKeys.at("temperature"), puff.temperature, between(0.0, kMaxTemperature));
  io.value(kPuffKeys.at("velocity"), puff.velocity, between(-kMaxSpeed, kMaxSpeed));
  if (!species_names.empty()) io.value(kPuffKeys.at("species"), puff.species);
}

inline constexpr auto kChangeKeys = key_table(
    kRunCommands,
    {{"time", "t", "Simulation time of the change."},
     {"piston", "a",
      "New x position of the right wall at rest. It moves there at constant velocity, from `time` "
      "to `until`."},
     {"reverse", "",
      "Whether all velocities and spins change their signs. An elastic gas then runs back."},
     {"set", "", "Keys and their new values. Only keys that can change in a run are allowed."},
     {"ramp", "",
      "Transition of numbers to their new values. Without a value the change is immediate."},
     {"until", "t",
      "Simulation time at which the ramp or the piston ends. It is later than `time`."}});

/// The keys of one item of [[change]].
template <class Visitor>
void visit_change(Visitor& io, Change& change, const std::vector<std::string>& species_names) {
  io.value(kChangeKeys.at("time"), change.time, at_least(0.0), kRequired);
  io.settings(kChangeKeys.at("set"), change.set);
  io.choice(kChangeKeys.at("ramp"), change.ramp, kRamps);
  io.value(kChangeKeys.at("piston"), change.piston, above(0.0));
  io.value(kChangeKeys.at("until"), change.until, above(change.time),
           change.ramp || change.piston ? kRequired : kNotWithoutRamp);
  io.value(kChangeKeys.at("reverse"), change.reverse);
  io.table("nudge", change.nudge, [](auto& io, Nudge& nudge) { visit_nudge(io, nudge); });
  io.table("puff", change.puff, [&](auto& io, Puff& puff) { visit_puff(io, puff, species_names); });
}

}  // namespace clatter
