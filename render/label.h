#pragma once

#include <string>

#include "engine/scene/scene.h"

namespace clatter {

/// How a picture says what it shows, whatever the values.
struct Label {
  std::string name;            ///< ends with its symbol, if any: "velocity v"
  std::string subscript = "";  ///< of that symbol, e.g. "x"; may be empty
  Sign sign = Sign::Positive;
  std::string unit = "";  ///< e.g. "a/t"; empty of bare numbers

  bool operator==(const Label&) const = default;
};

/// Of a disk's colour.
Label label_of(ColourBy colour_by);
/// Of a heatmap, in so many dimensions; of a quantity as a whole where the field has no component.
Label label_of(Field field, int dimension);

}  // namespace clatter
