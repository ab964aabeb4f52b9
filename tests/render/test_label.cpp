#include <doctest/doctest.h>

#include "render/label.h"

namespace clatter {

TEST_CASE("Label: it has a symbol and a unit") {
  CHECK(label_of(Field(Quantity::Temperature, 0), 2) ==
        Label{"temperature T", "x", Sign::Positive, "m a²/t²"});
  CHECK(label_of(Field(Quantity::HeatFlux, 1), 2) ==
        Label{"heat flux q", "y", Sign::Either, "m a/t³"});
  CHECK(label_of(Quantity::Dissipation, 2).sign == Sign::Negative);
  CHECK(label_of(Field(Quantity::BalanceMomentum, 0), 2) ==
        Label{"momentum residual", "x", Sign::Either, ""});
  CHECK(label_of(ColourBy::Speed).unit == "a/t");
  CHECK(label_of(ColourBy::Spin).unit == "1/t");
  CHECK(label_of(Quantity::HeatFlux, 2) == Label{"heat flux q", "", Sign::Either, "m a/t³"});
}

}  // namespace clatter
