#include <doctest/doctest.h>

#include <algorithm>
#include <cmath>
#include <nlohmann/json.hpp>
#include <regex>

#include "tests/app/shell.h"

namespace clatter {

using nlohmann::json;

TEST_CASE("Bench: the table of fields has a row for each estimator and one for the balances") {
  const Shell shell;
  const Outcome outcome = shell.run("clatter bench fields --duration 300 --json t.json");
  CAPTURE(outcome.err);
  REQUIRE(outcome.code == 0);
  CHECK(says(outcome.err, "300 time units"));
  CHECK(outcome.out.starts_with("estimator "));
  CHECK(std::ranges::count(outcome.out, '\n') == 10);
  const json table = json::parse(shell.read("t.json"));
  REQUIRE(table.size() == 9);
  CHECK(table[0].at("estimator") == "bare run");
  CHECK_FALSE(table[0].contains("variance"));
  for (std::size_t row = 1; row < 8; ++row) {
    const std::string name = table[row].at("estimator");
    CAPTURE(name);
    CHECK(says(outcome.out, "\n" + name + " "));
    const double cost = table[row].at("cost"), variance = table[row].at("variance");
    CHECK(cost > 0.0);
    CHECK(variance > 0.0);
    CHECK(table[row].at("cost_times_variance") > 0.0);
  }
  CHECK(table[8].at("estimator") == "balance");
  CHECK(table[8].at("cost") > 0.0);
  CHECK_FALSE(table[8].contains("variance"));
  // Thirty snapshots have less information than complete flights.
  CHECK(table[1].at("variance") == table[2].at("variance"));
  CHECK(table[7].at("variance") > table[2].at("variance"));
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
      CHECK(setting.at("bytes") > 1e3);
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
  const json table = json::parse(shell.read("t.json"));
  REQUIRE(table.size() == 30);
  CHECK(std::ranges::count(outcome.out, '\n') == 31);
  CHECK(table[0].at("feature") == "bare");
  for (const json& row : table) {
    CAPTURE(row.dump());
    CHECK(row.at("rate_over_bare") > 0.0);
  }
}

TEST_CASE("Bench: the table of render has the cost of each stage, for pictures of two sizes") {
  const Shell shell;
  for (const auto& [dimension, particles] : {std::pair("2", "disks"), {"3", "spheres"}}) {
    const Outcome outcome = shell.run("clatter bench render --count 500 --dimension " +
                                      std::string(dimension) + " --json table.json");
    CAPTURE(outcome.err);
    CHECK(outcome.code == 0);
    CHECK(outcome.err.starts_with("elastic " + std::string(particles)));
    CHECK(std::ranges::count(outcome.out, '\n') == 3);
    const json rows = json::parse(shell.read("table.json"));
    REQUIRE(rows.size() == 2);
    for (const json& row : rows) {
      CHECK(row["count"] == 500);
      for (const std::string stage : {"simulate", "snapshot", "draw", particles, "heatmap",
                                      "overlay", "read", "png", "x264"}) {
        CAPTURE(stage);
        CHECK(row[stage + "_milliseconds"].get<double>() > 0.0);
      }
    }
    CHECK(rows[0]["width"] == 1280);
    CHECK(rows[1]["width"] == 1920);
  }
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
    CHECK((is_sanitized() || row["bytes_per_disk"].is_null()));
  }
}

}  // namespace clatter
