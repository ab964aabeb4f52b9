#pragma once

#include <nlohmann/json_fwd.hpp>
#include <optional>

#include "engine/physics/atmosphere.h"
#include "engine/physics/shear_theory.h"
#include "engine/physics/theory.h"
#include "engine/physics/two_compartments.h"
#include "engine/scene/scene.h"

namespace clatter {

/// The gas of the theory of vibrated boxes. Absent unless the scene has smooth disks between two
/// equal walls, driven or static, without any other force.
std::optional<VibratedGas> vibrated_gas(const Scene& scene);

/// The atmosphere of a scene: smooth elastic particles that fall on a thermal floor. Absent unless
/// the other walls are periodic, elastic and static, or as hot as the floor, and no other force
/// acts.
std::optional<Atmosphere> atmosphere(const Scene& scene);

/// The two compartments of a scene: smooth inelastic disks that fall on a driven floor, between
/// static walls, with one partition in the middle that is open from some height to the top. Absent
/// for other scenes.
std::optional<TwoCompartments> two_compartments(const Scene& scene);

/// Whether the gas has neither walls nor a drive and loses energy in collisions.
bool cools_freely(const Scene& scene);

/// k of Haff's law in a periodic box (theory 6.6). Absent unless the scene has smooth particles
/// that cool without any force.
std::optional<double> haff_rate(const Scene& scene);

/// Theories of a steady sheared gas (theory 14.5-14.7).
struct SteadyShear {
  ShearTheory grad;                 ///< of a dilute gas
  double enskog_temperature = 0.0;  ///< of a dense gas of nearly elastic particles
};

/// The theories of a sheared box without walls. Absent unless the scene has smooth, inelastic
/// particles that are alike, and no other drive.
std::optional<SteadyShear> steady_shear(const Scene& scene);

/// Enskog's collisions per particle and time (theory 6.2, 12.10), at the same temperature of all
/// species of a mixture.
double collision_rate(const Scene& scene, double temperature);

/// The predictions of kinetic theory for a scene. Empty unless physics/theory.h covers the scene: a
/// gas between two vibrated walls, or a gas in a periodic box. For mixtures see
/// mixture_theory_json().
nlohmann::ordered_json theory_json(const Scene& scene);

}  // namespace clatter
