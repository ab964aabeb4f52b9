#include "render/quantity.h"

#include "engine/scene/unit.h"

namespace clatter {

namespace {

Quantity name_of(ColourBy colour_by) {
  switch (colour_by) {
    case ColourBy::None:
      return {""};
    case ColourBy::Speed:
      return {"speed |v|"};
    case ColourBy::VelocityX:
      return {"velocity v", "x", Sign::Either};
    case ColourBy::VelocityY:
      return {"velocity v", "y", Sign::Either};
    case ColourBy::Spin:
      return {"spin ω", "", Sign::Either};
  }
  return {""};
}

// Particles repel each other, so pressure is positive and normal stress negative.
Quantity name_of(Field field) {
  switch (field) {
    case Field::Density:
      return {"density ρ"};
    case Field::VelocityX:
      return {"flow V", "x", Sign::Either};
    case Field::VelocityY:
      return {"flow V", "y", Sign::Either};
    case Field::Temperature:
      return {"temperature T"};
    case Field::TemperatureX:
      return {"temperature T", "x"};
    case Field::TemperatureY:
      return {"temperature T", "y"};
    case Field::StressXx:
      return {"stress σ", "xx", Sign::Negative};
    case Field::StressYy:
      return {"stress σ", "yy", Sign::Negative};
    case Field::StressXy:
      return {"stress σ", "xy", Sign::Either};
    case Field::StressXxKinetic:
      return {"kinetic stress σ", "xx", Sign::Negative};
    case Field::StressYyKinetic:
      return {"kinetic stress σ", "yy", Sign::Negative};
    case Field::StressXyKinetic:
      return {"kinetic stress σ", "xy", Sign::Either};
    case Field::StressXxCollisional:
      return {"collisional stress σ", "xx", Sign::Negative};
    case Field::StressYyCollisional:
      return {"collisional stress σ", "yy", Sign::Negative};
    case Field::StressXyCollisional:
      return {"collisional stress σ", "xy", Sign::Either};
    case Field::HeatFluxX:
      return {"heat flux q", "x", Sign::Either};
    case Field::HeatFluxY:
      return {"heat flux q", "y", Sign::Either};
    case Field::HeatFluxXKinetic:
      return {"kinetic heat flux q", "x", Sign::Either};
    case Field::HeatFluxYKinetic:
      return {"kinetic heat flux q", "y", Sign::Either};
    case Field::HeatFluxXCollisional:
      return {"collisional heat flux q", "x", Sign::Either};
    case Field::HeatFluxYCollisional:
      return {"collisional heat flux q", "y", Sign::Either};
    case Field::Dissipation:
      return {"dissipation ζ", "", Sign::Negative};
    case Field::Spin:
      return {"mean spin ω", "", Sign::Either};
    case Field::SpinTemperature:
      return {"spin temperature T", "rot"};
    case Field::BalanceMass:
      return {"mass residual", "", Sign::Either};
    case Field::BalanceMomentumX:
      return {"momentum residual", "x", Sign::Either};
    case Field::BalanceMomentumY:
      return {"momentum residual", "y", Sign::Either};
    case Field::BalanceEnergy:
      return {"energy residual", "", Sign::Either};
  }
  return {""};
}

// With raised exponents for "^2" and "^3"; nothing for bare numbers.
std::string typeset(std::string unit) {
  if (unit == "1") return "";
  for (const auto& [plain, raised] : {std::pair("^2", "²"), {"^3", "³"}}) {
    for (auto at = unit.find(plain); at != std::string::npos; at = unit.find(plain)) {
      unit.replace(at, 2, raised);
    }
  }
  return unit;
}

Quantity without_subscript(Quantity quantity) {
  quantity.subscript.clear();
  return quantity;
}

}  // namespace

Quantity quantity_of(ColourBy colour_by) {
  Quantity quantity = name_of(colour_by);
  const bool turns = colour_by == ColourBy::Spin;
  quantity.unit = typeset(unit_of(turns ? Field::Spin : Field::VelocityX));
  return quantity;
}

Quantity quantity_of(Field field) {
  Quantity quantity = name_of(field);
  quantity.unit = typeset(unit_of(field));
  return quantity;
}

Quantity quantity_of(Arrows arrows) {
  switch (arrows) {
    case Arrows::Velocity:
      return without_subscript(quantity_of(Field::VelocityX));
    case Arrows::HeatFlux:
      return without_subscript(quantity_of(Field::HeatFluxX));
  }
  return {""};
}

}  // namespace clatter
