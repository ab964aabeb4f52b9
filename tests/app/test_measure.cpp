#include <doctest/doctest.h>

#include <algorithm>
#include <cmath>
#include <nlohmann/json.hpp>
#include <optional>

#include "tests/support/shell.h"

namespace clatter {

using nlohmann::json;

// Some 10,000 collisions: half a second.
static const std::string kMeasure =
    "clatter measure vibrated --set measure.burn_in=20 --until 120 ";

static double mean(const json& estimate) {
  CHECK(std::isfinite(estimate.at("mean").get<double>()));
  CHECK(estimate.at("standard_error").get<double>() > 0.0);
  return estimate.at("mean");
}

// The other keys are compared in test_results.cpp.
TEST_CASE("Measure: it prints one JSON object, with its seed, times and cost") {
  const Shell shell;
  const Outcome outcome = shell.run(kMeasure + "--seed 7");
  CAPTURE(outcome.err);
  REQUIRE(outcome.code == 0);
  const json result = json::parse(outcome.out);
  CHECK(result.at("seed") == 7);
  CHECK(result.at("scene").at("measure").at("burn_in") == 20.0);
  CHECK(result.at("time").at("burn_in") == 20.0);
  CHECK(result.at("time").at("measured").get<double>() == doctest::Approx(100.0));
  CHECK(result.at("events").at("disk_disk") > 1000);
  CHECK(mean(result.at("collision_rate")) ==
        doctest::Approx(result.at("events").at("disk_disk").get<double>() * 2 / 200 / 100));
  CHECK(std::abs(result.at("energy").at("ledger_residual").get<double>()) < 1e-12);
  // (1 - 7 phi/16)/(1 - phi)^2 with phi = pi/10.
  CHECK(result.at("theory").at("chi").get<double>() == doctest::Approx(1.8338).epsilon(1e-4));
  const json& series = result.at("temperature_series");
  REQUIRE(series.at("time").size() == 121);
  CHECK(series.at("time")[120] == 120.0);
  CHECK(series.at("translational")[0].get<double>() == doctest::Approx(1.0));
  CHECK(result.at("checks").at("deepest_overlap") < 1e-9);
  CHECK(result.at("checks").at("clock_steps_back") < 1e-9);
  CHECK(result.at("performance").at("cpu_seconds") > 0.0);
  CHECK(result.at("performance").at("collisions_per_second") > 0.0);
  CHECK(result.at("performance").at("peak_memory_bytes") > 1'000'000);
}

TEST_CASE("Measure: the result has the predictions of theory for a gas in a periodic box") {
  const Shell shell;
  struct Row {
    std::string scene, key;
    std::optional<double> value;
  };
  const std::string driven = "rough_driven --set measure.burn_in=0";
  for (const Row& row : {
           // Independently computed: 1630 disks in 80 x 80 with alpha = .7 (theory 6).
           Row{"cooling", "compressibility", 1.4848714567},
           {"cooling", "haff_rate", 0.164135655149},
           // alpha = .9, beta = .3, q = 1/2: by bisection of the energy transfers in collisions.
           {"rough_cooling", "temperature_ratio", 0.652744303614},
           // Kicks of 0.1 per component every 0.05, their mean removed: 0.01 (1 - 1/400) / 0.05.
           {driven, "bulk_drive_power", 0.1995},
           {driven, "temperature_driven", {}},  // friction has a limit
           {driven + " --set particles.friction=inf", "temperature_ratio", 0.25 / (1.0 - 0.5)},
           // No dissipation.
           {"equilibrium --set particles.restitution=1 --set measure.burn_in=0 "
            "--set 'bulk_drive={interval=1,kick_speed=1}'",
            "temperature_driven",
            {}},
           {"vibrated --set measure.burn_in=0", "compressibility", {}},
       }) {
    CAPTURE(row.scene);
    CAPTURE(row.key);
    const Outcome outcome = shell.run("clatter measure " + row.scene + " --quiet --until 5");
    CAPTURE(outcome.err);
    REQUIRE(outcome.code == 0);
    const json theory = json::parse(outcome.out).at("theory");
    REQUIRE(theory.contains(row.key) == row.value.has_value());
    if (row.value) CHECK(theory.at(row.key).get<double>() == doctest::Approx(*row.value));
  }
}

TEST_CASE(
    "Measure: the seed is 1 unless given; another seed changes the run, other averages do not") {
  const Shell shell;
  const auto hash = [&](const std::string& flags) {
    return json::parse(shell.run(kMeasure + flags).out).at("state_hash");
  };
  const json first = hash("--seed 1");
  CHECK(hash("") == first);
  CHECK(hash("--seed 2") != first);
  CHECK(hash("--set measure.fields=[] --set measure.series_interval=7") == first);
}

TEST_CASE("Measure: results and tables go into the files asked for") {
  const Shell shell;
  const Outcome outcome = shell.run(kMeasure + "--quiet --out r.json --csv tables");
  CHECK(outcome.code == 0);
  CHECK(outcome.out.empty());
  CHECK(outcome.err.empty());
  CHECK(shell.files() == std::vector<std::string>{"r.json", "tables"});
  CHECK(json::accept(shell.read("r.json")));
  CHECK(shell.run("ls tables").out == "maps.csv\nprofile.csv\ntemperature_series.csv\n");
}

TEST_CASE("Measure: a run can start from a saved state") {
  const Shell shell;
  REQUIRE(shell.run(kMeasure + "--quiet --out r.json --save-state end.csv").code == 0);
  CHECK(shell.read("end.csv").starts_with("x,y,vx,vy\n"));
  CHECK(std::ranges::count(shell.read("end.csv"), '\n') == 201);
  shell.run("mkdir from && cp end.csv from/start.csv");
  shell.write(
      "from/s.toml",
      "box.size = [20, 25]\nparticles.start = { layout = 'file', file = 'start.csv' }\n"
      "walls.left = { kind = 'driven', drive_speed = 1 }\nwalls.right = { kind = 'static' }\n"
      "measure.burn_in = 0\n");
  // The run is so short that no position changes by even the last bit.
  const std::string instant = " --quiet --until 1e-300 --save-state again.csv";
  for (const std::string scene : {"from/s.toml",
                                  "vibrated --set measure.burn_in=0 --set "
                                  "'particles.start={layout=\"file\",file=\"end.csv\"}'"}) {
    CAPTURE(scene);
    const Outcome outcome = shell.run("clatter measure " + scene + instant);
    CAPTURE(outcome.err);
    REQUIRE(outcome.code == 0);
    CHECK(json::parse(outcome.out).at("state_hash") ==
          json::parse(shell.read("r.json")).at("state_hash"));
    CHECK(shell.read("again.csv") == shell.read("end.csv"));
  }
  CHECK(says(shell.run("clatter check from/s.toml").out, "count = 200\n"));
}

TEST_CASE("Measure: where t_c makes most collisions elastic, a better one is advised") {
  const Shell shell;
  const Outcome frozen = shell.run(
      "clatter measure cooling --set collapse.contact_time=100 --set measure.burn_in=1 --until 20");
  CHECK(frozen.code == 0);
  // A thousandth of the time between collisions (theory 6.2), at phi = 0.2 and T = 0.98.
  CHECK(says(frozen.err, "a smaller value, for example 0.0008, restores the dissipation"));
  const Outcome usual = shell.run(
      "clatter measure cooling --set collapse.contact_time=1e-6 --set measure.burn_in=1 --until 5");
  CHECK(usual.code == 0);
  CHECK_FALSE(says(usual.err, "contact_time"));
  shell.write("pile.toml",
              "box.size = [10, 20]\nparticles = { count = 20, restitution = 0.5 }\n"
              "walls.bottom = { kind = 'static', restitution = 0.5 }\n"
              "walls.top = { kind = 'static' }\ngravity.acceleration = [0, -1]\n"
              "collapse.contact_time = 1e-2\nmeasure.burn_in = 20\n");
  const Outcome resting = shell.run("clatter measure pile.toml --until 40");
  CHECK(resting.code == 0);
  CHECK(says(resting.err, "a larger value, for example 0.1, makes the run faster"));
}

TEST_CASE("Measure: an interrupted measurement keeps its results so far") {
  const Shell shell;
  const std::string interrupted = "timeout --preserve-status -s INT 3 clatter measure vibrated ";
  SUBCASE("while it averages") {
    const Outcome outcome =
        shell.run(interrupted +
                  "--set measure.burn_in=1 --set measure.duration=1e6 --out r.json "
                  "--save-state end.csv");
    CHECK(outcome.code == 130);
    CHECK(std::ranges::count(shell.read("end.csv"), '\n') == 201);
    shell.run("rm end.csv");
    const json result = json::parse(shell.read("r.json"));
    const double measured = result.at("time").at("measured");
    CHECK(measured > 0.0);
    CHECK(measured < 1e6);
    CHECK(mean(result.at("temperature")) > 0.0);
  }
  SUBCASE("during the burn-in: no averages") {
    const Outcome outcome = shell.run(interrupted + "--set measure.burn_in=1e6 --out r.json");
    CHECK(outcome.code == 130);
    const json result = json::parse(shell.read("r.json"));
    CHECK(result.at("time").at("measured") == 0.0);
    CHECK(result.at("temperature_series").at("time").size() > 1);
    CHECK_FALSE(result.contains("temperature"));
    CHECK_FALSE(result.contains("energy"));
  }
  CHECK(shell.files() == std::vector<std::string>{"r.checkpoint", "r.json"});
}

TEST_CASE("Measure: it ends once its mean is as precise as asked, and says how precise") {
  const Shell shell;
  const std::string line = "clatter measure vibrated --set measure.fields=[] ";
  const Outcome enough = shell.run(line + "--accuracy 3%");
  REQUIRE(enough.code == 0);
  const json result = json::parse(enough.out);
  CHECK(result.at("accuracy").at("of") == "temperature");
  CHECK(result.at("accuracy").at("asked") == 0.03);
  const double reached = result.at("accuracy").at("reached");
  CHECK(reached <= 0.03);
  const json& temperature = result.at("temperature");
  CHECK(reached >= temperature.at("standard_error").get<double>() / mean(temperature));
  const double measured = result.at("time").at("measured");
  CHECK(measured >= 256.0);
  CHECK(measured < 2000.0);  // the duration of the scene
  CHECK(says(enough.err, "note: temperature = "));

  const Outcome more = shell.run(line + "--accuracy 0.01 --accuracy-of pressure.left --until 800");
  REQUIRE(more.code == 0);
  const json late = json::parse(more.out);
  CHECK(late.at("time").at("measured").get<double>() == doctest::Approx(300.0));
  CHECK(late.at("accuracy").at("reached") > 0.01);
  CHECK(late.at("accuracy").at("asked") == 0.01);
  CHECK(late.at("accuracy").at("of") == "pressure.left");
  // The error falls with the square root of the time after the burn-in.
  const double known = late.at("accuracy").at("reached");
  const std::string advice = "give about --until ";
  REQUIRE(says(more.err, advice));
  const double end = std::stod(more.err.substr(more.err.find(advice) + advice.size()));
  CHECK(end == doctest::Approx(500.0 + 300.0 * std::pow(known / 0.01, 2.0)).epsilon(0.05));

  check_refused(shell, line + "--accuracy 1% --accuracy-of pressure.top",
                {"no mean 'pressure.top'"});
  check_refused(shell, line + "--accuracy 100%", {"--accuracy"});
}

// At alpha = 0.9975 the dissipation balances the walls' energy for a gas of uniform density. It
// does not for a gas that is denser at the walls.
TEST_CASE("Measure: theory has no temperature for a gas that its walls heat without bound") {
  const Shell shell;
  const auto theory = [&](const std::string& settings) {
    const std::string line =
        "clatter measure vibrated --quiet --set measure.burn_in=0 --until 1 "
        "--set walls.left.restitution=1.05 --set walls.right.restitution=1.05 ";
    return json::parse(shell.run(line + settings).out).at("theory");
  };
  const json heated = theory("--set particles.restitution=1");
  CHECK(heated.at("epsilon_effective") < 0.0);
  CHECK_FALSE(heated.contains("temperature_simple"));
  const json layered = theory("--set particles.restitution=0.9975");
  CHECK(layered.at("epsilon_effective") > 0.0);
  CHECK(layered.contains("temperature_refined"));
  CHECK_FALSE(layered.contains("temperature_corrected"));
  // Zero gravity is equivalent to no gravity.
  CHECK(theory("--set gravity.acceleration=[0,0]").contains("psi"));
  CHECK_FALSE(theory("--set gravity.acceleration=[0,-1]").contains("psi"));
}

TEST_CASE("Measure: notes have the temperature of a result file, and tables without fields") {
  const Shell shell;
  const std::string line = "clatter measure vibrated --set measure.burn_in=5 --until 25 ";
  const std::string written = line + "--out a.json ";
  const std::string emptied = line + "--set measure.fields=[] ";
  const std::string mean = "note: temperature = ", empty = "measure.fields is empty";
  CHECK(says(shell.run(written).err, mean));
  CHECK_FALSE(says(shell.run(written + "--quiet").err, mean));
  for (const std::string flag : {"--csv tables", "--hdf5 a.h5"}) {
    CHECK(says(shell.run(emptied + flag).err, empty));
    CHECK_FALSE(says(shell.run(emptied + "--quiet " + flag).err, empty));
    CHECK_FALSE(says(shell.run(line + flag).err, empty));
  }
}

TEST_CASE("Measure: a gas that cools is reported as not stationary") {
  const Shell shell;
  const Outcome cooling = shell.run("clatter measure cooling --until 5");
  const std::string lower = "lower by ";
  REQUIRE(says(cooling.err, lower));
  const double drift = json::parse(cooling.out).at("checks").at("temperature_drift");
  CHECK(drift < -3.0);
  CHECK(std::stod(cooling.err.substr(cooling.err.find(lower) + lower.size())) ==
        doctest::Approx(-drift).epsilon(0.06));
  CHECK_FALSE(says(shell.run("clatter measure equilibrium --until 20").err, "stationary"));
}

TEST_CASE("Measure: progress is written to stderr as asked") {
  const Shell shell;
  const Outcome outcome = shell.run(
      "clatter measure vibrated --until 1e6 --progress json 2>told & pid=$!\n"
      "while [ ! -s told ] && kill -0 $pid; do sleep 0.05; done; kill -TERM $pid; wait $pid");
  CHECK(outcome.code == 130);
  const std::string told = shell.read("told");
  const json progress = json::parse(told.substr(0, told.find('\n')));
  CHECK(progress.at("until") == 1e6);
  CHECK(progress.at("time") > 0.0);
  CHECK(progress.at("done") < 1.0);
  CHECK(progress.at("seconds_left") > 0.0);
  CHECK(json::accept(outcome.out));
}

TEST_CASE("Measure: check predicts the memory that a measurement takes") {
  if (is_sanitized()) {
    MESSAGE("[skipped] a sanitizer takes several times the memory for itself");
    return;
  }
  const Shell shell;
  for (const std::string fields : {"\"balance\"", "\"density\"", "\"velocity\", \"balance\""}) {
    CAPTURE(fields);
    const std::string rest =
        " vibrated --set measure.cells=[400,400] --set measure.burn_in=0 "
        "--set measure.duration=4 --set 'measure.fields=[" +
        fields + "]' ";
    const std::string told = shell.run("clatter check" + rest).err;
    const std::string memory = "Memory: about ";
    REQUIRE(says(told, memory));
    const double megabytes = std::stod(told.substr(told.find(memory) + memory.size()));
    REQUIRE(shell.run("clatter measure --quiet --out r.json" + rest).code == 0);
    const double peak = json::parse(shell.read("r.json")).at("performance").at("peak_memory_bytes");
    // The number of parts of the run may be half of its maximum.
    CHECK(1e6 * megabytes < 1.5 * peak);
    CHECK(1e6 * megabytes > 0.7 * peak);
  }
}

}  // namespace clatter
