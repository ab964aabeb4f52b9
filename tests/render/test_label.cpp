#include <doctest/doctest.h>

#include <vector>

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

TEST_CASE("Label: colours of particles have a symbol, an axis, a sign and a unit") {
  struct Row {
    ColourBy colour_by;
    int dimension;
    Label label;
  };
  for (const Row& row : {Row{ColourBy::Speed, 2, {"speed |v|", "", Sign::Positive, "a/t"}},
                         Row{ColourBy::VelocityX, 2, {"velocity v", "x", Sign::Either, "a/t"}},
                         Row{ColourBy::VelocityY, 2, {"velocity v", "y", Sign::Either, "a/t"}},
                         Row{ColourBy::VelocityZ, 3, {"velocity v", "z", Sign::Either, "a/t"}},
                         Row{ColourBy::Spin, 2, {"spin ω", "", Sign::Either, "1/t"}},
                         Row{ColourBy::Spin, 3, {"spin |ω|", "", Sign::Positive, "1/t"}},
                         Row{ColourBy::Depth, 3, {"depth", "", Sign::Either, "a"}}}) {
    CHECK(label_of(row.colour_by, row.dimension) == row.label);
  }
}

TEST_CASE("Label: every field has its title, the axes of its component and its unit") {
  struct Row {
    const char* field;
    const char* name;
    const char* subscript;
    const char* unit;
  };
  const std::vector<Row> rows = {
      {"density", "density ρ", "", "1/a²"},
      {"velocity_x", "flow V", "x", "a/t"},
      {"velocity_y", "flow V", "y", "a/t"},
      {"temperature", "temperature T", "", "m a²/t²"},
      {"temperature_x", "temperature T", "x", "m a²/t²"},
      {"temperature_y", "temperature T", "y", "m a²/t²"},
      {"stress_xx", "stress σ", "xx", "m/t²"},
      {"stress_yy", "stress σ", "yy", "m/t²"},
      {"stress_xy", "stress σ", "xy", "m/t²"},
      {"stress_xx_kinetic", "kinetic stress σ", "xx", "m/t²"},
      {"stress_yy_kinetic", "kinetic stress σ", "yy", "m/t²"},
      {"stress_xy_kinetic", "kinetic stress σ", "xy", "m/t²"},
      {"stress_xx_collisional", "collisional stress σ", "xx", "m/t²"},
      {"stress_yy_collisional", "collisional stress σ", "yy", "m/t²"},
      {"stress_xy_collisional", "collisional stress σ", "xy", "m/t²"},
      {"heat_flux_x", "heat flux q", "x", "m a/t³"},
      {"heat_flux_y", "heat flux q", "y", "m a/t³"},
      {"heat_flux_x_kinetic", "kinetic heat flux q", "x", "m a/t³"},
      {"heat_flux_y_kinetic", "kinetic heat flux q", "y", "m a/t³"},
      {"heat_flux_x_collisional", "collisional heat flux q", "x", "m a/t³"},
      {"heat_flux_y_collisional", "collisional heat flux q", "y", "m a/t³"},
      {"dissipation", "dissipation ζ", "", "m/t³"},
      {"spin", "mean spin ω", "", "1/t"},
      {"spin_temperature", "spin temperature T", "rot", "m a²/t²"},
      {"balance_mass", "mass residual", "", ""},
      {"balance_momentum_x", "momentum residual", "x", ""},
      {"balance_momentum_y", "momentum residual", "y", ""},
      {"balance_energy", "energy residual", "", ""}};
  const std::vector<NamedField> fields = field_names(2);
  REQUIRE(fields.size() == rows.size());
  for (std::size_t k = 0; k < rows.size(); ++k) {
    CAPTURE(rows[k].field);
    CHECK(fields[k].first == rows[k].field);
    const Label label = label_of(fields[k].second, 2);
    CHECK(label.name == rows[k].name);
    CHECK(label.subscript == rows[k].subscript);
    CHECK(label.unit == rows[k].unit);
    CHECK(label.sign == sign_of(fields[k].second));
  }
}

TEST_CASE("Label: a disk's colour has the name, component, sign and unit of its quantity") {
  CHECK(label_of(ColourBy::None) == Label{""});
  CHECK(label_of(ColourBy::Speed) == Label{"speed |v|", "", Sign::Positive, "a/t"});
  CHECK(label_of(ColourBy::VelocityX) == Label{"velocity v", "x", Sign::Either, "a/t"});
  CHECK(label_of(ColourBy::VelocityY) == Label{"velocity v", "y", Sign::Either, "a/t"});
  CHECK(label_of(ColourBy::Spin) == Label{"spin ω", "", Sign::Either, "1/t"});
}

}  // namespace clatter
