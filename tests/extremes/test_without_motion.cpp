#include <doctest/doctest.h>

#include <cmath>
#include <nlohmann/json.hpp>
#include <sstream>
#include <string>

#include "engine/dynamics/simulation.h"
#include "tests/support/shell.h"
#include "tests/engine/support/gas.h"
#include "tests/extremes/figure.h"

using namespace clatter;
using namespace clatter::testing;

namespace {

template <int D>
void check_at_rest(const Vec<D>& box) {
  const Model<D> model = with_walls(periodic_box<D>(box), 0, kDriven);
  State<D> start = random_gas(model, 20, 121);
  for (Vec<D>& v : start.velocities) v.setZero();
  Simulation<D> simulation(model, start);
  const std::uint64_t before = simulation.state_hash();
  simulation.run_until(100.0);
  simulation.run_until(kNever, 1);
  CHECK(simulation.state_hash() == before);
  CHECK(simulation.time() == 100.0);
  CHECK(simulation.counts().wall_collisions + simulation.counts().pair_collisions == 0);
}

template <int D>
void check_dead_walls(const Vec<D>& box) {
  const Wall walls[] = {{.kind = WallKind::Driven, .drive_speed = 0.0},
                        {.kind = WallKind::Driven, .restitution = 0.0, .drive_speed = 0.0},
                        {.kind = WallKind::Thermal, .temperature = 0.0}};
  for (const Wall& wall : walls) {
    const Model<D> model = with_walls(with_walls(periodic_box<D>(box), 0, wall), 1, wall);
    const State<D> start = random_gas(model, 20, 122);
    Simulation<D> simulation(model, start);
    const double energy = simulation.kinetic_energy();
    simulation.run_until(100.0);
    const bool elastic = wall.kind == WallKind::Driven && wall.restitution == 1.0;
    if (elastic) CHECK(std::fabs(simulation.kinetic_energy() / energy - 1.0) < 1e-12);
    if (!elastic) CHECK(simulation.kinetic_energy() < 0.1 * energy);
    CHECK(finite_and_inside(model, simulation.state()));
    const double overlap = brute_force_overlap(model, simulation.state());
    MESSAGE("energy left ", brief(simulation.kinetic_energy() / energy), ", overlap ",
            brief(overlap));
    CHECK(overlap < 1e-12);
    check_sound(simulation);
  }
}

}  // namespace

TEST_CASE("Without motion: a gas at T = 0 between driven walls" *
          doctest::description("the state keeps its bits while time advances")) {
  check_at_rest<2>({9.0, 8.0});
  check_at_rest<3>({5.0, 4.0, 4.5});
}

TEST_CASE("Without motion: walls that add no energy: v_dr = 0, T_w = 0, alpha_w = 0" *
          doctest::description("energy constant to 1e-12 for elastic walls, else below a tenth; "
                               "all numbers finite, overlap below 1e-12")) {
  check_dead_walls<2>({9.0, 8.0});
  check_dead_walls<3>({5.0, 4.0, 4.5});
}

namespace {

using nlohmann::json;

// Number of numeric values in a result. null would mean NaN.
int numbers_in(const json& value) {
  int numbers = value.is_number() ? 1 : 0;
  REQUIRE_FALSE(value.is_null());
  if (!value.is_structured()) return numbers;
  for (const json& part : value) numbers += numbers_in(part);
  return numbers;
}

// Removes the cells of a profile without particles. Their only defined value is a density of 0.
void take_out_unvisited(json& profile) {
  const json density = profile.at("density");
  for (const auto& take : {&profile, &profile.at("standard_error")}) {
    for (auto& [name, column] : take->items()) {
      if (!column.is_array() || column.size() != density.size()) continue;
      for (std::size_t i = density.size(); i-- > 0;) {
        if (density[i] == 0.0) column.erase(i);
      }
    }
  }
}

const std::string kStill[] = {
    "conduction --set walls.left.temperature=0 --set walls.right.temperature=0",
    "vibrated --set walls.left.drive_speed=0 --set walls.right.drive_speed=0",
    "vibrated --set particles.start.temperature=0",
    "equilibrium --set particles.start.temperature=0",
    "rough_cooling --set particles.start.temperature=0 --set particles.start.spin_temperature=0",
    "equilibrium --set particles.count=0",
    "equilibrium --set particles.count=1",
    "equilibrium --set particles.count=2",
    "equilibrium --set particles.count=3",
    "spheres.toml --set particles.start.temperature=0",
    "spheres.toml --set particles.count=0",
    "spheres.toml --set particles.count=1",
    "spheres.toml --set particles.count=2"};

// A scene of spheres beside the gallery's scenes of disks.
void write_spheres(const Shell& shell) {
  shell.write("spheres.toml", R"(
      box.size = [6.0, 5.0, 4.0]
      particles = { count = 20, restitution = 0.9, friction = 0.3 }
      measure.cells = [3, 2, 4])");
}

}  // namespace

TEST_CASE("Without motion: results at T_w = 0, T = 0, v_dr = 0, and with few particles" *
          doctest::description("every number of the result is finite; tables have nan only in "
                               "cells that no particle visited, with density 0")) {
  const Shell shell;
  write_spheres(shell);
  int numbers = 0, lines = 0;
  for (const std::string& scene : kStill) {
    CAPTURE(scene);
    const Outcome outcome = shell.run(
        "clatter measure " + scene +
        " --quiet --until 30 --set measure.burn_in=5 --csv tables --set "
        "'measure.fields=[\"density\","
        "\"temperature\",\"velocity\",\"stress\",\"heat_flux\",\"dissipation\",\"balance\"]'");
    CAPTURE(outcome.err);
    REQUIRE(outcome.code == 0);
    json result = json::parse(outcome.out);
    if (result.contains("profile")) take_out_unvisited(result.at("profile"));
    numbers += numbers_in(result);
    CHECK(shell.files() == std::vector<std::string>{"spheres.toml", "tables"});
    for (const char* table :
         {"tables/temperature_series.csv", "tables/profile.csv", "tables/maps.csv"}) {
      std::istringstream text(shell.read(table));
      for (std::string line; std::getline(text, line); ++lines) {
        CHECK_FALSE(says(line, "inf"));
        // Position or edges, then the density.
        if (says(line, "nan")) CHECK_MESSAGE(says(line, ",0,"), line);
      }
    }
  }
  MESSAGE(numbers, " numbers and ", lines, " lines of tables of ", std::size(kStill), " scenes");
}

TEST_CASE("Without motion: pictures at T_w = 0, T = 0, v_dr = 0, and with few particles" *
          doctest::description("every field, colour and arrow is drawn")) {
  const Shell shell;
  write_spheres(shell);
  const std::string views[] = {"--set view.field=temperature --set view.colour_by=speed",
                               "--set view.field=heat_flux_x --set view.arrows=heat_flux",
                               "--set view.field=balance_energy --set view.arrows=velocity"};
  std::size_t pictures = 0;
  for (const std::string& scene : kStill) {
    CAPTURE(scene);
    const Outcome outcome = shell.run("clatter render " + scene +
                                      " --quiet --size 320x240 --to 1 --overwrite --out a.png " +
                                      views[pictures++ % std::size(views)]);
    CAPTURE(outcome.err);
    CHECK(outcome.code == 0);
    CHECK(shell.read("a.png").size() > 1000);
  }
  MESSAGE(pictures, " pictures");
}
