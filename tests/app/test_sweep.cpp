#include <doctest/doctest.h>

#include <cmath>
#include <map>
#include <nlohmann/json.hpp>
#include <sstream>

#include "tests/app/sweep_scene.h"

namespace clatter {

using nlohmann::json;

namespace {

// The table of a sweep, by column; the cells of a column by row.
std::map<std::string, std::vector<std::string>> read_csv(const std::string& text) {
  std::istringstream lines(text);
  std::string line;
  std::vector<std::string> names;
  std::map<std::string, std::vector<std::string>> columns;
  while (std::getline(lines, line)) {
    std::istringstream cells(line);
    std::vector<std::string> row;
    for (std::string cell; std::getline(cells, cell, ',');) row.push_back(cell);
    if (names.empty()) {
      names = row;
      continue;
    }
    REQUIRE(row.size() == names.size());
    for (std::size_t k = 0; k < names.size(); ++k) columns[names[k]].push_back(row[k]);
  }
  return columns;
}

json without_performance(json result) {
  result.erase("performance");
  return result;
}

}  // namespace

TEST_CASE("Sweep: each result is that of `clatter measure`, and the table has their means") {
  const Shell shell;
  write_sweep(shell);
  const Outcome sweep = shell.run("clatter sweep s.toml --out d");
  CAPTURE(sweep.err);
  REQUIRE(sweep.code == 0);
  CHECK(sweep.err == "sweep: 12 runs: 12 with result, 0 failed, 0 open\n");
  REQUIRE(shell.run("clatter sweep collect d").code == 0);
  const auto table = read_csv(shell.read("d/table.csv"));

  std::istringstream manifest(shell.read("d/manifest.jsonl"));
  const std::vector<std::string> restitutions = {"0.7", "0.95"}, temperatures = {"0.5", "2.0"};
  const std::vector<int> seeds = {4, 2, 9};
  int id = 0;
  for (std::size_t point = 0; point < 4; ++point) {
    std::vector<json> results;
    for (const int seed : seeds) {
      std::string line;
      REQUIRE(std::getline(manifest, line));
      const json run = json::parse(line);
      CHECK(run.at("id") == ++id);
      CHECK(run.at("seed") == seed);
      CHECK(run.at("set").at("particles.restitution") == restitutions[point / 2]);
      CHECK(run.at("set").at("walls.right.temperature") == temperatures[point % 2]);
      const Outcome alone = shell.run(
          "clatter measure a.toml --quiet --seed " + std::to_string(seed) +
          " --set measure.profile_axis=y --set particles.restitution=" + restitutions[point / 2] +
          " --set walls.right.temperature=" + temperatures[point % 2]);
      results.push_back(json::parse(alone.out));
      CHECK(without_performance(results.back()) ==
            without_performance(
                json::parse(shell.read("d/results/" + std::to_string(id) + ".json"))));
    }
    const auto cell = [&](const std::string& column) {
      CAPTURE(column);
      return std::stod(table.at(column).at(point));
    };
    CHECK(cell("particles.restitution") == std::stod(restitutions[point / 2]));
    CHECK(cell("walls.right.temperature") == std::stod(temperatures[point % 2]));
    CHECK(cell("replicas") == 3);
    CHECK(table.at("seeds").at(point) == "4 2 9");
    std::string hashes;
    double events = 0.0, measured = 0.0, overlap = 0.0;
    for (const json& result : results) {
      if (!hashes.empty()) hashes += ' ';
      hashes += result.at("state_hash").get<std::string>();
      events += result.at("events").at("disk_disk").get<double>();
      measured += result.at("time").at("measured").get<double>();
      overlap = std::max(overlap, result.at("checks").at("deepest_overlap").get<double>());
    }
    CHECK(table.at("state_hashes").at(point) == hashes);
    CHECK(cell("events.disk_disk") == events);
    CHECK(cell("time.measured") == doctest::Approx(measured));
    CHECK(cell("checks.deepest_overlap") == overlap);
    int means = 0;
    for (const auto& [name, column] : table) {
      const std::string suffix = "_standard_error";
      if (!name.ends_with(suffix)) continue;
      ++means;
      std::string mean_name = name.substr(0, name.size() - suffix.size());
      std::string place = mean_name;
      std::ranges::replace(place, '.', '/');
      place.insert(0, 1, '/');
      const json::json_pointer at(place);
      double sum = 0.0, squares = 0.0, blocked = 0.0;
      for (const json& result : results) {
        const double mean = result.at(at).at("mean");
        const double error = result.at(at).at("standard_error");
        sum += mean;
        squares += mean * mean;
        blocked += error * error;
      }
      CAPTURE(name);
      CHECK(cell(mean_name) == doctest::Approx(sum / 3));
      // The variance of the mean of three values.
      CHECK(cell(name) == doctest::Approx(std::sqrt((squares - sum * sum / 3) / 6)).epsilon(1e-6));
      CHECK(cell(mean_name + "_blocking_error") == doctest::Approx(std::sqrt(blocked) / 3));
    }
    // Temperature (3), kurtosis (2), collision rate, energy (3), pressure (4).
    CHECK(means == 13);
  }
}

TEST_CASE("Sweep: one replica has the error of its run, and JSON lines have the profiles") {
  const Shell shell;
  write_sweep(shell);
  shell.write("s.toml",
              "scene = \"a.toml\"\nseeds = [5]\n[axes]\n\"particles.count\" = [4, 6, 8]\n");
  REQUIRE(shell.run("clatter sweep s.toml --out d && clatter sweep collect d").code == 0);
  const auto table = read_csv(shell.read("d/table.csv"));
  CHECK_FALSE(table.contains("temperature_blocking_error"));
  std::vector<json> rows;
  std::istringstream lines(shell.read("d/table.jsonl"));
  for (const int id : {1, 2, 3}) {
    const json result = json::parse(shell.read("d/results/" + std::to_string(id) + ".json"));
    std::string line;
    REQUIRE(std::getline(lines, line));
    const json row = json::parse(line);
    CHECK(row.at("temperature_standard_error") == result.at("temperature").at("standard_error"));
    CHECK(row.at("pressure.top") == result.at("pressure").at("top").at("mean"));
    CHECK(row.at("profile") == result.at("profile"));
    CHECK(row.at("particles.count") == 2 + 2 * id);
    rows.push_back(row);
  }
  const Outcome outcome = shell.run(CLATTER_READERS "read_table.py d");
  CAPTURE(outcome.err);  // names a missing module, which ./run test installs
  REQUIRE(outcome.code == 0);
  const json read = json::parse(outcome.out);
  for (std::size_t point = 0; point < 3; ++point) {
    const json& row = rows.at(point);
    const json& columns = read.at("rows").at(point);
    for (const char* name : {"temperature", "energy.walls_in", "checks.deepest_overlap"}) {
      CAPTURE(name);
      CHECK(columns.at(name).get<double>() == doctest::Approx(row.at(name).get<double>()));
      CHECK(read.at("datasets").at(name).at(point) == row.at(name));
    }
    CHECK(columns.at("state_hashes") == row.at("state_hashes"));
    CHECK(read.at("datasets").at("state_hashes").at(point) == row.at("state_hashes"));
    for (const char* name : {"edges", "density", "standard_error/density"}) {
      CAPTURE(name);
      CHECK(read.at("datasets").at(std::string("profile/") + name).at(point) ==
            row.at("profile").at(json::json_pointer(std::string("/") + name)));
    }
  }
}

TEST_CASE("Sweep: more values add runs, and all other changes are refused") {
  const Shell shell;
  write_sweep(shell);
  REQUIRE(shell.run("clatter sweep s.toml --out d").code == 0);
  const Outcome before = shell.run("cd d/results && ls -i1 && cksum *");
  shell.run("sed -i 's/2.0\\]/2.0, 3.0]/; s/4, 2, 9/4, 2, 9, 8/' s.toml");
  const Outcome more = shell.run("clatter sweep s.toml --out d");
  CHECK(more.code == 0);
  CHECK(says(more.err, "sweep: 24 runs: 24 with result"));
  for (int id = 1; id <= 12; ++id) {
    const std::string name = std::to_string(id) + ".json";
    CHECK(says(before.out, shell.run("cd d/results && ls -i1 " + name).out));
  }
  // A shorter file removes nothing.
  shell.run("sed -i 's/, 3.0\\]/]/' s.toml");
  CHECK(says(shell.run("clatter sweep s.toml --out d").err, "24 runs: 24 with result"));

  const std::string text = shell.read("s.toml");
  for (const auto& [change, words] : std::vector<std::pair<std::string, std::string>>{
           {"sed -i 's/= \"y\"/= \"x\"/' s.toml", "other settings in [set]"},
           {"sed -i 's/\\[set\\]/until = 9\\n[set]/' s.toml", "another 'until'"},
           {"sed -i 's/\\[set\\]/accuracy = \"5%\"\\n[set]/' s.toml", "another 'accuracy'"},
           {"echo '\"particles.count\" = [5]' >> s.toml", "other axes"},
           {"sed -i 's/count = 8/count = 9/' a.toml", "another scene"}}) {
    shell.write("s.toml", text);
    REQUIRE(shell.run(change).code == 0);
    check_refused(shell, "clatter sweep s.toml --out d", {"d has runs with " + words});
  }
}

TEST_CASE("Sweep: a seed that is added with the axes in another order belongs to the same points") {
  const Shell shell;
  write_sweep(shell);
  REQUIRE(shell.run("clatter sweep s.toml --out d --quiet").code == 0);
  shell.run("sed -i '/restitution/{h;d}; $G; s/4, 2, 9/4, 2, 9, 8/' s.toml");
  CHECK(shell.read("s.toml").ends_with("2.0]\n\"particles.restitution\" = [0.7, 0.95]\n"));
  const Outcome more = shell.run("clatter sweep s.toml --out d && clatter sweep collect d");
  CAPTURE(more.err);
  REQUIRE(more.code == 0);
  CHECK(read_csv(shell.read("d/table.csv")).at("replicas") ==
        std::vector<std::string>{"4", "4", "4", "4"});
}

TEST_CASE("Sweep: the scene is beside the sweep file or in the gallery") {
  const Shell shell;
  write_sweep(shell);
  shell.run("mkdir in; mv s.toml in");
  check_refused(shell, "clatter sweep in/s.toml --out d",
                {"in/s.toml: the scene 'a.toml' is not in the folder of this file"});
  for (const std::string name : {"", "nothing"}) {
    shell.write("other.toml", "scene = \"" + name + "\"\n");
    check_refused(shell, "clatter sweep other.toml --out d",
                  {"other.toml: the scene '" + name + "': there is no such scene"});
  }
  CHECK(shell.run("mv a.toml in; clatter sweep in/s.toml --out d --quiet").code == 0);
}

TEST_CASE("Sweep: a single run is measured by hand, once") {
  const Shell shell;
  write_sweep(shell);
  shell.run("sed -i 's/duration = 30/duration = 1e6/' a.toml");
  shell.run("timeout -s INT 1 clatter sweep s.toml --out d --quiet");
  shell.run("sed -i 's/duration = 1e6/duration = 30/' d/scene.toml; rm d/runs/*.checkpoint");
  CHECK(shell.run("clatter sweep run d 2 11-12 --quiet").code == 0);
  CHECK(shell.run("ls d/results").out == "11.json\n12.json\n2.json\n");
  const std::string time = shell.run("stat -c %Y.%i d/results/2.json").out;
  CHECK(shell.run("clatter sweep run d 2").code == 0);
  CHECK(shell.run("stat -c %Y.%i d/results/2.json").out == time);
  const std::string run = "clatter sweep run d ";
  check_refused(shell, run + "13", {"d: there is no run 13; give a number from 1 to 12"});
  check_refused(shell, run + "5-3", {"ID: '5-3' is no run"});
  check_refused(shell, run + "''", {"ID: '' is no run"});
  // A long list of numbers costs no memory.
  const std::string limit = is_sanitized() ? "" : "ulimit -v 1000000; ";
  check_refused(shell, limit + run + "12-2147483647", {"there is no run 13"});
}

}  // namespace clatter
