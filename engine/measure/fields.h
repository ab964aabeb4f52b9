#pragma once

#include <array>
#include <vector>

#include "engine/measure/cell_integrals.h"
#include "engine/measure/dual.h"
#include "engine/measure/moment_layout.h"
#include "engine/scene/field.h"

namespace clatter {

/// Time averages of a cell per area, in 3D per volume. S is double or Dual. Sums that the layout
/// does not keep are 0.
template <int D, class S>
struct CellAverages {
  using Vector = std::array<S, D>;
  using Tensor = std::array<std::array<S, D>, D>;  ///< [k][l]

  S density{};                         ///< rho, of numbers
  S mass_density{};                    ///< sum m; of particles that are alike rho
  Vector momentum{};                   ///< sum m v_k
  Tensor momentum_flux{};              ///< sum m v_k v_l
  Vector energy_flux{};                ///< sum (m v^2 + I omega^2)/2 v_k
  std::array<S, kSpinSize<D>> spin{};  ///< sum omega
  S spin_energy{};                     ///< sum I omega^2 / 2
  Tensor transfer{};                   ///< of momentum l along k in collisions, per time
  Vector energy_transfer{};  ///< energy transfer of collisions, sum of branch vector times energy
  S dissipation{};           ///< <= 0, energy gain in collisions between particles, per time

  /// The same of the particles of one species; undefined unless they are asked for.
  struct Species {
    S density;
    S mass_density;
    Vector momentum;
    Vector squares;  ///< sum m v_k^2
    Vector drag;     ///< momentum that it gains in collisions with other species, per time
  } species;

  /// E = sum (m v^2 + I omega^2)/2.
  S energy() const {
    S twice = 2.0 * spin_energy;
    for (int k = 0; k < D; ++k) twice = twice + momentum_flux[k][k];
    return 0.5 * twice;
  }
};

/// The averages from a cell's row of sums, divided by time and area. `species`: that of the
/// averages of a species, or Field::kNone.
template <int D, class S>
CellAverages<D, S> averages_of(const MomentLayout<D>& layout, const S* row,
                               int species = Field::kNone);

/// The sums of a cell in a window, divided by time and `measure`, its area or volume: a row for
/// averages_of().
template <int D>
void averages_row(const MomentLayout<D>& layout, const CellSums& sums, std::size_t cell,
                  double measure, std::vector<double>& row);

/// The averages of a cell from the sums of a window. `measure` is the cell's area or volume.
template <int D>
CellAverages<D, double> averages_of(const MomentLayout<D>& layout, const CellSums& sums,
                                    std::size_t cell, double measure, int species = Field::kNone);

/// The sums that a field needs.
Needs needs_of(Field field);

/// Value of a field (theory 8). In a cell without particles, velocity, temperatures, spins and the
/// kinetic parts of stress and heat flux are NaN. The total stress and heat flux are NaN if the
/// collisional part is 0 too. Residuals are always NaN, because they do not follow from averages.
/// The averages must be of the species of the field, if it has one.
template <int D, class S>
S field_value(Field field, const CellAverages<D, S>& cell);

extern template CellAverages<2, double> averages_of(const MomentLayout<2>&, const double*, int);
extern template CellAverages<3, double> averages_of(const MomentLayout<3>&, const double*, int);
extern template CellAverages<2, Dual> averages_of(const MomentLayout<2>&, const Dual*, int);
extern template CellAverages<3, Dual> averages_of(const MomentLayout<3>&, const Dual*, int);
extern template void averages_row(const MomentLayout<2>&, const CellSums&, std::size_t, double,
                                  std::vector<double>&);
extern template void averages_row(const MomentLayout<3>&, const CellSums&, std::size_t, double,
                                  std::vector<double>&);
extern template CellAverages<2, double> averages_of(const MomentLayout<2>&, const CellSums&,
                                                    std::size_t, double, int);
extern template CellAverages<3, double> averages_of(const MomentLayout<3>&, const CellSums&,
                                                    std::size_t, double, int);
extern template double field_value(Field, const CellAverages<2, double>&);
extern template double field_value(Field, const CellAverages<3, double>&);
extern template Dual field_value(Field, const CellAverages<2, Dual>&);
extern template Dual field_value(Field, const CellAverages<3, Dual>&);

}  // namespace clatter
