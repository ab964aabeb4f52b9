#pragma once

#include <array>
#include <optional>

#include "engine/physics/wall_motion.h"

namespace clatter {

/// How rough a partner in a collision is (theory 3); smooth where both are absent.
struct Roughness {
  std::optional<double> friction;  ///< mu >= 0, may be infinite; absent beside the other: infinite
  std::optional<double> tangential_restitution;  ///< beta_0, -1..1; absent beside the other: 1

  /// Mu and beta_0 in force; 0 and -1 where both are absent.
  double friction_in_force() const;
  double tangential_restitution_in_force() const;
  /// Whether a touch can change a spin: mu > 0 and beta_0 > -1.
  bool any() const;
};

/// What a wall does to the particles that touch it (theory 4).
enum class WallKind {
  Static,      ///< reflects with its restitution
  Driven,      ///< adds drive_speed to the normal velocity: the saw-tooth limit (theory 4.1, 4.4)
  Thermal,     ///< forgets the incoming velocity and emits at its temperature
  Sawtooth,    ///< moves inwards by its stroke at constant speed, jumps back, and again
  Sinusoidal,  ///< swings by half its stroke to either side of its place
};

/// One wall of the box.
struct Wall {
  WallKind kind = WallKind::Static;
  double restitution = 1.0;  ///< alpha_w >= 0, of all but thermal walls; may exceed 1
  Roughness roughness = {};  ///< of all but thermal walls
  double drive_speed =
      0.0;  ///< v_dr >= 0 of a driven wall, the gain in normal velocity (theory 4.1)
  double temperature = 1.0;  ///< T_w >= 0 of a thermal wall
  double stroke = 0.0;       ///< whole travel of a saw-tooth or sinusoidal wall, >= 0
  double frequency = 0.0;    ///< of its motion, in periods per time unit, >= 0
  double phase = 0.0;        ///< of its motion at time 0, in periods

  /// Whether the wall changes its place.
  bool moves() const { return kind == WallKind::Sawtooth || kind == WallKind::Sinusoidal; }
  /// The motion of one that moves, its phase at simulation time 0; others stay at rest.
  WallMotion motion() const;
  /// How far into the box it is at time 0.
  double start_travel() const;
  /// How far into the box its motion takes it.
  double innermost_travel() const;
  /// How far out of the box its motion takes it.
  double outermost_travel() const { return kind == WallKind::Sinusoidal ? 0.5 * stroke : 0.0; }
};

/// The sides of the box: axis is side / 2, and the odd ones lie at the axis' far end.
enum Side { kLeft, kRight, kBottom, kTop, kBack, kFront };

/// Names of the sides in scene files, indexed by Side.
inline constexpr std::array<const char*, 6> kSideNames = {"left", "right", "bottom",
                                                          "top",  "back",  "front"};

}  // namespace clatter
