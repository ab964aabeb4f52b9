#include <doctest/doctest.h>

#include "render/quantity.h"

namespace clatter {

TEST_CASE("Quantity: quantities have a symbol and a unit") {
  CHECK(quantity_of(Field::TemperatureX) ==
        Quantity{"temperature T", "x", Sign::Positive, "m a²/t²"});
  CHECK(quantity_of(Field::HeatFluxY) == Quantity{"heat flux q", "y", Sign::Either, "m a/t³"});
  CHECK(quantity_of(Field::Dissipation).sign == Sign::Negative);
  CHECK(quantity_of(Field::BalanceMomentumX) ==
        Quantity{"momentum residual", "x", Sign::Either, ""});
  CHECK(quantity_of(ColourBy::Speed).unit == "a/t");
  CHECK(quantity_of(ColourBy::Spin).unit == "1/t");
  CHECK(quantity_of(Arrows::HeatFlux) == Quantity{"heat flux q", "", Sign::Either, "m a/t³"});
}

}  // namespace clatter
