#pragma once

#include <limits>

#include "engine/dynamics/model.h"

namespace clatter::testing {

inline constexpr double kInfinity = std::numeric_limits<double>::infinity();

/// One wall of each kind, and with each law of its touch.
inline const Wall kStatic{};
inline const Wall kLossy{.restitution = 0.8};
inline const Wall kDriven{.kind = WallKind::Driven, .restitution = 0.9, .drive_speed = 1.0};
inline const Wall kRoughDriven{.kind = WallKind::Driven,
                               .restitution = 0.9,
                               .roughness = {.friction = 0.3, .tangential_restitution = 0.5},
                               .drive_speed = 1.0};
inline const Wall kThermal{.kind = WallKind::Thermal, .temperature = 2.0};
inline const Wall kSawtooth{
    .kind = WallKind::Sawtooth, .restitution = 0.9, .stroke = 0.3, .frequency = 2.0, .phase = 0.25};
inline const Wall kSinusoidal{.kind = WallKind::Sinusoidal,
                              .restitution = 0.8,
                              .stroke = 0.4,
                              .frequency = 1.0,
                              .phase = 0.125};

/// An elastic gas in a periodic box.
Model<2> periodic_box(double lx, double ly);

/// The same box with the same wall at both ends of an axis.
Model<2> with_walls(Model<2> model, int axis, const Wall& wall);

/// A box of 9 x 8 with the same walls at the ends of x, and of y.
Model<2> four(const Wall& sides, const Wall& ends);

/// The same model, whose particles lose energy.
Model<2> inelastic(Model<2> model, double restitution);

/// The same model, whose particles are rough and spin.
Model<2> rough(Model<2> model, double friction, double tangential_restitution);

/// The same model under gravity.
Model<2> falling(Model<2> model, const Vec2& gravity);

/// The same model with kicks, of spins too where these are carried.
Model<2> kicked(Model<2> model, double interval, double speed);

/// The same model with a t_c.
Model<2> with_contact_time(Model<2> model, double contact_time);

/// All there is: four kinds of walls, rough particles, gravity, kicks, t_c.
Model<2> everything();

}  // namespace clatter::testing
