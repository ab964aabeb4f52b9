#include <doctest/doctest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <nlohmann/json.hpp>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "app/bench/features.h"
#include "engine/scene/scene_file.h"
#include "tests/app/printed_columns.h"
#include "tests/support/shell.h"

namespace clatter {

using nlohmann::json;

TEST_CASE("Bench: the table of fields has a row for each estimator and one for the balances") {
  const Shell shell;
  const Outcome outcome = shell.run("clatter bench fields --duration 300 --json t.json");
  CAPTURE(outcome.err);
  REQUIRE(outcome.code == 0);
  const json table = json::parse(shell.read("t.json"));
  REQUIRE(table.size() == 9);
  check_columns(outcome.out, table, "estimator cost ns/collision variance cost x variance",
                {{"cost", " %.3f"},
                 {"added_nanoseconds_per_collision", " %.1f"},
                 {"variance", " %.3e"},
                 {"cost_times_variance", " %.3e"}});
  CHECK(table[0].at("cost") == 1.0);
  for (std::size_t row = 1; row < 8; ++row) {
    CAPTURE(row);
    const double cost = table[row].at("cost"), variance = table[row].at("variance");
    CHECK(cost > 0.0);
    CHECK(table[row].at("cost_times_variance") == doctest::Approx(cost * variance).epsilon(1e-12));
  }
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
      // `clatter measure` counts 140 collisions per time unit; a long t_c has more. The cost is
      // that of the fastest run, so the product may be smaller.
      const double per_time = setting.at("events_per_cpu_second").get<double>() *
                              setting.at("cpu_seconds_per_time").get<double>();
      CHECK(per_time < 1.6 * 140.0);
      CHECK(per_time > 0.2 * 140.0);
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

  CHECK(says(outcome.out, "overlap"));
  CHECK(std::ranges::count(shell.read("t.csv"), '\n') == 1 + 7 + 6);
  // Width and height in the header of the picture.
  CHECK(shell.read("t.png").substr(16, 8) == std::string("\0\0\x06\x40\0\0\x03\xe8", 8));
  const std::string page = shell.read("page.md");
  CHECK(page.starts_with("before\n<!-- tables -->\n"));
  CHECK(page.ends_with("<!-- end of tables -->\nafter\n"));
  CHECK(says(page, "\n| off "));
  CHECK_FALSE(says(page, "\nold\n"));
  check_refused(shell, "clatter bench accuracy --dial colour", {"no dial 'colour'"});
  const Outcome unwritable = shell.run("clatter bench accuracy --plot none/t");
  CHECK(unwritable.code != 0);
  CHECK(says(unwritable.err, "--plot"));
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

TEST_CASE("Bench: encodings of a film trade processor time for bytes" *
          doctest::test_suite("slow")) {
  const Shell shell;
  const Outcome outcome =
      shell.run("clatter bench accuracy --duration 20 --dial encoding --json t.json");
  CAPTURE(outcome.err);
  REQUIRE(outcome.code == 0);
  const json settings = dial_of(json::parse(shell.read("t.json")), "encoding");
  REQUIRE(settings.size() == 3);
  for (std::size_t k = 0; k < settings.size(); ++k) {
    CHECK(settings[k].at("ssim") > 0.98);
    CHECK(settings[k].at("ssim") < 1.0);
    if (k == 0) continue;
    CHECK(settings[k].at("bytes_per_second") > settings[k - 1].at("bytes_per_second"));
    CHECK(settings[k].at("cpu_seconds_per_picture") <
          settings[k - 1].at("cpu_seconds_per_picture"));
  }
}

TEST_CASE("Bench: the table of features has a rate for each") {
  const Shell shell;
  const Outcome outcome = shell.run("clatter bench features --count 50 --json t.json");
  CAPTURE(outcome.err);
  REQUIRE(outcome.code == 0);
  const json table = json::parse(shell.read("t.json"));
  REQUIRE(table.size() == 34);
  check_columns(outcome.out, table, "with Mcoll/s rate",
                {{"million_collisions_per_cpu_second", " %.3f"}, {"rate_over_bare", " %.3f"}});
  const double bare = table[0].at("million_collisions_per_cpu_second");
  for (const json& row : table) {
    CAPTURE(row.dump());
    // A median of ratios, against the ratio of medians.
    const double rate = row.at("million_collisions_per_cpu_second");
    CHECK(rate > 0.0);
    CHECK(row.at("rate_over_bare") > 0.4 * rate / bare);
    CHECK(row.at("rate_over_bare") < 2.5 * rate / bare);
  }
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

TEST_CASE("Bench: the table of render has the cost of each stage, without ffmpeg fewer stages") {
  const Shell shell;
  struct Row {
    std::string program, flags, particles;
    bool encoders = true;
  };
  for (const Row& row :
       {Row{"clatter", "--dimension 2", "disks"}, Row{"clatter", "--dimension 3", "spheres"},
        Row{"c=$(command -v clatter); PATH=/none $c", "", "disks", false}}) {
    CAPTURE(row.program);
    CAPTURE(row.flags);
    const Outcome outcome =
        shell.run(row.program + " bench render --count 500 --json t.json " + row.flags);
    CAPTURE(outcome.err);
    CHECK(outcome.code == 0);
    CHECK(says(outcome.err, "need ffmpeg") == !row.encoders);
    const json rows = json::parse(shell.read("t.json"));
    REQUIRE(rows.size() == 2);
    std::vector<std::string> stages = {"simulate", "snapshot", "draw", row.particles,
                                       "heatmap",  "overlay",  "read", "png"};
    if (row.encoders) stages.insert(stages.end(), {"fast", "balanced", "small"});
    std::string heading = "N size";
    std::vector<std::pair<std::string, const char*>> columns;
    for (const std::string& stage : stages) {
      heading += " " + stage;
      columns.emplace_back(stage + "_milliseconds", " %.2f");
      for (const json& picture : rows) {
        CHECK(picture[columns.back().first].get<double>() > 0.0);
      }
    }
    check_columns(outcome.out, rows, heading, columns);
    CHECK(rows[0].contains("balanced_milliseconds") == row.encoders);
    CHECK(rows[0]["height"] == 720);
    CHECK(rows[1]["width"] == 1920);
  }
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
  CHECK(rows[0]["longest_milliseconds"] >= rows[0]["median_milliseconds"]);
  // At least the states at the start and at the end: position, velocity, time and number.
  CHECK(rows[0]["record_megabytes"] >= 2e-6 * 20 * 48);
  CHECK(rows[0]["record_megabytes"] < 1.0);
}

}  // namespace clatter
