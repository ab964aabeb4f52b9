// The tables of observables in all files. tests/engine/observables compares their values with
// theory.

#include <doctest/doctest.h>

#include <algorithm>
#include <nlohmann/json.hpp>
#include <string>
#include <utility>
#include <vector>

#include "tests/support/shell.h"
#include "tests/support/tables.h"

namespace clatter {

using nlohmann::json;
using testing::Table;
using testing::table_in;

namespace {

// Bond order is for disks only.
std::string all_of(int dimension) {
  return std::string(
             "[\"radial_distribution\", \"velocity_distribution\", \"free_flights\", "
             "\"collisions\", "
             "\"wall_hits\", \"mean_squared_displacement\", \"velocity_autocorrelation\", "
             "\"structure_factor\", \"clusters\", \"wall_power\", \"plane_current\", "
             "\"local_density\", \"spin_distribution\", \"probe\", \"collision_counts\", "
             "\"radial_distribution_profile\"") +
         (dimension == 2 ? ", \"bond_order\"]" : "]");
}

// A gas without any symmetry, of disks or spheres.
std::string scene(int dimension, const std::string& observables) {
  const bool disks = dimension == 2;
  return "schema = 1\ntitle = \"all\"\n[box]\nsize = " +
         std::string(disks ? "[11.0, 9.0]" : "[6.0, 7.0, 5.0]") +
         R"(
[particles]
count = 25
restitution = 0.9
friction = 0.3
[walls.left]
kind = "thermal"
temperature = 0.5
[walls.right]
kind = "thermal"
temperature = 2.0
[measure]
burn_in = 2.0
duration = 40.0
observables = )" +
         observables +
         (observables.find("clusters") == std::string::npos
              ? "\n"
              : "\n[measure.clusters]\nrange = 1.8\n");
}

std::string file_of(std::string table) {
  std::ranges::replace(table, '.', '_');
  return table + ".csv";
}

json at(const json& result, const std::string& name) {
  std::string path = "/" + name;
  std::ranges::replace(path, '.', '/');
  return result.at(json::json_pointer(path));
}

struct Expected {
  std::string name;
  std::vector<std::pair<std::string, std::string>> columns;  // with units
  std::vector<std::string> without_errors;
};

// Independent of the program: the tables of docs/results.md.
std::vector<Expected> expected_tables(int dimension) {
  const auto histogram = [](const std::string& name, const std::string& unit,
                            const std::string& inverse) {
    return Expected{name, {{"low", unit}, {"high", unit}, {"density", inverse}}, {"low", "high"}};
  };
  const std::string energy = "m a^2/t^2", power = "m a^2/t^3";
  std::vector<Expected> tables = {
      {"radial_distribution", {{"r", "a"}, {"g", "1"}}, {"r"}},
      {"velocity_distribution", {{"low", "1"}, {"high", "1"}}, {"low", "high"}},
      histogram("velocity_distribution.speed", "1", "1"),
      histogram("free_flights.time", "t", "1/t"),
      histogram("free_flights.path", "a", "1/a"),
      histogram("collisions.impact_parameter", "a", "1/a"),
      histogram("collisions.normal_speed", "a/t", "1/(a/t)"),
      histogram("collisions.tangential_speed", "a/t", "1/(a/t)"),
      histogram("collisions.energy_loss", energy, "1/(" + energy + ")"),
      {"mean_squared_displacement", {{"time", "t"}, {"total", "a^2"}}, {"time"}},
      {"velocity_autocorrelation", {{"time", "t"}, {"mean", "a^2/t^2"}}, {"time"}},
      {"structure_factor", {{"k", "1/a"}, {"vectors", "1"}, {"S", "1"}}, {"k", "vectors"}},
      {"clusters.growth",
       {{"time", "t"}, {"number", "1"}, {"largest", "1"}, {"mean_size", "1"}},
       {"time", "number", "largest", "mean_size"}},
      {"velocity_distribution.tails", {{"low", "1"}, {"high", "1"}}, {"low", "high"}},
      {"radial_distribution_profile",
       {{"x_low", "a"}, {"x_high", "a"}, {"r", "a"}, {"g", "1"}},
       {"x_low", "x_high", "r"}},
      {"spin_distribution.components", {{"low", "1"}, {"high", "1"}}, {"low", "high"}}};
  for (const std::string name : {"clusters.size", "plane_current.number", "local_density.number",
                                 "collision_counts.particle", "collision_counts.pair"}) {
    tables.push_back(histogram(name, "1", "1"));
  }
  for (const std::string place : {"left", "right", "total"}) {
    tables.push_back(histogram("wall_power." + place, power, "1/(" + power + ")"));
    if (place == "total") continue;
    for (const char* way : {".incoming", ".outgoing"}) {
      tables.push_back(histogram("wall_hits." + place + way, "a/t", "1/(a/t)"));
    }
  }
  const auto table = [&](const std::string& name) -> Expected& {
    return *std::ranges::find(tables, name, &Expected::name);
  };
  if (dimension == 2) {
    tables.push_back({"bond_order", {{"time", "t"}, {"correlation", "1"}}, {"time"}});
  }
  Expected& spins = table("spin_distribution.components");
  if (dimension == 2) {
    spins.columns.emplace_back("density", "1");
  } else {
    for (const char* axis : {"x", "y", "z"}) spins.columns.emplace_back(axis, "1");
    tables.push_back(histogram("spin_distribution.cosine", "1", "1"));
  }
  Expected probe = {"probe.series",
                    {{"time", "t"},
                     {"density", dimension == 2 ? "1/a^2" : "1/a^3"},
                     {"temperature", "m a^2/t^2"}},
                    {"time", "density", "temperature"}};
  for (int axis = 0; axis < dimension; ++axis) {
    const std::string name(1, "xyz"[axis]);
    table("velocity_distribution.tails").columns.emplace_back(name, "1");
    probe.columns.emplace_back("velocity_" + name, "a/t");
    probe.without_errors.push_back("velocity_" + name);
    table("velocity_distribution").columns.emplace_back(name, "1");
    table("mean_squared_displacement").columns.emplace_back(name, "a^2");
    table("mean_squared_displacement").columns.emplace_back("drift_" + name, "a");
    table("velocity_autocorrelation").columns.emplace_back(name, "a^2/t^2");
  }
  tables.push_back(std::move(probe));
  return tables;
}

}  // namespace

TEST_CASE("Observables: JSON, CSV and HDF5 have the same tables") {
  for (const int dimension : {2, 3}) {
    CAPTURE(dimension);
    const Shell shell;
    shell.write("s.toml", scene(dimension, all_of(dimension)));
    const Outcome outcome =
        shell.run("clatter measure s.toml --quiet --out r.json --csv t --hdf5 r.h5");
    CAPTURE(outcome.err);
    REQUIRE(outcome.code == 0);
    const json result = json::parse(shell.read("r.json"));
    const Outcome read = shell.run(CLATTER_READERS "read_hdf5.py r.h5");
    CAPTURE(read.err);
    const json file = json::parse(read.out);
    const std::vector<Expected> tables = expected_tables(dimension);
    for (const Expected& table : tables) {
      CAPTURE(table.name);
      const json found = at(result, table.name);
      const json datasets = at(file, table.name);
      const Table csv = table_in(shell.read("t/" + file_of(table.name)));
      CHECK(csv.units.size() == table.columns.size());
      std::size_t columns = 0, errors = 0;
      for (const auto& [name, unit] : table.columns) {
        CAPTURE(name);
        ++columns;
        CHECK(found.at(name).size() > 3);
        CHECK(csv.columns.at(name) == found.at(name));
        CHECK(csv.units.at(name) == unit);
        CHECK(datasets.at(name).at("values") == found.at(name));
        CHECK(datasets.at(name).at("units") == unit);
        const bool exact =
            std::ranges::find(table.without_errors, name) != table.without_errors.end();
        CHECK(csv.columns.contains(name + "_error") == !exact);
        if (exact) continue;
        ++errors;
        const json error = found.at("standard_error").at(name);
        CHECK(csv.columns.at(name + "_error") == error);
        CHECK(datasets.at("standard_error").at(name).at("values") == error);
        CHECK(datasets.at("standard_error").at(name).at("units") == unit);
      }
      CHECK(csv.columns.size() == columns + errors);
      CHECK(found.value("standard_error", json::object()).size() == errors);
    }
    // Means are attributes of the groups, and there are no other tables.
    CHECK(at(file, "free_flights.mean_time.mean") == at(result, "free_flights.mean_time.mean"));
    CHECK(shell.run("ls t | wc -l").out == std::to_string(tables.size() + 1) + "\n");
    CHECK(file.at("wall_hits").size() == 2);

    // Another run in this folder removes the tables that it does not have.
    shell.write("s.toml", scene(dimension, "[\"free_flights\"]"));
    REQUIRE(shell.run("clatter measure s.toml --quiet --out r.json --csv t").code == 0);
    CHECK(shell.run("ls t | xargs").out ==
          "free_flights_path.csv free_flights_time.csv temperature_series.csv\n");
  }
}

TEST_CASE("Observables: a resumed run has the same results") {
  const Shell shell;
  shell.write("s.toml", scene(2, all_of(2)));
  const std::string line = "clatter measure s.toml --quiet --set measure.duration=40000 ";
  REQUIRE(shell.run(line + "--out whole.json").code == 0);
  REQUIRE(cut_off(shell, line + "--out part.json", "TERM").code == 130);
  REQUIRE(shell.run(line + "--resume c --out resumed.json").code == 0);
  json whole = json::parse(shell.read("whole.json"));
  json resumed = json::parse(shell.read("resumed.json"));
  for (json* result : {&whole, &resumed}) result->erase("performance");
  CHECK(whole == resumed);
}

TEST_CASE("Observables: their means take part in goals, replicas and sweeps") {
  const Shell shell;
  shell.write("s.toml", scene(2, "[\"free_flights\"]"));
  const Outcome goal = shell.run(
      "clatter measure s.toml --accuracy 5% --accuracy-of free_flights.mean_path --out g.json");
  CAPTURE(goal.err);
  CHECK(goal.code == 0);
  CHECK(json::parse(shell.read("g.json")).at("accuracy").at("of") == "free_flights.mean_path");
  REQUIRE(shell.run("clatter measure s.toml --replicas 2 --quiet --out r.json").code == 0);
  const json replicas = json::parse(shell.read("r.json"));
  const double first = at(replicas.at("results")[0], "free_flights.mean_time.mean").get<double>();
  const double second = at(replicas.at("results")[1], "free_flights.mean_time.mean").get<double>();
  CHECK(at(replicas, "free_flights.mean_time.mean").get<double>() ==
        doctest::Approx(0.5 * (first + second)).epsilon(1e-12));
  shell.write("w.toml",
              "scene = \"s.toml\"\nreplicas = 1\n[axes]\n\"particles.restitution\" = [0.8, 0.9]\n");
  REQUIRE(shell.run("clatter sweep w.toml --quiet --out d && clatter sweep collect d").code == 0);
  const std::string header = shell.run("grep -v '^#' d/table.csv | head -1").out;
  CHECK(says(header, "free_flights.mean_time,free_flights.mean_time_standard_error"));
}

TEST_CASE("Observables: losses before a change of the laws are in the result") {
  const Shell shell;
  shell.write("s.toml", scene(2, "[\"collisions\"]") +
                            "[[change]]\ntime = 20.0\nset = { \"particles.restitution\" = 1.0, "
                            "\"particles.friction\" = 0.0 }\n");
  REQUIRE(shell.run("clatter measure s.toml --quiet --out r.json").code == 0);
  const json result = json::parse(shell.read("r.json"));
  const double collisions = at(result, "events.disk_disk").get<double>();
  const double dissipated = at(result, "energy.dissipated.mean").get<double>();
  CHECK(dissipated > 0.0);
  CHECK(at(result, "collisions.mean_energy_loss.mean").get<double>() * collisions ==
        doctest::Approx(dissipated * at(result, "time.measured").get<double>()).epsilon(1e-9));
  CHECK(at(result, "collisions.energy_loss.low").size() > 5);
  // Some contacts with friction stick.
  CHECK(at(result, "collisions.sliding_share.mean").get<double>() > 0.05);
}

TEST_CASE("Observables: settings without their observable are refused") {
  const Shell shell;
  shell.write("s.toml", scene(2, "[\"free_flights\"]"));
  const auto with = [](const std::string& kind, const std::string& setting) {
    return "'measure.observables=[\"" + kind + "\"]' --set measure." + kind + "." + setting;
  };
  for (const auto& [flags, words] : std::vector<std::pair<std::string, std::string>>{
           {"s.toml --set measure.radial_distribution.bins=50", "without its observable"},
           {"s.toml --set 'measure.observables=[\"radial\"]'", "\"radial_distribution\""},
           {"s.toml --set " + with("velocity_distribution", "interval=1e-9"), "1e7 samples"},
           {"s.toml --set " + with("mean_squared_displacement", "longest=1e30"), "1e7 intervals"},
           {"vibrated --set " + with("velocity_autocorrelation", "interval=1e-9"),
            "a lag of at most 0.01, or an interval of at least 1e-06"},
           {"s.toml --set " + with("structure_factor", "range=1e5"), "1e4 waves along the box"},
           {"vibrated --set 'measure.observables=[\"structure_factor\"]' --set "
            "walls.bottom.kind=static --set walls.top.kind=static",
            "\"structure_factor\" needs a periodic axis"},
           {"vibrated --set " + with("radial_distribution_profile", "axis=z"), "cannot be \"z\""},
           {"spheres_vibrated --set 'measure.observables=[\"bond_order\"]'", "for disks only"}}) {
    check_refused(shell, "clatter measure " + flags, {words});
  }
  for (const auto& [keys, words] : std::vector<std::pair<std::string, std::vector<std::string>>>{
           {"lower = [1.0, 1.0, 1.0]\n", {"p.toml:20:1:", "3 numbers"}},
           {"lower = [3.0, 1.0]\nupper = [2.0, 5.0]\n", {"p.toml:21:1:", "from 3 to 2 along x"}},
           {"upper = [5.0, 9.5]\n", {"p.toml:20:1:", "along y", "from 0 to 9"}},
           {"lower = [-1.0, 0.0]\n", {"p.toml:20:1:", "measure.probe.lower"}}}) {
    shell.write("p.toml", scene(2, "[\"probe\"]") + "[measure.probe]\n" + keys);
    check_refused(shell, "clatter measure p.toml", words);
  }
}

}  // namespace clatter
