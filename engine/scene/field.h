#pragma once

#include <array>
#include <cstdint>
#include <string>
#include <utility>
#include <vector>

namespace clatter {

/// Quantities of the gas that fields show (theory 8).
enum class Quantity : std::uint8_t {
  Density,          ///< rho, particles per area; in 3D per volume, as all densities
  Velocity,         ///< V, their mean velocity
  Temperature,      ///< T_k = m <(v_k - V_k)^2>, and T, the mean of T_k over the axes
  Stress,           ///< sigma, minus the pressure tensor; xy: y momentum through a face normal to x
  HeatFlux,         ///< q, relative to V
  Dissipation,      ///< zeta <= 0, energy gain in collisions of particles per time and area
  Drag,             ///< momentum that a species gains from others, per time and area (theory 12.21)
  Spin,             ///< mean angular velocity
  SpinTemperature,  ///< T_rot = I <omega^2>, the mean over the components of omega
  BalanceMass,      ///< residual of a balance (theory 9.1-9.3), relative to the bookings
  BalanceMomentum,
  BalanceEnergy
};

/// Contribution to a stress or a heat flux: by particles, by collisions along their branch vectors,
/// or both.
enum class Part : std::uint8_t { Total, Kinetic, Collisional };

/// A field over the box: a component of a quantity, or of a part of it.
struct Field {
  static constexpr std::int8_t kNone = -1;

  Quantity quantity = Quantity::Density;
  std::int8_t i = kNone;  ///< axis of the component; kNone for scalars and the mean temperature
  std::int8_t j = kNone;  ///< second axis of a tensor's component, i <= j
  Part part = Part::Total;
  std::int16_t species = kNone;  ///< number of the species that it is of; kNone: all particles

  constexpr Field() = default;
  constexpr Field(Quantity quantity, int i = kNone, int j = kNone, Part part = Part::Total)
      : quantity(quantity),
        i(static_cast<std::int8_t>(i)),
        j(static_cast<std::int8_t>(j)),
        part(part) {}
  constexpr Field(Quantity quantity, int i, Part part) : Field(quantity, i, kNone, part) {}

  /// The same field of one species of a mixture.
  constexpr Field of(std::size_t number) const {
    Field field = *this;
    field.species = static_cast<std::int16_t>(number);
    return field;
  }

  bool operator==(const Field&) const = default;
};

/// Components of a quantity.
enum class Rank : std::uint8_t {
  Scalar,
  Vector,         ///< one along each axis
  Tensor,         ///< a symmetric one: xx, yy (, zz), then xy (, xz, yz)
  MeanAndShares,  ///< the mean over the axes, then one component per axis
  AxialVector     ///< in 2D one component without an axis; in 3D one about each axis
};

/// Signs of the values of a field.
enum class Sign : std::uint8_t { Positive, Negative, Either };

/// Source of a quantity's values.
enum class Kind : std::uint8_t {
  Average,         ///< over particles and collisions
  SpinAverage,     ///< over particles that spin
  SpeciesAverage,  ///< over the particles of one species; all particles together have no value
  Residual         ///< of a balance equation
};

/// A unit as powers of mass, length and time.
struct Unit {
  int mass = 0, length = 0, time = 0;
  bool per_volume = false;  ///< divided by an area in 2D, by a volume in 3D
};

/// Properties of a quantity for scenes, files and pictures.
struct QuantityTraits {
  Quantity quantity;
  const char* name;            ///< in scenes and files
  const char* title;           ///< in pictures; ends with the symbol, if any: "stress σ"
  const char* subscript = "";  ///< of the symbol, before subscripts of components
  Unit unit = {};
  Sign sign = Sign::Positive;  ///< of a tensor's diagonal; other components have either sign
  Rank rank = Rank::Scalar;
  bool has_parts = false;  ///< whether it is the sum of a kinetic and a collisional part
  Kind kind = Kind::Average;
};

/// The quantities in the order of Quantity, which is also the order in files. Particles repel each
/// other, so pressure is positive and normal stress negative.
inline constexpr std::array<QuantityTraits, 12> kQuantities = {{
    {.quantity = Quantity::Density,
     .name = "density",
     .title = "density ρ",
     .unit = {.per_volume = true}},
    {.quantity = Quantity::Velocity,
     .name = "velocity",
     .title = "flow V",
     .unit = {.length = 1, .time = -1},
     .sign = Sign::Either,
     .rank = Rank::Vector},
    {.quantity = Quantity::Temperature,
     .name = "temperature",
     .title = "temperature T",
     .unit = {.mass = 1, .length = 2, .time = -2},
     .rank = Rank::MeanAndShares},
    {.quantity = Quantity::Stress,
     .name = "stress",
     .title = "stress σ",
     .unit = {.mass = 1, .length = 2, .time = -2, .per_volume = true},
     .sign = Sign::Negative,
     .rank = Rank::Tensor,
     .has_parts = true},
    {.quantity = Quantity::HeatFlux,
     .name = "heat_flux",
     .title = "heat flux q",
     .unit = {.mass = 1, .length = 3, .time = -3, .per_volume = true},
     .sign = Sign::Either,
     .rank = Rank::Vector,
     .has_parts = true},
    {.quantity = Quantity::Dissipation,
     .name = "dissipation",
     .title = "dissipation ζ",
     .unit = {.mass = 1, .length = 2, .time = -3, .per_volume = true},
     .sign = Sign::Negative},
    {.quantity = Quantity::Drag,
     .name = "drag",
     .title = "drag f",
     .unit = {.mass = 1, .length = 1, .time = -2, .per_volume = true},
     .sign = Sign::Either,
     .rank = Rank::Vector,
     .kind = Kind::SpeciesAverage},
    {.quantity = Quantity::Spin,
     .name = "spin",
     .title = "mean spin ω",
     .unit = {.time = -1},
     .sign = Sign::Either,
     .rank = Rank::AxialVector,
     .kind = Kind::SpinAverage},
    {.quantity = Quantity::SpinTemperature,
     .name = "spin_temperature",
     .title = "spin temperature T",
     .subscript = "rot",
     .unit = {.mass = 1, .length = 2, .time = -2},
     .kind = Kind::SpinAverage},
    {.quantity = Quantity::BalanceMass,
     .name = "balance_mass",
     .title = "mass residual",
     .sign = Sign::Either,
     .kind = Kind::Residual},
    {.quantity = Quantity::BalanceMomentum,
     .name = "balance_momentum",
     .title = "momentum residual",
     .sign = Sign::Either,
     .rank = Rank::Vector,
     .kind = Kind::Residual},
    {.quantity = Quantity::BalanceEnergy,
     .name = "balance_energy",
     .title = "energy residual",
     .sign = Sign::Either,
     .kind = Kind::Residual},
}};

/// The properties of a quantity.
constexpr const QuantityTraits& traits_of(Quantity quantity) {
  return kQuantities[static_cast<std::size_t>(quantity)];
}

/// Whether there is one row per quantity, in the order of Quantity.
constexpr bool in_order(const auto& rows) {
  for (std::size_t k = 0; k < rows.size(); ++k) {
    if (rows[k].quantity != static_cast<Quantity>(k)) return false;
  }
  return rows.size() == static_cast<std::size_t>(Quantity::BalanceEnergy) + 1;
}
static_assert(in_order(kQuantities));

/// Whether a field is a residual of a balance equation, not an average.
constexpr bool is_residual(Field field) {
  return traits_of(field.quantity).kind == Kind::Residual;
}

/// Whether a field is an average over spins.
constexpr bool of_spins(Field field) {
  return traits_of(field.quantity).kind == Kind::SpinAverage;
}

/// Whether a quantity is one of each species of a mixture alone, not of all particles.
constexpr bool of_species_alone(Quantity quantity) {
  return traits_of(quantity).kind == Kind::SpeciesAverage;
}

/// Whether a quantity is one of each species of a mixture: density, velocity, temperature and drag.
constexpr bool has_species(Quantity quantity) {
  return quantity == Quantity::Density || quantity == Quantity::Velocity ||
         quantity == Quantity::Temperature || of_species_alone(quantity);
}

/// Signs of the values of a field.
Sign sign_of(Field field);

/// The axes of a field's component, for example "xy"; empty without axes.
std::string axes_of(Field field);

/// Meaning of the letters in units.
inline constexpr const char* kUnits =
    "a: particle diameter, m: particle mass, t: time unit of the scene";

/// The unit of a quantity in D dimensions in the letters of kUnits, for example "m a^2/t^2"; "1"
/// for dimensionless quantities.
std::string unit_of(Quantity quantity, int dimension);

/// A field and its name in scenes and files.
using NamedField = std::pair<std::string, Field>;

/// The name of a field in files, of all particles: "stress_xy_kinetic".
std::string name_of(Field field);

/// The name of a field of a species, "temperature_x_large"; without a species name_of(field).
std::string name_of(Field field, const std::string& species);

/// The common name of all components of a field: "stress_kinetic" for each component of the kinetic
/// stress. Components of temperatures and residuals have only their own names.
std::string joint_name_of(Field field);

/// All components of a quantity and of its parts in D dimensions, in the order of files.
std::vector<Field> fields_of(Quantity quantity, int dimension);

/// All fields of all particles in D dimensions, in the order of files.
std::vector<Field> all_fields(int dimension);

/// The residuals, in the order of Conserved<D>.
std::vector<Field> residual_fields(int dimension);

/// The fields of all particles with their names, then those of each of these species. Of fields
/// with one name the first is in the list.
std::vector<NamedField> field_names(int dimension, const std::vector<std::string>& species = {});

/// The names of fields in measure.fields, one entry per field. A name may stand for several fields.
/// Scenes are written with the first name of a field.
std::vector<NamedField> measured_names(int dimension);

/// Estimator of fields: integrates flights exactly, or takes snapshots of positions.
enum class Estimator { Exact, Snapshot };

}  // namespace clatter
