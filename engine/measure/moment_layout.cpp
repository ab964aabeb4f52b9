#include "engine/measure/moment_layout.h"

#include "engine/measure/fields.h"

namespace clatter {

template <int D>
MomentLayout<D> moment_layout(std::span<const Field> fields, bool spins, bool mixed) {
  Needs needs = 0;
  for (const Field field : fields) needs |= needs_of(field);
  MomentLayout<D> layout;
  const auto keep = [&](Needs sum, int& place, int numbers) {
    if (!(needs & sum)) return;
    place = layout.size;
    layout.size += numbers;
  };
  if (mixed) layout.mass = layout.size++;
  keep(sum::kMomentum, layout.momentum, D);
  keep(sum::kSquares, layout.squares, D);
  keep(sum::kShears, layout.shears, D * (D - 1) / 2);
  keep(sum::kEnergyFlux, layout.energy_flux, D);
  if (spins) keep(sum::kSpin, layout.spin, kSpinSize<D>);
  if (spins) keep(sum::kSpinEnergy, layout.spin_energy, 1);
  layout.kinetic = layout.size;
  keep(sum::kTransfer, layout.transfer, D * D);
  keep(sum::kEnergyTransfer, layout.energy_transfer, D);
  layout.along_branch = layout.size;
  keep(sum::kDissipation, layout.dissipation, 1);
  return layout;
}

template MomentLayout<2> moment_layout<2>(std::span<const Field>, bool, bool);
template MomentLayout<3> moment_layout<3>(std::span<const Field>, bool, bool);

}  // namespace clatter
