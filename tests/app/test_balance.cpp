// The balance equations of mass, momentum and energy, from the command line.

#include <doctest/doctest.h>

#include <nlohmann/json.hpp>

#include "tests/support/shell.h"

namespace clatter {

using nlohmann::json;

namespace {

const std::string kBalance = " --quiet --set 'measure.fields=[\"balance\"]' ";

}  // namespace

TEST_CASE("Balance: the equations close in every cell, whatever acts on the gas") {
  const Shell shell;
  for (const std::string scene :
       {"equilibrium --set particles.restitution=0.9",  // smooth
        "rough_cooling --set particles.start.spin_temperature=1",
        "barometer --set bulk_drive.interval=0.1 --set bulk_drive.kick_speed=0.2",
        "conduction",                              // thermal walls
        "vibrated --set walls.left.friction=0.5",  // driven walls
        "shaker",                                  // a finite stroke
        "collapse --set gravity.acceleration=[0.1,0] --set measure.cells=[31,17]"}) {
    CAPTURE(scene);
    const Outcome outcome =
        shell.run("clatter measure " + scene + kBalance + "--set measure.burn_in=1 --until 5");
    CAPTURE(outcome.err);
    REQUIRE(outcome.code == 0);
    const json result = json::parse(outcome.out);
    CHECK(result.at("events").at("disk_disk") > 0);
    CHECK_FALSE(result.contains("profile"));
    const json& balance = result.at("balance");
    CHECK(balance.size() == 3);
    CHECK(balance.at("mass") == 0.0);
    for (const char* equation : {"momentum", "energy"}) {
      CAPTURE(equation);
      CHECK(balance.at(equation) > 0.0);
      CHECK(balance.at(equation) <= 1e-10);
    }
  }
}

TEST_CASE("Balance: residuals are the same beside fields, and absent unless asked for") {
  const Shell shell;
  const auto measure = [&](const std::string& fields) {
    return json::parse(shell
                           .run("clatter measure vibrated --quiet --set measure.burn_in=1 "
                                "--until 5 --csv tables --set 'measure.fields=[" +
                                fields + "]'")
                           .out);
  };
  const json both = measure("\"density\", \"balance\"");
  CHECK(both.at("scene").at("measure").at("fields") == json({"density", "balance"}));
  CHECK(both.at("profile").contains("density"));
  CHECK_FALSE(both.at("profile").contains("balance_energy"));
  CHECK(both.at("balance") == measure("\"balance\"").at("balance"));
  CHECK_FALSE(measure("\"density\"").contains("balance"));
}

TEST_CASE("Balance: it continues from a checkpoint, or restarts where cells hold another energy") {
  const Shell shell;
  const std::string line =
      "clatter measure rough_driven --set measure.burn_in=1" + kBalance + "--out r.json ";
  REQUIRE(shell.run(line + "--until 5 --checkpoint c").code == 0);
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

TEST_CASE("Balance: pictures show residuals") {
  const Shell shell;
  for (const std::string field :
       {"balance_mass", "balance_momentum_x", "balance_momentum_y", "balance_energy"}) {
    CAPTURE(field);
    const Outcome outcome =
        shell.run("clatter render vibrated --quiet --size 320x240 --to 2 --out " + field +
                  ".png --set view.field=" + field);
    CAPTURE(outcome.err);
    CHECK(outcome.code == 0);
    CHECK(shell.read(field + ".png").size() > 1000);
  }
}

}  // namespace clatter
