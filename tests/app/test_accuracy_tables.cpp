// The results of `clatter bench accuracy` in all output formats.

#include <doctest/doctest.h>

#include <cmath>
#include <map>
#include <nlohmann/json.hpp>
#include <sstream>

#include "app/bench/accuracy_output.h"
#include "app/bench/run_result.h"
#include "engine/measure/measurement.h"
#include "engine/run/scheduled_run.h"

namespace clatter {

using nlohmann::json;

namespace {

// All numbers are different.
AccuracyTable gas_table() {
  AccuracyRow row{.setting = "1e-3",
                  .value = 1e-3,
                  .cpu_per_time = 0.0125,
                  .events_per_second = 2.25e6,
                  .bytes = 34e3,
                  .deepest_overlap = 5e-4,
                  .elasticised_share = 0.063,
                  .dominated = true};
  for (int k = 0; k < kCompared; ++k) {
    const double number = k + 1.0;
    row.comparison.bias[k] = {.mean = 0.01 * number, .standard_error = 0.001 * number};
  }
  row.comparison.error = 0.079;
  return {"contact_time", "Contact time t_c", {row}};
}

PictureTable picture_table() {
  return {"frame_rate", "Frame rate", {{"30", 30.0, 0.045, 0.9876, 0.067, 5.4e4, false}}};
}

std::vector<std::string> words_of(const std::string& text, char gap) {
  std::vector<std::string> words;
  std::istringstream stream(text);
  for (std::string word; std::getline(stream, word, gap);) words.push_back(word);
  return words;
}

}  // namespace

TEST_CASE("Accuracy tables: JSON and CSV have each number under its own name") {
  AccuracyBench bench;
  bench.scene = "barometer";
  bench.duration = 321.0;
  const json found = json::parse(accuracy_json(bench, {gas_table()}, {picture_table()}));
  const auto estimate = [](double number) {
    return json{{"mean", 0.01 * number}, {"standard_error", 0.001 * number}};
  };
  const json expected = {{"scene", "barometer"},
                         {"replicas", 8},
                         {"duration", 321.0},
                         {"dials",
                          {{{"dial", "contact_time"},
                            {"title", "Contact time t_c"},
                            {"settings",
                             {{{"setting", "1e-3"},
                               {"value", 1e-3},
                               {"cpu_seconds_per_time", 0.0125},
                               {"events_per_cpu_second", 2.25e6},
                               {"bytes", 34e3},
                               {"bias",
                                {{"temperature", estimate(1.0)},
                                 {"pressure", estimate(2.0)},
                                 {"stress", estimate(3.0)},
                                 {"heat_flux", estimate(4.0)},
                                 {"dissipation", estimate(5.0)},
                                 {"density", estimate(6.0)}}},
                               {"deepest_overlap", 5e-4},
                               {"elasticised_share", 0.063},
                               {"error", 0.079},
                               {"dominated", true}}}}},
                           {{"dial", "frame_rate"},
                            {"title", "Frame rate"},
                            {"settings",
                             {{{"setting", "30"},
                               {"value", 30.0},
                               {"cpu_seconds_per_picture", 0.045},
                               {"ssim", 0.9876},
                               {"centre_error_pixels", 0.067},
                               {"bytes_per_second", 5.4e4},
                               {"dominated", false}}}}}}}};
  CHECK(found == expected);

  const std::vector<std::string> lines =
      words_of(accuracy_csv({gas_table()}, {picture_table()}), '\n');
  REQUIRE(lines.size() == 3);
  const std::vector<std::string> names = words_of(lines[0], ',');
  for (const std::size_t dial : {0, 1}) {
    std::map<std::string, std::string> row;
    const std::vector<std::string> cells = words_of(lines[dial + 1], ',');
    REQUIRE(cells.size() == names.size());
    for (std::size_t k = 0; k < names.size(); ++k) row[names[k]] = cells[k];
    CHECK(row["dial"] == expected["dials"][dial]["dial"].get<std::string>());
    json columns = expected["dials"][dial]["settings"][0];
    CHECK(row["setting"] == columns["setting"].get<std::string>());
    CHECK(row["dominated"] == (columns["dominated"] ? "1" : "0"));
    const json biases = columns.value("bias", json::object());
    for (const auto& [quantity, bias] : biases.items()) {
      columns[quantity + "_bias"] = bias["mean"];
      columns[quantity + "_bias_error"] = bias["standard_error"];
    }
    for (const char* key : {"dial", "setting", "dominated"}) row.erase(key);
    for (const char* key : {"setting", "dominated", "bias"}) columns.erase(key);
    for (const auto& [name, cell] : row) {
      CAPTURE(name);
      CHECK((cell == "nan") == !columns.contains(name));
      if (cell != "nan") CHECK(std::stod(cell) == doctest::Approx(columns[name].get<double>()));
      columns.erase(name);
    }
    CHECK(columns.empty());
  }
}

// Along y, between two different walls.
TEST_CASE("Accuracy tables: a run's means are those that a measurement has") {
  Scene scene;
  scene.box = Vec2(9.0, 8.0);
  scene.particles.count = 14;
  scene.particles.restitution = 0.8;
  scene.walls[kBottom] = Wall{.kind = WallKind::Thermal, .temperature = 2.0};
  scene.walls[kTop] = Wall{.kind = WallKind::Static, .restitution = 0.7};
  scene.contact_time = 0.1;
  scene.measure.cells = {2, 30};
  const Effort effort{.burn_in = 3.0, .duration = 20.0};
  const RunResult found = observe(scene, effort, 5);

  Measure measure = scene.measure;
  measure.burn_in = effort.burn_in;
  measure.fields = {Quantity::Density, Field(Quantity::Stress, 1, 1), Field(Quantity::HeatFlux, 1),
                    Quantity::Dissipation};
  measure.profile_axis = Axis::Y;
  const auto simulation = simulation_of<2>(scene, 5);
  Measurement<2> measurement(*simulation, measure, 23.0);
  simulation->run_until(23.0);
  const Measured measured = measurement.result();
  const auto column = [&](Field field, std::size_t k) {
    const double value = measured.profile->at(field)[k].mean;
    return std::isnan(value) ? 0.0 : value;
  };
  const auto mean = [&](Field field) {
    double sum = 0.0;
    for (std::size_t k = 0; k < 30; ++k) sum += column(field, k) / 30.0;
    return sum;
  };
  CHECK(found.time == 20.0);
  CHECK(found.events == static_cast<double>(measured.pair_collisions + measured.wall_collisions));
  CHECK(found.collision_rate == measured.collision_rate.mean);
  CHECK(found.elasticised_share ==
        static_cast<double>(measured.elasticised) / static_cast<double>(measured.pair_collisions));
  CHECK(found.means[kTemperature] == measured.temperature.mean);
  CHECK(found.means[kPressure] ==
        doctest::Approx(0.5 * (measured.pressure[kBottom]->mean + measured.pressure[kTop]->mean)));
  CHECK(found.means[kStress] == doctest::Approx(mean(Field(Quantity::Stress, 1, 1))));
  CHECK(found.means[kDissipation] == doctest::Approx(mean(Quantity::Dissipation)));
  // Sixty compared columns, two per column of the profile.
  for (std::size_t k = 0; k < 60; ++k) {
    CHECK(found.density[k] == column(Quantity::Density, k / 2));
    CHECK(found.heat_flux[k] == column(Field(Quantity::HeatFlux, 1), k / 2));
  }
}

TEST_CASE("Accuracy tables: biases are differences of runs of one seed, over the finest") {
  // Two replicas each, with numbers on a straight line.
  std::vector<RunResult> reference(2), replicas(2);
  for (int r : {0, 1}) {
    for (int k = 0; k < kComparedMeans; ++k) {
      reference[r].means[k] = 10.0 * (k + 1);
      replicas[r].means[k] = 10.0 * (k + 1) + (k + 1) * (r == 0 ? 1.0 : 3.0);
    }
    reference[r].density.fill(2.0);
    replicas[r].density.fill(2.0);
    reference[r].heat_flux.fill(-5.0);
    replicas[r].heat_flux.fill(-6.0);
    replicas[r].cpu_seconds = 1.0;
  }
  const Comparison comparison = compare(replicas, reference);
  for (const ComparedMean k : {kTemperature, kPressure, kStress, kDissipation}) {
    CAPTURE(k);
    CHECK(comparison.bias[k].mean == doctest::Approx(0.2));
    CHECK(comparison.bias[k].standard_error == doctest::Approx(0.1));
  }
  CHECK(comparison.bias[kHeatFlux].mean == doctest::Approx(0.2));
  CHECK(comparison.bias[kHeatFlux].standard_error == doctest::Approx(0.0));
  CHECK(comparison.bias[kDensityProfile].mean == 0.0);
  // Four of 0.2^2 - 0.1^2 + 0.1^2 * 2 s, one of 0.2^2, one of 0.
  CHECK(comparison.error == doctest::Approx(std::sqrt((4.0 * 0.05 + 0.04) / 6.0)));
}

// The root mean square bias is that of the products of different replicas.
TEST_CASE("Accuracy tables: the bias of a profile excludes the scatter of the replicas") {
  const auto bias_of = [](const std::array<double, 3>& densities) {
    std::vector<RunResult> reference(3), replicas(3);
    for (std::size_t r = 0; r < 3; ++r) {
      reference[r].density.fill(2.0);
      replicas[r].density.fill(densities[r]);
    }
    return compare(replicas, reference).bias[kDensityProfile];
  };
  // Relative differences .05, .1, .15: products .005, .0075, .015. Their jackknife error is
  // .0060093.
  const Estimate clear = bias_of({2.1, 2.2, 2.3});
  CHECK(clear.mean == doctest::Approx(std::sqrt(0.0275 / 3.0)));
  CHECK(clear.standard_error == doctest::Approx(0.5 * 0.0060093 / std::sqrt(0.0275 / 3.0)));
  // Relative differences -.05, .05, .1: the mean product is negative, the error the same.
  const Estimate hidden = bias_of({1.9, 2.1, 2.2});
  CHECK(hidden.mean == 0.0);
  CHECK(hidden.standard_error == doctest::Approx(std::sqrt(0.0060093)));
}

TEST_CASE("Accuracy tables: the limit of settings is relative to the reference") {
  std::vector<RunResult> reference(2);
  std::vector<std::vector<RunResult>> settings(2, std::vector<RunResult>(2));
  for (int r : {0, 1}) {
    const double scatter = r == 0 ? -1.0 : 1.0;
    for (int k = 0; k < kComparedMeans; ++k) {
      reference[r].means[k] = 10.0 + 0.5 * scatter;
      settings[0][r].means[k] = 15.0 + 0.1 * scatter;  // at 1
      settings[1][r].means[k] = 19.0 + 0.2 * scatter;  // at 3
    }
    reference[r].heat_flux.fill(-10.0 - 0.5 * scatter);
    settings[0][r].heat_flux.fill(-15.0 - 0.1 * scatter);
    settings[1][r].heat_flux.fill(-19.0 - 0.2 * scatter);
  }
  const Comparison comparison = compare_limit({1.0, 3.0}, settings, reference);
  for (int k = 0; k < kComparedMeans; ++k) {
    CAPTURE(k);
    CHECK(comparison.bias[k].mean == doctest::Approx(0.3));
    CHECK(comparison.bias[k].standard_error == doctest::Approx(std::hypot(0.15, 0.1, 0.5) / 10.0));
  }
  CHECK(std::isnan(comparison.bias[kDensityProfile].mean));
  CHECK(std::isnan(comparison.error));
}

TEST_CASE("Accuracy tables: a straight line is extrapolated to 0 by its errors") {
  // A line through (1, 5) and (3, 9): 3 at 0, with errors 1.5 * 0.1 and 0.5 * 0.2.
  const Estimate found = extrapolate(
      {1.0, 3.0}, {{.mean = 5.0, .standard_error = 0.1}, {.mean = 9.0, .standard_error = 0.2}});
  CHECK(found.mean == doctest::Approx(3.0));
  CHECK(found.standard_error == doctest::Approx(std::hypot(0.15, 0.1)));
}

}  // namespace clatter
