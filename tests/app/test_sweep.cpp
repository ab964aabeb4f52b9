#include <doctest/doctest.h>

#include <cmath>
#include <map>
#include <nlohmann/json.hpp>
#include <sstream>

#include "tests/app/shell.h"
#include "tests/app/tables.h"

namespace clatter {

using nlohmann::json;

namespace {

// No symmetry: the walls differ, and gravity is oblique.
const std::string kScene = R"(
box.size = [9.0, 7.0]
particles = { count = 8, restitution = 0.9 }
gravity.acceleration = [0.03, -0.1]
measure = { burn_in = 2.0, duration = 30, fields = ["density"], cells = [3, 2] }
[walls.left]
kind = "driven"
drive_speed = 1.0
[walls.right]
kind = "thermal"
temperature = 0.7
[walls.bottom]
kind = "thermal"
temperature = 1.5
[walls.top]
kind = "static"
)";

const std::string kSweep = R"(scene = "a.toml"
seeds = [4, 2, 9]
[set]
"measure.profile_axis" = "y"
[axes]
"particles.restitution" = [0.7, 0.95]
"walls.right.temperature" = [0.5, 2.0]
)";

void write_sweep(const Shell& shell) {
  shell.write("a.toml", kScene);
  shell.write("s.toml", kSweep);
}

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
  const auto refused = [&](const std::string& change, const std::string& message) {
    shell.write("s.toml", text);
    REQUIRE(shell.run(change).code == 0);
    const Outcome outcome = shell.run("clatter sweep s.toml --out d");
    CHECK(outcome.code == 2);
    CHECK_MESSAGE(says(outcome.err, message), outcome.err);
  };
  refused("sed -i 's/= \"y\"/= \"x\"/' s.toml", "s.toml: d has runs with other settings in [set]");
  refused("sed -i 's/\\[set\\]/until = 9\\n[set]/' s.toml", "d has runs with another 'until'");
  refused("sed -i 's/\\[set\\]/accuracy = \"5%\"\\n[set]/' s.toml",
          "d has runs with another 'accuracy'");
  refused("echo '\"particles.count\" = [5]' >> s.toml", "d has runs with other axes");
  refused("sed -i 's/count = 8/count = 9/' a.toml", "d has runs with another scene");
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

TEST_CASE("Sweep: failed runs are listed with their reasons, and do not stop the others") {
  const Shell shell;
  // The collapse of a cooling gas, and a box that is too small for a combination of values.
  shell.write("s.toml", R"(scene = "equilibrium"
[set]
"measure.burn_in" = 0.0
"measure.duration" = 1000.0
[axes]
"particles.restitution" = [0.99, 0.1]
"particles.count" = [30, 300]
"box.size" = [[25.0, 25.0], [8.0, 8.0]]
)");
  const Outcome sweep = shell.run("clatter sweep s.toml --out d");
  CHECK(sweep.code == 1);
  CAPTURE(sweep.err);
  const std::string restitution = "particles.restitution=0.1 particles.count=300 ";
  CHECK(says(sweep.err, "sweep: 8 runs: "));
  CHECK(says(sweep.err, "  run 7 (" + restitution +
                            "box.size=[25.0, 25.0], seed 1) failed: "
                            "time does not advance beyond t = 0.88"));
  CHECK(says(sweep.err, "  run 8 (" + restitution + "box.size=[8.0, 8.0], seed 1) failed: "));
  CHECK(says(sweep.err, "300 particles do not fit into the box"));
  // Failures that would occur again are not repeated.
  const Outcome again = shell.run("clatter sweep s.toml --out d");
  CHECK(again.code == 1);
  CHECK(again.err == sweep.err.substr(sweep.err.find("sweep: 8 runs")));
  CHECK(says(shell.run("clatter sweep status d").err, "inelastic collapse"));
  CHECK(shell.run("clatter sweep run d 8").code == 2);
}

TEST_CASE("Sweep: interrupts and kills lose at most what was running") {
  const Shell shell;
  write_sweep(shell);
  shell.run("sed -i 's/duration = 30/duration = 9000/; s/count = 8/count = 30/' a.toml");
  REQUIRE(shell.run("clatter sweep s.toml --out calm --quiet && clatter sweep collect calm").code ==
          0);
  // An interrupt ends all processes, with checkpoints of the runs that have begun.
  Outcome interrupted;
  for (const char* delay : {"0.5", "2", "8"}) {
    interrupted = shell.run(std::string("timeout -s INT ") + delay +
                            " clatter sweep s.toml --out d --progress none; echo $?; ls d/runs");
    CHECK(interrupted.out.starts_with("124\n"));
    if (says(interrupted.out, ".checkpoint")) break;
  }
  CHECK(says(interrupted.out, ".checkpoint"));
  // Kills of the sweep and of single runs, at times without any pattern.
  for (const char* delay : {"0.13", "0.31", "0.07", "0.43", "0.23", "0.37"}) {
    shell.run(std::string("clatter sweep s.toml --out d --quiet & sleep ") + delay +
              "; kill -9 $! $(pgrep -P $!); wait");
  }
  const Outcome last = shell.run("clatter sweep s.toml --out d --quiet && clatter sweep collect d");
  CAPTURE(last.err);
  CHECK(last.code == 0);
  for (const char* table : {"table.csv", "table.jsonl", "table.h5"}) {
    CAPTURE(table);
    CHECK(shell.run("cmp calm/" + std::string(table) + " d/" + table).code == 0);
  }
  CHECK(shell.run("ls d/runs").out == "locks\n");
}

TEST_CASE("Sweep: a list of runs beyond the largest file of the system is an error") {
  const Shell shell;
  shell.write("s.toml", "scene = \"vibrated\"\nreplicas = 1000\n");
  const Outcome outcome = shell.run("ulimit -f 8; clatter sweep s.toml --out d --prepare");
  CHECK(outcome.code == 1);
  CHECK(says(outcome.err, "manifest.jsonl: File too large"));
  CHECK(shell.run("clatter sweep s.toml --out d --prepare && wc -l <d/manifest.jsonl").out ==
        "1000\n");
}

TEST_CASE("Sweep: a folder belongs to one sweep at a time") {
  const Shell shell;
  write_sweep(shell);
  shell.run("sed -i 's/duration = 30/duration = 1e6/' a.toml; mkdir other; touch other/file");
  const Outcome two = shell.run(
      "clatter sweep s.toml --out d --quiet & sleep 1; clatter sweep s.toml --out d; echo $?; kill "
      "$!; wait");
  CHECK(two.out == "2\n");
  CHECK(says(two.err, "--out: another sweep runs in d; wait for its end, or give another folder"));
  const Outcome other = shell.run("clatter sweep s.toml --out other");
  CHECK(other.code == 2);
  CHECK(says(other.err, "--out: other exists and is not the folder of a sweep; give another name"));
  const Outcome none = shell.run("clatter sweep status other");
  CHECK(none.code == 2);
  CHECK(says(none.err, "other: this is not the folder of a sweep; start one with `clatter sweep"));
}

TEST_CASE("Sweep: a folder that a killed sweep has begun is completed, and no file is replaced") {
  const Shell shell;
  write_sweep(shell);
  for (const char* begun : {"mkdir -p d/runs", "mkdir -p d/runs d/results && touch d/runs/locks",
                            "mkdir -p d/runs && touch d/runs/locks d/.scene.toml.17-0"}) {
    CAPTURE(std::string(begun));
    REQUIRE(shell.run(begun).code == 0);
    const Outcome outcome = shell.run("clatter sweep s.toml --out d --prepare");
    CHECK_MESSAGE(outcome.code == 0, outcome.err);
    shell.run("rm -r d");
  }
  shell.write("scene.toml", "# of the user\n");
  const Outcome outcome = shell.run("clatter sweep s.toml --out .");
  CHECK(outcome.code == 2);
  CHECK(says(outcome.err, "--out: . exists and is not the folder of a sweep; give another name"));
  CHECK(shell.read("scene.toml") == "# of the user\n");
}

TEST_CASE("Sweep: the start file of a scene is copied into the folder, and nowhere else") {
  const Shell shell;
  shell.write("a.toml", kScene);
  shell.write("s.toml", "scene = \"a.toml\"\n");
  REQUIRE(shell.run("clatter measure a.toml --quiet --until 3 --save-state x.csv").code == 0);
  shell.run(
      "mkdir -p in/sub up; mv a.toml s.toml in; cp x.csv in/sub/y.csv; cp x.csv in/table.csv");
  const auto sweep = [&](const std::string& start, const std::string& out) {
    shell.run("sed -i 's|^particles.*|particles = { start = { layout = \"file\", file = \"" +
              start + "\" } }|' in/a.toml");
    return shell.run("clatter sweep in/s.toml --out " + out + " --quiet");
  };
  const Outcome below = sweep("sub/y.csv", "d");
  CHECK_MESSAGE(below.code == 0, below.err);
  CHECK(shell.read("d/sub/y.csv") == shell.read("x.csv"));
  const Outcome beside = sweep("sub/../../x.csv", "up/d");
  CHECK(beside.code == 2);
  CHECK(says(beside.err, "the start file is not below the folder of the scene; copy it there"));
  const Outcome own = sweep("table.csv", "up/d");
  CHECK(own.code == 2);
  CHECK(says(own.err, "the folder of a sweep has its own \"table.csv\"; rename the start file"));
  CHECK(shell.run("ls up").out == "");
}

TEST_CASE("Sweep: a failure that can pass is repeated, and its record is removed") {
  const Shell shell;
  write_sweep(shell);
  REQUIRE(shell.run("clatter measure a.toml --quiet --until 3 --save-state x.csv").code == 0);
  shell.run(
      "sed -i \"s|^particles.*|particles.start = { layout = \\\"file\\\", file = "
      "\\\"$PWD/x.csv\\\" }|\" a.toml");
  REQUIRE(shell.run("clatter sweep s.toml --out d --prepare && mv x.csv y.csv").code == 0);
  CHECK(shell.run("clatter sweep run d 1-2").code == 2);
  const Outcome missing = shell.run("clatter sweep status d");
  CHECK(says(missing.err,
             "run 2 (particles.restitution=0.7 walls.right.temperature=0.5, seed 2) "
             "failed: "));
  CHECK(says(missing.err, "there is no file"));
  const Outcome found = shell.run("mv y.csv x.csv; clatter sweep s.toml --out d");
  CHECK(found.code == 0);
  CHECK(found.err == "sweep: 12 runs: 12 with result, 0 failed, 0 open\n");
  CHECK(shell.run("ls d/failed").out == "");
}

TEST_CASE("Sweep: a damaged checkpoint is named, and its run starts again without it") {
  const Shell shell;
  write_sweep(shell);
  REQUIRE(shell.run("clatter sweep s.toml --out d --prepare; echo x > d/runs/3.checkpoint").code ==
          0);
  const Outcome damaged = shell.run("clatter sweep s.toml --out d");
  CHECK(damaged.code == 1);
  CHECK(says(damaged.err,
             "d/runs/3.checkpoint: this is not a checkpoint; remove it, and start the "
             "sweep again\n"));
  const Outcome removed = shell.run("rm d/runs/3.checkpoint; clatter sweep s.toml --out d");
  CHECK(removed.code == 0);
  CHECK(removed.err == "sweep: 12 runs: 12 with result, 0 failed, 0 open\n");
}

TEST_CASE("Sweep: failures are printed with --quiet too") {
  const Shell shell;
  write_sweep(shell);
  shell.run("sed -i 's/seeds.*/accuracy = 0.1\\naccuracy_of = \"nothing\"/' s.toml");
  const Outcome outcome = shell.run("clatter sweep s.toml --out d --quiet");
  CHECK(outcome.code == 1);
  CHECK(says(outcome.err, "sweep: 4 runs: 0 with result, 4 failed, 0 open"));
  CHECK(says(outcome.err, "nothing"));
}

TEST_CASE("Sweep: a process without a result is named with the reason of its end") {
  const Shell shell;
  write_sweep(shell);
  shell.run("sed -i 's/duration = 30/duration = 9e6/' a.toml");
  // The failure of an earlier start does not count as the end of the run. The process has reported
  // its progress before it is killed.
  shell.run(
      "clatter sweep s.toml --out d --prepare; echo '{\"code\":1,\"reason\":\"old\"}' > "
      "d/failed/1.json");
  const Outcome killed = shell.run(
      "clatter sweep s.toml --out d --threads 1 --progress none & "
      "until pgrep -f \"sweep run $(pwd -P)/d \" > child; do sleep 0.05; done; sleep 2; "
      "kill -9 $(cat child); sleep 0.5; kill -TERM $(pgrep -f \"sweep run $(pwd -P)/d \"); sleep "
      "1.5; kill -INT $!; wait");
  CHECK_MESSAGE(killed.err ==
                    "clatter: run 1 (particles.restitution=0.7 walls.right.temperature=0.5, seed "
                    "4) has ended without a result: Killed\n"
                    "clatter: run 2 (particles.restitution=0.7 walls.right.temperature=0.5, seed "
                    "2) has ended without a result: it was interrupted\n"
                    "clatter: interrupted; the same command continues the sweep\n",
                killed.err);
  CHECK(shell.run("ls d/failed").out == "");
}

TEST_CASE("Sweep: a chart without points is refused, and series are the values of one column") {
  const Shell shell;
  write_sweep(shell);
  const auto refused = [&](const std::string& flags, const std::string& message) {
    const Outcome outcome = shell.run("clatter sweep plot d --out c.svg --x replicas " + flags);
    CHECK(outcome.code == 2);
    CHECK_MESSAGE(says(outcome.err, message), outcome.err);
    CHECK(shell.run("ls c.svg").code != 0);
  };
  REQUIRE(shell.run("clatter sweep s.toml --out d --prepare").code == 0);
  refused("--y temperature", "d: the sweep has no results; measure it with");
  REQUIRE(shell.run("clatter sweep s.toml --out d").code == 0);
  refused("--y temperature --by 'replicas*2'", "--by: the table has no column 'replicas*2'");
  const std::string empty = "d: the chart has no points; give columns of numbers";
  refused("--y program", empty);
  refused("--y temperature/0", empty);
  refused("--y 0*temperature --log", empty);
  CHECK(shell.run("clatter sweep plot d --out c.svg --x replicas --y temperature").code == 0);
}

TEST_CASE("Sweep: a folder that is removed during the sweep is not a success") {
  const Shell shell;
  write_sweep(shell);
  shell.run("sed -i 's/duration = 30/duration = 1e5/' a.toml");
  // The last process has ended before the sweep looks at the folder.
  const Outcome outcome = shell.run(
      "clatter sweep s.toml --out d --quiet --threads 1 & until ls d/results/1.json; do sleep "
      "0.01; "
      "done; rm -rf d; kill -INT $!; wait $!");
  CHECK(outcome.code == 2);
  CHECK(says(outcome.err, "d: this is not the folder of a sweep"));
}

TEST_CASE("Sweep: the scene is beside the sweep file or in the gallery") {
  const Shell shell;
  write_sweep(shell);
  shell.run("mkdir in; mv s.toml in");
  const Outcome elsewhere = shell.run("clatter sweep in/s.toml --out d");
  CHECK(elsewhere.code == 2);
  CHECK(says(elsewhere.err,
             "in/s.toml: the scene 'a.toml' is not in the folder of this file; give "
             "its path from there"));
  for (const std::string name : {"", "nothing"}) {
    shell.write("other.toml", "scene = \"" + name + "\"\n");
    check_refused(shell, "clatter sweep other.toml --out d",
                  {"other.toml: the scene '" + name + "': there is no such scene"});
  }
  CHECK(shell.run("mv a.toml in; clatter sweep in/s.toml --out d --quiet").code == 0);
}

TEST_CASE("Sweep: a batch script names any folder that Slurm can read") {
  const Shell shell;
  write_sweep(shell);
  const auto script = [&](const std::string& folder) {
    shell.run("clatter sweep s.toml --prepare --out " + folder);
    return shell.run("clatter sweep submit --slurm --dry-run " + folder);
  };
  CHECK(script("'a %a b'").code == 0);
  CHECK(says(shell.read("a %a b/slurm/job.sh"), "/a %%a b/slurm/%a.log\"\n"));
  const Outcome quotes = script("'a\"b'");
  CHECK(quotes.code == 2);
  CHECK(says(quotes.err, "a batch script cannot name this folder; rename it"));
}

TEST_CASE("Sweep: a folder can have the name of a flag") {
  const Shell shell;
  write_sweep(shell);
  const Outcome outcome = shell.run("clatter sweep s.toml --out=--quiet");
  CHECK(outcome.code == 0);
  CHECK(outcome.err == "sweep: 12 runs: 12 with result, 0 failed, 0 open\n");
}

TEST_CASE("Sweep: damaged and foreign files are named, and never counted") {
  const Shell shell;
  write_sweep(shell);
  shell.run("sed -i 's/seeds.*/seeds = [4, 2]/' s.toml");
  REQUIRE(shell.run("clatter sweep s.toml --out calm --quiet && clatter sweep collect calm").code ==
          0);
  const auto damaged = [&](const std::string& damage, const std::string& line) {
    REQUIRE(shell.run("rm -rf d; cp -r calm d; " + damage).code == 0);
    return shell.run(line);
  };
  const std::string start = "clatter sweep s.toml --out d", collect = "clatter sweep collect d";
  // Files that are no records of this sweep.
  for (const char* stranger :
       {"cp d/results/1.json d/results/01.json", "cp d/results/1.json d/results/-1.json",
        "mkdir d/failed/3.json", "echo '{\"code\":\"x\"}' > d/failed/3.json",
        "echo '{\"code\":3,\"reason\":\"x\"}' > d/failed/3.json"}) {
    CAPTURE(std::string(stranger));
    for (const char* first : {"true; ", "rm d/results/2.json; "}) {
      const Outcome outcome = damaged(first + std::string(stranger), start);
      CHECK(outcome.code == 0);
      CHECK(outcome.err == "sweep: 8 runs: 8 with result, 0 failed, 0 open\n");
      CHECK(shell.run(collect + " && cmp d/table.csv calm/table.csv").code == 0);
    }
  }
  // A manifest without all runs would give other settings to their results.
  const std::string advice = "restore the file, or start the sweep in another folder";
  for (const char* damage : {": > d/manifest.jsonl", "rm d/manifest.jsonl",
                             "rm d/manifest.jsonl d/results/*; echo > d/runs/2.checkpoint",
                             "rm d/results/*; echo '{}' > d/failed/99.json"}) {
    CAPTURE(std::string(damage));
    const Outcome outcome = damaged(damage, start);
    CHECK(outcome.code == 1);
    CHECK(says(outcome.err, "d/manifest.jsonl is damaged: it has no run "));
    CHECK(says(outcome.err, advice));
    CHECK(shell.run("cmp d/sweep.toml calm/sweep.toml").code == 0);
  }
  for (const char* damage :
       {"tac calm/manifest.jsonl > d/manifest.jsonl",
        "head -c 100 calm/manifest.jsonl > "
        "d/manifest.jsonl",
        "echo '{\"id\":\"1\"}' > d/manifest.jsonl", "sed -i 's/\"0.7\"/0.7/' d/manifest.jsonl"}) {
    CAPTURE(std::string(damage));
    const Outcome outcome = damaged(damage, "clatter sweep status d");
    CHECK(outcome.code == 1);
    CHECK(says(outcome.err, "d/manifest.jsonl is damaged: line "));
    CHECK(says(outcome.err, advice));
  }
  // A folder that cannot be read has an unknown number of runs.
  const Outcome unreadable = damaged("rm -r d/results; touch d/results", collect);
  CHECK(unreadable.code == 1);
  CHECK(says(unreadable.err, "cannot read d/results: Not a directory"));
  // Results.
  for (const char* damage : {"echo '{\"state_hash\":1}' > d/results/3.json",
                             "sed -i 's/\"profile\": *{/\"profile\":4, \"x\": {/' d/results/3.json",
                             "cp d/results/2.json d/results/3.json"}) {
    CAPTURE(std::string(damage));
    const Outcome outcome = damaged(damage, collect);
    CHECK(outcome.code == 1);
    CHECK_MESSAGE(says(outcome.err, "d/results/3.json"), outcome.err);
    CHECK_MESSAGE(says(outcome.err, "is damaged; remove it, and start the sweep again"),
                  outcome.err);
  }
}

TEST_CASE("Sweep: an empty result is measured again") {
  const Shell shell;
  write_sweep(shell);
  REQUIRE(shell.run("clatter sweep s.toml --out d --quiet && cp d/results/2.json whole").code == 0);
  shell.run(": >d/results/2.json");
  CHECK(says(shell.run("clatter sweep status d").err, " 0 failed, 1 open"));
  CHECK(shell.run("clatter sweep s.toml --out d --quiet").code == 0);
  CHECK(shell
            .run("for f in whole d/results/2.json; do sed '/performance/,$d' $f >$f.kept; done; "
                 "cmp whole.kept d/results/2.json.kept")
            .code == 0);
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
  const Outcome wrong = shell.run("clatter sweep run d 13");
  CHECK(wrong.code == 2);
  CHECK(says(wrong.err, "d: there is no run 13; give a number from 1 to 12"));
  CHECK(says(shell.run("clatter sweep run d 5-3").err, "ID: '5-3' is no run; give numbers"));
  CHECK(says(shell.run("clatter sweep run d ''").err, "ID: '' is no run; give numbers"));
  // A long list of numbers costs no memory.
  const std::string limit = is_sanitized() ? "" : "ulimit -v 1000000; ";
  CHECK(says(shell.run(limit + "clatter sweep run d 12-2147483647").err,
             "there is no run 13; give a number from 1 to 12"));
}

}  // namespace clatter
