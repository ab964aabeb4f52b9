#pragma once

#include <cstdint>
#include <optional>
#include <variant>
#include <vector>

#include "engine/physics/grain.h"
#include "engine/physics/spin.h"
#include "engine/vec.h"

namespace clatter {

/// Place and velocity of a free piston at one time, along its axis.
struct PistonState {
  double place = 0.0;  ///< of its middle
  double velocity = 0.0;

  bool operator==(const PistonState&) const = default;
};

/// Positions, velocities and spins of all particles at one time, in original order.
template <int D>
struct State {
  std::vector<Vec<D>> positions;    ///< [N] centres inside the box
  std::vector<Vec<D>> velocities;   ///< [N]
  std::vector<Spin<D>> spins = {};  ///< [N] angular velocities; empty without spins
  std::vector<Grain> grains = {};   ///< [N] what the particles are; empty: all are alike
  /// Of the free piston; absent: there is none, or it is where the laws place it at the start.
  std::optional<PistonState> piston = {};

  bool operator==(const State&) const = default;
};

/// The state of disks or of spheres.
using AnyState = std::variant<State<2>, State<3>>;

/// Number of particles of either state.
inline std::size_t particle_count(const AnyState& state) {
  return std::visit([](const auto& any) { return any.positions.size(); }, state);
}

/// Maximum number of particles: cell lists store two bits per dimension beside a particle's number.
template <int D>
inline constexpr std::uint32_t kMaxParticles = (std::uint32_t{1} << (32 - 2 * D)) - 1;

/// Largest overlap, in diameters, that counts as rounding of a start state's positions and is
/// accepted.
inline constexpr double kStartRounding = 1e-12;

/// T = (1/DN) sum m v^2 of a state; 0 without particles.
template <int D>
double temperature_of(const State<D>& state);

}  // namespace clatter
