#pragma once

#include <string>

#include "engine/scene/view.h"

namespace clatter {

/// Which signs the values of a quantity have.
enum class Sign { Positive, Negative, Either };

/// What belongs to a quantity, whatever its values.
struct Quantity {
  std::string name;            ///< ends with its symbol, if any: "velocity v"
  std::string subscript = "";  ///< of that symbol, e.g. "x"; may be empty
  Sign sign = Sign::Positive;
  std::string unit = "";  ///< e.g. "a/t"; empty of bare numbers

  bool operator==(const Quantity&) const = default;
};

/// What a disk's colour shows.
Quantity quantity_of(ColourBy colour_by);
/// What a heatmap shows.
Quantity quantity_of(Field field);
/// What arrows show, without its components.
Quantity quantity_of(Arrows arrows);

}  // namespace clatter
