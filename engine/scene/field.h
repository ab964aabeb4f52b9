#pragma once

#include <algorithm>
#include <array>

namespace clatter {

/// A field over the box, chapter 4; what is not called kinetic or collisional is the sum of both.
enum class Field {
  Density,    ///< rho, particles per area
  VelocityX,  ///< V, their mean velocity
  VelocityY,
  Temperature,  ///< T = (T_x + T_y)/2, about V
  TemperatureX,
  TemperatureY,
  StressXx,  ///< sigma, minus the pressure tensor; xy: of momentum along y, through x
  StressYy,
  StressXy,
  StressXxKinetic,
  StressYyKinetic,
  StressXyKinetic,
  StressXxCollisional,
  StressYyCollisional,
  StressXyCollisional,
  HeatFluxX,  ///< q, about V
  HeatFluxY,
  HeatFluxXKinetic,
  HeatFluxYKinetic,
  HeatFluxXCollisional,
  HeatFluxYCollisional,
  Dissipation,      ///< zeta <= 0, energy per time and area that collisions of particles give
  Spin,             ///< mean angular velocity
  SpinTemperature,  ///< T_rot = I <omega^2>
  BalanceMass,  ///< what Eqs. (4.1)-(4.3) leave open, relative to what was booked, see Imbalances
  BalanceMomentumX,
  BalanceMomentumY,
  BalanceEnergy
};

/// The fields that are residuals of balance equations, in the order of Conserved<2>.
inline constexpr std::array<Field, 4> kResiduals = {Field::BalanceMass, Field::BalanceMomentumX,
                                                    Field::BalanceMomentumY, Field::BalanceEnergy};

/// Whether a field is one of these, and no average over particles and collisions.
constexpr bool is_residual(Field field) {
  return std::ranges::find(kResiduals, field) != kResiduals.end();
}

/// How particles come to count in fields: their flights exactly, or where they are now and then.
enum class Estimator { Exact, Snapshot };

}  // namespace clatter
