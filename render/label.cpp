#include "render/label.h"

namespace clatter {

std::string typeset(std::string unit) {
  if (unit == "1") return "";
  for (const auto& [plain, raised] : {std::pair("^2", "²"), {"^3", "³"}}) {
    for (auto at = unit.find(plain); at != std::string::npos; at = unit.find(plain)) {
      unit.replace(at, 2, raised);
    }
  }
  return unit;
}

Label label_of(ColourBy colour_by, int dimension) {
  const std::string speed = unit_of(Quantity::Velocity, 2), spin = unit_of(Quantity::Spin, 2);
  switch (colour_by) {
    case ColourBy::None:
    case ColourBy::Species:
      break;
    case ColourBy::Speed:
      return {"speed |v|", "", Sign::Positive, speed};
    case ColourBy::VelocityX:
      return {"velocity v", "x", Sign::Either, speed};
    case ColourBy::VelocityY:
      return {"velocity v", "y", Sign::Either, speed};
    case ColourBy::VelocityZ:
      return {"velocity v", "z", Sign::Either, speed};
    case ColourBy::Spin:
      if (dimension == 3) return {"spin |ω|", "", Sign::Positive, spin};
      return {"spin ω", "", Sign::Either, spin};
    case ColourBy::Depth:
      return {"depth", "", Sign::Either, "a"};
    case ColourBy::Diameter:
      return {"diameter d", "", Sign::Positive, "a"};
  }
  return {""};
}

static const char* part_name(Part part) {
  switch (part) {
    case Part::Total:
      return "";
    case Part::Kinetic:
      return "kinetic ";
    case Part::Collisional:
      return "collisional ";
  }
  return "";
}

Label label_of(Field field, int dimension, const std::string& species) {
  const QuantityTraits& traits = traits_of(field.quantity);
  std::string subscript = traits.subscript + axes_of(field);
  if (!subscript.empty() && !species.empty()) subscript += ' ';
  return {std::string(part_name(field.part)) + traits.title, subscript + species, sign_of(field),
          typeset(unit_of(field.quantity, dimension))};
}

}  // namespace clatter
