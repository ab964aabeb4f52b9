#include "engine/measure/moment_layout.h"

namespace clatter {

namespace {

// Kinds of sums that fields need; see the members of MomentLayout of these names.
struct Needs {
  bool velocity = false, squares = false, shears = false, energy_flux = false;
  bool spin = false, spin_energy = false;
  bool transfer = false, energy_transfer = false, dissipation = false;

  // Of a normal component, or of a shear.
  void add_kinetic_stress(bool shear) {
    velocity = true;
    (shear ? shears : squares) = true;
  }
  // Eq. (4.29) multiplied out has the energy and every component of the kinetic stress.
  void add_kinetic_heat_flux() { velocity = squares = shears = energy_flux = spin_energy = true; }
  void add_collisional_heat_flux() { velocity = transfer = energy_transfer = true; }

  void add(Field field) {
    switch (field) {
      case Field::Density:
        break;
      case Field::VelocityX:
      case Field::VelocityY:
        velocity = true;
        break;
      case Field::Temperature:
      case Field::TemperatureX:
      case Field::TemperatureY:
        velocity = squares = true;
        break;
      case Field::StressXx:
      case Field::StressYy:
        transfer = true;
        [[fallthrough]];
      case Field::StressXxKinetic:
      case Field::StressYyKinetic:
        add_kinetic_stress(false);
        break;
      case Field::StressXy:
        transfer = true;
        [[fallthrough]];
      case Field::StressXyKinetic:
        add_kinetic_stress(true);
        break;
      case Field::StressXxCollisional:
      case Field::StressYyCollisional:
      case Field::StressXyCollisional:
        transfer = true;
        break;
      case Field::HeatFluxX:
      case Field::HeatFluxY:
        add_collisional_heat_flux();
        [[fallthrough]];
      case Field::HeatFluxXKinetic:
      case Field::HeatFluxYKinetic:
        add_kinetic_heat_flux();
        break;
      case Field::HeatFluxXCollisional:
      case Field::HeatFluxYCollisional:
        add_collisional_heat_flux();
        break;
      case Field::Dissipation:
        dissipation = true;
        break;
      case Field::Spin:
        spin = true;
        break;
      case Field::SpinTemperature:
        spin_energy = true;
        break;
      case Field::BalanceMass:
      case Field::BalanceMomentumX:
      case Field::BalanceMomentumY:
      case Field::BalanceEnergy:
        break;  // none of these sums
    }
  }
};

}  // namespace

template <int D>
MomentLayout<D> moment_layout(std::span<const Field> fields, bool spins) {
  Needs needs;
  for (const Field field : fields) needs.add(field);
  MomentLayout<D> layout;
  const auto keep = [&](bool needed, int& place, int numbers) {
    if (!needed) return;
    place = layout.size;
    layout.size += numbers;
  };
  keep(needs.velocity, layout.velocity, D);
  keep(needs.squares, layout.squares, D);
  keep(needs.shears, layout.shears, D * (D - 1) / 2);
  keep(needs.energy_flux, layout.energy_flux, D);
  keep(needs.spin && spins, layout.spin, Spin<D>::SizeAtCompileTime);
  keep(needs.spin_energy && spins, layout.spin_energy, 1);
  layout.kinetic = layout.size;
  keep(needs.transfer, layout.transfer, D * D);
  keep(needs.energy_transfer, layout.energy_transfer, D);
  layout.along_branch = layout.size;
  keep(needs.dissipation, layout.dissipation, 1);
  return layout;
}

template MomentLayout<2> moment_layout<2>(std::span<const Field>, bool);

}  // namespace clatter
