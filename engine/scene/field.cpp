#include "engine/scene/field.h"

#include <algorithm>
#include <cstdlib>

namespace clatter {

Sign sign_of(Field field) {
  const QuantityTraits& traits = traits_of(field.quantity);
  return traits.rank == Rank::Tensor && field.i != field.j ? Sign::Either : traits.sign;
}

std::string axes_of(Field field) {
  std::string axes;
  for (const std::int8_t axis : {field.i, field.j}) {
    if (axis != Field::kNone) axes += "xyz"[axis];
  }
  return axes;
}

std::string unit_of(Quantity quantity, int dimension) {
  const Unit& unit = traits_of(quantity).unit;
  const int length = unit.length - (unit.per_volume ? dimension : 0);
  std::string above, below;
  bool several_below = false;
  for (const auto& [letter, power] : {std::pair("m", unit.mass), {"a", length}, {"t", unit.time}}) {
    if (power == 0) continue;
    std::string& side = power > 0 ? above : below;
    if (power < 0 && !below.empty()) several_below = true;
    if (!side.empty()) side += ' ';
    side += letter;
    if (std::abs(power) > 1) side += '^' + std::to_string(std::abs(power));
  }
  if (above.empty()) above = "1";
  if (below.empty()) return above;
  return several_below ? above + "/(" + below + ")" : above + "/" + below;
}

static std::string part_suffix(Part part) {
  switch (part) {
    case Part::Total:
      return "";
    case Part::Kinetic:
      return "_kinetic";
    case Part::Collisional:
      return "_collisional";
  }
  return "";
}

std::string name_of(Field field) {
  const std::string axes = axes_of(field);
  return traits_of(field.quantity).name + (axes.empty() ? "" : '_' + axes) +
         part_suffix(field.part);
}

std::string name_of(Field field, const std::string& species) {
  return name_of(field) + (species.empty() ? "" : '_' + species);
}

std::string joint_name_of(Field field) {
  const bool alone = is_residual(field) || traits_of(field.quantity).rank == Rank::MeanAndShares;
  return alone ? name_of(field)
               : name_of(Field(field.quantity, Field::kNone, Field::kNone, field.part));
}

static void add_components(std::vector<Field>& fields, Quantity quantity, Part part,
                           int dimension) {
  const Rank rank = traits_of(quantity).rank;
  const bool has_whole = rank == Rank::Scalar || rank == Rank::MeanAndShares ||
                         (rank == Rank::AxialVector && dimension == 2);
  const bool has_axes = rank == Rank::Vector || rank == Rank::MeanAndShares ||
                        (rank == Rank::AxialVector && dimension == 3);
  if (has_whole) fields.emplace_back(quantity, Field::kNone, Field::kNone, part);
  for (int i = 0; has_axes && i < dimension; ++i) {
    fields.emplace_back(quantity, i, Field::kNone, part);
  }
  if (rank != Rank::Tensor) return;
  for (int i = 0; i < dimension; ++i) fields.emplace_back(quantity, i, i, part);
  for (int i = 0; i < dimension; ++i) {
    for (int j = i + 1; j < dimension; ++j) fields.emplace_back(quantity, i, j, part);
  }
}

std::vector<Field> fields_of(Quantity quantity, int dimension) {
  std::vector<Field> fields;
  add_components(fields, quantity, Part::Total, dimension);
  if (traits_of(quantity).has_parts) {
    add_components(fields, quantity, Part::Kinetic, dimension);
    add_components(fields, quantity, Part::Collisional, dimension);
  }
  return fields;
}

std::vector<Field> all_fields(int dimension) {
  std::vector<Field> all;
  for (const QuantityTraits& traits : kQuantities) {
    if (of_species_alone(traits.quantity)) continue;
    const std::vector<Field> fields = fields_of(traits.quantity, dimension);
    all.insert(all.end(), fields.begin(), fields.end());
  }
  return all;
}

std::vector<Field> residual_fields(int dimension) {
  std::vector<Field> fields = all_fields(dimension);
  std::erase_if(fields, [](Field field) { return !is_residual(field); });
  return fields;
}

std::vector<NamedField> field_names(int dimension, const std::vector<std::string>& species) {
  std::vector<NamedField> names;
  for (const Field field : all_fields(dimension)) names.emplace_back(name_of(field), field);
  for (std::size_t s = 0; s < species.size(); ++s) {
    for (const QuantityTraits& traits : kQuantities) {
      if (!has_species(traits.quantity)) continue;
      for (const Field field : fields_of(traits.quantity, dimension)) {
        const std::string name = name_of(field, species[s]);
        const bool known = std::ranges::find(names, name, &NamedField::first) != names.end();
        if (!known) names.emplace_back(name, field.of(s));
      }
    }
  }
  return names;
}

// The mean temperature comes after its components, so that a single component keeps its own name
// when written.
std::vector<NamedField> measured_names(int dimension) {
  std::vector<NamedField> names;
  for (const QuantityTraits& traits : kQuantities) {
    const std::vector<Field> fields = fields_of(traits.quantity, dimension);
    const bool shares = traits.rank == Rank::MeanAndShares;
    for (const Field field : fields) {
      if (shares && field.i != Field::kNone) names.emplace_back(name_of(field), field);
    }
    for (const Field field : fields) {
      const std::string name = shares ? traits.name : joint_name_of(field);
      names.emplace_back(is_residual(field) ? "balance" : name, field);
    }
  }
  return names;
}

}  // namespace clatter
