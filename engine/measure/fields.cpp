#include "engine/measure/fields.h"

#include <limits>
#include <vector>

namespace clatter {

namespace {

constexpr int kX = 0, kY = 1;

template <class S>
using Cell = CellAverages<2, S>;

// Particles at a wall whose centres come to a cell's border to the bit seem to visit the cell for
// as long as rounding has it: V would be a ratio of roundings.
template <class S>
bool visited(const Cell<S>& cell) {
  constexpr double kRounding = 1e-12;  // particles per a^2
  return value_of(cell.density) > kRounding;
}

// V = p/(m rho). Where no particle ever was nothing flows.
template <class S>
S velocity(const Cell<S>& cell, int k) {
  return visited(cell) ? cell.momentum[k] / cell.density : S(0.0);
}

// Eq. (4.16): rho T_k/2 = E_k - m rho V_k^2/2.
template <class S>
S temperature(const Cell<S>& cell, int k) {
  return cell.momentum_flux[k][k] / cell.density - velocity(cell, k) * velocity(cell, k);
}

// Eq. (4.26): -[sum m v_k v_l Phi - m rho V_k V_l].
template <class S>
S kinetic_stress(const Cell<S>& cell, int k, int l) {
  return cell.density * velocity(cell, k) * velocity(cell, l) - cell.momentum_flux[k][l];
}

// Eqs. (4.22)-(4.24).
template <class S>
S collisional_stress(const Cell<S>& cell, int k, int l) {
  return -cell.transfer[k][l];
}

// Eq. (4.29), multiplied out: sum (m/2) v^2 v_k Phi - E V_k + (sigma_kin.V)_k.
template <class S>
S kinetic_heat_flux(const Cell<S>& cell, int k) {
  S flux = cell.energy_flux[k] - cell.energy() * velocity(cell, k);
  for (int l = 0; l < 2; ++l) flux = flux + kinetic_stress(cell, k, l) * velocity(cell, l);
  return flux;
}

// What Eq. (4.38) adds to it: q_int_o, Eq. (4.34), about the mean velocity.
template <class S>
S collisional_heat_flux(const Cell<S>& cell, int k) {
  S flux = cell.energy_transfer[k];
  for (int l = 0; l < 2; ++l) flux = flux + collisional_stress(cell, k, l) * velocity(cell, l);
  return flux;
}

template <class S>
S no_value() {
  return S(std::numeric_limits<double>::quiet_NaN());
}

// What particles that come by carry: unknown where none does.
template <class S>
S of_visitors(const Cell<S>& cell, S value) {
  return visited(cell) ? value : no_value<S>();
}

// The whole of what particles and collisions carry: all collisional where no particle comes by.
template <class S>
S total(const Cell<S>& cell, S kinetic, S collisional) {
  if (visited(cell)) return kinetic + collisional;
  return value_of(collisional) != 0.0 ? collisional : no_value<S>();
}

template <class S>
S stress(const Cell<S>& cell, int k, int l) {
  return total(cell, kinetic_stress(cell, k, l), collisional_stress(cell, k, l));
}

template <class S>
S heat_flux(const Cell<S>& cell, int k) {
  return total(cell, kinetic_heat_flux(cell, k), collisional_heat_flux(cell, k));
}

}  // namespace

template <class S>
CellAverages<2, S> averages_of(const MomentLayout<2>& layout, const S* row) {
  CellAverages<2, S> cell;
  const auto read = [&](int place, int number) { return place < 0 ? S(0.0) : row[place + number]; };
  cell.density = row[layout.count];
  cell.spin = read(layout.spin, 0);
  cell.spin_energy = read(layout.spin_energy, 0);
  cell.dissipation = read(layout.dissipation, 0);
  for (int k = 0; k < 2; ++k) {
    cell.momentum[k] = read(layout.velocity, k);
    cell.energy_flux[k] = read(layout.energy_flux, k);
    cell.energy_transfer[k] = read(layout.energy_transfer, k);
    for (int l = 0; l < 2; ++l) {
      cell.momentum_flux[k][l] = k == l ? read(layout.squares, k) : read(layout.shears, 0);
      cell.transfer[k][l] = read(layout.transfer, 2 * k + l);
    }
  }
  return cell;
}

CellAverages<2, double> averages_of(const MomentLayout<2>& layout, const CellSums& sums,
                                    std::size_t cell, double area) {
  const auto size = static_cast<std::size_t>(layout.size);
  std::vector<double> row(size);
  for (std::size_t k = 0; k < size; ++k) {
    const double weight = static_cast<int>(k) < layout.kinetic ? sums.kinetic_weight : sums.time;
    row[k] = sums.rows[cell * size + k] / (weight * area);
  }
  return averages_of(layout, row.data());
}

template <class S>
S field_value(Field field, const CellAverages<2, S>& cell) {
  switch (field) {
    case Field::Density:
      return visited(cell) ? cell.density : S(0.0);
    case Field::VelocityX:
      return of_visitors(cell, velocity(cell, kX));
    case Field::VelocityY:
      return of_visitors(cell, velocity(cell, kY));
    case Field::Temperature:
      return of_visitors(cell, 0.5 * (temperature(cell, kX) + temperature(cell, kY)));
    case Field::TemperatureX:
      return of_visitors(cell, temperature(cell, kX));
    case Field::TemperatureY:
      return of_visitors(cell, temperature(cell, kY));
    case Field::StressXx:
      return stress(cell, kX, kX);
    case Field::StressYy:
      return stress(cell, kY, kY);
    case Field::StressXy:
      return stress(cell, kX, kY);
    case Field::StressXxKinetic:
      return of_visitors(cell, kinetic_stress(cell, kX, kX));
    case Field::StressYyKinetic:
      return of_visitors(cell, kinetic_stress(cell, kY, kY));
    case Field::StressXyKinetic:
      return of_visitors(cell, kinetic_stress(cell, kX, kY));
    case Field::StressXxCollisional:
      return collisional_stress(cell, kX, kX);
    case Field::StressYyCollisional:
      return collisional_stress(cell, kY, kY);
    case Field::StressXyCollisional:
      return collisional_stress(cell, kX, kY);
    case Field::HeatFluxX:
      return heat_flux(cell, kX);
    case Field::HeatFluxY:
      return heat_flux(cell, kY);
    case Field::HeatFluxXKinetic:
      return of_visitors(cell, kinetic_heat_flux(cell, kX));
    case Field::HeatFluxYKinetic:
      return of_visitors(cell, kinetic_heat_flux(cell, kY));
    case Field::HeatFluxXCollisional:
      return collisional_heat_flux(cell, kX);
    case Field::HeatFluxYCollisional:
      return collisional_heat_flux(cell, kY);
    case Field::Dissipation:
      return cell.dissipation;
    case Field::Spin:
      return of_visitors(cell, cell.spin / cell.density);
    case Field::SpinTemperature:
      return of_visitors(cell, 2.0 * cell.spin_energy / cell.density);
    case Field::BalanceMass:
    case Field::BalanceMomentumX:
    case Field::BalanceMomentumY:
    case Field::BalanceEnergy:
      break;
  }
  return no_value<S>();
}

template CellAverages<2, double> averages_of(const MomentLayout<2>&, const double*);
template CellAverages<2, Dual> averages_of(const MomentLayout<2>&, const Dual*);
template double field_value(Field, const CellAverages<2, double>&);
template Dual field_value(Field, const CellAverages<2, Dual>&);

}  // namespace clatter
