#include "engine/measure/moment_layout.h"

#include <algorithm>

#include "engine/measure/fields.h"

namespace clatter {

// The sums of each species are the first sums of a row: count, mass, momentum, squares.
template <int D>
static void keep_species(MomentLayout<D>& layout, std::span<const Field> fields) {
  for (const Field field : fields) {
    if (field.species == Field::kNone || field.quantity == Quantity::Drag) continue;
    layout.species_count = std::max(layout.species_count, field.species + 1);
    int size = 1;
    if (field.quantity == Quantity::Velocity) size = layout.momentum + D;
    if (field.quantity == Quantity::Temperature) size = layout.squares + D;
    layout.species_size = std::max(layout.species_size, size);
  }
  if (layout.species_count == 0) return;
  layout.species = layout.size;
  layout.size += layout.species_count * layout.species_size;
}

template <int D>
static void keep_drag(MomentLayout<D>& layout, std::span<const Field> fields) {
  for (const Field field : fields) {
    if (field.quantity == Quantity::Drag)
      layout.drag_count = std::max(layout.drag_count, field.species + 1);
  }
  if (layout.drag_count == 0) return;
  layout.drag = layout.size;
  layout.size += layout.drag_count * D;
}

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
  layout.common = layout.size;
  keep_species(layout, fields);
  layout.kinetic = layout.size;
  keep(sum::kTransfer, layout.transfer, D * D);
  keep(sum::kEnergyTransfer, layout.energy_transfer, D);
  layout.along_branch = layout.size;
  keep(sum::kDissipation, layout.dissipation, 1);
  keep_drag(layout, fields);
  return layout;
}

template MomentLayout<2> moment_layout<2>(std::span<const Field>, bool, bool);
template MomentLayout<3> moment_layout<3>(std::span<const Field>, bool, bool);

}  // namespace clatter
