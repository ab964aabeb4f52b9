// Every value of a result and of its files, compared with an independent computation.

#include <doctest/doctest.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <map>
#include <memory>
#include <nlohmann/json.hpp>

#include "app/results/csv_tables.h"
#include "app/results/hdf5_file.h"
#include "app/results/json_text.h"
#include "app/results/result_json.h"
#include "app/results/vtk_files.h"
#include "engine/error.h"
#include "engine/measure/measurement.h"
#include "tests/app/shell.h"
#include "tests/app/tables.h"
#include "tests/app/witness.h"

namespace clatter {

using nlohmann::json;
using namespace testing;

namespace {

constexpr int kColumns = 3, kRows = 5, kCells = kColumns * kRows;
const Vec2 kBox(9.0, 8.0);
constexpr double kBurnIn = 0.76, kDuration = 12.0, kContactTime = 0.05;

// A scene without symmetry: four kinds of walls, oblique gravity, and kicked rough disks that start
// at one side and drift.
Scene uneven_scene() {
  Scene scene;
  scene.box = kBox;
  scene.particles.count = 14;
  scene.particles.restitution = 0.8;
  scene.particles.roughness = {.friction = 0.4, .tangential_restitution = 0.5};
  scene.particles.inertia = 0.45;
  scene.walls = {
      Wall{.kind = WallKind::Driven, .restitution = 0.9, .drive_speed = 1.5},
      Wall{.kind = WallKind::Static,
           .restitution = 0.7,
           .roughness = {.friction = 0.3, .tangential_restitution = 0.2}},
      Wall{.kind = WallKind::Thermal, .temperature = 0.5},
      Wall{.kind = WallKind::Sinusoidal, .restitution = 0.8, .stroke = 0.3, .frequency = 1.1}};
  scene.gravity = Vec2(0.15, -0.4);
  scene.bulk_drive = BulkDrive{.interval = 0.7, .kick_speed = 0.2, .kick_spin = 0.3};
  scene.contact_time = kContactTime;
  Measure& measure = scene.measure;
  measure.burn_in = kBurnIn;
  measure.duration = kDuration;
  measure.series_interval = 0.47;
  measure.fields = all_fields(2);
  measure.cells = {kColumns, kRows};
  return scene;
}

// Disks that roll and collide in a periodic box.
Scene periodic_scene() {
  Scene scene = uneven_scene();
  scene.walls = {};
  scene.gravity.reset();
  scene.measure.fields.clear();
  return scene;
}

State<2> uneven_start() {
  State<2> state;
  for (int k = 0; k < 14; ++k) {
    state.positions.emplace_back(0.9 + 1.3 * (k % 4) + 0.1 * (k / 4), 0.8 + 1.4 * (k / 4));
    state.velocities.emplace_back(0.6 + 1.2 * std::sin(3.0 * k), 0.3 + 0.7 * std::cos(5.0 * k));
    state.spins.push_back(Spin<2>(0.5 + std::sin(7.0 * k)));
  }
  return state;
}

// A run with its measurement and an independent witness.
class Witnessed {
 public:
  explicit Witnessed(const Scene& scene)
      : scene(scene),
        simulation(model_of<2>(scene, 11), uneven_start()),
        witness(simulation),
        windows{scene.measure.burn_in, scene.measure.duration / 512.0, 512} {
    simulation.add_observer(witness);
    Measurement<2> measurement(simulation, scene.measure, windows.end());
    simulation.run_until(windows.end());
    measured = measurement.result();
    witness.finish();
  }

  json result(const Performance& performance = {}) const {
    return result_json(scene, 11, simulation, measured, performance);
  }

  Scene scene;
  Simulation<2> simulation;
  Witness witness;
  Windows windows;
  Measured measured;
};

// Checks that two documents have the same keys, and numbers that are equal within rounding errors.
void check_same(const json& actual, const json& expected, const std::string& place = "") {
  CAPTURE(place);
  if (expected.is_object()) {
    REQUIRE(actual.is_object());
    for (const auto& [key, value] : actual.items()) {
      CAPTURE(key);
      CHECK(expected.contains(key));
    }
    for (const auto& [key, value] : expected.items()) {
      CAPTURE(key);
      REQUIRE(actual.contains(key));
      check_same(actual[key], value, place + '/' + key);
    }
  } else if (expected.is_array()) {
    REQUIRE(actual.size() == expected.size());
    for (std::size_t k = 0; k < expected.size(); ++k) {
      check_same(actual[k], expected[k], place + '/' + std::to_string(k));
    }
  } else if (expected.is_number_float() && actual.is_number()) {
    const double value = expected;
    CHECK(std::fabs(actual.get<double>() - value) <= 1e-9 + 1e-5 * std::fabs(value));
  } else {
    CHECK(actual == expected);
  }
}

json estimate(const WitnessedMean& mean) {
  return {{"mean", mean.mean}, {"standard_error", mean.standard_error}};
}

// The gas in a cell, or in a row of cells, by the definitions of chapter 4. In a cell without
// disks, the transfer by collisions refers to a gas at rest, and the kinetic parts are not numbers.
struct CellGas {
  CellGas(const Numbers& sums, double area_and_time) {
    const Numbers s = sums / area_and_time;
    density = s[kCount];
    collisional << -s[kTransferXX], -s[kTransferXY], -s[kTransferYX], -s[kTransferYY];
    collisional_heat = Vec2(s[kEnergyX], s[kEnergyY]);
    dissipation = s[kSources];
    if (density == 0.0) return;
    velocity = Vec2(s[kVx], s[kVy]) / density;
    const Eigen::Matrix2d squares{{s[kVxVx], s[kVxVy]}, {s[kVxVy], s[kVyVy]}};
    kinetic = density * velocity * velocity.transpose() - squares;
    const double energy = 0.5 * squares.trace() + s[kSpinEnergy];
    kinetic_heat = Vec2(s[kEnergyVx], s[kEnergyVy]) - energy * velocity + kinetic * velocity;
    collisional_heat += collisional * velocity;
    spin = s[kSpin] / density;
    spin_temperature = 2.0 * s[kSpinEnergy] / density;
  }

  double temperature(int axis) const { return -kinetic(axis, axis) / density; }
  double stress(int k, int l) const { return whole(kinetic(k, l), collisional(k, l)); }
  double heat(int k) const { return whole(kinetic_heat[k], collisional_heat[k]); }
  double whole(double by_disks, double by_collisions) const {
    if (density > 0.0) return by_disks + by_collisions;
    return by_collisions == 0.0 ? kNone : by_collisions;
  }

  static constexpr double kNone = std::numeric_limits<double>::quiet_NaN();
  double density;
  Vec2 velocity = Vec2::Constant(kNone);
  Eigen::Matrix2d kinetic = Eigen::Matrix2d::Constant(kNone), collisional;  // stress
  Vec2 kinetic_heat = Vec2::Constant(kNone), collisional_heat;
  double dissipation, spin = kNone, spin_temperature = kNone;
};

struct FieldMeaning {
  const char* unit;
  std::function<double(const CellGas&)> value;
};

const std::map<std::string, FieldMeaning>& fields() {
  using Gas = const CellGas&;
  static const std::map<std::string, FieldMeaning> all = {
      {"density", {"1/a^2", [](Gas g) { return g.density; }}},
      {"velocity_x", {"a/t", [](Gas g) { return g.velocity.x(); }}},
      {"velocity_y", {"a/t", [](Gas g) { return g.velocity.y(); }}},
      {"temperature",
       {"m a^2/t^2", [](Gas g) { return 0.5 * (g.temperature(0) + g.temperature(1)); }}},
      {"temperature_x", {"m a^2/t^2", [](Gas g) { return g.temperature(0); }}},
      {"temperature_y", {"m a^2/t^2", [](Gas g) { return g.temperature(1); }}},
      {"stress_xx", {"m/t^2", [](Gas g) { return g.stress(0, 0); }}},
      {"stress_yy", {"m/t^2", [](Gas g) { return g.stress(1, 1); }}},
      {"stress_xy", {"m/t^2", [](Gas g) { return g.stress(0, 1); }}},
      {"stress_xx_kinetic", {"m/t^2", [](Gas g) { return g.kinetic(0, 0); }}},
      {"stress_yy_kinetic", {"m/t^2", [](Gas g) { return g.kinetic(1, 1); }}},
      {"stress_xy_kinetic", {"m/t^2", [](Gas g) { return g.kinetic(0, 1); }}},
      {"stress_xx_collisional", {"m/t^2", [](Gas g) { return g.collisional(0, 0); }}},
      {"stress_yy_collisional", {"m/t^2", [](Gas g) { return g.collisional(1, 1); }}},
      {"stress_xy_collisional", {"m/t^2", [](Gas g) { return g.collisional(0, 1); }}},
      {"heat_flux_x", {"m a/t^3", [](Gas g) { return g.heat(0); }}},
      {"heat_flux_y", {"m a/t^3", [](Gas g) { return g.heat(1); }}},
      {"heat_flux_x_kinetic", {"m a/t^3", [](Gas g) { return g.kinetic_heat.x(); }}},
      {"heat_flux_y_kinetic", {"m a/t^3", [](Gas g) { return g.kinetic_heat.y(); }}},
      {"heat_flux_x_collisional", {"m a/t^3", [](Gas g) { return g.collisional_heat.x(); }}},
      {"heat_flux_y_collisional", {"m a/t^3", [](Gas g) { return g.collisional_heat.y(); }}},
      {"dissipation", {"m/t^3", [](Gas g) { return g.dissipation; }}},
      {"spin", {"1/t", [](Gas g) { return g.spin; }}},
      {"spin_temperature", {"m a^2/t^2", [](Gas g) { return g.spin_temperature; }}}};
  return all;
}

// The sums of the cells in `chosen`, in every window.
std::vector<Numbers> joined(const std::vector<std::vector<Numbers>>& sums,
                            const std::vector<int>& chosen) {
  std::vector<Numbers> joined;
  for (const auto& window : sums) {
    Numbers& sum = joined.emplace_back(Numbers::Zero(kCellSums));
    for (const int cell : chosen) sum += window[static_cast<std::size_t>(cell)];
  }
  return joined;
}

// A profile as in the result file.
json profile_of(const std::vector<std::vector<Numbers>>& sums, const Windows& windows, int axis) {
  const int places = axis == 0 ? kColumns : kRows;
  json profile = {{"axis", axis == 0 ? "x" : "y"}};
  for (int i = 0; i <= places; ++i) profile["edges"].push_back(kBox[axis] * i / places);
  for (int i = 0; i < places; ++i) {
    std::vector<int> cells;
    for (int cell = 0; cell < kCells; ++cell) {
      if ((axis == 0 ? cell % kColumns : cell / kColumns) == i) cells.push_back(cell);
    }
    const std::vector<Numbers> series = joined(sums, cells);
    const double area = kBox.prod() / places;
    for (const auto& [name, field] : fields()) {
      const WitnessedMean mean = mean_of(series, [&](const Numbers& window) {
        return field.value(CellGas(window, area * windows.length));
      });
      profile[name].push_back(mean.mean);
      profile["standard_error"][name].push_back(mean.standard_error);
    }
  }
  return profile;
}

// The values of each field in all cells over some windows: null in cells without disks.
std::map<std::string, json> maps_of(const std::vector<std::vector<Numbers>>& sums, int from, int to,
                                    const Windows& windows) {
  std::map<std::string, json> maps;
  for (int cell = 0; cell < kCells; ++cell) {
    Numbers sum = Numbers::Zero(kCellSums);
    for (int window = from; window < to; ++window) {
      sum += sums[static_cast<std::size_t>(window)][static_cast<std::size_t>(cell)];
    }
    const CellGas gas(sum, kBox.prod() / kCells * windows.length * (to - from));
    for (const auto& [name, field] : fields()) {
      const double value = field.value(gas);
      maps[name].push_back(std::isfinite(value) ? json(value) : json());
    }
  }
  return maps;
}

json read(const Shell& shell, const std::string& reader, const std::string& file) {
  const Outcome outcome = shell.run(CLATTER_READERS + reader + " " + file);
  CAPTURE(outcome.err);
  REQUIRE(outcome.code == 0);
  return json::parse(outcome.out);
}

const std::array<const char*, 4> kResiduals = {"balance_mass", "balance_momentum_x",
                                               "balance_momentum_y", "balance_energy"};

// Artificial residuals, different for each equation and each cell.
Residuals made_up_residuals() {
  Residuals residuals;
  for (int equation = 0; equation < 4; ++equation) {
    std::vector<double>& cells = residuals.equations.emplace_back();
    for (int cell = 0; cell < kCells; ++cell) {
      cells.push_back((cell % 2 ? -0.125 : 0.125) * (100 * (equation + 1) + cell));
    }
  }
  return residuals;
}

json time_series(const Witness& witness, double end, double interval) {
  json series;
  for (int k = 0; k * interval < end; ++k) {
    double squares = 0.0, spin_squares = 0.0;
    witness.at(k * interval, [&](const Vec2& v, double spin) {
      squares += v.squaredNorm();
      spin_squares += spin * spin;
    });
    const auto count = static_cast<double>(witness.count());
    series["time"].push_back(k * interval);
    series["translational"].push_back(squares / (2.0 * count));
    series["spin"].push_back(witness.moment_of_inertia() * spin_squares / count);
  }
  return series;
}

// All keys of a result that follow from totals of the gas.
json totals_json(const Witnessed& run) {
  const std::vector<Numbers> windows = totals_of(run.witness, run.windows);
  const auto mean = [&](auto function) { return mean_of(windows, function); };
  const auto per_time = [&](Total total, double length = 1.0) {
    return estimate(
        mean([=, &run](const Numbers& w) { return w[total] / (length * run.windows.length); }));
  };
  const double count = 14.0, share = 1.0 / (count * run.windows.length);
  const WitnessedMean temperature =
      mean([=](const Numbers& w) { return 0.5 * share * (w[kSquaresX] + w[kSquaresY]); });
  const auto excess = [&](Total second, Total fourth) {
    return estimate(
        mean([=](const Numbers& w) { return w[fourth] / (3.0 * w[second] * w[second]) - 1.0; }));
  };
  const double inertia = run.witness.moment_of_inertia();
  json expected = {
      {"temperature", estimate(temperature)},
      {"temperature_x", estimate(mean([=](const Numbers& w) { return share * w[kSquaresX]; }))},
      {"temperature_y", estimate(mean([=](const Numbers& w) { return share * w[kSquaresY]; }))},
      {"spin_temperature",
       estimate(mean([=](const Numbers& w) { return inertia * share * w[kSpinSquares]; }))},
      {"kurtosis_excess_x", excess(kSecondX, kFourthX)},
      {"kurtosis_excess_y", excess(kSecondY, kFourthY)},
      {"collision_rate",
       estimate(mean([=](const Numbers& w) { return 2.0 * share * w[kCollisions]; }))},
      {"energy", {{"bulk_in", per_time(kBulkIn)}, {"dissipated", per_time(kDissipated)}}},
      {"pressure", json::object()},
      {"temperature_series",
       time_series(run.witness, run.windows.end(), run.scene.measure.series_interval)},
      {"time", {{"burn_in", kBurnIn}, {"measured", kDuration}}}};
  if (run.scene.periodic(0)) {
    expected["pressure"]["virial"] = estimate(mean([=](const Numbers& w) {
      const double thermal = 0.5 * (w[kSquaresX] + w[kSquaresY]) * count / (count - 1.0);
      return 1.0 + 0.5 * w[kVirial] / thermal;
    }));
  } else {
    expected["energy"]["walls_in"] = per_time(kWallsIn);
    expected["energy"]["gravity_in"] = per_time(kGravityIn);
    expected["pressure"] = {{"left", per_time(kLeftImpulse, kBox.y())},
                            {"right", per_time(kRightImpulse, kBox.y())},
                            {"bottom", per_time(kBottomImpulse, kBox.x())},
                            {"top", per_time(kTopImpulse, kBox.x())}};
  }

  int pairs = 0, elasticised = 0, walls = 0;
  double lost = 0.0, kept = 0.0;
  for (const WitnessedTouch& touch : run.witness.touches()) {
    if (touch.time < kBurnIn) continue;
    walls += touch.side >= 0;
    if (touch.side >= 0) continue;
    ++pairs;
    elasticised += touch.within_contact_time;
    (touch.within_contact_time ? kept : lost) += touch.loss_by_law;
  }
  const int kicks = 17;  // at 1.4, 2.1, ... 12.6
  REQUIRE(elasticised > 0);
  expected["events"] = {
      {"disk_disk", pairs}, {"disk_wall", walls}, {"kicks", kicks}, {"elasticised", elasticised}};
  expected["checks"] = {{"temperature_drift", temperature.drift},
                        {"elasticised_share", static_cast<double>(elasticised) / pairs},
                        {"undissipated_share", kept / lost}};
  return expected;
}

// Removes rounding errors and non-physical values from a result, and checks that the errors are
// small.
void take_out_rounding(json& result) {
  for (const char* number : {"deepest_overlap", "clock_steps_back"}) {
    CHECK(result.at("checks").at(number) < 1e-9);
    result["checks"].erase(number);
  }
  CHECK(result.at("energy").at("ledger_residual") < 1e-12);
  result["energy"].erase("ledger_residual");
  for (const char* key :
       {"schema", "scene", "seed", "program", "state_hash", "theory", "performance", "balance"}) {
    result.erase(key);
  }
}

}  // namespace

TEST_CASE("Results: a list of plain values is on one line, and the text has the same value") {
  const nlohmann::ordered_json result = {{"title", "a \"b\" ü"},
                                         {"edges", {0.0, 0.5, 1e-300}},
                                         {"empty", json::array()},
                                         {"none", json::object()},
                                         {"profile", {{"axis", "x"}, {"density", {0.1, nullptr}}}},
                                         {"results", {{{"seed", 1}}, {{"seed", 2}}}}};
  const std::string text = json_text(result);
  CHECK(text == R"({
 "title": "a \"b\" ü",
 "edges": [0.0,0.5,1e-300],
 "empty": [],
 "none": {},
 "profile": {
  "axis": "x",
  "density": [0.1,null]
 },
 "results": [
  {
   "seed": 1
  },
  {
   "seed": 2
  }
 ]
})");
  CHECK(nlohmann::ordered_json::parse(text) == result);
  const Shell shell;
  REQUIRE(shell.run("clatter measure vibrated --until 20 --out a.json").code == 0);
  const std::string written = shell.read("a.json");
  CHECK(std::ranges::count(written, '\n') < 250);
  const auto parsed = nlohmann::ordered_json::parse(written);
  CHECK(json_text(parsed) + '\n' == written);
}

TEST_CASE("Results: every value of a walled gas follows from its events") {
  const Witnessed run(uneven_scene());
  json result = run.result();
  take_out_rounding(result);
  json expected = totals_json(run);
  expected["profile"] =
      profile_of(cell_sums_of(run.witness, run.windows, kBox, {kColumns, kRows}), run.windows, 0);
  check_same(result, expected);
}

TEST_CASE("Results: every value of a periodic gas follows from its events") {
  const Witnessed run(periodic_scene());
  json result = run.result();
  take_out_rounding(result);
  check_same(result, totals_json(run));
}

TEST_CASE("Results: each number about the run itself has its own key") {
  Scene scene = uneven_scene();
  scene.measure.fields = residual_fields(2);
  RunState<2> saved = Simulation<2>(model_of<2>(scene, 11), uneven_start()).save();
  saved.checks = {.deepest_overlap = 3e-14, .clock_steps_back = 5e-15};
  const Simulation<2> simulation(model_of<2>(scene, 11), saved);
  Measured measured;
  measured.duration = 1.0;
  measured.ledger_residual = 7e-15;
  measured.residuals = made_up_residuals();
  measured.residuals->equations[1][3] = 200.0;
  measured.residuals->equations[2][4] = -400.0;
  const json result = result_json(
      scene, 17, simulation, measured,
      {.cpu_seconds = 2.5, .wall_seconds = 3.25, .collisions = 40, .peak_memory_bytes = 96});
  CHECK(result.at("schema") == 1);
  CHECK(result.at("seed") == 17);
  CHECK(result.at("program") == "clatter " CLATTER_VERSION);
  CHECK(std::stoull(result.at("state_hash").get<std::string>(), nullptr, 16) ==
        simulation.state_hash());
  CHECK(result.at("scene").at("walls").at("bottom").at("temperature") == 0.5);
  CHECK(result.at("scene").at("gravity").at("acceleration") == json({0.15, -0.4}));
  CHECK(result.at("checks").at("deepest_overlap") == 3e-14);
  CHECK(result.at("checks").at("clock_steps_back") == 5e-15);
  CHECK(result.at("energy").at("ledger_residual") == 7e-15);
  CHECK(result.at("balance") == json{{"mass", 14.25}, {"momentum", 400.0}, {"energy", 51.75}});
  CHECK(result.at("performance") == json{{"cpu_seconds", 2.5},
                                         {"wall_seconds", 3.25},
                                         {"collisions_per_second", 16.0},
                                         {"peak_memory_bytes", 96}});
}

TEST_CASE("Results: every column of the tables follows from the events, with its unit") {
  for (const Axis axis : {Axis::X, Axis::Y}) {
    Scene scene = uneven_scene();
    scene.measure.profile_axis = axis;
    Witnessed run(scene);
    const auto sums = cell_sums_of(run.witness, run.windows, kBox, {kColumns, kRows});
    const Shell shell;
    write_tables(shell.path(""), run.measured);

    const Table series = table_in(shell.read("temperature_series.csv"));
    const json times =
        time_series(run.witness, run.windows.end(), run.scene.measure.series_interval);
    check_same(series.columns, {{"time", times.at("time")},
                                {"temperature", times.at("translational")},
                                {"spin_temperature", times.at("spin")}});
    CHECK(series.units == std::map<std::string, std::string>{{"time", "t"},
                                                             {"temperature", "m a^2/t^2"},
                                                             {"spin_temperature", "m a^2/t^2"}});

    const std::string along = axis == Axis::X ? "x" : "y";
    const json profile = profile_of(sums, run.windows, static_cast<int>(axis));
    check_same(run.result().at("profile"), profile);
    const json& edges = profile.at("edges");
    json columns = {{along + "_low", json(edges.begin(), edges.end() - 1)},
                    {along + "_high", json(edges.begin() + 1, edges.end())}};
    std::map<std::string, std::string> units = {{along, "a"}};
    for (const auto& [name, field] : fields()) {
      columns[name] = profile.at(name);
      columns[name + "_error"] = profile.at("standard_error").at(name);
      units[name] = field.unit;
    }
    const Table table = table_in(shell.read("profile.csv"));
    check_same(table.columns, columns);
    CHECK(table.units == units);
    CHECK(table.symbols == "a: particle diameter, m: particle mass, t: time unit of the scene");
  }
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

TEST_CASE("Results: a request stops the writing of maps, and leaves no part of a file") {
  const Witnessed run(uneven_scene());
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
  Witnessed run(uneven_scene());
  const auto sums = cell_sums_of(run.witness, run.windows, kBox, {kColumns, kRows});
  // Real residuals are rounding errors, and could come from any run.
  const Residuals residuals = made_up_residuals();
  for (FieldMap& map : run.measured.maps->maps) {
    for (std::size_t k = 0; k < kResiduals.size(); ++k) {
      if (name_of(map.field) == kResiduals[k]) map.values = residuals.equations[k];
    }
  }
  const Shell shell;
  write_tables(shell.path(""), run.measured);
  write_vtk(shell.path(""), run.measured, "who made it");
  write_hdf5(shell.path("r.h5"), run.result(), run.measured);

  auto maps = maps_of(sums, 0, run.windows.count, run.windows);
  for (std::size_t k = 0; k < kResiduals.size(); ++k) maps[kResiduals[k]] = residuals.equations[k];
  const auto unit = [&](const std::string& name) {
    return fields().contains(name) ? fields().at(name).unit : "1";
  };

  json columns;
  for (int cell = 0; cell < kCells; ++cell) {
    columns["x"].push_back((cell % kColumns + 0.5) * 3.0);
    columns["y"].push_back((cell / kColumns + 0.5) * 1.6);
  }
  std::map<std::string, std::string> units = {{"x", "a"}, {"y", "a"}};
  for (const auto& [name, map] : maps) {
    columns[name] = map;
    units[name] = unit(name);
  }
  const Table table = table_in(shell.read("maps.csv"));
  check_same(table.columns, columns);
  CHECK(table.units == units);

  // The position of each field in VTK: an array and a component.
  const std::map<std::string, std::pair<std::string, std::size_t>> places = {
      {"velocity_x", {"velocity", 0}},
      {"velocity_y", {"velocity", 1}},
      {"stress_xx", {"stress", 0}},
      {"stress_yy", {"stress", 1}},
      {"stress_xy", {"stress", 3}},
      {"stress_xx_kinetic", {"stress_kinetic", 0}},
      {"stress_yy_kinetic", {"stress_kinetic", 1}},
      {"stress_xy_kinetic", {"stress_kinetic", 3}},
      {"stress_xx_collisional", {"stress_collisional", 0}},
      {"stress_yy_collisional", {"stress_collisional", 1}},
      {"stress_xy_collisional", {"stress_collisional", 3}},
      {"heat_flux_x", {"heat_flux", 0}},
      {"heat_flux_y", {"heat_flux", 1}},
      {"heat_flux_x_kinetic", {"heat_flux_kinetic", 0}},
      {"heat_flux_y_kinetic", {"heat_flux_kinetic", 1}},
      {"heat_flux_x_collisional", {"heat_flux_collisional", 0}},
      {"heat_flux_y_collisional", {"heat_flux_collisional", 1}}};
  const auto check_arrays = [&](const json& arrays, const std::map<std::string, json>& maps) {
    for (const auto& [name, map] : maps) {
      CAPTURE(name);
      const auto place = places.find(name);
      if (place == places.end()) {
        check_same(arrays.at(name).at("values"), map);
        CHECK(arrays.at(name).at("units") == unit(name));
        continue;
      }
      const auto& [array, component] = place->second;
      json values = json::array();
      for (const json& tuple : arrays.at(array).at("values")) values.push_back(tuple[component]);
      check_same(values, map);
      CHECK(arrays.at(array).at("units") == unit(name));
      CHECK(arrays.at(array).at("components") == (array.starts_with("stress")
                                                      ? json({"XX", "YY", "ZZ", "XY", "YZ", "XZ"})
                                                      : json({"X", "Y", "Z"})));
    }
  };
  const json image = read(shell, "read_vtk.py", "fields.vti");
  CHECK(image.at("dimensions") == json({kColumns + 1, kRows + 1, 1}));
  check_same(image.at("spacing"), {3.0, 1.6, 1.0});
  check_same(image.at("time"), {kBurnIn, kBurnIn + kDuration});
  CHECK(image.at("arrays").size() == 18);
  check_arrays(image.at("arrays"), maps);
  CHECK(says(shell.read("fields.vti"), "<!-- who made it; units, a: particle diameter"));

  json file = read(shell, "read_hdf5.py", "r.h5");
  for (const auto& [name, map] : maps) {
    CAPTURE(name);
    const json& dataset = file.at("maps").at(name);
    CHECK(dataset.at("units") == unit(name));
    for (int row = 0; row < kRows; ++row) {
      check_same(dataset.at("values")[row],
                 json(map.begin() + kColumns * row, map.begin() + kColumns * (row + 1)));
    }
  }
  CHECK(file.at("maps").size() == maps.size() + 3);
  check_same(file.at("maps").at("time"),
             {{"values", {kBurnIn, kBurnIn + kDuration}}, {"units", "t"}});
  check_same(file.at("maps").at("x_edges"), {{"values", {0.0, 3.0, 6.0, 9.0}}, {"units", "a"}});
  check_same(file.at("maps").at("y_edges"),
             {{"values", {0.0, 1.6, 3.2, 4.8, 6.4, 8.0}}, {"units", "a"}});

  // 512 windows, 8 per part.
  const json series = read(shell, "read_vtk.py", "series.pvd");
  REQUIRE(series.size() == 64);
  CHECK(file.at("map_series").size() == fields().size() + 3);
  CHECK(file.at("map_series").at("x_edges") == file.at("maps").at("x_edges"));
  CHECK(file.at("map_series").at("y_edges") == file.at("maps").at("y_edges"));
  CHECK(file.at("map_series").at("time").at("units") == "t");
  for (int part = 0; part < 64; ++part) {
    const double begin = kBurnIn + part * kDuration / 64.0, end = begin + kDuration / 64.0;
    const auto expected = maps_of(sums, 8 * part, 8 * part + 8, run.windows);
    check_same(series[part].at("time"), {begin, end});
    check_same(series[part].at("timestep"), 0.5 * (begin + end));
    check_arrays(series[part].at("arrays"), expected);
    check_same(file.at("map_series").at("time").at("values")[part], {begin, end});
    for (const auto& [name, map] : expected) {
      const json& dataset = file.at("map_series").at(name);
      if (part == 0) CHECK(dataset.at("units") == unit(name));
      for (int row = 0; row < kRows; ++row) {
        check_same(dataset.at("values")[part][row],
                   json(map.begin() + kColumns * row, map.begin() + kColumns * (row + 1)));
      }
    }
  }
}

TEST_CASE("Results: HDF5 has series and profile with their units, the rest as the result file") {
  const Witnessed run(uneven_scene());
  const json result = run.result(
      {.cpu_seconds = 2.5, .wall_seconds = 3.25, .collisions = 40, .peak_memory_bytes = 96});
  const Shell shell;
  write_hdf5(shell.path("r.h5"), result, run.measured);
  json file = read(shell, "read_hdf5.py", "r.h5");
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
  for (const auto& [name, field] : fields()) {
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

}  // namespace clatter
