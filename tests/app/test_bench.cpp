#include <doctest/doctest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdio>
#include <nlohmann/json.hpp>
#include <numbers>
#include <optional>
#include <regex>
#include <sstream>
#include <string>
#include <vector>

#include "app/bench/cores.h"
#include "app/bench/engine.h"
#include "app/bench/features.h"
#include "engine/scene/scene_file.h"
#include "tests/app/shell.h"

namespace clatter {

using nlohmann::json;

namespace {

// Checks that the last printed columns have the numbers of the JSON rows under `keys`, with these
// formats of printf. A dash or a blank stands for null or for an absent key.
void check_columns(const std::string& out, const json& rows, const std::string& heading,
                   const std::vector<std::pair<std::string, const char*>>& keys) {
  std::istringstream lines(out);
  std::string line;
  REQUIRE(std::getline(lines, line));
  CHECK(std::regex_replace(line, std::regex("^ +| +(?= )"), "") == heading);
  for (const json& row : rows) {
    REQUIRE(std::getline(lines, line));
    CAPTURE(line);
    CAPTURE(row.dump());
    std::string numbers;
    for (const auto& [key, format] : keys) {
      if (!row.contains(key)) continue;
      char text[64];
      if (row.at(key).is_null()) {
        std::snprintf(text, sizeof text, " -");
      } else {
        std::snprintf(text, sizeof text, format, row.at(key).get<double>());
      }
      numbers += text;
    }
    CHECK(std::regex_replace(line, std::regex(" +"), " ").ends_with(numbers));
  }
}

}  // namespace

TEST_CASE("Bench: the table of fields has a row for each estimator and one for the balances") {
  const Shell shell;
  const Outcome outcome = shell.run("clatter bench fields --duration 300 --json t.json");
  CAPTURE(outcome.err);
  REQUIRE(outcome.code == 0);
  CHECK(says(outcome.err, "300 time units"));
  CHECK(std::ranges::count(outcome.out, '\n') == 10);
  const json table = json::parse(shell.read("t.json"));
  REQUIRE(table.size() == 9);
  check_columns(outcome.out, table, "estimator cost ns/collision variance cost x variance",
                {{"cost", " %.3f"},
                 {"added_nanoseconds_per_collision", " %.1f"},
                 {"variance", " %.3e"},
                 {"cost_times_variance", " %.3e"}});
  CHECK(table[0].at("cost") == 1.0);
  CHECK(table[0].at("added_nanoseconds_per_collision") == 0.0);
  CHECK(table[0].at("estimator") == "bare run");
  CHECK_FALSE(table[0].contains("variance"));
  for (std::size_t row = 1; row < 8; ++row) {
    const std::string name = table[row].at("estimator");
    CAPTURE(name);
    CHECK(says(outcome.out, "\n" + name + " "));
    const double cost = table[row].at("cost"), variance = table[row].at("variance");
    CHECK(cost > 0.0);
    CHECK(variance > 0.0);
    CHECK(table[row].at("cost_times_variance") == doctest::Approx(cost * variance).epsilon(1e-12));
    // The collisions of a row are the same number n, and (cost - 1)/added is (time of the bare
    // run)/n.
    const double added = table[row].at("added_nanoseconds_per_collision");
    const double of_all_fields = table[1].at("added_nanoseconds_per_collision");
    const double cost_of_all_fields = table[1].at("cost");
    CHECK((cost - 1.0) * of_all_fields ==
          doctest::Approx((cost_of_all_fields - 1.0) * added).epsilon(1e-9));
  }
  CHECK(table[8].at("estimator") == "balance");
  CHECK(table[8].at("cost") > 0.0);
  CHECK_FALSE(table[8].contains("variance"));
  // Thirty snapshots have less information than complete flights, and all fields cost more than T.
  CHECK(table[1].at("estimator") == "exact, all fields");
  CHECK(table[2].at("estimator") == "exact");
  CHECK(table[7].at("estimator") == "snapshot 10");
  CHECK(table[1].at("variance") == table[2].at("variance"));
  CHECK(table[7].at("variance") > table[2].at("variance"));
  CHECK(table[1].at("cost") > table[2].at("cost"));
}

namespace {

const json& dial_of(const json& table, const std::string& name) {
  for (const json& dial : table.at("dials")) {
    if (dial.at("dial") == name) return dial.at("settings");
  }
  FAIL("no dial " << name);
  return table;
}

double bias(const json& setting, const std::string& quantity) {
  return setting.at("bias").at(quantity).at("mean");
}

double error(const json& setting, const std::string& quantity) {
  return setting.at("bias").at(quantity).at("standard_error");
}

}  // namespace

TEST_CASE("Bench: the table of accuracy compares each setting of a dial with the finest") {
  const Shell shell;
  shell.write("page.md", "before\n<!-- tables -->\nold\n<!-- end of tables -->\nafter\n");
  const Outcome outcome = shell.run(
      "clatter bench accuracy --duration 40 --dial contact_time --dial estimator "
      "--json t.json --csv t.csv --plot t.png --markdown page.md");
  CAPTURE(outcome.err);
  REQUIRE(outcome.code == 0);
  CHECK(says(outcome.err, "8 runs of each setting, seeds 1 to 8, of 40 time units"));
  const json table = json::parse(shell.read("t.json"));
  REQUIRE(table.at("dials").size() == 2);

  const json& contact_time = dial_of(table, "contact_time");
  REQUIRE(contact_time.size() == 7);
  CHECK(contact_time[0].at("setting") == "off");
  CHECK(contact_time[0].at("elasticised_share").is_null());
  // The finest t_c is none. With 8 runs, a deviation of 7 standard errors occurs once in 5000
  // numbers.
  CHECK(contact_time[1].at("bias").size() == 6);
  for (const auto& [quantity, off] : contact_time[1].at("bias").items()) {
    CAPTURE(quantity);
    CHECK(std::fabs(bias(contact_time[1], quantity)) <= 7.0 * error(contact_time[1], quantity));
  }
  CHECK(bias(contact_time[6], "temperature") > 0.5);
  CHECK(contact_time[6].at("elasticised_share") > 0.1);
  CHECK(contact_time[6].at("error") > 0.5);

  for (const json& dial : table.at("dials")) {
    for (const json& setting : dial.at("settings")) {
      CAPTURE(setting.at("setting"));
      CHECK(setting.at("cpu_seconds_per_time") > 1e-6);
      CHECK(setting.at("cpu_seconds_per_time") < 1.0);
      CHECK(setting.at("events_per_cpu_second") > 1e3);
      // The address sanitizer does not report the heap.
      if (!is_sanitized()) CHECK(setting.at("bytes") > 1e3);
      CHECK(setting.at("deepest_overlap") < 1e-9);
    }
  }

  // Snapshots do not change the run.
  const json& estimator = dial_of(table, "estimator");
  CHECK(bias(estimator[5], "temperature") == 0.0);
  CHECK(bias(estimator[5], "dissipation") == 0.0);
  CHECK(error(estimator[5], "stress") > error(estimator[1], "stress"));

  CHECK(std::ranges::count(shell.read("t.csv"), '\n') == 1 + 7 + 6);
  CHECK(shell.read("t.png").substr(1, 3) == "PNG");
  const std::string page = shell.read("page.md");
  CHECK(page.starts_with("before\n<!-- tables -->\n"));
  CHECK(page.ends_with("<!-- end of tables -->\nafter\n"));
  CHECK(says(page, "\n| off "));
  CHECK_FALSE(says(page, "\nold\n"));
  check_refused(shell, "clatter bench accuracy --dial colour",
                {"no dial 'colour'", "choose one of antialiasing, picture_size, "});
}

TEST_CASE("Bench: refusals of the table of accuracy name their cause") {
  const Shell shell;
  for (const std::string flag : {"--csv", "--json", "--plot", "--markdown"}) {
    const Outcome outcome = shell.run("clatter bench accuracy " + flag + " none/t");
    CAPTURE(outcome.err);
    CHECK(outcome.code != 0);
    CHECK(says(outcome.err, flag));
  }
  shell.write("lone.toml", "box.size = [9, 9]\nparticles.count = 1\n");
  const std::string refusal = shell.run("clatter bench accuracy lone.toml").err;
  CAPTURE(refusal);
  CHECK(says(refusal, "remove [[change]]"));
  CHECK(refusal.find("at least two disks") < refusal.find("choose another scene"));
}

TEST_CASE("Bench: a time-stepped gas is exact only in the limit of short steps") {
  const Shell shell;
  shell.write("elastic.toml",
              "box.size = [10, 10]\nparticles = { count = 40, restitution = 1.0 }\n"
              "walls.left = { kind = 'static' }\nwalls.right = { kind = 'static' }\n");
  const Outcome outcome = shell.run(
      "clatter bench accuracy elastic.toml --duration 100 --dial time_step --json t.json");
  CAPTURE(outcome.err);
  REQUIRE(outcome.code == 0);
  const json table = json::parse(shell.read("t.json"));
  const json& steps = dial_of(table, "time_step");
  CHECK(steps[0].at("deepest_overlap") < 1e-12);
  for (std::size_t k = 1; k < steps.size(); ++k) {
    // Collisions of elastic disks conserve energy at any time step.
    CHECK(std::fabs(bias(steps[k], "temperature")) < 1e-9);
    CHECK(steps[k].at("deepest_overlap") > steps[k - 1].at("deepest_overlap"));
    // The error excludes dissipation, which is zero in the exact gas.
    CHECK(steps[k].at("error").is_number());
  }
  CHECK_FALSE(says(outcome.out, "inf"));
  // 8 runs, as above, plus the remaining error at dt = 0.001 and 0.003.
  CHECK(std::fabs(bias(steps[2], "pressure")) < 7.0 * error(steps[2], "pressure") + 0.02);
  CHECK(std::fabs(bias(steps[2], "stress")) < 7.0 * error(steps[2], "stress") + 0.02);
  CHECK(bias(steps[6], "stress") < -0.1);
}

TEST_CASE("Bench: coarser pictures resemble the best one less" * doctest::test_suite("slow")) {
  const Shell shell;
  const Outcome outcome = shell.run(
      "clatter bench accuracy --duration 20 --dial antialiasing --dial picture_size "
      "--dial frame_rate --json t.json");
  CAPTURE(outcome.err);
  REQUIRE(outcome.code == 0);
  const json table = json::parse(shell.read("t.json"));
  for (const char* name : {"antialiasing", "picture_size", "frame_rate"}) {
    CAPTURE(name);
    const json& settings = dial_of(table, name);
    CHECK(settings.front().at("ssim") > 0.99);
    CHECK(settings.front().at("centre_error_pixels") < 0.3);
    for (std::size_t k = 1; k < settings.size(); ++k) {
      CHECK(settings[k].at("ssim") < settings[k - 1].at("ssim"));
      CHECK(settings[k].at("centre_error_pixels") > settings[k - 1].at("centre_error_pixels"));
      CHECK(settings[k].at("cpu_seconds_per_picture") > 0.0);
    }
  }
}

TEST_CASE("Bench: the table of features has a rate for each") {
  const Shell shell;
  const Outcome outcome = shell.run("clatter bench features --count 50 --json t.json");
  CAPTURE(outcome.err);
  REQUIRE(outcome.code == 0);
  CHECK(outcome.err.starts_with("50 disks, phi = 0.3; 7 rounds of 10000 collisions each"));
  const json table = json::parse(shell.read("t.json"));
  REQUIRE(table.size() == 33);
  CHECK(std::ranges::count(outcome.out, '\n') == 34);
  check_columns(outcome.out, table, "with Mcoll/s rate",
                {{"million_collisions_per_cpu_second", " %.3f"}, {"rate_over_bare", " %.3f"}});
  const std::vector<Feature> rows = features();
  REQUIRE(rows.size() == table.size());
  const double bare = table[0].at("million_collisions_per_cpu_second");
  for (std::size_t k = 0; k < table.size(); ++k) {
    const json& row = table[k];
    CAPTURE(row.dump());
    CHECK(row.at("feature") == rows[k].name);
    // A median of ratios, against the ratio of medians.
    const double rate = row.at("million_collisions_per_cpu_second");
    CHECK(rate > 0.0);
    CHECK(row.at("rate_over_bare") > 0.4 * rate / bare);
    CHECK(row.at("rate_over_bare") < 2.5 * rate / bare);
  }
  CHECK(table[0].at("feature") == "bare");
  CHECK(table[0].at("rate_over_bare") == 1.0);
}

TEST_CASE("Bench: each row of the table of features adds the feature of its name") {
  const std::vector<Feature> rows = features();
  const auto row = [&](const std::string& name) -> const Feature& {
    const auto found = std::ranges::find(rows, name, &Feature::name);
    REQUIRE_MESSAGE(found != rows.end(), name);
    return *found;
  };
  const auto scene = [&](const std::string& name) {
    Scene scene;
    row(name).add(scene);
    return scene;
  };
  const std::string bare = scene_to_toml(Scene{});
  for (const char* name :
       {"bare", "bare again", "fields exact", "fields exact, all", "fields snapshot 1", "balance",
        "60 frames a time unit", "checkpoint each round", "radial_distribution", "free_flights"}) {
    CAPTURE(name);
    CHECK(scene_to_toml(scene(name)) == bare);
  }

  // The keys of the scene that each feature sets.
  using Sides = std::array<std::optional<WallKind>, 4>;
  const auto sides = [&](const std::string& name) {
    Sides kinds;
    const Scene with = scene(name);
    for (std::size_t k = 0; k < kinds.size(); ++k) {
      if (with.walls[k]) kinds[k] = with.walls[k]->kind;
    }
    return kinds;
  };
  constexpr auto rigid = Wall{}.kind;
  CHECK(scene("inelastic").particles.restitution == 0.999);
  for (const char* name : {"inelastic, driven walls", "inelastic, moving walls"}) {
    const auto kind =
        name == std::string("inelastic, driven walls") ? WallKind::Driven : WallKind::Sawtooth;
    CHECK(scene(name).particles.restitution == 0.9);
    CHECK(sides(name) == Sides{kind, kind});
  }
  CHECK(scene("inelastic, moving walls").walls[kLeft]->stroke == 0.1);
  CHECK(scene("inelastic, moving walls").walls[kRight]->frequency == 5.0);
  CHECK(scene("inelastic, bulk drive").particles.restitution == 0.9);
  CHECK(scene("inelastic, bulk drive").bulk_drive.value().interval == 0.05);
  CHECK(scene("inelastic, bulk drive").bulk_drive.value().kick_speed == 0.12);
  for (const char* name :
       {"walls on four sides", "wall_hits, four walls", "wall_power, four walls"}) {
    CHECK(sides(name) == Sides{rigid, rigid, rigid, rigid});
  }
  CHECK(sides("gravity") == Sides{std::nullopt, std::nullopt, rigid, rigid});
  CHECK(scene("gravity").gravity.value()[0] == 0.0);
  CHECK(scene("gravity").gravity.value()[1] == -0.02);
  for (const char* name : {"rough", "spin_distribution, rough"}) {
    CHECK(std::isinf(scene(name).particles.roughness.friction.value()));
    CHECK(scene(name).particles.roughness.tangential_restitution == 1.0);
  }
  CHECK(scene("t_c").contact_time == 1e-6);
  CHECK(scene("t_c").particles.restitution == 0.999);

  // Measurements beside the run.
  CHECK(row("fields exact").fields == std::vector<Field>{Quantity::Temperature});
  CHECK_FALSE(row("fields exact").snapshots);
  CHECK(row("fields snapshot 1").fields == std::vector<Field>{Quantity::Temperature});
  CHECK(row("fields snapshot 1").snapshots == 1.0);
  CHECK(row("fields exact, all").fields.size() == 12);
  for (const Feature& feature : rows) {
    CAPTURE(feature.name);
    CHECK(feature.fields.empty() == !feature.name.starts_with("fields"));
    CHECK(feature.balance == (feature.name == "balance"));
    CHECK(feature.frames == (feature.name == "60 frames a time unit" ? 60.0 : 0.0));
    CHECK(feature.checkpoint == (feature.name == "checkpoint each round"));
  }
  CHECK(row("radial_distribution").observable == ObservableKind::RadialDistribution);
  CHECK(row("wall_power, four walls").observable == ObservableKind::WallPower);
  CHECK(row("wall_hits, four walls").observable == ObservableKind::WallHits);
  CHECK(row("spin_distribution, rough").observable == ObservableKind::SpinDistribution);
}

TEST_CASE("Bench: the table of render has the cost of each stage, for pictures of two sizes") {
  const Shell shell;
  for (const auto& [dimension, particles] :
       {std::pair<std::string, std::string>("2", "disks"), {"3", "spheres"}}) {
    const Outcome outcome = shell.run("clatter bench render --count 500 --dimension " + dimension +
                                      " --json table.json");
    CAPTURE(outcome.err);
    CHECK(outcome.code == 0);
    CHECK(outcome.err.starts_with("elastic " + particles));
    CHECK(std::ranges::count(outcome.out, '\n') == 3);
    const json rows = json::parse(shell.read("table.json"));
    REQUIRE(rows.size() == 2);
    std::string heading = "N size";
    std::vector<std::pair<std::string, const char*>> columns;
    for (const std::string& stage :
         std::vector<std::string>{"simulate", "snapshot", "draw", particles, "heatmap", "overlay",
                                  "read", "png", "x264", "veryfast"}) {
      heading += " " + stage;
      columns.emplace_back(stage + "_milliseconds", " %.2f");
    }
    check_columns(outcome.out, rows, heading, columns);
    for (const json& row : rows) {
      CHECK(row["count"] == 500);
      for (const auto& [stage, format] : columns) {
        CAPTURE(stage);
        CHECK(row[stage].get<double>() > 0.0);
      }
    }
    CHECK(says(outcome.out, "500   1280x720 "));
    CHECK(says(outcome.out, "500  1920x1080 "));
    CHECK(rows[0]["height"] == 720);
    CHECK(rows[1]["height"] == 1080);
    CHECK(rows[0]["width"] == 1280);
    CHECK(rows[1]["width"] == 1920);
  }
}

TEST_CASE("Bench: without ffmpeg the table of render leaves out the encoder and says so") {
  const Shell shell;
  const Outcome outcome =
      shell.run("c=$(command -v clatter); PATH=/none $c bench render --count 10 --json table.json");
  CAPTURE(outcome.err);
  CHECK(outcome.code == 0);
  CHECK(says(outcome.err, "without the columns of the encoder, which need ffmpeg"));
  CHECK(std::regex_search(outcome.out, std::regex("read +png\n")));
  const json rows = json::parse(shell.read("table.json"));
  REQUIRE(rows.size() == 2);
  CHECK(rows[0].contains("png_milliseconds"));
  CHECK_FALSE(rows[0].contains("x264_milliseconds"));
}

TEST_CASE("Bench: the table of the timeline has the time of jumps and the memory of the record") {
  const Shell shell;
  const Outcome outcome = shell.run("clatter bench timeline --count 20 --json t.json");
  CHECK(outcome.code == 0);
  const json rows = json::parse(shell.read("t.json"));
  REQUIRE(rows.size() == 1);
  check_columns(outcome.out, rows, "N median ms longest ms MB",
                {{"count", " %.0f"},
                 {"median_milliseconds", " %.2f"},
                 {"longest_milliseconds", " %.2f"},
                 {"record_megabytes", " %.2f"}});
  CHECK(rows[0]["count"] == 20);
  CHECK(rows[0]["median_milliseconds"] > 0.0);
  CHECK(rows[0]["longest_milliseconds"] >= rows[0]["median_milliseconds"]);
  // At least the states at the start and at the end: position, velocity, time and number.
  CHECK(rows[0]["record_megabytes"] >= 2e-6 * 20 * 48);
  CHECK(rows[0]["record_megabytes"] < 1.0);
}

TEST_CASE("Bench: the engine's table is the default, and one cell of it ends in its numbers") {
  // The memory of so few disks is within the noise of the program. A sanitizer adds memory.
  const std::regex cell(std::string(R"((?:^|\n) +100 +0\.300 +[.\d]+ +[.\d]+ +)") +
                        (is_sanitized() ? "[-\\d]+" : "-") + "\n$");
  const Shell shell;
  for (const std::string name : {"", " engine"}) {
    CAPTURE(name);
    const Outcome outcome =
        shell.run("clatter bench" + name + " --count 100 --area-fraction 0.3 --json cell.json");
    CHECK(outcome.code == 0);
    CHECK(std::regex_search(outcome.out, cell));
    const json row = json::parse(shell.read("cell.json"))[0];
    CHECK(row["count"] == 100);
    CHECK(row["area_fraction"] == 0.3);
    CHECK((is_sanitized() || row["bytes_per_disk"].is_null()));
    check_columns(outcome.out, json::array({row}), "N phi Mcoll/s setup s bytes/disk",
                  {{"count", " %.0f"},
                   {"area_fraction", " %.3f"},
                   {"million_collisions_per_cpu_second", " %.3f"},
                   {"setup_seconds", " %.3f"},
                   {"bytes_per_disk", " %.0f"}});
  }
}

TEST_CASE("Bench: the rows of the engine's table, by fraction and then by number") {
  using Cells = std::vector<EngineCell>;
  CHECK(engine_cells({}) == Cells{{1000, 0.1},
                                  {10000, 0.1},
                                  {100000, 0.1},
                                  {1000000, 0.1},
                                  {1000, 0.3},
                                  {10000, 0.3},
                                  {100000, 0.3},
                                  {1000000, 0.3},
                                  {1000, 0.5},
                                  {10000, 0.5},
                                  {100000, 0.5},
                                  {1000000, 0.5},
                                  {1000, 0.7},
                                  {10000, 0.7},
                                  {100000, 0.7},
                                  {1000000, 0.7}});
  CHECK(engine_cells({.dimension = 3, .volume_fraction = {}}) == Cells{{1372, 0.1},
                                                                       {10976, 0.1},
                                                                       {87808, 0.1},
                                                                       {1000000, 0.1},
                                                                       {1372, 0.3},
                                                                       {10976, 0.3},
                                                                       {87808, 0.3},
                                                                       {1000000, 0.3},
                                                                       {1372, 0.49},
                                                                       {10976, 0.49},
                                                                       {87808, 0.49},
                                                                       {1000000, 0.49}});
  CHECK(engine_cells({.count = 50, .area_fraction = 0.2, .volume_fraction = {}}) ==
        Cells{{50, 0.2}});
  CHECK(engine_cells({.count = 50, .volume_fraction = 0.3}) == Cells{{50, 0.3}});
}

TEST_CASE("Bench: a cell of the engine's table for spheres, with its memory") {
  const Shell shell;
  const Outcome outcome =
      shell.run("clatter bench engine --count 100000 --volume-fraction 0.2 --json cell.json");
  CAPTURE(outcome.err);
  REQUIRE(outcome.code == 0);
  CHECK(outcome.err.starts_with("elastic spheres, periodic box"));
  const json rows = json::parse(shell.read("cell.json"));
  REQUIRE(rows.size() == 1);
  check_columns(outcome.out, rows, "N phi Mcoll/s setup s bytes/sph.",
                {{"count", " %.0f"},
                 {"volume_fraction", " %.3f"},
                 {"million_collisions_per_cpu_second", " %.3f"},
                 {"setup_seconds", " %.3f"},
                 {"bytes_per_sphere", " %.0f"}});
  CHECK(rows[0]["count"] == 100'000);
  CHECK(rows[0]["volume_fraction"] == 0.2);
  CHECK(rows[0]["setup_seconds"] > 1e-3);
  if (!is_sanitized()) {
    CHECK(rows[0]["bytes_per_sphere"] > 200.0);
    CHECK(rows[0]["bytes_per_sphere"] < 500.0);
  }
}

TEST_CASE("Bench: a cell of the table of cores has the gas as a whole and in tiles") {
  const Shell shell;
  const Outcome outcome = shell.run(
      "clatter bench cores --count 100000 --area-fraction 0.25 --threads 3 --json cores.json");
  CAPTURE(outcome.err);
  REQUIRE(outcome.code == 0);
  CHECK(outcome.err.starts_with("elastic disks, periodic box"));
  const json rows = json::parse(shell.read("cores.json"));
  std::vector<int> threads;
  for (const json& row : rows) {
    threads.push_back(row["threads"]);
    CHECK(row["count"] == 100'000);
    CHECK(row["area_fraction"] == 0.25);
    const double rate = row["million_collisions_per_second"],
                 whole = rows[0]["million_collisions_per_second"];
    CHECK(rate > 0.0);
    CHECK(row["of_whole"].get<double>() == doctest::Approx(rate / whole).epsilon(1e-6));
    const bool tiles = row["threads"] > 0;
    if (!tiles) CHECK(row["busy"] == 1.0);
    CHECK((row["redundant"] > 0.0) == tiles);
    CHECK(row["redone"] < 0.5);
    // Halos are copied in each window, and windows are rarely run again.
    if (tiles) CHECK(row["redundant"] > row["redone"]);
    CHECK(row["busy"] <= 1.1);
  }
  CHECK(threads == std::vector<int>{0, 1, 2, 3});
  check_columns(outcome.out, rows, "N phi threads Mcoll/s of whole busy redundant redone",
                {{"million_collisions_per_second", " %.3f"},
                 {"of_whole", " %.2f"},
                 {"busy", " %.2f"},
                 {"redundant", " %.2f"},
                 {"redone", " %.3f"}});
  check_refused(shell, "clatter bench cores --count 2 --area-fraction 0.9",
                {"--area-fraction",
                 "no square box holds this number of disks at this fraction; choose a "
                 "smaller fraction, or another --count"});
}

TEST_CASE("Bench: the table of cores has large gases, up to the number asked for") {
  using Cells = std::vector<EngineCell>;
  const auto cells = [](int dimension, int count) {
    return cores_cells({.dimension = dimension, .count = count});
  };
  const Cells disks = {{100'000, 0.1}, {100'000, 0.3}, {100'000, 0.5}, {100'000, 0.7}};
  CHECK(cells(2, 100'000) == disks);
  CHECK(cells(3, 999'999) ==
        Cells{{100'000, 0.1}, {100'000, 0.3}, {100'000, 0.45}, {100'000, 0.7}});
  const Cells all = cells(2, 0);
  REQUIRE(all.size() == 12);
  for (std::size_t k = 0; k < all.size(); ++k) {
    CHECK(all[k].first == (k < 4 ? 1e5 : k < 8 ? 1e6 : 1e7));
    CHECK(all[k].second == disks[k % 4].second);
  }
}

TEST_CASE("Bench: the plot of cores names its gas and its axes") {
  const Plot plot = empty_cores_plot(2);
  CHECK(plot.title == "Collision rate on several threads");
  CHECK(plot.caption ==
        "Elastic disks in a periodic box; the smallest number of threads: the gas as a whole");
  CHECK(plot.x_name == "threads");
  CHECK(plot.y_name == "million collisions per second");
  CHECK(says(empty_cores_plot(3).caption, "Elastic spheres in"));
}

TEST_CASE("Bench: the plot of growth has the rates of each fraction over the number") {
  const Plot plot = growth_plot({{.count = 100, .fraction = 0.1, .rate = 2.346},
                                 {.count = 1000, .fraction = 0.1, .rate = 2.0},
                                 {.count = 100, .fraction = 0.7, .rate = 1.5}});
  CHECK(plot.title == "Collision rate of the engine");
  CHECK(plot.caption == "Elastic disks in a periodic box, one core, by area fraction phi");
  CHECK(plot.x_name == "number of disks");
  CHECK(plot.y_name == "million collisions per CPU second");
  REQUIRE(plot.panels.size() == 2);
  CHECK(plot.panels[0].title == "phi = 0.1");
  CHECK(plot.panels[1].title == "phi = 0.7");
  REQUIRE(plot.panels[0].points.size() == 2);
  CHECK(plot.panels[1].points.size() == 1);
  const PlotPoint& first = plot.panels[0].points[0];
  CHECK(first.x == 100.0);
  CHECK(first.y == 2.346);
  CHECK(first.label == "2.35");
}

TEST_CASE("Bench: a fraction that no box holds is refused under the flag that gave it") {
  const Shell shell;
  for (const std::string flag : {"--area-fraction 0.9", "--volume-fraction 0.74"}) {
    CAPTURE(flag);
    const Outcome outcome = shell.run("clatter bench engine --count 10 " + flag);
    CHECK(outcome.code == 2);
    CHECK(says(outcome.err, flag.substr(0, flag.find(' ')) +
                                ": no square or cubic box holds this number of particles"));
    CHECK(says(outcome.err, "choose a smaller fraction, or another --count"));
  }
}

TEST_CASE("Bench: the table of growth has the numbers and fractions of its limit" *
          doctest::test_suite("slow")) {
  const Shell shell;
  const Outcome outcome =
      shell.run("clatter bench growth --count 100 --json t.json --plot growth.png", 600);
  CAPTURE(outcome.err);
  REQUIRE(outcome.code == 0);
  const json rows = json::parse(shell.read("t.json"));
  std::vector<double> fractions;
  for (const json& row : rows) {
    if (!row.contains("gas")) {
      CHECK(row["count"] == 100);
      fractions.push_back(row["area_fraction"]);
    }
  }
  CHECK(fractions == std::vector{0.01, 0.1, 0.3, 0.5, 0.7});
  REQUIRE(rows.size() == fractions.size() + 2);
  const std::string table = outcome.out.substr(outcome.out.find("gas "));
  const json gases = json::array({rows[5], rows[6]});
  check_columns(table, gases, "gas N phi Mcoll/s of homog.",
                {{"count", " %.0f"},
                 {"area_fraction", " %.3f"},
                 {"million_collisions_per_cpu_second", " %.3f"},
                 {"of_homogeneous", " %.2f"}});
  for (const json& row : gases) {
    CHECK(row["count"] == 20'000);
    CHECK(row["area_fraction"].get<double>() == doctest::Approx(0.1).epsilon(1e-12));
  }
  CHECK(gases[0]["gas"] == "cooled into clusters");
  CHECK(gases[1]["gas"] == "collapsed under gravity");
  CHECK(shell.read("growth.png").starts_with("\x89PNG"));
}

TEST_CASE("Bench: one gas with clusters cools, the other falls on a floor") {
  const std::vector<Inhomogeneous> gases = inhomogeneous_gases(5000);
  REQUIRE(gases.size() == 2);
  for (const Inhomogeneous& gas : gases) {
    const Scene& scene = gas.scene;
    const bool falls = gas.name == std::string("collapsed under gravity");
    CAPTURE(gas.name);
    CHECK(scene.particles.count == 5000);
    const double area = scene.box[0] * scene.box[1];
    CHECK(5000 * 0.25 * std::numbers::pi / area == doctest::Approx(0.1).epsilon(1e-12));
    CHECK(scene.gravity.has_value() == falls);
    if (falls) CHECK((*scene.gravity)[1] == -0.2);
    CHECK(scene.particles.restitution == (falls ? 0.9 : 0.6));
    CHECK(scene.contact_time == 1e-6);
    CHECK(scene.walls[kBottom].has_value() == falls);
    CHECK(scene.walls[kTop].has_value() == falls);
    if (falls) CHECK(scene.walls[kBottom]->restitution == 0.9);
    if (falls) CHECK(scene.walls[kTop]->restitution == 1.0);
  }
}

}  // namespace clatter
