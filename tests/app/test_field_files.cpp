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
const std::string kMeasureFields =
    "clatter measure vibrated --quiet --set measure.burn_in=20 --until 22 "
    "--set measure.cells=[40,20] --set particles.friction=inf --set view.overlay=false "
    "--set 'measure.fields=[\"density\",\"velocity\",\"temperature\",\"stress\","
    "\"stress_collisional\",\"heat_flux\",\"dissipation\",\"spin\"]' ";
constexpr int kColumns = 40, kRows = 20;

}  // namespace

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

// Maps, series and profiles are compared in test_result_maps.cpp.
TEST_CASE("Field files: h5py reads the whole result, and the scene as attributes") {
  const Shell shell;
  REQUIRE(shell.run(kMeasureFields + "--seed 9223372036854775809 --out r.json --hdf5 r.h5").code ==
          0);
  const json result = json::parse(shell.read("r.json"));
  const json file = read_by(shell, "read_hdf5.py", "r.h5");
  for (const auto& [key, value] : result.items()) {
    if (key == "temperature_series" || key == "profile") continue;
    CAPTURE(key);
    CHECK(file.at(key) == value);
  }
  CHECK(file.at("scene").at("particles").at("friction") == "inf");
  CHECK(file.at("scene").at("view").at("overlay") == false);
}

TEST_CASE("Field files: VTK reads vectors and tensors of disks with zeros along z") {
  const Shell shell;
  REQUIRE(shell.run(kMeasureFields + "--out r.json --vtk maps").code == 0);
  const json arrays = read_by(shell, "read_vtk.py", "maps/fields.vti").at("arrays");
  const std::vector<double> zeros(kColumns * kRows);
  for (const char* name : {"velocity", "heat_flux", "stress", "stress_collisional"}) {
    CAPTURE(name);
    json along_z = json::array();
    for (const json& tuple : arrays.at(name).at("values")) along_z.push_back(tuple.at(2));
    CHECK(along_z == json(zeros));
  }
}

TEST_CASE("Field files: residuals have maps of numbers in all files, and no series") {
  const Shell shell;
  for (const bool alone : {true, false}) {
    CAPTURE(alone);
    const std::string fields = alone ? "\"balance\"" : "\"balance\",\"velocity\"";
    REQUIRE(shell
                .run("rm -rf maps && " + kMeasureFields +
                     "--out r.json --csv tables --vtk maps --hdf5 r.h5 --set 'measure.fields=[" +
                     fields + "]'")
                .code == 0);
    const json file = read_by(shell, "read_hdf5.py", "r.h5");
    CHECK(read_by(shell, "read_vtk.py", "maps/fields.vti").at("arrays").size() == (alone ? 4 : 5));
    const Table table = table_in(shell.read("tables/maps.csv"));
    double largest = 0.0;
    for (const char* name :
         {"balance_mass", "balance_momentum_x", "balance_momentum_y", "balance_energy"}) {
      CAPTURE(name);
      CHECK(file.at("maps").contains(name));
      const json& residuals = table.columns.at(name);
      CHECK(residuals.size() == kColumns * kRows);
      for (const json& residual : residuals) {
        largest = std::max(largest, std::abs(residual.get<double>()));
      }
    }
    const json balance = json::parse(shell.read("r.json")).at("balance");
    CHECK(largest == std::max(balance.at("momentum"), balance.at("energy")).get<double>());
    CHECK(file.contains("map_series") == !alone);
    CHECK((shell.run("ls maps").out == "fields.vti\n") == alone);
  }
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

}  // namespace clatter
