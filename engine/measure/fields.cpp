#include "engine/measure/fields.h"

#include <algorithm>
#include <limits>
#include <vector>

namespace clatter {

namespace {

template <int D, class S>
using Cell = CellAverages<D, S>;

// Fewer particles per a^2 are a time of rounding errors.
constexpr double kRounding = 1e-12;

// Whether particles were in the cell. The centres of particles at a wall may reach a cell's border
// exactly; the cell then gets a time of rounding errors, and V would be a ratio of these.
template <int D, class S>
bool visited(const Cell<D, S>& cell) {
  return value_of(cell.density) > kRounding;
}

// V = p/rho_m, the velocity of the centre of mass; 0 without particles.
template <int D, class S>
S velocity(const Cell<D, S>& cell, int k) {
  return visited(cell) ? cell.momentum[k] / cell.mass_density : S(0.0);
}

// (theory 8.2, 12.7): rho T_k/2 = E_k - rho_m V_k^2/2.
template <int D, class S>
S temperature(const Cell<D, S>& cell, int k) {
  const S mass = cell.mass_density / cell.density;  // mean
  return cell.momentum_flux[k][k] / cell.density - mass * velocity(cell, k) * velocity(cell, k);
}

// (theory 8.3): -[sum m v_k v_l Phi - rho_m V_k V_l].
template <int D, class S>
S kinetic_stress(const Cell<D, S>& cell, int k, int l) {
  return cell.mass_density * velocity(cell, k) * velocity(cell, l) - cell.momentum_flux[k][l];
}

// (theory 8.4)
template <int D, class S>
S collisional_stress(const Cell<D, S>& cell, int k, int l) {
  return -cell.transfer[k][l];
}

// (theory 8.8), expanded: sum (m/2) v^2 v_k Phi - E V_k + (sigma_kin.V)_k.
template <int D, class S>
S kinetic_heat_flux(const Cell<D, S>& cell, int k) {
  S flux = cell.energy_flux[k] - cell.energy() * velocity(cell, k);
  for (int l = 0; l < D; ++l) flux = flux + kinetic_stress(cell, k, l) * velocity(cell, l);
  return flux;
}

// The term of (theory 8.9): q^o (theory 8.7), relative to the mean velocity.
template <int D, class S>
S collisional_heat_flux(const Cell<D, S>& cell, int k) {
  S flux = cell.energy_transfer[k];
  for (int l = 0; l < D; ++l) flux = flux + collisional_stress(cell, k, l) * velocity(cell, l);
  return flux;
}

template <class S>
S no_value() {
  return S(std::numeric_limits<double>::quiet_NaN());
}

// A value that particles carry: NaN in a cell that no particle visited.
template <int D, class S>
S of_visitors(const Cell<D, S>& cell, S value) {
  return visited(cell) ? value : no_value<S>();
}

// In a cell without particles the total is the collisional part alone.
template <int D, class S>
S part_of(Part part, const Cell<D, S>& cell, S kinetic, S collisional) {
  switch (part) {
    case Part::Kinetic:
      return of_visitors(cell, kinetic);
    case Part::Collisional:
      return collisional;
    case Part::Total:
      break;
  }
  if (visited(cell)) return kinetic + collisional;
  return value_of(collisional) != 0.0 ? collisional : no_value<S>();
}

template <int D, class S>
S mean_temperature(const Cell<D, S>& cell) {
  S sum = temperature(cell, 0);
  for (int k = 1; k < D; ++k) sum = sum + temperature(cell, k);
  return (1.0 / D) * sum;
}

// Derivation of a quantity from the averages of a cell.
template <int D, class S>
struct Derivation {
  Quantity quantity;
  Needs kinetic;      // sums for its kinetic part, or for all of it
  Needs collisional;  // sums for its collisional part
  S (*value)(Field field, const Cell<D, S>& cell);
};

template <int D, class S>
constexpr std::array<Derivation<D, S>, kQuantities.size()> kDerivations = {{
    {Quantity::Density, 0, 0,
     [](Field, const Cell<D, S>& cell) { return visited(cell) ? cell.density : S(0.0); }},
    {Quantity::Velocity, sum::kMomentum, 0,
     [](Field field, const Cell<D, S>& cell) {
       return of_visitors(cell, velocity(cell, field.i));
     }},
    {Quantity::Temperature, sum::kMomentum | sum::kSquares, 0,
     [](Field field, const Cell<D, S>& cell) {
       return of_visitors(
           cell, field.i == Field::kNone ? mean_temperature(cell) : temperature(cell, field.i));
     }},
    {Quantity::Stress, sum::kMomentum | sum::kSquares | sum::kShears, sum::kTransfer,
     [](Field field, const Cell<D, S>& cell) {
       return part_of(field.part, cell, kinetic_stress(cell, field.i, field.j),
                      collisional_stress(cell, field.i, field.j));
     }},
    // The expanded (theory 8.8) contains the energy and every component of the kinetic stress.
    {Quantity::HeatFlux,
     sum::kMomentum | sum::kSquares | sum::kShears | sum::kEnergyFlux | sum::kSpinEnergy,
     sum::kMomentum | sum::kTransfer | sum::kEnergyTransfer,
     [](Field field, const Cell<D, S>& cell) {
       return part_of(field.part, cell, kinetic_heat_flux(cell, field.i),
                      collisional_heat_flux(cell, field.i));
     }},
    {Quantity::Dissipation, sum::kDissipation, 0,
     [](Field, const Cell<D, S>& cell) { return cell.dissipation; }},
    {Quantity::Drag, 0, 0, [](Field, const Cell<D, S>&) { return S(0.0); }},
    {Quantity::Spin, sum::kSpin, 0,
     [](Field field, const Cell<D, S>& cell) {
       return of_visitors(cell, cell.spin[std::max<int>(field.i, 0)] / cell.density);
     }},
    {Quantity::SpinTemperature, sum::kSpinEnergy, 0,
     [](Field, const Cell<D, S>& cell) {
       constexpr double kPerComponent = 2.0 / kSpinSize<D>;
       return of_visitors(cell, kPerComponent * cell.spin_energy / cell.density);
     }},
    {Quantity::BalanceMass, 0, 0, [](Field, const Cell<D, S>&) { return no_value<S>(); }},
    {Quantity::BalanceMomentum, 0, 0, [](Field, const Cell<D, S>&) { return no_value<S>(); }},
    {Quantity::BalanceEnergy, 0, 0, [](Field, const Cell<D, S>&) { return no_value<S>(); }},
}};
static_assert(in_order(kDerivations<2, double>));

}  // namespace

Needs needs_of(Field field) {
  const auto& row = kDerivations<2, double>[static_cast<std::size_t>(field.quantity)];
  Needs needs = 0;
  if (field.part != Part::Collisional) needs |= row.kinetic;
  if (field.part != Part::Kinetic) needs |= row.collisional;
  // A component of the stress is either normal or a shear.
  if (field.quantity == Quantity::Stress) {
    needs &= ~(field.i == field.j ? sum::kShears : sum::kSquares);
  }
  return needs;
}

template <int D, class S>
static void read_species(typename CellAverages<D, S>::Species& averages,
                         const MomentLayout<D>& layout, const S* row, int species) {
  for (int k = 0; k < D; ++k) {
    averages.drag[k] = species < layout.drag_count ? row[layout.drag + species * D + k] : S(0.0);
  }
  if (species >= layout.species_count) return;
  const S* const sums = row + layout.of_species(species);
  const auto read = [&](int place, int number) {
    const int index = place + number;
    return place < 0 || index >= layout.species_size ? S(0.0) : sums[index];
  };
  averages.density = read(layout.count, 0);
  averages.mass_density = read(layout.mass, 0);
  for (int k = 0; k < D; ++k) {
    averages.momentum[k] = read(layout.momentum, k);
    averages.squares[k] = read(layout.squares, k);
  }
}

template <int D, class S>
CellAverages<D, S> averages_of(const MomentLayout<D>& layout, const S* row, int species) {
  CellAverages<D, S> cell;
  const auto read = [&](int place, int number) { return place < 0 ? S(0.0) : row[place + number]; };
  if (species != Field::kNone) read_species<D, S>(cell.species, layout, row, species);
  cell.density = row[layout.count];
  cell.mass_density = row[layout.mass];
  for (int k = 0; k < kSpinSize<D>; ++k) cell.spin[k] = read(layout.spin, k);
  cell.spin_energy = read(layout.spin_energy, 0);
  cell.dissipation = read(layout.dissipation, 0);
  int shear = 0;
  for (int k = 0; k < D; ++k) {
    cell.momentum[k] = read(layout.momentum, k);
    cell.energy_flux[k] = read(layout.energy_flux, k);
    cell.energy_transfer[k] = read(layout.energy_transfer, k);
    cell.momentum_flux[k][k] = read(layout.squares, k);
    for (int l = k + 1; l < D; ++l) {
      cell.momentum_flux[k][l] = cell.momentum_flux[l][k] = read(layout.shears, shear++);
    }
    for (int l = 0; l < D; ++l) cell.transfer[k][l] = read(layout.transfer, D * k + l);
  }
  return cell;
}

template <int D>
void averages_row(const MomentLayout<D>& layout, const CellSums& sums, std::size_t cell,
                  double measure, std::vector<double>& row) {
  const auto size = static_cast<std::size_t>(layout.size);
  row.resize(size);
  for (std::size_t k = 0; k < size; ++k) {
    const double weight = static_cast<int>(k) < layout.kinetic ? sums.kinetic_weight : sums.time;
    row[k] = sums.rows[cell * size + k] / (weight * measure);
  }
}

template <int D>
CellAverages<D, double> averages_of(const MomentLayout<D>& layout, const CellSums& sums,
                                    std::size_t cell, double measure, int species) {
  std::vector<double> row;
  averages_row(layout, sums, cell, measure, row);
  return averages_of<D, double>(layout, row.data(), species);
}

// Its temperature is relative to the common velocity, so that the sum of n_s T_s is rho T (theory
// 12.8).
template <int D, class S>
static S species_value(Field field, const CellAverages<D, S>& cell) {
  const auto& species = cell.species;
  if (field.quantity == Quantity::Drag) return species.drag[field.i];
  const bool present = value_of(species.density) > kRounding;
  if (field.quantity == Quantity::Density) return present ? species.density : S(0.0);
  if (!present) return no_value<S>();
  if (field.quantity == Quantity::Velocity) return species.momentum[field.i] / species.mass_density;
  const auto along = [&](int k) {
    const S v = velocity(cell, k);
    return (species.squares[k] - 2.0 * (v * species.momentum[k]) + v * v * species.mass_density) /
           species.density;
  };
  if (field.i != Field::kNone) return along(field.i);
  S sum = along(0);
  for (int k = 1; k < D; ++k) sum = sum + along(k);
  return (1.0 / D) * sum;
}

template <int D, class S>
S field_value(Field field, const CellAverages<D, S>& cell) {
  if (field.species != Field::kNone) return species_value(field, cell);
  return kDerivations<D, S>[static_cast<std::size_t>(field.quantity)].value(field, cell);
}

template CellAverages<2, double> averages_of(const MomentLayout<2>&, const double*, int);
template CellAverages<3, double> averages_of(const MomentLayout<3>&, const double*, int);
template CellAverages<2, Dual> averages_of(const MomentLayout<2>&, const Dual*, int);
template CellAverages<3, Dual> averages_of(const MomentLayout<3>&, const Dual*, int);
template void averages_row(const MomentLayout<2>&, const CellSums&, std::size_t, double,
                           std::vector<double>&);
template void averages_row(const MomentLayout<3>&, const CellSums&, std::size_t, double,
                           std::vector<double>&);
template CellAverages<2, double> averages_of(const MomentLayout<2>&, const CellSums&, std::size_t,
                                             double, int);
template CellAverages<3, double> averages_of(const MomentLayout<3>&, const CellSums&, std::size_t,
                                             double, int);
template double field_value(Field, const CellAverages<2, double>&);
template double field_value(Field, const CellAverages<3, double>&);
template Dual field_value(Field, const CellAverages<2, Dual>&);
template Dual field_value(Field, const CellAverages<3, Dual>&);

}  // namespace clatter
