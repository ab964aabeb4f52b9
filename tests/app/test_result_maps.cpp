// Every cell of the maps of a result in all its files, compared with an independent computation.

#include <doctest/doctest.h>

#include <cmath>
#include <map>
#include <nlohmann/json.hpp>

#include "app/results/csv_tables.h"
#include "app/results/hdf5_file.h"
#include "app/results/vtk_files.h"
#include "engine/error.h"
#include "tests/app/check_same.h"
#include "tests/app/expected_values.h"
#include "tests/app/readers.h"
#include "tests/app/witnessed_run.h"
#include "tests/support/messages.h"
#include "tests/support/shell.h"
#include "tests/support/tables.h"

namespace clatter {

using nlohmann::json;
using namespace testing;

namespace {

const json kVectorComponents = {"X", "Y", "Z"};
const json kTensorComponents = {"XX", "YY", "ZZ", "XY", "YZ", "XZ"};

// The values of each field in all cells over some windows: null in cells without particles.
template <int D>
std::map<std::string, json> maps_of(const std::vector<std::vector<Numbers>>& sums, int from, int to,
                                    const Windows& windows) {
  std::map<std::string, json> maps;
  for (int cell = 0; cell < Vessel<D>::cells.prod(); ++cell) {
    Numbers sum = Numbers::Zero(CellOf<D>::kSize);
    for (int window = from; window < to; ++window) {
      sum += sums[static_cast<std::size_t>(window)][static_cast<std::size_t>(cell)];
    }
    const CellGas<D> gas(sum, cell_size<D>().prod() * windows.length * (to - from));
    for (const auto& [name, field] : fields<D>()) {
      const double value = field.value(gas);
      maps[name].push_back(std::isfinite(value) ? json(value) : json());
    }
  }
  return maps;
}

// The numbers of nested lists, in order.
json numbers_in(const json& values) {
  if (!values.is_array()) return json::array({values});
  json all = json::array();
  for (const json& part : values) {
    for (const json& value : numbers_in(part)) all.push_back(value);
  }
  return all;
}

template <int D>
std::vector<std::string> residual_names() {
  std::vector<std::string> names = {"balance_mass"};
  for (int k = 0; k < D; ++k) names.push_back(std::string("balance_momentum_") + kAxisNames[k]);
  names.push_back("balance_energy");
  return names;
}

template <int D>
std::string unit_of_map(const std::string& name) {
  return fields<D>().contains(name) ? fields<D>().at(name).unit : "1";
}

// The arrays of a file of VTK against maps of their components.
template <int D>
void check_arrays(const json& arrays, const std::map<std::string, json>& maps) {
  for (const auto& [name, map] : maps) {
    CAPTURE(name);
    const auto field = fields<D>().find(name);
    const bool alone = field == fields<D>().end() || field->second.array.empty();
    const json& array = arrays.at(alone ? name : field->second.array);
    CHECK(array.at("units") == unit_of_map<D>(name));
    if (alone) {
      check_same(array.at("values"), map);
      continue;
    }
    json values = json::array();
    for (const json& tuple : array.at("values")) values.push_back(tuple[field->second.component]);
    check_same(values, map);
    CHECK(array.at("components") ==
          (name.starts_with("stress") ? kTensorComponents : kVectorComponents));
  }
}

template <int D>
void check_maps_csv(const Shell& shell, const std::map<std::string, json>& maps) {
  json columns;
  std::map<std::string, std::string> units;
  for (int axis = 0; axis < D; ++axis) {
    for (int cell = 0; cell < Vessel<D>::cells.prod(); ++cell) {
      columns[kAxisNames[axis]].push_back((index_along<D>(axis, cell) + 0.5) *
                                          cell_size<D>()[axis]);
    }
    units[kAxisNames[axis]] = "a";
  }
  for (const auto& [name, map] : maps) {
    columns[name] = map;
    units[name] = unit_of_map<D>(name);
  }
  const Table table = table_in(shell.read("maps.csv"));
  check_same(table.columns, columns);
  CHECK(table.units == units);
}

// The extents of lists in lists, from outside.
json extents(const json& values) {
  json sizes = json::array();
  for (const json* list = &values; list->is_array(); list = &list->front()) {
    sizes.push_back(list->size());
  }
  return sizes;
}

// The cells along the axes, the last axis first, as in HDF5.
template <int D>
json cells_from_last() {
  json cells = json::array();
  for (int axis = D - 1; axis >= 0; --axis) cells.push_back(Vessel<D>::cells[axis]);
  return cells;
}

template <int D>
void check_edges(const json& group) {
  for (int axis = 0; axis < D; ++axis) {
    json edges = json::array();
    for (int k = 0; k <= Vessel<D>::cells[axis]; ++k) edges.push_back(k * cell_size<D>()[axis]);
    check_same(group.at(std::string(kAxisNames[axis]) + "_edges"),
               {{"values", edges}, {"units", "a"}});
  }
}

template <int D>
void check_maps() {
  Witnessed<D> run(uneven_scene<D>());
  const auto sums = run.cell_sums();
  // Real residuals are rounding errors, and could come from any run.
  const Residuals residuals = made_up_residuals<D>();
  const std::vector<std::string> names = residual_names<D>();
  for (FieldMap& map : run.measured.maps->maps) {
    for (std::size_t k = 0; k < names.size(); ++k) {
      if (name_of(map.field) == names[k]) map.values = residuals.equations[k];
    }
  }
  const Shell shell;
  write_tables(shell.path(""), run.measured);
  write_vtk(shell.path(""), run.measured, "who made it");
  write_hdf5(shell.path("r.h5"), run.result(), run.measured);

  auto maps = maps_of<D>(sums, 0, run.windows.count, run.windows);
  for (std::size_t k = 0; k < names.size(); ++k) maps[names[k]] = residuals.equations[k];
  check_maps_csv<D>(shell, maps);

  const json image = read_by(shell, "read_vtk.py", "fields.vti");
  json dimensions = {1, 1, 1}, spacing = {1.0, 1.0, 1.0};
  for (int axis = 0; axis < D; ++axis) {
    dimensions[axis] = Vessel<D>::cells[axis] + 1;
    spacing[axis] = cell_size<D>()[axis];
  }
  CHECK(image.at("dimensions") == dimensions);
  CHECK(image.at("origin") == json({0.0, 0.0, 0.0}));
  check_same(image.at("spacing"), spacing);
  check_same(image.at("time"), {kBurnIn, kBurnIn + kDuration});
  // Density, velocity, T of the axes and T, stress, heat flux, dissipation, spin, T_rot, residuals.
  CHECK(image.at("arrays").size() == 1 + 1 + (D + 1) + 3 + 3 + 1 + 1 + 1 + (D + 2));
  check_arrays<D>(image.at("arrays"), maps);
  CHECK(says(shell.read("fields.vti"), "<!-- who made it; units, a: particle diameter"));

  const json file = read_by(shell, "read_hdf5.py", "r.h5");
  for (const auto& [name, map] : maps) {
    CAPTURE(name);
    const json& dataset = file.at("maps").at(name);
    CHECK(dataset.at("units") == unit_of_map<D>(name));
    CHECK(extents(dataset.at("values")) == cells_from_last<D>());
    check_same(numbers_in(dataset.at("values")), map);
  }
  CHECK(file.at("maps").size() == maps.size() + D + 1);
  check_same(file.at("maps").at("time"),
             {{"values", {kBurnIn, kBurnIn + kDuration}}, {"units", "t"}});
  check_edges<D>(file.at("maps"));

  // 512 windows, 8 per part.
  const json series = read_by(shell, "read_vtk.py", "series.pvd");
  REQUIRE(series.size() == 64);
  CHECK(file.at("map_series").size() == fields<D>().size() + D + 1);
  check_edges<D>(file.at("map_series"));
  CHECK(file.at("map_series").at("time").at("units") == "t");
  for (int part = 0; part < 64; ++part) {
    const double begin = kBurnIn + part * kDuration / 64.0, end = begin + kDuration / 64.0;
    const auto expected = maps_of<D>(sums, 8 * part, 8 * part + 8, run.windows);
    check_same(series[part].at("time"), {begin, end});
    check_same(series[part].at("timestep"), 0.5 * (begin + end));
    check_arrays<D>(series[part].at("arrays"), expected);
    check_same(file.at("map_series").at("time").at("values")[part], {begin, end});
    for (const auto& [name, map] : expected) {
      const json& dataset = file.at("map_series").at(name);
      if (part == 0) CHECK(dataset.at("units") == unit_of_map<D>(name));
      const json& values = dataset.at("values")[part];
      CHECK(extents(values) == cells_from_last<D>());
      check_same(numbers_in(values), map);
    }
  }
}

template <int D>
void check_hdf5() {
  const Witnessed<D> run(uneven_scene<D>());
  const json result = run.result(
      {.cpu_seconds = 2.5, .wall_seconds = 3.25, .collisions = 40, .peak_memory_bytes = 96});
  const Shell shell;
  write_hdf5(shell.path("r.h5"), result, run.measured);
  json file = read_by(shell, "read_hdf5.py", "r.h5");
  const auto dataset = [](const json& values, const char* unit) {
    return json{{"values", values}, {"units", unit}};
  };
  const json& series = result.at("temperature_series");
  CHECK(file.at("temperature_series") ==
        json{{"time", dataset(series.at("time"), "t")},
             {"translational", dataset(series.at("translational"), "m a^2/t^2")},
             {"spin", dataset(series.at("spin"), "m a^2/t^2")}});
  const json& profile = result.at("profile");
  json expected = {{"axis", "x"}, {"edges", dataset(profile.at("edges"), "a")}};
  for (const auto& [name, field] : fields<D>()) {
    expected[name] = dataset(profile.at(name), field.unit);
    expected["standard_error"][name] = dataset(profile.at("standard_error").at(name), field.unit);
  }
  CHECK(file.at("profile") == expected);
  CHECK(file.at("units") == "a: particle diameter, m: particle mass, t: time unit of the scene");
  json rest = result;
  for (const char* key : {"temperature_series", "profile", "maps", "map_series", "units"}) {
    file.erase(key);
    rest.erase(key);
  }
  check_same(file, rest);
}

}  // namespace

TEST_CASE("Results: a request stops the writing of maps, and leaves no part of a file") {
  const Witnessed<2> run(uneven_scene<2>());
  const Shell shell;
  int looks = 0;
  const auto at_the_second = [&] { return ++looks % 2 == 0; };
  CHECK_THROWS_AS(write_tables(shell.path(""), run.measured, at_the_second), Interrupted);
  CHECK_THROWS_AS(write_vtk(shell.path(""), run.measured, "who made it", at_the_second),
                  Interrupted);
  CHECK_THROWS_AS(write_hdf5(shell.path("r.h5"), run.result(), run.measured, at_the_second),
                  Interrupted);
  CHECK(looks == 6);
  CHECK(shell.files() == std::vector<std::string>{"profile.csv", "temperature_series.csv"});
}

TEST_CASE("Results: every cell of the maps follows from its events, in all files") {
  check_maps<2>();
}

TEST_CASE("Results: every cell of the maps of spheres follows from its events, in all files") {
  check_maps<3>();
}

TEST_CASE("Results: HDF5 has series and profile with their units, the rest as the result file") {
  check_hdf5<2>();
  check_hdf5<3>();
}

}  // namespace clatter
