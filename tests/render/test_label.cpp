#include <doctest/doctest.h>

#include <algorithm>
#include <string>
#include <vector>

#include "render/label.h"

namespace clatter {

TEST_CASE("Label: colours of particles have a symbol, an axis, a sign and a unit") {
  struct Row {
    ColourBy colour_by;
    int dimension;
    Label label;
  };
  for (const Row& row :
       {Row{ColourBy::Speed, 2, {"speed |v|", "", Sign::Positive, "a/t"}},
        Row{ColourBy::VelocityX, 2, {"velocity v", "x", Sign::Either, "a/t"}},
        Row{ColourBy::VelocityY, 2, {"velocity v", "y", Sign::Either, "a/t"}},
        Row{ColourBy::VelocityZ, 3, {"velocity v", "z", Sign::Either, "a/t"}},
        Row{ColourBy::None, 2, {""}}, Row{ColourBy::Spin, 2, {"spin ω", "", Sign::Either, "1/t"}},
        Row{ColourBy::Spin, 3, {"spin |ω|", "", Sign::Positive, "1/t"}},
        Row{ColourBy::Depth, 3, {"depth", "", Sign::Either, "a"}},
        Row{ColourBy::Diameter, 2, {"diameter d", "", Sign::Positive, "a"}}}) {
    CHECK(label_of(row.colour_by, row.dimension) == row.label);
  }
}

TEST_CASE("Label: every field has its title, the axes of its component and its unit") {
  struct Row {
    std::string field;
    const char* name;
    const char* subscript;
    const char* unit;
  };
  std::size_t found = 0;
  const std::vector<Row> rows = {
      {"density", "density ρ", "", "1/a²"},
      {"velocity_x", "flow V", "x", "a/t"},
      {"temperature", "temperature T", "", "m a²/t²"},
      {"temperature_x", "temperature T", "x", "m a²/t²"},
      {"stress_xx", "stress σ", "xx", "m/t²"},
      {"stress_xy", "stress σ", "xy", "m/t²"},
      {"stress_xy_kinetic", "kinetic stress σ", "xy", "m/t²"},
      {"stress_xy_collisional", "collisional stress σ", "xy", "m/t²"},
      {"heat_flux_x", "heat flux q", "x", "m a/t³"},
      {"heat_flux_x_kinetic", "kinetic heat flux q", "x", "m a/t³"},
      {"heat_flux_y_collisional", "collisional heat flux q", "y", "m a/t³"},
      {"dissipation", "dissipation ζ", "", "m/t³"},
      {"spin", "mean spin ω", "", "1/t"},
      {"spin_temperature", "spin temperature T", "rot", "m a²/t²"},
      {"balance_mass", "mass residual", "", ""},
      {"balance_momentum_x", "momentum residual", "x", ""},
      {"balance_energy", "energy residual", "", ""}};
  for (const NamedField& field : field_names(2)) {
    const Label label = label_of(field.second, 2);
    CAPTURE(field.first);
    CHECK_FALSE(label.name.empty());
    CHECK(label.sign == sign_of(field.second));
    const auto row = std::ranges::find(rows, field.first, &Row::field);
    if (row == rows.end()) continue;
    ++found;
    CHECK(label.name == row->name);
    CHECK(label.subscript == row->subscript);
    CHECK(label.unit == row->unit);
  }
  CHECK(found == rows.size());
}

TEST_CASE("Label: a field of a species has its name after the component") {
  const Field temperature = Field(Quantity::Temperature).of(1);
  CHECK(label_of(temperature, 2, "heavy").subscript == "heavy");
  CHECK(label_of(Field(Quantity::Temperature, 1).of(1), 2, "heavy").subscript == "y heavy");
  const Label drag = label_of(Field(Quantity::Drag, 0).of(0), 3, "light");
  CHECK(drag.name == "drag f");
  CHECK(drag.subscript == "x light");
  CHECK(drag.unit == "m/(a² t²)");
}

}  // namespace clatter
