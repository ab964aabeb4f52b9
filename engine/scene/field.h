#pragma once

#include <array>
#include <cstdint>
#include <string>
#include <utility>
#include <vector>

namespace clatter {

/// What fields give of the gas at a place (theory 8).
enum class Quantity : std::uint8_t {
  Density,          ///< rho, particles per area; in space per volume, as all that is per area
  Velocity,         ///< V, their mean velocity
  Temperature,      ///< T_k = m <(v_k - V_k)^2>, and T, the mean of these over the axes
  Stress,           ///< sigma, minus the pressure tensor; xy: of momentum along y, through x
  HeatFlux,         ///< q, about V
  Dissipation,      ///< zeta <= 0, energy per time and area that collisions of particles give
  Spin,             ///< mean angular velocity
  SpinTemperature,  ///< T_rot = I <omega^2>, the mean over the components of omega
  BalanceMass,      ///< what the balances (theory 9.1-9.3) leave open, relative to what was booked
  BalanceMomentum,
  BalanceEnergy
};

/// What carries a stress or a heat flux: particles, collisions along their branch vectors, or both.
enum class Part : std::uint8_t { Total, Kinetic, Collisional };

/// A field over the box: a component of a quantity, or of a part of it.
struct Field {
  static constexpr std::int8_t kNone = -1;

  Quantity quantity = Quantity::Density;
  std::int8_t i = kNone;  ///< axis of the component; none of scalars and of the whole temperature
  std::int8_t j = kNone;  ///< second axis of a tensor's component, i <= j
  Part part = Part::Total;

  constexpr Field() = default;
  constexpr Field(Quantity quantity, int i = kNone, int j = kNone, Part part = Part::Total)
      : quantity(quantity),
        i(static_cast<std::int8_t>(i)),
        j(static_cast<std::int8_t>(j)),
        part(part) {}
  constexpr Field(Quantity quantity, int i, Part part) : Field(quantity, i, kNone, part) {}

  bool operator==(const Field&) const = default;
};

/// Which components a quantity has.
enum class Rank : std::uint8_t {
  Scalar,
  Vector,         ///< one along each axis
  Tensor,         ///< a symmetric one: xx, yy (, zz), then xy (, xz, yz)
  MeanAndShares,  ///< the mean over the axes, then what each axis has
  AxialVector     ///< one in the plane, which has no axis; in space one about each axis
};

/// Which signs the values of a field have.
enum class Sign : std::uint8_t { Positive, Negative, Either };

/// What a quantity is known from.
enum class Kind : std::uint8_t {
  Average,      ///< over particles and collisions
  SpinAverage,  ///< over particles that spin
  Residual      ///< of a balance equation
};

/// A unit as powers of mass, length and time.
struct Unit {
  int mass = 0, length = 0, time = 0;
  bool per_volume = false;  ///< divided by an area in the plane, by a volume in space
};

/// All that scenes, files and pictures need to know of a quantity.
struct QuantityTraits {
  Quantity quantity;
  const char* name;            ///< in scenes and files
  const char* title;           ///< in pictures; ends with the symbol, if any: "stress σ"
  const char* subscript = "";  ///< of the symbol, before those of components
  Unit unit = {};
  Sign sign = Sign::Positive;  ///< of a tensor that of its diagonal; what is off it has either
  Rank rank = Rank::Scalar;
  bool has_parts = false;  ///< whether it is the sum of a kinetic and a collisional part
  Kind kind = Kind::Average;
};

/// The quantities, in the order of Quantity, which is that of files too. Particles repel each
/// other, so that pressure is positive and normal stress negative.
inline constexpr std::array<QuantityTraits, 11> kQuantities = {{
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

/// The row of a quantity.
constexpr const QuantityTraits& traits_of(Quantity quantity) {
  return kQuantities[static_cast<std::size_t>(quantity)];
}

/// Whether a row for each quantity stands in its place.
constexpr bool in_order(const auto& rows) {
  for (std::size_t k = 0; k < rows.size(); ++k) {
    if (rows[k].quantity != static_cast<Quantity>(k)) return false;
  }
  return rows.size() == static_cast<std::size_t>(Quantity::BalanceEnergy) + 1;
}
static_assert(in_order(kQuantities));

/// Whether a field is what a balance equation leaves open, and no average.
constexpr bool is_residual(Field field) {
  return traits_of(field.quantity).kind == Kind::Residual;
}

/// Whether a field is an average that only particles with spins have.
constexpr bool of_spins(Field field) {
  return traits_of(field.quantity).kind == Kind::SpinAverage;
}

/// Which signs the values of a field have.
Sign sign_of(Field field);

/// The axes of a field's component, such as "xy"; empty where it has none.
std::string axes_of(Field field);

/// What the letters in units stand for.
inline constexpr const char* kUnits =
    "a: particle diameter, m: particle mass, t: time unit of the scene";

/// The unit of a quantity in D dimensions in terms of these, in plain text such as "m a^2/t^2"; "1"
/// of bare numbers.
std::string unit_of(Quantity quantity, int dimension);

/// A field and its name in scenes and files.
using NamedField = std::pair<std::string, Field>;

/// The name of a field in files: "stress_xy_kinetic".
std::string name_of(Field field);

/// The name that all components of a field have together: "stress_kinetic" of each of its
/// components. Those of temperatures and residuals stand alone.
std::string joint_name_of(Field field);

/// All components of a quantity in D dimensions, and those of its parts, in the order of files.
std::vector<Field> fields_of(Quantity quantity, int dimension);

/// All fields that a gas in D dimensions may have, in the order of files.
std::vector<Field> all_fields(int dimension);

/// The residuals, in the order of Conserved<D>.
std::vector<Field> residual_fields(int dimension);

/// All fields one by one, with their names.
std::vector<NamedField> field_names(int dimension);

/// The names by which fields are asked for in measurements, once for each field that they stand
/// for; the first name of a field is that which scenes are written with.
std::vector<NamedField> measured_names(int dimension);

/// How particles come to count in fields: their flights exactly, or where they are now and then.
enum class Estimator { Exact, Snapshot };

}  // namespace clatter
