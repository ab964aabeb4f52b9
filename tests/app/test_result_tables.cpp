// Every column of the tables of a result, compared with an independent computation.

#include <doctest/doctest.h>

#include <map>
#include <nlohmann/json.hpp>

#include "app/results/csv_tables.h"
#include "engine/error.h"
#include "tests/app/check_same.h"
#include "tests/app/expected_values.h"
#include "tests/app/witnessed_run.h"
#include "tests/support/shell.h"
#include "tests/support/tables.h"

namespace clatter {

using nlohmann::json;
using namespace testing;

namespace {

template <int D>
void check_tables(int axis) {
  Scene scene = uneven_scene<D>();
  scene.measure.profile_axis = static_cast<Axis>(axis);
  const Witnessed<D> run(scene);
  const Shell shell;
  write_tables(shell.path(""), run.measured);

  const Table series = table_in(shell.read("temperature_series.csv"));
  const json times = time_series(run.witness, run.windows.end(), run.scene.measure.series_interval);
  check_same(series.columns, {{"time", times.at("time")},
                              {"temperature", times.at("translational")},
                              {"spin_temperature", times.at("spin")}});
  CHECK(series.units == std::map<std::string, std::string>{{"time", "t"},
                                                           {"temperature", "m a^2/t^2"},
                                                           {"spin_temperature", "m a^2/t^2"}});

  const std::string along = kAxisNames[axis];
  const json profile = profile_of<D>(run.cell_sums(), run.windows, axis);
  check_same(run.result().at("profile"), profile);
  const json& edges = profile.at("edges");
  json columns = {{along + "_low", json(edges.begin(), edges.end() - 1)},
                  {along + "_high", json(edges.begin() + 1, edges.end())}};
  std::map<std::string, std::string> units = {{along, "a"}};
  for (const auto& [name, field] : fields<D>()) {
    columns[name] = profile.at(name);
    columns[name + "_error"] = profile.at("standard_error").at(name);
    units[name] = field.unit;
  }
  const Table table = table_in(shell.read("profile.csv"));
  check_same(table.columns, columns);
  CHECK(table.units == units);
  CHECK(table.symbols == "a: particle diameter, m: particle mass, t: time unit of the scene");
}

}  // namespace

TEST_CASE("Results: every column of the tables follows from the events, with its unit") {
  for (const int axis : {0, 1}) check_tables<2>(axis);
}

TEST_CASE("Results: every column of the tables of spheres follows from the events") {
  for (const int axis : {0, 1, 2}) check_tables<3>(axis);
}

TEST_CASE("Results: tables of an earlier run stay until the new ones are written") {
  const Shell shell;
  shell.write("maps.csv", "earlier");
  shell.run("mkdir temperature_series.csv");
  CHECK_THROWS_AS(write_tables(shell.path(""), Measured()), RunError);
  CHECK(shell.read("maps.csv") == "earlier");
  shell.run("rmdir temperature_series.csv");
  write_tables(shell.path(""), Measured());
  CHECK(shell.files() == std::vector<std::string>{"temperature_series.csv"});
}

}  // namespace clatter
