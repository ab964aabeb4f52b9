// Every value of a result, compared with an independent computation.

#include <doctest/doctest.h>

#include <algorithm>
#include <nlohmann/json.hpp>
#include <type_traits>

#include "app/results/result_json.h"
#include "engine/dimension.h"
#include "tests/app/check_same.h"
#include "tests/app/expected_values.h"
#include "tests/app/witnessed_run.h"
#include "tests/support/shell.h"

namespace clatter {

using nlohmann::json;
using namespace testing;

namespace {

json estimate(const WitnessedMean& mean) {
  return {{"mean", mean.mean}, {"standard_error", mean.standard_error}};
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

}  // namespace

TEST_CASE("Results: a list of plain values is on one line, and the text has the same value") {
  const nlohmann::ordered_json result = {{"title", "a \"b\" ü"},
                                         {"empty", json::array()},
                                         {"profile", {{"density", {0.0, 1e-300, nullptr}}}},
                                         {"results", {{{"seed", 1}}, {{"seed", 2}}}}};
  const std::string text = json_text(result);
  CHECK(says(text, "\"density\": [0.0,1e-300,null]\n"));
  CHECK(nlohmann::ordered_json::parse(text) == result);
  const Shell shell;
  REQUIRE(shell.run("clatter measure vibrated --until 20 --out a.json").code == 0);
  const std::string written = shell.read("a.json");
  CHECK(std::ranges::count(written, '\n') < 250);
  const auto parsed = nlohmann::ordered_json::parse(written);
  CHECK(json_text(parsed) + '\n' == written);
}

TEST_CASE("Results: every value of a walled or a periodic gas follows from its events") {
  for (const int dimension : {2, 3}) {
    for (const bool walled : {true, false}) {
      CAPTURE(dimension);
      CAPTURE(walled);
      with_dimension(dimension, [&]<int D>(std::integral_constant<int, D>) {
        const Witnessed<D> run(walled ? uneven_scene<D>() : periodic_scene<D>());
        json result = run.result();
        take_out_rounding(result);
        json expected = totals_json(run);
        if (walled) expected["profile"] = profile_of<D>(run.cell_sums(), run.windows, 0);
        check_same(result, expected);
      });
    }
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
  const json result = result_json(scene, 17, simulation, measured,
                                  {.cpu_seconds = 2.5,
                                   .wall_seconds = 3.25,
                                   .collisions = 40,
                                   .peak_memory_bytes = 96,
                                   .tiles = 6});
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
                                         {"peak_memory_bytes", 96},
                                         {"tiles", 6}});
}

}  // namespace clatter
