#pragma once

#include <string>

#include "engine/scene/scene.h"

namespace clatter {

/// Name, sign and unit of a quantity in a picture.
struct Label {
  std::string name;            ///< name and symbol, "velocity v"
  std::string subscript = "";  ///< subscript of the symbol, e.g. "x"; empty: none
  Sign sign = Sign::Positive;
  std::string unit = "";  ///< e.g. "a/t"; empty: dimensionless

  bool operator==(const Label&) const = default;
};

/// A unit with superscripts for "^2" and "^3"; empty for the unit "1".
std::string typeset(std::string unit);
/// Label of the colour of the particles in `dimension` dimensions.
Label label_of(ColourBy colour_by, int dimension = 2);
/// Label of a field in `dimension` dimensions. A field without a component gets the label of the
/// whole quantity, and a field of a species the name of it after the component.
Label label_of(Field field, int dimension, const std::string& species = {});

}  // namespace clatter
