// The balance equations of mass, momentum and energy, from the command line.

#include <doctest/doctest.h>

#include <nlohmann/json.hpp>

#include "tests/support/shell.h"

namespace clatter {

using nlohmann::json;

namespace {

const std::string kBalance = " --quiet --set 'measure.fields=[\"balance\"]' ";

}  // namespace

TEST_CASE("Balance: it continues from a checkpoint, or restarts where cells hold another energy") {
  const Shell shell;
  const std::string line =
      "clatter measure rough_driven --set measure.burn_in=1" + kBalance + "--out r.json ";
  REQUIRE(shell.run(line + "--until 5 --checkpoint c").code == 0);
  CHECK(json::parse(shell.read("r.json")).at("balance").at("mass") == 0.0);
  CHECK(shell.run(line + "--until 9 --resume c").code == 0);
  CHECK(json::parse(shell.read("r.json")).at("time").at("burn_in") == 1.0);
  CHECK(json::parse(shell.read("r.json")).at("balance").at("energy") <= 1e-10);
  CHECK(shell.run(line + "--until 9 --resume c --set particles.inertia=0.4").code == 0);
  CHECK(json::parse(shell.read("r.json")).at("time").at("burn_in") == 5.0);
  CHECK(json::parse(shell.read("r.json")).at("balance").at("energy") <= 1e-10);
}

// A lone disk far from all faces: only gravity contributes, by less or more than the last digit of
// its velocity.
TEST_CASE("Balance: the equations close under a gravity too weak to change velocities") {
  const Shell shell;
  for (const std::string gravity : {"1e-20", "1e-17", "1e-13", "1e-10", "1e-7", "1e-3"}) {
    CAPTURE(gravity);
    const Outcome outcome =
        shell.run("clatter measure equilibrium" + kBalance +
                  "--set particles.count=1 --set box.size=[1000,1000] --set measure.cells=[1,1] "
                  "--set measure.burn_in=0 --until 16 --out r.json --set gravity.acceleration=[" +
                  gravity + ",0]");
    CAPTURE(outcome.err);
    CHECK(outcome.code == 0);
    const json balance = json::parse(shell.read("r.json")).at("balance");
    CHECK(balance.at("momentum") < 3e-7);
    CHECK(balance.at("energy") < 3e-7);
  }
}

}  // namespace clatter
