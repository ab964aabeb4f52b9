#include <doctest/doctest.h>

#include <algorithm>
#include <nlohmann/json.hpp>

#include "tests/app/shell.h"

namespace clatter {

using nlohmann::json;

TEST_CASE("The table of what fields cost has a row of each estimator, and of the balances") {
  const Shell shell;
  const Outcome outcome = shell.run("clatter bench fields --duration 300 --json t.json");
  CAPTURE(outcome.err);
  REQUIRE(outcome.code == 0);
  CHECK(outcome.err.find("300 time units") != std::string::npos);
  CHECK(outcome.out.starts_with("estimator "));
  CHECK(std::ranges::count(outcome.out, '\n') == 10);
  const json table = json::parse(shell.read("t.json"));
  REQUIRE(table.size() == 9);
  CHECK(table[0].at("estimator") == "bare run");
  CHECK(table[0].at("cost") == 1.0);
  CHECK_FALSE(table[0].contains("variance"));
  for (std::size_t row = 1; row < 8; ++row) {
    const std::string name = table[row].at("estimator");
    CAPTURE(name);
    CHECK(outcome.out.find("\n" + name + " ") != std::string::npos);
    const double cost = table[row].at("cost"), variance = table[row].at("variance");
    CHECK(cost > 0.0);
    CHECK(variance > 0.0);
    CHECK(table[row].at("cost_times_variance") == cost * variance);
  }
  CHECK(table[8].at("estimator") == "balance");
  CHECK(table[8].at("cost") > 0.0);
  CHECK_FALSE(table[8].contains("variance"));
  // Thirty snapshots know less than whole flights.
  CHECK(table[1].at("variance") == table[2].at("variance"));
  CHECK(table[7].at("variance") > table[2].at("variance"));
}

}  // namespace clatter
