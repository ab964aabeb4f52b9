#pragma once

#include <limits>

#include "engine/laws/model.h"

namespace clatter::testing {

inline constexpr double kInfinity = std::numeric_limits<double>::infinity();

/// One wall of each kind, and one with each contact law.
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
template <int D>
Model<D> periodic_box(const Vec<D>& box) {
  Model<D> model;
  model.box = box;
  if (D == 3) model.inertia = 0.4;
  return model;
}
inline Model<2> periodic_box(double lx, double ly) {
  return periodic_box<2>({lx, ly});
}
inline Model<3> periodic_box(double lx, double ly, double lz) {
  return periodic_box<3>({lx, ly, lz});
}

/// The same model with images that slide along x.
template <int D>
Model<D> sheared(Model<D> model, double rate) {
  model.shear_rate = rate;
  return model;
}

/// The same model with equal walls at both ends of an axis.
template <int D>
Model<D> with_walls(Model<D> model, int axis, const Wall& wall) {
  model.walls[2 * axis] = model.walls[2 * axis + 1] = wall;
  return model;
}

/// The same model with equal walls at all sides.
template <int D>
Model<D> walled(Model<D> model, const Wall& wall) {
  model.walls.fill(wall);
  return model;
}

/// A box of 9 x 8 with equal walls at the ends of x, and of y.
inline Model<2> four(const Wall& sides, const Wall& ends) {
  return with_walls(with_walls(periodic_box(9.0, 8.0), 0, sides), 1, ends);
}

/// The same model with inelastic particles.
template <int D>
Model<D> inelastic(Model<D> model, double restitution) {
  model.restitution = restitution;
  return model;
}

/// The same model with rough, spinning particles.
template <int D>
Model<D> rough(Model<D> model, double friction, double tangential_restitution) {
  model.roughness = {friction, tangential_restitution};
  model.spins = true;
  return model;
}

/// The same model under gravity.
template <int D>
Model<D> falling(Model<D> model, const Vec<D>& gravity) {
  model.gravity = gravity;
  return model;
}

/// The same model with kicks. Kicks also act on spins if the model has spins.
template <int D>
Model<D> kicked(Model<D> model, double interval, double speed) {
  model.bulk_drive = BulkDrive{interval, speed, model.spins ? speed : 0.0};
  return model;
}

/// The same model with a t_c.
template <int D>
Model<D> with_contact_time(Model<D> model, double contact_time) {
  model.contact_time = contact_time;
  return model;
}

/// The same model with laws for the three species of mixed_gas. Every pair of species has its own
/// law, and the second species its own laws of walls.
template <int D>
Model<D> with_species(Model<D> model) {
  SpeciesLaws<D> laws{.pairs = {}, .walls = {3, model.walls}};
  for (int k = 0; k < 9; ++k) {
    // 0: one with itself; 1, 2, 3: the others, in both orders.
    const int between = k / 3 == k % 3 ? k / 3 : 2 + k / 3 + k % 3;
    Roughness roughness = model.roughness;
    if (roughness.any()) roughness.friction = 0.1 + 0.1 * between;
    laws.pairs.push_back({model.restitution * (1.0 - 0.05 * between), roughness});
  }
  for (auto& wall : laws.walls[1]) {
    if (!wall) continue;
    wall->restitution *= 0.75;
    wall->temperature *= 2.0;
  }
  model.species = laws;
  return model;
}

/// All features: walls of every kind, rough particles, gravity, kicks, t_c.
template <int D = 2>
Model<D> everything();
template <>
Model<2> everything<2>();
template <>
Model<3> everything<3>();

}  // namespace clatter::testing
