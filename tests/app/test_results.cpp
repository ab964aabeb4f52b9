// Every value of a result and of its files, compared with an independent computation.

#include <doctest/doctest.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <map>
#include <memory>
#include <nlohmann/json.hpp>
#include <type_traits>

#include "app/results/csv_tables.h"
#include "app/results/hdf5_file.h"
#include "app/results/json_text.h"
#include "app/results/result_json.h"
#include "app/results/vtk_files.h"
#include "engine/dimension.h"
#include "engine/error.h"
#include "engine/measure/measurement.h"
#include "tests/app/shell.h"
#include "tests/app/tables.h"
#include "tests/app/witness.h"

namespace clatter {

using nlohmann::json;
using namespace testing;

namespace {

constexpr double kBurnIn = 0.76, kDuration = 12.0, kContactTime = 0.05;

// The box and its cells, a different number along each axis.
template <int D>
struct Vessel {
  static const Vec<D> box;
  static const IntVec<D> cells;
  static const int count;  // particles
};
template <>
const Vec<2> Vessel<2>::box(9.0, 8.0);
template <>
const IntVec<2> Vessel<2>::cells(3, 5);
template <>
const int Vessel<2>::count = 14;
template <>
const Vec<3> Vessel<3>::box(6.0, 5.0, 4.4);
template <>
const IntVec<3> Vessel<3>::cells(3, 2, 4);
template <>
const int Vessel<3>::count = 24;

template <int D>
Vec<D> cell_size() {
  return Vessel<D>::box.cwiseQuotient(Vessel<D>::cells.template cast<double>());
}

// The index of a cell along an axis.
template <int D>
int index_along(int axis, int cell) {
  for (int k = 0; k < axis; ++k) cell /= Vessel<D>::cells[k];
  return cell % Vessel<D>::cells[axis];
}

// A scene without symmetry: different walls, oblique gravity, and kicked rough particles that start
// at one side and drift.
template <int D>
Scene uneven_scene() {
  Scene scene = default_scene(D);
  scene.box = Vessel<D>::box;
  scene.particles.count = Vessel<D>::count;
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
  if (D == 3) {
    scene.walls[kBack] =
        Wall{.kind = WallKind::Sawtooth, .restitution = 0.9, .stroke = 0.2, .frequency = 0.9};
    scene.walls[kFront] = Wall{.kind = WallKind::Thermal, .temperature = 1.3};
  }
  scene.gravity = Vec<3>(0.15, -0.4, 0.25).head<D>();
  scene.bulk_drive = BulkDrive{.interval = 0.7, .kick_speed = 0.2, .kick_spin = 0.3};
  scene.contact_time = kContactTime;
  Measure& measure = scene.measure;
  measure.burn_in = kBurnIn;
  measure.duration = kDuration;
  measure.series_interval = 0.47;
  measure.fields = all_fields(D);
  measure.cells.assign(Vessel<D>::cells.begin(), Vessel<D>::cells.end());
  return scene;
}

// Particles that roll and collide in a periodic box.
template <int D>
Scene periodic_scene() {
  Scene scene = uneven_scene<D>();
  scene.walls = {};
  scene.gravity.reset();
  scene.measure.fields.clear();
  return scene;
}

// Rows of four particles along x; of spheres, three rows in each of two layers.
template <int D>
State<D> uneven_start() {
  State<D> state;
  for (int k = 0; k < Vessel<D>::count; ++k) {
    const int row = D == 2 ? k / 4 : k / 4 % 3, layer = k / 12;
    state.positions.push_back(
        Vec<3>(0.9 + 1.3 * (k % 4) + 0.1 * (k / 4), 0.8 + 1.4 * row, 0.8 + 1.3 * layer).head<D>());
    state.velocities.push_back(Vec<3>(0.6 + 1.2 * std::sin(3.0 * k), 0.3 + 0.7 * std::cos(5.0 * k),
                                      0.4 + 0.6 * std::sin(11.0 * k))
                                   .head<D>());
    state.spins.push_back(
        Vec<3>(0.5 + std::sin(7.0 * k), 0.3 + std::cos(2.0 * k), std::sin(1.0 * k) - 0.4)
            .head<kSpinSize<D>>());
  }
  return state;
}

// A run with its measurement and an independent witness.
template <int D>
class Witnessed {
 public:
  explicit Witnessed(const Scene& scene)
      : scene(scene),
        simulation(model_of<D>(scene, 11), uneven_start<D>()),
        witness(simulation),
        windows{scene.measure.burn_in, scene.measure.duration / 512.0, 512} {
    simulation.add_observer(witness);
    Measurement<D> measurement(simulation, scene.measure, windows.end());
    simulation.run_until(windows.end());
    measured = measurement.result();
    witness.finish();
  }

  json result(const Performance& performance = {}) const {
    return result_json(scene, 11, simulation, measured, performance);
  }

  std::vector<std::vector<Numbers>> cell_sums() const {
    return cell_sums_of<D>(witness, windows, Vessel<D>::box, Vessel<D>::cells);
  }

  Scene scene;
  Simulation<D> simulation;
  Witness<D> witness;
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
// particles, the transfer by collisions refers to a gas at rest, and the kinetic parts are not
// numbers.
template <int D>
struct CellGas {
  using Matrix = Eigen::Matrix<double, D, D>;

  CellGas(const Numbers& sums, double volume_and_time) {
    using C = CellOf<D>;
    const Numbers s = sums / volume_and_time;
    const auto vector = [&](int place) { return Vec<D>(s.segment<D>(place)); };
    const auto matrix = [&](int place) {
      Matrix m;
      for (int k = 0; k < D; ++k) m.row(k) = vector(place + D * k);
      return m;
    };
    density = s[C::kCount];
    collisional = -matrix(C::kTransfer);
    collisional_heat = vector(C::kEnergyTransfer);
    dissipation = s[C::kSources];
    if (density == 0.0) return;
    velocity = vector(C::kVelocity) / density;
    const Matrix squares = matrix(C::kSquares);
    kinetic = density * velocity * velocity.transpose() - squares;
    const double energy = 0.5 * squares.trace() + s[C::kSpinEnergy];
    kinetic_heat = vector(C::kEnergyFlow) - energy * velocity + kinetic * velocity;
    collisional_heat += collisional * velocity;
    spin = s.segment<kSpinSize<D>>(C::kSpin) / density;
    spin_temperature = 2.0 * s[C::kSpinEnergy] / kSpinSize<D> / density;
  }

  double temperature(int axis) const { return -kinetic(axis, axis) / density; }
  double temperature() const { return -kinetic.trace() / D / density; }
  double stress(int k, int l) const { return whole(kinetic(k, l), collisional(k, l)); }
  double heat(int k) const { return whole(kinetic_heat[k], collisional_heat[k]); }
  double whole(double by_particles, double by_collisions) const {
    if (density > 0.0) return by_particles + by_collisions;
    return by_collisions == 0.0 ? kNone : by_collisions;
  }

  static constexpr double kNone = std::numeric_limits<double>::quiet_NaN();
  double density;
  Vec<D> velocity = Vec<D>::Constant(kNone);
  Matrix kinetic = Matrix::Constant(kNone), collisional;  // stress
  Vec<D> kinetic_heat = Vec<D>::Constant(kNone), collisional_heat;
  double dissipation;
  Spin<D> spin = Spin<D>::Constant(kNone);
  double spin_temperature = kNone;
};

template <int D>
struct FieldMeaning {
  const char* unit;
  std::function<double(const CellGas<D>&)> value;
  // Place in VTK: the array and its component, if that is not the field itself.
  std::string array = "";
  std::size_t component = 0;
};

constexpr const char* kAxisNames[] = {"x", "y", "z"};
const json kVectorComponents = {"X", "Y", "Z"};
const json kTensorComponents = {"XX", "YY", "ZZ", "XY", "YZ", "XZ"};

template <int D>
const std::map<std::string, FieldMeaning<D>>& fields() {
  using Gas = const CellGas<D>&;
  constexpr bool kDisks = D == 2;
  static const auto all = [] {
    std::map<std::string, FieldMeaning<D>> all = {
        {"density", {kDisks ? "1/a^2" : "1/a^3", [](Gas g) { return g.density; }}},
        {"temperature", {"m a^2/t^2", [](Gas g) { return g.temperature(); }}},
        {"dissipation", {kDisks ? "m/t^3" : "m/(a t^3)", [](Gas g) { return g.dissipation; }}},
        {"spin_temperature", {"m a^2/t^2", [](Gas g) { return g.spin_temperature; }}}};
    const char* const stress_unit = kDisks ? "m/t^2" : "m/(a t^2)";
    const char* const heat_unit = kDisks ? "m a/t^3" : "m/t^3";
    for (int k = 0; k < D; ++k) {
      const std::string axis = kAxisNames[k];
      const auto place = static_cast<std::size_t>(k);
      all["velocity_" + axis] = {"a/t", [k](Gas g) { return g.velocity[k]; }, "velocity", place};
      all["temperature_" + axis] = {"m a^2/t^2", [k](Gas g) { return g.temperature(k); }};
      all["heat_flux_" + axis] = {heat_unit, [k](Gas g) { return g.heat(k); }, "heat_flux", place};
      all["heat_flux_" + axis + "_kinetic"] = {heat_unit, [k](Gas g) { return g.kinetic_heat[k]; },
                                               "heat_flux_kinetic", place};
      all["heat_flux_" + axis + "_collisional"] = {
          heat_unit, [k](Gas g) { return g.collisional_heat[k]; }, "heat_flux_collisional", place};
      for (int l = k; l < D; ++l) {
        const std::string name = "stress_" + axis + kAxisNames[l];
        const std::size_t tensor_place = k == l ? place : l - k == 2 ? 5 : 3 + place;
        all[name] = {stress_unit, [=](Gas g) { return g.stress(k, l); }, "stress", tensor_place};
        all[name + "_kinetic"] = {stress_unit, [=](Gas g) { return g.kinetic(k, l); },
                                  "stress_kinetic", tensor_place};
        all[name + "_collisional"] = {stress_unit, [=](Gas g) { return g.collisional(k, l); },
                                      "stress_collisional", tensor_place};
      }
    }
    if (kDisks) all["spin"] = {"1/t", [](Gas g) { return g.spin[0]; }};
    for (int k = 0; k < kSpinSize<D> && !kDisks; ++k) {
      all[std::string("spin_") + kAxisNames[k]] = {"1/t", [k](Gas g) { return g.spin[k]; }, "spin",
                                                   static_cast<std::size_t>(k)};
    }
    return all;
  }();
  return all;
}

// The sums of the cells in `chosen`, in every window.
std::vector<Numbers> joined(const std::vector<std::vector<Numbers>>& sums,
                            const std::vector<int>& chosen) {
  std::vector<Numbers> joined;
  for (const auto& window : sums) {
    Numbers& sum = joined.emplace_back(Numbers::Zero(window.front().size()));
    for (const int cell : chosen) sum += window[static_cast<std::size_t>(cell)];
  }
  return joined;
}

// A profile as in the result file.
template <int D>
json profile_of(const std::vector<std::vector<Numbers>>& sums, const Windows& windows, int axis) {
  const int places = Vessel<D>::cells[axis];
  json profile = {{"axis", kAxisNames[axis]}};
  for (int i = 0; i <= places; ++i) profile["edges"].push_back(Vessel<D>::box[axis] * i / places);
  for (int i = 0; i < places; ++i) {
    std::vector<int> cells;
    for (int cell = 0; cell < Vessel<D>::cells.prod(); ++cell) {
      if (index_along<D>(axis, cell) == i) cells.push_back(cell);
    }
    const std::vector<Numbers> series = joined(sums, cells);
    const double volume = Vessel<D>::box.prod() / places;
    for (const auto& [name, field] : fields<D>()) {
      const WitnessedMean mean = mean_of(series, [&](const Numbers& window) {
        return field.value(CellGas<D>(window, volume * windows.length));
      });
      profile[name].push_back(mean.mean);
      profile["standard_error"][name].push_back(mean.standard_error);
    }
  }
  return profile;
}

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
json flat(const json& values) {
  if (!values.is_array()) return json::array({values});
  json all = json::array();
  for (const json& part : values) {
    for (const json& value : flat(part)) all.push_back(value);
  }
  return all;
}

json read(const Shell& shell, const std::string& reader, const std::string& file) {
  const Outcome outcome = shell.run(CLATTER_READERS + reader + " " + file);
  CAPTURE(outcome.err);
  REQUIRE(outcome.code == 0);
  return json::parse(outcome.out);
}

template <int D>
std::vector<std::string> residual_names() {
  std::vector<std::string> names = {"balance_mass"};
  for (int k = 0; k < D; ++k) names.push_back(std::string("balance_momentum_") + kAxisNames[k]);
  names.push_back("balance_energy");
  return names;
}

// Artificial residuals, different for each equation and each cell.
template <int D>
Residuals made_up_residuals() {
  Residuals residuals;
  for (int equation = 0; equation < D + 2; ++equation) {
    std::vector<double>& cells = residuals.equations.emplace_back();
    for (int cell = 0; cell < Vessel<D>::cells.prod(); ++cell) {
      cells.push_back((cell % 2 ? -0.125 : 0.125) * (100 * (equation + 1) + cell));
    }
  }
  return residuals;
}

template <int D>
json time_series(const Witness<D>& witness, double end, double interval) {
  json series;
  for (int k = 0; k * interval < end; ++k) {
    double squares = 0.0, spin_squares = 0.0;
    witness.at(k * interval, [&](const Vec<D>& v, const Spin<D>& spin) {
      squares += v.squaredNorm();
      spin_squares += spin.squaredNorm();
    });
    const auto count = static_cast<double>(witness.count());
    series["time"].push_back(k * interval);
    series["translational"].push_back(squares / (D * count));
    series["spin"].push_back(witness.moment_of_inertia() * spin_squares / (kSpinSize<D> * count));
  }
  return series;
}

// All keys of a result that follow from totals of the gas.
template <int D>
json totals_json(const Witnessed<D>& run) {
  using T = TotalsOf<D>;
  const std::vector<Numbers> windows = totals_of(run.witness, run.windows);
  const auto mean = [&](auto function) { return mean_of(windows, function); };
  const auto per_time = [&](int total, double size = 1.0) {
    return estimate(
        mean([=, &run](const Numbers& w) { return w[total] / (size * run.windows.length); }));
  };
  const double count = Vessel<D>::count, share = 1.0 / (count * run.windows.length);
  const auto squares = [](const Numbers& w) { return w.segment<D>(T::kSquares).sum(); };
  const WitnessedMean temperature = mean([=](const Numbers& w) { return share / D * squares(w); });
  const double inertia = run.witness.moment_of_inertia();
  json expected = {
      {"temperature", estimate(temperature)},
      {"spin_temperature", estimate(mean([=](const Numbers& w) {
         return inertia * share * w[T::kSpinSquares] / kSpinSize<D>;
       }))},
      {"collision_rate",
       estimate(mean([=](const Numbers& w) { return 2.0 * share * w[T::kCollisions]; }))},
      {"energy", {{"bulk_in", per_time(T::kBulkIn)}, {"dissipated", per_time(T::kDissipated)}}},
      {"pressure", json::object()},
      {"temperature_series",
       time_series(run.witness, run.windows.end(), run.scene.measure.series_interval)},
      {"time", {{"burn_in", kBurnIn}, {"measured", kDuration}}}};
  for (int k = 0; k < D; ++k) {
    const std::string axis = kAxisNames[k];
    expected["temperature_" + axis] =
        estimate(mean([=](const Numbers& w) { return share * w[T::kSquares + k]; }));
    expected["kurtosis_excess_" + axis] = estimate(mean([=](const Numbers& w) {
      return w[T::kFourth + k] / (3.0 * w[T::kSecond + k] * w[T::kSecond + k]) - 1.0;
    }));
  }
  if (run.scene.periodic(0)) {
    expected["pressure"]["virial"] = estimate(mean([=](const Numbers& w) {
      const double thermal = squares(w) / D * count / (count - 1.0);
      return 1.0 + w[T::kVirial] / D / thermal;
    }));
  } else {
    expected["energy"]["walls_in"] = per_time(T::kWallsIn);
    expected["energy"]["gravity_in"] = per_time(T::kGravityIn);
    const char* const names[] = {"left", "right", "bottom", "top", "back", "front"};
    for (int side = 0; side < 2 * D; ++side) {
      const double size = Vessel<D>::box.prod() / Vessel<D>::box[side / 2];
      expected["pressure"][names[side]] = per_time(T::kImpulse + side, size);
    }
  }

  int pairs = 0, elasticised = 0, walls = 0;
  double lost = 0.0, kept = 0.0;
  for (const WitnessedTouch<D>& touch : run.witness.touches()) {
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

  const json image = read(shell, "read_vtk.py", "fields.vti");
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

  const json file = read(shell, "read_hdf5.py", "r.h5");
  for (const auto& [name, map] : maps) {
    CAPTURE(name);
    const json& dataset = file.at("maps").at(name);
    CHECK(dataset.at("units") == unit_of_map<D>(name));
    CHECK(extents(dataset.at("values")) == cells_from_last<D>());
    check_same(flat(dataset.at("values")), map);
  }
  CHECK(file.at("maps").size() == maps.size() + D + 1);
  check_same(file.at("maps").at("time"),
             {{"values", {kBurnIn, kBurnIn + kDuration}}, {"units", "t"}});
  check_edges<D>(file.at("maps"));

  // 512 windows, 8 per part.
  const json series = read(shell, "read_vtk.py", "series.pvd");
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
      check_same(flat(values), map);
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
  for (const int dimension : {2, 3}) {
    CAPTURE(dimension);
    with_dimension(dimension, []<int D>(std::integral_constant<int, D>) {
      const Witnessed<D> run(uneven_scene<D>());
      json result = run.result();
      take_out_rounding(result);
      json expected = totals_json(run);
      expected["profile"] = profile_of<D>(run.cell_sums(), run.windows, 0);
      check_same(result, expected);
    });
  }
}

TEST_CASE("Results: every value of a periodic gas follows from its events") {
  for (const int dimension : {2, 3}) {
    CAPTURE(dimension);
    with_dimension(dimension, []<int D>(std::integral_constant<int, D>) {
      const Witnessed<D> run(periodic_scene<D>());
      json result = run.result();
      take_out_rounding(result);
      check_same(result, totals_json(run));
    });
  }
}

TEST_CASE("Results: each number about the run itself has its own key") {
  Scene scene = uneven_scene<2>();
  scene.measure.fields = residual_fields(2);
  RunState<2> saved = Simulation<2>(model_of<2>(scene, 11), uneven_start<2>()).save();
  saved.checks = {.deepest_overlap = 3e-14, .clock_steps_back = 5e-15};
  const Simulation<2> simulation(model_of<2>(scene, 11), saved);
  Measured measured;
  measured.duration = 1.0;
  measured.ledger_residual = 7e-15;
  measured.residuals = made_up_residuals<2>();
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
