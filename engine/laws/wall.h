#pragma once

#include <array>
#include <optional>

#include "engine/physics/wall_motion.h"
#include "engine/vec.h"

namespace clatter {

/// Roughness of a partner in a collision (theory 3); smooth if both members are absent.
struct Roughness {
  std::optional<double> friction;  ///< mu, 0 to infinity; absent with the other set: infinity
  std::optional<double> tangential_restitution;  ///< beta_0, -1..1; absent with the other set: 1

  /// Resulting mu and beta_0; 0 and -1 if both members are absent.
  double friction_in_force() const;
  double tangential_restitution_in_force() const;
  /// Whether a contact can change a spin: mu > 0 and beta_0 > -1.
  bool any() const;
  /// Whether every contact keeps the energy: nothing spins, or mu is infinite and beta_0 = 1.
  bool conserves() const;

  bool operator==(const Roughness&) const = default;
};

/// Action of a wall on particles (theory 4).
enum class WallKind {
  Static,      ///< reflects with its restitution
  Driven,      ///< adds drive_speed to the normal velocity: the saw-tooth limit (theory 4.1, 4.4)
  Thermal,     ///< forgets the incoming velocity and emits at its temperature
  Sawtooth,    ///< periodic: moves inwards by its stroke at constant speed, jumps back
  Sinusoidal,  ///< oscillates by half its stroke about its rest position
};

/// One wall of the box.
struct Wall {
  WallKind kind = WallKind::Static;
  double restitution = 1.0;  ///< alpha_w >= 0, of all but thermal walls; may exceed 1
  Roughness roughness = {};  ///< of all but thermal walls
  double drive_speed =
      0.0;  ///< v_dr >= 0 of a driven wall, the gain in normal velocity (theory 4.1)
  double temperature = 1.0;  ///< T_w >= 0 of a thermal wall
  double stroke = 0.0;       ///< peak-to-peak travel of a saw-tooth or sinusoidal wall, >= 0
  double frequency = 0.0;    ///< of its motion, in periods per time unit, >= 0
  double phase = 0.0;        ///< of its motion at time 0, in periods
  /// Velocity of the surface along the wall (theory 4.9). Its component along the normal is 0, and
  /// those beyond the dimension are not read. Smooth walls pass no momentum along the surface.
  std::array<double, 3> surface_velocity = {};

  /// The velocity of the surface in D dimensions.
  template <int D>
  Vec<D> surface() const {
    return Eigen::Map<const Vec<D>>(surface_velocity.data());
  }
  /// Whether the surface slides.
  bool slides() const { return surface_velocity != std::array<double, 3>{}; }
  /// Whether the wall is of a kind that moves.
  bool moves() const { return kind == WallKind::Sawtooth || kind == WallKind::Sinusoidal; }
  /// The motion of a wall that moves, with its phase at simulation time 0; rest for other kinds.
  WallMotion motion() const;
  /// Displacement into the box at time 0.
  double start_travel() const;
  /// Largest displacement into the box.
  double innermost_travel() const;
  /// Largest displacement out of the box.
  double outermost_travel() const { return kind == WallKind::Sinusoidal ? 0.5 * stroke : 0.0; }
};

/// The sides of the box. The axis is side / 2; odd sides are at the far end of the axis.
enum Side { kLeft, kRight, kBottom, kTop, kBack, kFront };

/// Names of the sides in scene files, indexed by Side.
inline constexpr std::array<const char*, 6> kSideNames = {"left", "right", "bottom",
                                                          "top",  "back",  "front"};

}  // namespace clatter
