// Results of scenes with species.

#include <doctest/doctest.h>

#include <cmath>
#include <nlohmann/json.hpp>
#include <string>

#include "app/results/result_json.h"
#include "tests/support/shell.h"

namespace clatter {

using nlohmann::json;

namespace {

constexpr const char* kMixScene = R"(
schema = 1
box.size = [12, 9]
[particles]
restitution = 0.9
[[species]]
name = "small"
count = 30
[[species]]
name = "large"
count = 8
diameter = 2.0
[[pair]]
species = ["small", "large"]
restitution = 0.7
[walls.left]
kind = "thermal"
temperature = 1.0
[walls.right]
kind = "driven"
drive_speed = 1.0
[measure]
burn_in = 2.0
duration = 20.0
fields = ["density", "temperature", "balance"]
cells = [4, 3]
)";

json mix_result(const Shell& shell, const std::string& options = {}) {
  shell.write("mix.toml", kMixScene);
  const Outcome outcome = shell.run("clatter measure mix.toml --quiet " + options);
  CAPTURE(outcome.err);
  REQUIRE(outcome.code == 0);
  return json::parse(outcome.out);
}

double mean_in(const json& estimate) {
  return estimate.at("mean");
}

}  // namespace

TEST_CASE("Species: a result has each species and each pair, and they add up") {
  const Shell shell;
  const json result = mix_result(shell);
  const json& species = result.at("species");
  REQUIRE(species.size() == 2);
  CHECK(species[0].at("name") == "small");
  CHECK(species[0].at("count") == 30);
  CHECK(species[1].at("name") == "large");
  CHECK(species[1].at("count") == 8);
  CHECK(species[0].at("mean_position").size() == 2);
  CHECK(species[0].at("mean_position")[1].is_null());
  CHECK(mean_in(species[1].at("mean_position")[0]) > 1.0);
  CHECK_FALSE(species[0].contains("spin_temperature"));
  CHECK_FALSE(species[0].contains("bulk_in"));
  for (const char* key : {"temperature", "temperature_x", "temperature_y"}) {
    CAPTURE(key);
    CHECK((30.0 * mean_in(species[0].at(key)) + 8.0 * mean_in(species[1].at(key))) / 38.0 ==
          doctest::Approx(mean_in(result.at(key))).epsilon(1e-12));
  }
  CHECK(mean_in(species[0].at("walls_in")) + mean_in(species[1].at("walls_in")) ==
        doctest::Approx(mean_in(result.at("energy").at("walls_in"))).epsilon(1e-9));
  const json& pairs = result.at("pairs");
  REQUIRE(pairs.size() == 3);
  CHECK(pairs[1].at("species") == json{"small", "large"});
  double lost = 0.0, collisions = 0.0;
  for (const json& pair : pairs) {
    lost += mean_in(pair.at("dissipated"));
    collisions += mean_in(pair.at("collision_rate"));
  }
  CHECK(lost == doctest::Approx(mean_in(result.at("energy").at("dissipated"))).epsilon(1e-12));
  CHECK(collisions == doctest::Approx(19.0 * mean_in(result.at("collision_rate"))).epsilon(1e-12));
  CHECK(result.at("balance").at("number") == 0.0);
  CHECK(result.at("theory").at("pairs").size() == 3);
}

TEST_CASE("Species: profiles and tables have the fields of each species") {
  const Shell shell;
  const json profile = mix_result(shell, "--csv tables").at("profile");
  for (std::size_t k = 0; k < 4; ++k) {
    double density = 0.0, thermal = 0.0;
    for (const char* name : {"small", "large"}) {
      const double own = profile.at(std::string("density_") + name)[k];
      density += own;
      thermal += own * profile.at(std::string("temperature_") + name)[k].get<double>();
    }
    CHECK(density == doctest::Approx(profile.at("density")[k].get<double>()).epsilon(1e-12));
    CHECK(thermal ==
          doctest::Approx(density * profile.at("temperature")[k].get<double>()).epsilon(1e-10));
  }
  CHECK(profile.at("standard_error").contains("density_large"));
  CHECK(shell.read("tables/profile.csv").find(",density_large,density_large_error,") !=
        std::string::npos);
  CHECK(shell.read("tables/maps.csv").find("density_small") != std::string::npos);
}

TEST_CASE("Species: mixing has a series and means, which a table repeats") {
  const Shell shell;
  const json mixing =
      mix_result(shell, "--csv tables --set 'measure.observables=[\"mixing\"]'").at("mixing");
  const json& series = mixing.at("series");
  CHECK(series.at("time").size() == series.at("lacey").size());
  double mean = 0.0;
  for (const double lacey : series.at("lacey")) {
    mean += lacey / static_cast<double>(series.at("lacey").size());
  }
  CHECK(mean_in(mixing.at("lacey")) == doctest::Approx(mean).epsilon(0.02));
  CHECK(mean_in(mixing.at("entropy")) > 0.0);
  CHECK(mean_in(mixing.at("random_entropy")) < 1.0);
  const std::string table = shell.read("tables/mixing_series.csv");
  CHECK(table.find("time,lacey,entropy,random_entropy") != std::string::npos);
}

TEST_CASE("Species: replicas and goals name means by their species") {
  const Shell shell;
  const json all = mix_result(shell, "--replicas 2");
  const json &one = all.at("results")[0], &two = all.at("results")[1];
  CHECK(all.at("species")[1].at("name") == "large");
  CHECK(mean_in(all.at("species")[1].at("temperature")) ==
        doctest::Approx(0.5 * (mean_in(one.at("species")[1].at("temperature")) +
                               mean_in(two.at("species")[1].at("temperature")))));
  CHECK(mean_in(all.at("pairs")[1].at("dissipated")) ==
        doctest::Approx(0.5 * (mean_in(one.at("pairs")[1].at("dissipated")) +
                               mean_in(two.at("pairs")[1].at("dissipated")))));
  const json goal =
      mix_result(shell, "--accuracy 50% --accuracy-of species.large.temperature --until 400");
  CHECK(goal.at("accuracy").at("of") == "species.large.temperature");
}

TEST_CASE("Species: observables and names that cannot be are refused") {
  const Shell shell;
  shell.write("mix.toml", kMixScene);
  const std::string line = "clatter check mix.toml ";
  check_refused(shell, line + "--set 'measure.observables=[\"radial_distribution\"]'",
                {"measure.observables", "without walls"});
  check_refused(shell, line + "--set 'measure.observables=[\"radial_distribution_profile\"]'",
                {"measure.observables", "one diameter"});
  std::string text = kMixScene;
  text.replace(text.find("\"small\""), 7, "\"x\"");
  text.replace(text.find("\"small\", "), 9, "\"x\", ");
  shell.write("names.toml", text);
  check_refused(shell, "clatter check names.toml", {"temperature_x", "choose another name"});
}

}  // namespace clatter
