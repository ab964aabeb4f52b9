// Files of fields, read by VTK's own reader (as in ParaView) and by h5py.

#include <doctest/doctest.h>

#include <algorithm>
#include <cmath>
#include <nlohmann/json.hpp>

#include "tests/app/readers.h"
#include "tests/support/shell.h"
#include "tests/support/tables.h"

namespace clatter {

using nlohmann::json;
using namespace testing;

namespace {

// Vectors, tensors, scalars and spin fields, on cells with unequal edges. In this short time some
// cells are never visited.
const std::string kMeasure =
    "clatter measure vibrated --quiet --set measure.burn_in=20 --until 22 "
    "--set measure.cells=[40,20] --set particles.friction=inf --set view.overlay=false "
    "--set 'measure.fields=[\"density\",\"velocity\",\"temperature\",\"stress\","
    "\"stress_collisional\",\"heat_flux\",\"dissipation\",\"spin\"]' ";
constexpr int kColumns = 40, kRows = 20;

// Component k of an array that VTK read.
json component(const json& array, std::size_t k) {
  json values = json::array();
  for (const json& tuple : array.at("values")) values.push_back(tuple.at(k));
  return values;
}

// A map of rows and columns as one list, cell by cell.
json flat(const json& rows) {
  json values = json::array();
  for (const json& row : rows) values.insert(values.end(), row.begin(), row.end());
  return values;
}

// Averages over y of a map without gaps agree with the profile of the same field along x.
void check_columns(const json& map, const json& profile) {
  REQUIRE(map.size() == kColumns * kRows);
  REQUIRE(profile.size() == kColumns);
  for (int i = 0; i < kColumns; ++i) {
    double sum = 0.0, magnitude = 0.0;
    for (int j = 0; j < kRows; ++j) {
      sum += map[j * kColumns + i].get<double>();
      magnitude += std::abs(map[j * kColumns + i].get<double>());
    }
    CHECK(std::abs(sum / kRows - profile[i].get<double>()) <= 1e-12 * magnitude);
  }
}

}  // namespace

TEST_CASE("Field files: tables of maps agree with the profiles, and have nan where no disk came") {
  const Shell shell;
  REQUIRE(shell.run(kMeasure + "--out r.json --csv tables").code == 0);
  const json profile = json::parse(shell.read("r.json")).at("profile");
  const Table maps = table_in(shell.read("tables/maps.csv"));
  CHECK(maps.units.at("stress_xy") == "m/t^2");
  CHECK(maps.columns.at("x")[1] == 0.75);
  CHECK(maps.columns.at("y")[kColumns] == 1.875);
  for (const char* linear : {"density", "stress_xy_collisional", "dissipation"}) {
    CAPTURE(linear);
    check_columns(maps.columns.at(linear), profile.at(linear));
  }
  int gaps = 0;
  for (std::size_t i = 0; i < maps.columns.at("density").size(); ++i) {
    const bool visited = maps.columns.at("density")[i] > 0.0;
    for (const char* field : {"velocity_x", "temperature", "spin"}) {
      CHECK(maps.columns.at(field)[i].is_null() == !visited);
    }
    gaps += !visited;
  }
  CHECK(gaps > 0);
  CHECK(gaps < kColumns * kRows / 2);
}

TEST_CASE("Field files: VTK reads the maps with their vectors, tensors, units and gaps") {
  const Shell shell;
  REQUIRE(shell.run(kMeasure + "--out r.json --csv tables --vtk maps").code == 0);
  const auto columns = table_in(shell.read("tables/maps.csv")).columns;
  const json image = read_by(shell, "read_vtk.py", "maps/fields.vti");
  CHECK(image.at("dimensions") == json({kColumns + 1, kRows + 1, 1}));  // points around the cells
  CHECK(image.at("origin") == json({0.0, 0.0, 0.0}));
  CHECK(image.at("spacing") == json({0.5, 1.25, 1.0}));
  CHECK(image.at("time") == json({20.0, 22.0}));
  const json& arrays = image.at("arrays");
  CHECK(arrays.size() == 10);
  for (const char* scalar :
       {"density", "temperature", "temperature_x", "temperature_y", "dissipation", "spin"}) {
    CAPTURE(scalar);
    CHECK(arrays.at(scalar).at("values") == columns.at(scalar));
  }
  for (const std::string vector : {"velocity", "heat_flux"}) {
    CAPTURE(vector);
    const json& array = arrays.at(vector);
    CHECK(array.at("components") == json({"X", "Y", "Z"}));
    CHECK(component(array, 0) == columns.at(vector + "_x"));
    CHECK(component(array, 1) == columns.at(vector + "_y"));
    CHECK(component(array, 2) == json(std::vector<double>(kColumns * kRows)));
  }
  for (const std::string part : {"", "_collisional"}) {
    const json& array = arrays.at("stress" + part);
    CHECK(array.at("components") == json({"XX", "YY", "ZZ", "XY", "YZ", "XZ"}));
    CHECK(component(array, 0) == columns.at("stress_xx" + part));
    CHECK(component(array, 1) == columns.at("stress_yy" + part));
    CHECK(component(array, 2) == json(std::vector<double>(kColumns * kRows)));
    CHECK(component(array, 3) == columns.at("stress_xy" + part));
  }
  CHECK(arrays.at("density").at("units") == "1/a^2");
  CHECK(arrays.at("heat_flux").at("units") == "m a/t^3");
}

TEST_CASE("Field files: VTK reads the series of maps, and its parts add up to the whole") {
  const Shell shell;
  REQUIRE(shell.run(kMeasure + "--out r.json --vtk maps").code == 0);
  const json whole = read_by(shell, "read_vtk.py", "maps/fields.vti");
  const json series = read_by(shell, "read_vtk.py", "maps/series.pvd");
  REQUIRE(series.size() == 64);
  std::vector<double> sums(kColumns * kRows);
  double time = 20.0;
  for (const json& part : series) {
    const double begin = part.at("time")[0], end = part.at("time")[1];
    CHECK(begin == time);
    CHECK(part.at("timestep").get<double>() == doctest::Approx(0.5 * (begin + end)));
    time = end;
    const json& density = part.at("arrays").at("density").at("values");
    for (std::size_t i = 0; i < sums.size(); ++i) {
      sums[i] += density[i].get<double>() * (end - begin);
    }
  }
  CHECK(time == 22.0);
  for (std::size_t i = 0; i < sums.size(); ++i) {
    CHECK(sums[i] / 2.0 ==
          doctest::Approx(whole.at("arrays").at("density").at("values")[i].get<double>()));
  }
}

TEST_CASE("Field files: a series of maps replaces a longer one, and leaves the files of others") {
  const Shell shell;
  REQUIRE(shell.run("mkdir maps && cd maps && touch note series_40.vti series_50.vti").code == 0);
  shell.write("maps/series.pvd",
              "<DataSet timestep=\"1\" file=\"note\"/>"
              "<DataSet timestep=\"2\" file=\"series_40.vti\"/>");
  const std::string line =
      "clatter measure vibrated --quiet --set measure.burn_in=0 --until 5.2 --out r.json "
      "--vtk maps --set measure.series_interval=0.01 --set measure.fields=";
  SUBCASE("of more parts") {
    // 520 windows, 16 per part.
    REQUIRE(shell.run(line + "'[\"density\"]'").code == 0);
    CHECK(read_by(shell, "read_vtk.py", "maps/series.pvd").size() == 33);
    CHECK(shell.run("cd maps; ls | tail -n 3").out ==
          "series_31.vti\nseries_32.vti\nseries_50.vti\n");
    CHECK(shell.run("ls maps/note").code == 0);
  }
  SUBCASE("where there is none any more") {
    REQUIRE(shell.run(line + "'[\"balance\"]'").code == 0);
    CHECK(shell.run("ls maps").out == "fields.vti\nnote\nseries_50.vti\n");
  }
}

TEST_CASE("Field files: h5py reads the whole result, the scene as attributes, and the maps") {
  const Shell shell;
  REQUIRE(shell.run(kMeasure + "--seed 9223372036854775809 --out r.json --csv tables --hdf5 r.h5")
              .code == 0);
  const json result = json::parse(shell.read("r.json"));
  json file = read_by(shell, "read_hdf5.py", "r.h5");
  for (const auto& [key, value] : result.items()) {
    if (key == "temperature_series" || key == "profile") continue;
    CAPTURE(key);
    CHECK(file.at(key) == value);
  }
  CHECK(file.at("scene").at("particles").at("friction") == "inf");
  CHECK(file.at("scene").at("view").at("overlay") == false);
  for (const char* key : {"time", "translational", "spin"}) {
    CHECK(file.at("temperature_series").at(key).at("values") ==
          result.at("temperature_series").at(key));
  }
  CHECK(file.at("temperature_series").at("spin").at("units") == "m a^2/t^2");
  const json& profile = file.at("profile");
  CHECK(profile.at("axis") == "x");
  CHECK(profile.at("edges").at("values") == result.at("profile").at("edges"));

  const auto columns = table_in(shell.read("tables/maps.csv")).columns;
  for (const auto& [name, errors] : result.at("profile").at("standard_error").items()) {
    CAPTURE(name);
    CHECK(profile.at(name).at("values") == result.at("profile").at(name));
    CHECK(profile.at("standard_error").at(name).at("values") == errors);
    const json& map = file.at("maps").at(name);
    CHECK(map.at("values").size() == kRows);
    CHECK(flat(map.at("values")) == columns.at(name));
    CHECK(map.at("units") == profile.at(name).at("units"));
    CHECK(file.at("map_series").at(name).at("values").size() == 64);
  }
  CHECK(file.at("maps").at("velocity_x").at("units") == "a/t");
  CHECK(file.at("maps").at("time").at("values") == json({20.0, 22.0}));
  CHECK(file.at("maps").at("x_edges") == profile.at("edges"));
  CHECK(file.at("maps").at("y_edges").at("values").size() == kRows + 1);
  double sum = 0.0;
  for (std::size_t k = 0; k < 64; ++k) {
    const json& time = file.at("map_series").at("time").at("values")[k];
    sum += file.at("map_series").at("density").at("values")[k][7][5].get<double>() *
           (time[1].get<double>() - time[0].get<double>());
  }
  CHECK(sum / 2.0 ==
        doctest::Approx(file.at("maps").at("density").at("values")[7][5].get<double>()));
}

TEST_CASE("Field files: residuals have maps of numbers in all files, and no series") {
  const Shell shell;
  const std::string files = "--out r.json --csv tables --vtk maps --hdf5 r.h5 ";
  std::string fields = "\"balance\"";
  SUBCASE("beside averages") {
    fields += ",\"velocity\"";
  }
  SUBCASE("alone") {}
  REQUIRE(shell.run(kMeasure + files + "--set 'measure.fields=[" + fields + "]'").code == 0);
  const bool alone = fields == "\"balance\"";
  const json file = read_by(shell, "read_hdf5.py", "r.h5");
  const json image = read_by(shell, "read_vtk.py", "maps/fields.vti");
  const Table table = table_in(shell.read("tables/maps.csv"));
  CHECK(image.at("arrays").size() == (alone ? 4 : 5));
  double largest = 0.0;
  for (const std::string name :
       {"balance_mass", "balance_momentum_x", "balance_momentum_y", "balance_energy"}) {
    CAPTURE(name);
    const json& residuals = table.columns.at(name);
    CHECK(residuals.size() == kColumns * kRows);
    CHECK(image.at("arrays").at(name).at("values") == residuals);
    CHECK(image.at("arrays").at(name).at("units") == "1");
    CHECK(flat(file.at("maps").at(name).at("values")) == residuals);
    for (const json& residual : residuals) {
      largest = std::max(largest, std::abs(residual.get<double>()));
    }
  }
  const json balance = json::parse(shell.read("r.json")).at("balance");
  CHECK(largest == std::max(balance.at("momentum"), balance.at("energy")).get<double>());
  CHECK(file.contains("map_series") == !alone);
  CHECK((shell.run("ls maps").out == "fields.vti\n") == alone);
}

TEST_CASE("Field files: without fields there are no maps, and HDF5 has all the rest") {
  const Shell shell;
  const std::string line =
      "clatter measure cooling --quiet --until 2 --set measure.fields=[] "
      "--out r.json --csv tables --hdf5 r.h5";
  REQUIRE(shell.run(line).code == 0);
  const json file = read_by(shell, "read_hdf5.py", "r.h5");
  CHECK(file.at("state_hash") == json::parse(shell.read("r.json")).at("state_hash"));
  CHECK(file.at("temperature_series").at("time").at("values") == json({0.0, 1.0, 2.0}));
  CHECK_FALSE(file.contains("maps"));
  CHECK(shell.run("ls tables").out == "temperature_series.csv\n");
}

TEST_CASE("Field files: a run removes tables of an earlier run that it does not write") {
  const Shell shell;
  const auto tables = [&](const std::string& fields) {
    const Outcome outcome = shell.run(
        "clatter measure vibrated --quiet --set measure.burn_in=1 --until 2 --csv tables " +
        std::string("--out r.json --set measure.fields=") + fields + "; ls tables");
    REQUIRE(outcome.code == 0);
    return outcome.out;
  };
  CHECK(tables("'[\"density\"]'") == "maps.csv\nprofile.csv\ntemperature_series.csv\n");
  CHECK(tables("[]") == "temperature_series.csv\n");
}

}  // namespace clatter
