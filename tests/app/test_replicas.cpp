#include <doctest/doctest.h>

#include <cmath>
#include <nlohmann/json.hpp>

#include "tests/support/shell.h"

namespace clatter {

using nlohmann::json;

TEST_CASE("Replicas: measured at once they have the numbers of runs one by one") {
  const Shell shell;
  const std::string line = "clatter measure vibrated --set measure.burn_in=10 --until 40 ";
  const Outcome outcome = shell.run(line + "--replicas 3 --seed 5 --out all.json");
  CAPTURE(outcome.err);
  REQUIRE(outcome.code == 0);
  const json all = json::parse(shell.read("all.json"));
  CHECK(all.at("seeds") == json{5, 6, 7});
  REQUIRE(all.at("results").size() == 3);
  for (int k = 0; k < 3; ++k) {
    json one = json::parse(shell.run(line + "--seed " + std::to_string(5 + k)).out);
    one.erase("performance");
    CHECK(all.at("results")[k] == one);
  }
  // Each mean is an average over the replicas, and their scatter gives its error.
  const json flat = all.at("results")[0].flatten();
  std::size_t means = 0;
  for (const auto& [place, value] : flat.items()) {
    if (!place.ends_with("/standard_error")) continue;
    CAPTURE(place);
    const json::json_pointer estimate = json::json_pointer(place).parent_pointer();
    ++means;
    double sum = 0.0, squares = 0.0;
    for (const json& one : all.at("results")) sum += one.at(estimate).at("mean").get<double>();
    for (const json& one : all.at("results")) {
      squares += std::pow(one.at(estimate).at("mean").get<double>() - sum / 3.0, 2.0);
    }
    CHECK(all.at(estimate).at("mean").get<double>() == doctest::Approx(sum / 3.0).epsilon(1e-12));
    CHECK(all.at(estimate).at("standard_error").get<double>() ==
          doctest::Approx(std::sqrt(squares / 6.0)).epsilon(1e-9));
  }
  CHECK(means == 10);
  CHECK(all.size() == 3 + 8);  // energy and pressure have two each
  const Outcome one = shell.run(line + "--replicas 3 --seed 5 --threads 1 --out one.json");
  CHECK(one.code == 0);
  CHECK(shell.read("one.json") == shell.read("all.json"));
  check_refused(shell, line + "--replicas 2 --checkpoint c", {"--replicas", "--checkpoint"});
}

TEST_CASE("Replicas: they run on as many threads as asked for") {
  const Shell shell;
  // Waits for seven threads of replicas and the first one. Without them the command ends with 0.
  const Outcome outcome = shell.run(
      "clatter measure vibrated --until 5000 --quiet --replicas 9 --threads 7 --out all.json & "
      "pid=$!\n"
      "until [ \"$(ls /proc/$pid/task | wc -l)\" -eq 8 ] || ! kill -0 $pid; do sleep 0.02; done\n"
      "kill -TERM $pid; wait $pid");
  CHECK(outcome.code == 130);
}

// Seed 6 finishes, seed 7 collapses. All later seeds together would take hours.
TEST_CASE("Replicas: where one stops, the complete ones are written, and no more are run") {
  const Shell shell;
  const std::string line =
      "clatter measure collapse --quiet --set collapse={} --set particles.count=100 "
      "--set box.size=[15,15] --set measure.burn_in=0 ";
  json complete = json::parse(shell.run(line + "--seed 6").out);
  complete.erase("performance");
  for (const std::string replicas : {"2", "100000"}) {
    CAPTURE(replicas);
    const Outcome outcome = shell.run(line + "--seed 6 --out all.json --replicas " + replicas);
    CHECK(outcome.code == 3);
    CHECK(says(outcome.err, "seed 7: time does not advance beyond t = "));
    const json all = json::parse(shell.read("all.json"));
    CHECK(all.at("results").at(0) == complete);
    CHECK(all.at("seeds").at(0) == 6);
    CHECK(all.at("seeds").size() == all.at("results").size());
    CHECK(shell.run("rm all.json").code == 0);
  }
  // Without a complete replica there is no result.
  const Outcome none = shell.run(line + "--seed 7 --out none.json --replicas 2 --threads 1");
  CHECK(none.code == 3);
  CHECK(shell.read("none.json").empty());
}

}  // namespace clatter
