#include <doctest/doctest.h>

#include <algorithm>
#include <map>
#include <set>

#include "engine/scene/field.h"
#include "engine/scene/scene_file.h"
#include "tests/support/messages.h"

namespace clatter {

using namespace testing;

namespace {

// The names, each once, with spaces between them.
template <class Names>
std::string names_in(const Names& names) {
  std::string all, last;
  for (const auto& [name, field] : names) {
    if (name != last) all += (all.empty() ? "" : " ") + std::string(name);
    last = name;
  }
  return all;
}

const std::string kRough = "box.size = [10, 10]\nparticles.count = 5\nparticles.friction = 0.5\n";

std::string field_refusal(const std::string& text) {
  return refusal_of([&] { parse_scene(text, "s.toml"); });
}

Scene scene_with(const std::string& line) {
  return parse_scene(kRough + line, "s.toml");
}

}  // namespace

TEST_CASE("Field: the names are those that scripts rely on, in the order of files") {
  CHECK(names_in(field_names(2)) ==
        "density velocity_x velocity_y temperature temperature_x temperature_y stress_xx stress_yy "
        "stress_xy stress_xx_kinetic stress_yy_kinetic stress_xy_kinetic stress_xx_collisional "
        "stress_yy_collisional stress_xy_collisional heat_flux_x heat_flux_y heat_flux_x_kinetic "
        "heat_flux_y_kinetic heat_flux_x_collisional heat_flux_y_collisional dissipation spin "
        "spin_temperature balance_mass balance_momentum_x balance_momentum_y balance_energy");
  CHECK(
      names_in(measured_names(2)) ==
      "density velocity temperature_x temperature_y temperature stress stress_kinetic "
      "stress_collisional heat_flux heat_flux_kinetic heat_flux_collisional dissipation drag spin "
      "spin_temperature balance");
  const std::string in_space = names_in(field_names(3));
  CHECK(says(in_space, " stress_xx stress_yy stress_zz stress_xy stress_xz stress_yz "));
  CHECK(says(in_space, " spin_x spin_y spin_z "));
  CHECK(says(in_space, " balance_momentum_z "));
  // 1 + 3 + 4 + 3 * 6 + 3 * 3 + 1 + 3 + 1 + 1 + 3 + 1
  CHECK(std::ranges::count(in_space, ' ') == 44);
}

TEST_CASE("Field: a field has one name, and a name one field") {
  for (const int dimension : {2, 3}) {
    const std::vector<NamedField> names = field_names(dimension);
    const std::vector<Field> fields = all_fields(dimension);
    CHECK(names.size() == fields.size());
    for (std::size_t k = 0; k < names.size(); ++k) {
      CHECK(names[k].second == fields[k]);
      CHECK(names[k].first == name_of(fields[k]));
      for (std::size_t l = 0; l < k; ++l) {
        CHECK(names[k].first != names[l].first);
        CHECK(names[k].second != names[l].second);
      }
    }
    // All quantities can be measured.
    std::set<std::string> measured;
    for (const auto& [name, field] : measured_names(dimension)) measured.insert(name_of(field));
    CHECK(measured.size() == fields.size() + static_cast<std::size_t>(dimension));  // drag
  }
}

TEST_CASE("Fields: every name reads as the field that it is written from") {
  for (const auto& [name, field] : field_names(2)) {
    CAPTURE(name);
    const Scene scene = scene_with("view.field = \"" + name + "\"\n");
    CHECK(scene.view.field == field);
    CHECK(says(scene_to_toml(scene), "field = \"" + name + "\""));
  }
}

TEST_CASE("Fields: a heatmap shows a field of one species, by its name") {
  const std::string species =
      "box.size = [20, 20]\n[particles]\n[[species]]\nname = \"light\"\ncount = 3\n"
      "[[species]]\nname = \"heavy\"\ncount = 2\nmass = 4\n[view]\n";
  const Scene scene = parse_scene(species + "field = \"temperature_x_heavy\"\n", "s.toml");
  CHECK(scene.view.field == Field(Quantity::Temperature, 0).of(1));
  CHECK(says(scene_to_toml(scene), "field = \"temperature_x_heavy\""));
  CHECK(parse_scene(species + "field = \"drag_y_light\"\n", "s.toml").view.field ==
        Field(Quantity::Drag, 1).of(0));
  for (const char* const unknown : {"stress_xx_heavy", "density_large", "drag_x"}) {
    CAPTURE(unknown);
    const std::string message =
        field_refusal(species + "field = \"" + std::string(unknown) + "\"\n");
    CHECK(message.starts_with("s.toml:11:"));
    CHECK(says(message, "density_heavy"));
  }
}

TEST_CASE("Field: of names that several fields would have, the first field has it") {
  const std::vector<NamedField> names = field_names(2, {"x", "heavy", "x_heavy"});
  std::set<std::string> different;
  for (const auto& [name, field] : names) different.insert(name);
  CHECK(different.size() == names.size());
  const auto field_of = [&](const char* name) {
    return std::ranges::find(names, name, &NamedField::first)->second;
  };
  CHECK(field_of("temperature_x") == Field(Quantity::Temperature, 0));
  CHECK(field_of("temperature_x_heavy") == Field(Quantity::Temperature, 0).of(1));
  CHECK(field_of("density_x") == Field(Quantity::Density).of(0));
}

TEST_CASE("Fields: drag needs species") {
  const std::string message = field_refusal(kRough + "measure.fields = [\"drag\"]\n");
  CHECK(message.starts_with("s.toml:4:"));
  CHECK(says(message, "add [[species]]"));
}

TEST_CASE("Fields: fields of spheres are refused for disks, with the reason") {
  const char* const only_in_space[][2] = {
      {"view.field", "velocity_z"},         {"view.field", "stress_xz"},
      {"view.field", "stress_zz_kinetic"},  {"view.field", "heat_flux_z"},
      {"view.field", "balance_momentum_z"}, {"measure.fields", "temperature_z"}};
  for (const auto& [key, name] : only_in_space) {
    CAPTURE(name);
    const bool list = std::string(key) == "measure.fields";
    const std::string value = '"' + std::string(name) + '"';
    const std::string message =
        field_refusal(kRough + key + " = " + (list ? "[" + value + "]" : value) + "\n");
    CHECK(says(message, "the box has no z axis"));
    CHECK(message.starts_with("s.toml:4:"));
  }
}

TEST_CASE("Field: units follow from the dimension") {
  const std::map<std::string, std::array<std::string, 2>> expected = {
      {"density", {"1/a^2", "1/a^3"}},
      {"velocity", {"a/t", "a/t"}},
      {"temperature", {"m a^2/t^2", "m a^2/t^2"}},
      {"stress", {"m/t^2", "m/(a t^2)"}},
      {"heat_flux", {"m a/t^3", "m/t^3"}},
      {"dissipation", {"m/t^3", "m/(a t^3)"}},
      {"drag", {"m/(a t^2)", "m/(a^2 t^2)"}},
      {"spin", {"1/t", "1/t"}},
      {"spin_temperature", {"m a^2/t^2", "m a^2/t^2"}},
      {"balance_mass", {"1", "1"}},
      {"balance_momentum", {"1", "1"}},
      {"balance_energy", {"1", "1"}}};
  CHECK(expected.size() == kQuantities.size());
  for (const QuantityTraits& traits : kQuantities) {
    CAPTURE(traits.name);
    CHECK(unit_of(traits.quantity, 2) == expected.at(traits.name)[0]);
    CHECK(unit_of(traits.quantity, 3) == expected.at(traits.name)[1]);
  }
}

TEST_CASE("Field: normal stress is negative, shear and flows have either sign") {
  const std::string negative =
      " stress_xx stress_yy stress_zz stress_xx_kinetic stress_yy_kinetic stress_zz_kinetic "
      "stress_xx_collisional stress_yy_collisional stress_zz_collisional dissipation ";
  const std::string positive =
      " density temperature temperature_x temperature_y temperature_z spin_temperature ";
  for (const auto& [name, field] : field_names(3)) {
    CAPTURE(name);
    const std::string word = " " + std::string(name) + " ";
    const Sign expected = says(negative, word)   ? Sign::Negative
                          : says(positive, word) ? Sign::Positive
                                                 : Sign::Either;
    CHECK(static_cast<int>(sign_of(field)) == static_cast<int>(expected));
  }
}

}  // namespace clatter
