#include <doctest/doctest.h>

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <nlohmann/json.hpp>
#include <sstream>
#include <tuple>

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

TEST_CASE("Measure: it prints one JSON object, with everything that the scene has") {
  const Shell shell;
  const Outcome outcome = shell.run(kMeasure + "--seed 7");
  CAPTURE(outcome.err);
  REQUIRE(outcome.code == 0);
  const json result = json::parse(outcome.out);

  CHECK(result.at("schema") == 1);
  CHECK(result.at("seed") == 7);
  CHECK(result.at("program").get<std::string>().starts_with("clatter "));
  CHECK(result.at("scene").at("particles").at("count") == 200);
  CHECK(result.at("scene").at("measure").at("burn_in") == 20.0);
  CHECK(result.at("state_hash").get<std::string>().size() == 16);
  CHECK(result.at("time").at("burn_in") == 20.0);
  CHECK(result.at("time").at("measured").get<double>() == doctest::Approx(100.0));
  CHECK(result.at("events").at("disk_disk") > 1000);
  CHECK(result.at("events").at("disk_wall") > 100);

  const double t_x = mean(result.at("temperature_x")), t_y = mean(result.at("temperature_y"));
  CHECK(mean(result.at("temperature")) == doctest::Approx(0.5 * (t_x + t_y)));
  CHECK(t_x > t_y);  // the walls feed x
  CHECK(mean(result.at("kurtosis_excess_x")) > -1.0);
  CHECK(mean(result.at("kurtosis_excess_y")) > -1.0);
  CHECK(mean(result.at("collision_rate")) ==
        doctest::Approx(result.at("events").at("disk_disk").get<double>() * 2 / 200 / 100));

  const json& energy = result.at("energy");
  CHECK(mean(energy.at("walls_in")) > 0.0);
  CHECK(mean(energy.at("dissipated")) > 0.0);
  CHECK(std::abs(energy.at("ledger_residual").get<double>()) < 1e-12);
  CHECK(mean(result.at("pressure").at("left")) > 0.0);
  CHECK(mean(result.at("pressure").at("right")) > 0.0);
  // (1 - 7 phi/16)/(1 - phi)^2 with phi = pi/10.
  CHECK(result.at("theory").at("chi").get<double>() == doctest::Approx(1.8338).epsilon(1e-4));
  CHECK(result.at("theory").at("temperature_simple") > 0.0);
  CHECK(result.at("theory").at("temperature_refined") > 0.0);

  const json& series = result.at("temperature_series");
  REQUIRE(series.at("time").size() == 121);
  CHECK(series.at("translational").size() == 121);
  CHECK(series.at("time")[0] == 0.0);
  CHECK(series.at("time")[120] == 120.0);
  CHECK(series.at("translational")[0].get<double>() == doctest::Approx(1.0));

  const json& profile = result.at("profile");
  CHECK(profile.at("axis") == "x");
  REQUIRE(profile.at("edges").size() == 21);
  CHECK(profile.at("edges")[20] == 20.0);
  double disks = 0.0;
  for (const json& density : profile.at("density")) disks += density.get<double>() * 25.0;
  CHECK(disks == doctest::Approx(200.0));
  for (const char* key : {"density", "temperature_x", "temperature_y"}) {
    CAPTURE(key);
    CHECK(profile.at(key).size() == 20);
    CHECK(profile.at("standard_error").at(key).size() == 20);
  }

  CHECK(result.at("checks").at("deepest_overlap") < 1e-9);
  CHECK(result.at("checks").at("clock_steps_back") < 1e-9);
  CHECK(result.at("performance").at("cpu_seconds") > 0.0);
  CHECK(result.at("performance").at("collisions_per_second") > 0.0);
  CHECK(result.at("performance").at("peak_memory_bytes") > 1'000'000);
}

TEST_CASE("Measure: a result has only the parts of its scene") {
  const Shell shell;
  const json cooling =
      json::parse(shell.run("clatter measure cooling --until 5 --set measure.fields=[]").out);
  CHECK_FALSE(cooling.at("energy").contains("walls_in"));
  CHECK_FALSE(cooling.at("pressure").contains("left"));
  CHECK(cooling.at("pressure").contains("virial"));
  CHECK_FALSE(cooling.contains("profile"));
  CHECK_FALSE(cooling.at("theory").contains("psi"));
  CHECK_FALSE(cooling.contains("spin_temperature"));
}

TEST_CASE("Measure: the result has the predictions of theory for a gas in a periodic box") {
  const Shell shell;
  const auto theory = [&](const std::string& line) {
    const Outcome outcome = shell.run("clatter measure " + line + " --quiet --until 5");
    CAPTURE(outcome.err);
    REQUIRE(outcome.code == 0);
    return json::parse(outcome.out).at("theory");
  };
  // Independently computed: 1630 disks in 80 x 80 with alpha = .7 (theory 6).
  const json cooling = theory("cooling");
  CHECK(cooling.size() == 3);
  CHECK(cooling.at("compressibility").get<double>() == doctest::Approx(1.4848714567));
  CHECK(cooling.at("haff_rate").get<double>() == doctest::Approx(0.164135655149));
  // alpha = .9, beta = .3, q = 1/2: by bisection of the energy transfers in collisions.
  CHECK(theory("rough_cooling").at("temperature_ratio").get<double>() ==
        doctest::Approx(0.652744303614));

  // Kicks of 0.1 per component every 0.05, their mean removed: H = 0.01 (1 - 1/400) / 0.05.
  const json partial = theory("rough_driven --set measure.burn_in=0");
  CHECK(partial.at("bulk_drive_power").get<double>() == doctest::Approx(0.1995));
  CHECK_FALSE(partial.contains("temperature_driven"));  // friction has a limit
  const json driven = theory("rough_driven --set measure.burn_in=0 --set particles.friction=inf");
  CHECK(driven.at("temperature_ratio").get<double>() == doctest::Approx(0.25 / (1.0 - 0.5)));
  CHECK_FALSE(theory("equilibrium --set particles.restitution=1 "
                     "--set 'bulk_drive={interval=1,kick_speed=1}' --set measure.burn_in=0")
                  .contains("temperature_driven"));  // no dissipation
  CHECK_FALSE(theory("vibrated --set measure.burn_in=0").contains("compressibility"));
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
  const json result = json::parse(shell.read("r.json"));

  std::istringstream series(shell.read("tables/temperature_series.csv"));
  std::string line;
  std::getline(series, line);
  CHECK(line.starts_with("# units"));
  std::getline(series, line);
  CHECK(line == "time,temperature");
  for (std::size_t k = 0; k < 121; ++k) {
    double time = -1.0, temperature = -1.0;
    char comma = 0;
    REQUIRE(std::getline(series, line));
    std::istringstream(line) >> time >> comma >> temperature;
    CHECK(comma == ',');
    CHECK(time == result.at("temperature_series").at("time")[k]);
    CHECK(temperature == result.at("temperature_series").at("translational")[k]);
  }
  CHECK_FALSE(std::getline(series, line));

  const std::string profile = shell.read("tables/profile.csv");
  CHECK(says(profile, "\nx_low,x_high,density,density_error,"));
  CHECK(std::ranges::count(profile, '\n') == 22);
}

TEST_CASE("Measure: profiles have every field that was asked for, and no other") {
  const Shell shell;
  const auto profile = [&](const std::string& flags) {
    const Outcome outcome = shell.run(
        "clatter measure vibrated --set measure.burn_in=5 --until 30 --csv tables "
        "--set measure.cells=[10,5] " +
        flags);
    CAPTURE(outcome.err);
    REQUIRE(outcome.code == 0);
    return json::parse(outcome.out).at("profile");
  };
  const auto keys = [](const json& object) {
    std::vector<std::string> names;
    for (const auto& [key, value] : object.items()) names.push_back(key);
    return names;
  };
  const json all = profile(
      "--set 'measure.fields=[\"density\",\"velocity\",\"temperature\",\"stress\","
      "\"stress_kinetic\",\"stress_collisional\",\"heat_flux\",\"heat_flux_kinetic\","
      "\"heat_flux_collisional\",\"dissipation\",\"spin\",\"spin_temperature\"]' "
      "--set particles.friction=0.5");
  for (const char* key :
       {"density", "velocity_x", "velocity_y", "temperature", "temperature_x", "temperature_y",
        "stress_xx", "stress_yy", "stress_xy", "stress_xx_kinetic", "stress_xy_collisional",
        "heat_flux_x", "heat_flux_y", "heat_flux_x_kinetic", "heat_flux_y_collisional",
        "dissipation", "spin", "spin_temperature"}) {
    CAPTURE(key);
    REQUIRE(all.at(key).size() == 10);
    CHECK(all.at("standard_error").at(key).size() == 10);
    CHECK(all.at("standard_error").at(key)[4] > 0.0);
    CHECK(all.at(key)[4].is_number());
  }
  CHECK(all.at("stress_xx")[4].get<double>() ==
        doctest::Approx(all.at("stress_xx_kinetic")[4].get<double>() +
                        all.at("stress_xx_collisional")[4].get<double>()));
  const std::string table = shell.read("tables/profile.csv");
  CHECK(table.starts_with("# units"));
  CHECK(says(table, "heat_flux_x: m a/t^3"));
  CHECK(says(table, "\nx_low,x_high,density,density_error,velocity_x,"));
  CHECK(std::ranges::count(table, '\n') == 12);

  const json along_y = profile("--set 'measure.fields=[\"stress\"]' --set measure.profile_axis=y");
  CHECK(along_y.at("axis") == "y");
  CHECK(along_y.at("edges") == json({0.0, 5.0, 10.0, 15.0, 20.0, 25.0}));
  CHECK(keys(along_y) == std::vector<std::string>{"axis", "edges", "standard_error", "stress_xx",
                                                  "stress_xy", "stress_yy"});
  CHECK(says(shell.read("tables/profile.csv"), "\ny_low,y_high,stress_xx,"));

  const json snapshots = profile(
      "--set measure.estimator=snapshot --set measure.interval=0.5 "
      "--set measure.kernel=gaussian --set measure.width=2.5");
  double disks = 0.0;
  for (const json& density : snapshots.at("density")) disks += density.get<double>() * 50.0;
  CHECK(disks < 200.0);  // the remaining density is behind the walls
  CHECK(disks > 150.0);
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
  const double known = late.at("accuracy").at("reached");
  CHECK(late.at("accuracy").at("asked") == 0.01);
  CHECK(late.at("accuracy").at("of") == "pressure.left");
  double told_mean = 0.0, told_error = 0.0, time = 0.0, aim = 0.0, end = 0.0;
  REQUIRE(std::sscanf(more.err.substr(more.err.find("note: pressure")).c_str(),
                      "note: pressure.left = %lf, relative error %lf %% after %lf time units; for "
                      "%lf %%, give about --until %lf",
                      &told_mean, &told_error, &time, &aim, &end) == 5);
  CHECK(told_mean == doctest::Approx(mean(late.at("pressure").at("left"))).epsilon(1e-5));
  CHECK(told_error == doctest::Approx(100.0 * known).epsilon(0.01));
  CHECK(time == doctest::Approx(300.0));
  CHECK(aim == 1.0);
  // The error falls with the square root of the time after the burn-in.
  CHECK(end == doctest::Approx(500.0 + 300.0 * std::pow(known / 0.01, 2.0)).epsilon(0.05));

  check_refused(shell, line + "--accuracy 1% --accuracy-of pressure.top",
                {"no mean 'pressure.top'", "choose one of temperature, temperature_x, "});
  check_refused(shell, line + "--accuracy 100%", {"a share such as 1% or 0.01"});
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

TEST_CASE("Measure: where the result goes to a file, a note has the temperature") {
  const Shell shell;
  const std::string line =
      "clatter measure vibrated --set measure.burn_in=5 --until 25 --out a.json";
  const Outcome outcome = shell.run(line);
  CHECK(outcome.out.empty());
  const json temperature = json::parse(shell.read("a.json")).at("temperature");
  double mean = 0.0, error = 0.0, time = 0.0;
  REQUIRE(std::sscanf(outcome.err.c_str(),
                      "note: temperature = %lf +- %lf, averaged over %lf time units", &mean, &error,
                      &time) == 3);
  CHECK(time == 20.0);
  const double true_error = temperature.at("standard_error");
  CHECK(error == doctest::Approx(true_error).epsilon(0.05));
  CHECK(std::fabs(mean - temperature.at("mean").get<double>()) < 0.06 * true_error);
  CHECK_FALSE(says(shell.run(line + " --quiet").err, "temperature"));
  CHECK_FALSE(says(shell.run(line + " --accuracy 50%").err, "+-"));
}

TEST_CASE("Measure: tables without fields are noted") {
  const Shell shell;
  const char* kNote = "note: measure.fields is empty: no profile and no maps";
  const std::string line = "clatter measure cooling --until 1 --set measure.fields=[] ";
  for (const char* flag : {"--csv tables", "--hdf5 a.h5"}) {
    CHECK(says(shell.run(line + flag).err, kNote));
    CHECK_FALSE(says(shell.run(line + "--quiet " + flag).err, kNote));
  }
  CHECK_FALSE(says(shell.run("clatter measure vibrated --until 1 --csv maps").err, kNote));
}

TEST_CASE("Measure: averages continue over a change of a restitution, and restart over gravity") {
  const Shell shell;
  for (const std::string key : {"particles.restitution = 0.8", "gravity.acceleration = [0.1, 0]"}) {
    CAPTURE(key);
    shell.run("clatter check vibrated --quiet > s.toml");
    shell.write("change.toml", shell.read("s.toml") + "[[change]]\ntime = 3\nset." + key + "\n");
    const Outcome outcome =
        shell.run("clatter measure change.toml --set measure.burn_in=1 --until 6");
    CAPTURE(outcome.err);
    CHECK(outcome.code == 0);
    const bool restarts = key.starts_with("gravity");
    CHECK(says(outcome.err, "averages restart at t = 3\n") == restarts);
    CHECK(json::parse(outcome.out).at("time").at("burn_in") == (restarts ? 3.0 : 1.0));
  }
}

TEST_CASE("Measure: a gas that cools is reported as not stationary") {
  const Shell shell;
  const Outcome cooling = shell.run("clatter measure cooling --until 5");
  CHECK(says(cooling.err, "temperature is not stationary: in the second half"));
  CHECK(says(cooling.err, "lower by"));
  const double drift = json::parse(cooling.out).at("checks").at("temperature_drift");
  CHECK(drift < -3.0);
  const std::size_t at = cooling.err.find("lower by ");
  CHECK(std::stod(cooling.err.substr(at + 9)) == doctest::Approx(-drift).epsilon(0.06));
  const Outcome equilibrium = shell.run("clatter measure equilibrium --until 20");
  CHECK_FALSE(says(equilibrium.err, "stationary"));
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

TEST_CASE("Measure: spheres have a third axis, six walls, and maps with depth") {
  const Shell shell;
  shell.write("s.toml", R"(
      box.size = [6.0, 5.0, 4.0]
      particles = { count = 40, restitution = 0.9, friction = 0.3 }
      gravity.acceleration = [0.1, -0.3, 0.2]
      walls.left = { kind = "driven", drive_speed = 1.0 }
      walls.right = { kind = "static" }
      walls.bottom = { kind = "sinusoidal", stroke = 0.1, frequency = 1.0 }
      walls.top = { kind = "static" }
      walls.back = { kind = "thermal", temperature = 2.0 }
      walls.front = { kind = "static", restitution = 0.8 }
      [measure]
      burn_in = 10.0
      duration = 50.0
      fields = ["density", "velocity", "temperature", "stress", "balance"]
      cells = [3, 2, 4]
      profile_axis = "z")");
  REQUIRE(shell.run("clatter measure s.toml --quiet --out whole.json --csv tables").code == 0);
  const json result = json::parse(shell.read("whole.json"));
  const auto mean_at = [&](const std::string& pointer) {
    return result.at(json::json_pointer(pointer)).at("mean").get<double>();
  };
  CHECK(mean_at("/temperature") ==
        doctest::Approx(
            (mean_at("/temperature_x") + mean_at("/temperature_y") + mean_at("/temperature_z")) /
            3.0));
  CHECK(mean_at("/kurtosis_excess_z") > -1.0);
  CHECK(mean_at("/spin_temperature") > 0.0);
  // The forces of each pair of walls differ by the weight of the gas, per area of the wall.
  const double weight = 40.0;
  for (const auto& [near, far, share] : {std::tuple("left", "right", 0.1 / 20.0),
                                         {"bottom", "top", -0.3 / 24.0},
                                         {"back", "front", 0.2 / 30.0}}) {
    CAPTURE(near);
    const double difference =
        mean_at("/pressure/" + std::string(far)) - mean_at("/pressure/" + std::string(near));
    CHECK(difference == doctest::Approx(weight * share).epsilon(0.1));
  }
  CHECK(result.at("checks").at("deepest_overlap") < 1e-9);
  CHECK(result.at("balance").at("energy") < 1e-9);
  const json& profile = result.at("profile");
  CHECK(profile.at("edges") == json({0.0, 1.0, 2.0, 3.0, 4.0}));
  for (const char* name : {"velocity_z", "temperature_z", "stress_zz", "stress_xz", "stress_yz"}) {
    CHECK(profile.at(name).size() == 4);
  }
  // The density, 40 spheres in all, from the cells of the map.
  double spheres = 0.0;
  std::istringstream maps(shell.read("tables/maps.csv"));
  std::string line;
  std::getline(maps, line);
  std::getline(maps, line);
  CHECK(line.starts_with("x,y,z,density,"));
  for (int k = 0; k < 24; ++k) {
    std::getline(maps, line);
    double x, y, z, density;
    REQUIRE(std::sscanf(line.c_str(), "%lf,%lf,%lf,%lf", &x, &y, &z, &density) == 4);
    CHECK(x == doctest::Approx(2.0 * (k % 3) + 1.0));
    CHECK(y == doctest::Approx(2.5 * (k / 3 % 2) + 1.25));
    CHECK(z == doctest::Approx(1.0 * (k / 6) + 0.5));
    spheres += 5.0 * density;
  }
  CHECK(spheres == doctest::Approx(40.0).epsilon(1e-9));
  // A run in two parts is the same run.
  REQUIRE(shell.run("clatter measure s.toml --quiet --until 30 --checkpoint c --out a.json").code ==
          0);
  REQUIRE(shell.run("clatter measure s.toml --quiet --until 60 --resume c --out b.json").code == 0);
  CHECK(json::parse(shell.read("b.json")).at("state_hash") == result.at("state_hash"));
}

}  // namespace clatter
