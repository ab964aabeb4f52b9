#pragma once

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "engine/laws/domain.h"
#include "engine/laws/fixture.h"
#include "engine/laws/free_piston.h"
#include "engine/laws/wall.h"
#include "engine/physics/collision.h"
#include "engine/physics/grain.h"
#include "engine/vec.h"

namespace clatter {

/// How the kicks of bulk driving depend on the mass m of a particle (theory 12.6).
enum class KickLaw {
  Velocity,  ///< kick_speed for each: a white noise of accelerations
  Energy,    ///< kick_speed m^(-1/2): the same power for each
  Momentum,  ///< kick_speed / m: a white noise of forces
};

/// Homogeneous driving: periodic kicks of all particles at once (theory 5.1).
struct BulkDrive {
  double interval = 1.0;    ///< time between kicks, > 0
  double kick_speed = 0.0;  ///< standard deviation of a kick per velocity component, of a particle
                            ///< of mass 1; the mean momentum is removed
  double kick_spin = 0.0;   ///< standard deviation of the change of spin
  KickLaw law = KickLaw::Velocity;

  /// Standard deviation of a kick of a particle of some mass, per velocity component.
  double kick_speed_of(double mass) const {
    if (law == KickLaw::Velocity) return kick_speed;
    return kick_speed / (law == KickLaw::Energy ? std::sqrt(mass) : mass);
  }
};

/// Contact law of particles of two species.
struct PairLaw {
  double restitution = 1.0;  ///< alpha
  Roughness roughness = {};

  /// The law with its friction and tangential restitution in force.
  ContactLaw contact() const {
    return {restitution, roughness.friction_in_force(),
            roughness.tangential_restitution_in_force()};
  }
  /// Whether collisions take energy from the gas.
  bool dissipates() const { return restitution < 1.0 || !roughness.conserves(); }
};

/// Index of an unordered pair of species: (0, 0), (0, 1), (1, 1), (0, 2), ...
constexpr std::size_t pair_index(std::size_t first, std::size_t second) {
  const std::size_t low = first < second ? first : second, high = first < second ? second : first;
  return high * (high + 1) / 2 + low;
}

/// The laws of a mixture that differ between its species.
template <int D>
struct SpeciesLaws {
  /// [S x S] of each two species; both orders have the same law.
  std::vector<PairLaw> pairs;
  /// [S] walls that one species meets, by Side. They have the kinds and motions of Model::walls.
  std::vector<std::array<std::optional<Wall>, 2 * D>> walls;
  std::vector<std::string> names = {};  ///< [S] for results; empty: numbers from 0

  /// Number of species.
  std::size_t count() const { return walls.size(); }
  /// Name of a species for results.
  std::string name(std::size_t species) const {
    return names.empty() ? std::to_string(species) : names[species];
  }
};

/// The laws of a run. Simulation::set_laws changes them.
template <int D>
struct Model {
  Vec<D> box = Vec<D>::Zero();                   ///< edge lengths
  std::array<std::optional<Wall>, 2 * D> walls;  ///< indexed by Side; a pair absent: periodic
  std::vector<Fixture<D>> fixtures;              ///< bodies at rest in the box
  std::optional<FreePiston> free_piston;         ///< absent: none
  double diameter = 1.0;                         ///< of each particle; of a mixture: the largest
  double restitution = 1.0;                      ///< alpha of collisions between particles
  Roughness roughness;                           ///< of the particles
  double inertia = 0.5;                          ///< q = 4I/(m a^2)
  std::optional<SpeciesLaws<D>> species;         ///< absent: all particles have the laws above
  bool spins = false;  ///< whether particles have spins: they or walls are or were rough
  Vec<D> gravity = Vec<D>::Zero();      ///< acceleration of every particle
  std::optional<double> shear_rate;     ///< of a sheared box (theory 14); absent: not sheared
  std::optional<BulkDrive> bulk_drive;  ///< absent: none
  std::optional<double> contact_time;   ///< t_c of the TC model; absent: off
  std::uint64_t seed = 1;               ///< of every random number of the run

  /// What each particle is, unless the run has a mixture.
  Grain grain() const { return {.radius = 0.5 * diameter, .inertia = inertia}; }
  /// Contact law of particles of two species, by their numbers.
  PairLaw pair(std::uint32_t first, std::uint32_t second) const {
    if (!species) return {restitution, roughness};
    return species->pairs[first * species->count() + second];
  }
  /// The wall at a side as a species meets it. The side must have one.
  const Wall& wall(int side, std::uint32_t number) const {
    return species ? *species->walls[number][side] : *walls[side];
  }
  /// Calls visit(law) for each wall, each fixture and the free piston, as each species meets it.
  template <class Visit>
  void for_walls(const Visit& visit) const {
    const auto visit_all = [&](const auto& of_sides) {
      for (const std::optional<Wall>& wall : of_sides) {
        if (wall) visit(*wall);
      }
    };
    visit_all(walls);
    for (const Fixture<D>& fixture : fixtures) {
      visit(fixture.law);
      for (const Wall& law : fixture.of_species) visit(law);
    }
    if (free_piston) {
      visit(free_piston->law);
      for (const Wall& law : free_piston->of_species) visit(law);
    }
    if (!species) return;
    for (const auto& of_species : species->walls) visit_all(of_species);
  }
  /// Whether collisions of particles take energy from the gas.
  bool dissipates() const {
    if (!species) return pair(0, 0).dissipates();
    return std::ranges::any_of(species->pairs, &PairLaw::dissipates);
  }
  /// Whether there is gravity, so that particles fly along parabolas.
  bool has_gravity() const { return (gravity.array() != 0.0).any(); }
  /// Time between kicks; 0 without bulk driving.
  double kick_interval() const { return bulk_drive ? bulk_drive->interval : 0.0; }
  /// Whether the box is periodic along an axis.
  bool periodic(int axis) const { return !walls[2 * axis]; }
  /// Whether the box has no walls.
  bool is_periodic() const {
    return std::ranges::none_of(walls, [](const auto& wall) { return wall.has_value(); });
  }
  /// The box and its periodic images. Those of a sheared box have the offset of time 0.
  Domain<D> domain() const {
    Domain<D> domain;
    domain.box = box;
    for (int axis = 0; axis < D; ++axis) domain.periodic[axis] = periodic(axis);
    if (shear_rate) {
      domain.sheared = true;
      domain.slide = *shear_rate * box[1];
    }
    return domain;
  }
  /// Coordinate of the centre of a particle that touches a wall at its rest position. `end` is 0
  /// for the near wall of the axis and 1 for the far wall.
  double wall_plane(int axis, int end, double radius) const {
    return end ? box[axis] - radius : radius;
  }
  /// The same for a particle of diameter `diameter`.
  double wall_plane(int axis, int end) const { return wall_plane(axis, end, 0.5 * diameter); }
};

}  // namespace clatter
