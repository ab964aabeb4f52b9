#include "engine/scene/unit.h"

namespace clatter {

const char* unit_of(Field field) {
  switch (field) {
    case Field::Density:
      return "1/a^2";
    case Field::VelocityX:
    case Field::VelocityY:
      return "a/t";
    case Field::Temperature:
    case Field::TemperatureX:
    case Field::TemperatureY:
    case Field::SpinTemperature:
      return "m a^2/t^2";
    case Field::StressXx:
    case Field::StressYy:
    case Field::StressXy:
    case Field::StressXxKinetic:
    case Field::StressYyKinetic:
    case Field::StressXyKinetic:
    case Field::StressXxCollisional:
    case Field::StressYyCollisional:
    case Field::StressXyCollisional:
      return "m/t^2";
    case Field::HeatFluxX:
    case Field::HeatFluxY:
    case Field::HeatFluxXKinetic:
    case Field::HeatFluxYKinetic:
    case Field::HeatFluxXCollisional:
    case Field::HeatFluxYCollisional:
      return "m a/t^3";
    case Field::Dissipation:
      return "m/t^3";
    case Field::Spin:
      return "1/t";
    case Field::BalanceMass:
    case Field::BalanceMomentumX:
    case Field::BalanceMomentumY:
    case Field::BalanceEnergy:
      return "1";
  }
  return "";
}

}  // namespace clatter
