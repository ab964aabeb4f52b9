// Interrupted and resumed runs, with the command line.

#include <doctest/doctest.h>

#include <nlohmann/json.hpp>

#include "app/measure/measure_run.h"
#include "app/system/exit_code.h"
#include "engine/checkpoint/checkpoint.h"
#include "engine/error.h"
#include "tests/support/shell.h"

namespace clatter {

using nlohmann::json;

namespace {

json result_of(const Shell& shell, const std::string& name) {
  json result = json::parse(shell.read(name));
  result.erase("performance");
  return result;
}

// Most of a second of CPU time.
const std::string kLongRun =
    "clatter measure vibrated --set measure.burn_in=20 --until 6000 --quiet ";

}  // namespace

TEST_CASE("Resume: a measurement that was interrupted or killed ends in the same result") {
  const Shell shell;
  REQUIRE(shell.run(kLongRun + "--seed 7 --out whole.json --vtk whole").code == 0);
  for (const auto& [signal, code] : {std::pair{"TERM", 130}, std::pair{"KILL", 137}}) {
    REQUIRE(cut_off(shell, kLongRun + "--seed 7 --out part.json", signal).code == code);
    // The seed comes from the checkpoint.
    const Outcome outcome =
        shell.run(kLongRun + "--resume c --out resumed.json --vtk resumed; rm -f c c.previous");
    CAPTURE(outcome.err);
    CHECK(outcome.err.empty());
    CHECK(result_of(shell, "resumed.json") == result_of(shell, "whole.json"));
    CHECK(shell.run("diff -r whole resumed").code == 0);
  }
}

TEST_CASE("Resume: a measurement of an empty box of rough disks ends in the same result") {
  const Shell shell;
  const std::string line =
      "clatter measure vibrated --set particles.count=0 --set particles.friction=0.5 "
      "--set measure.burn_in=1 --until 4 --quiet ";
  REQUIRE(shell.run(line + "--out whole.json --checkpoint c").code == 0);
  REQUIRE(shell.run(line + "--out again.json --resume c").code == 0);
  CHECK(result_of(shell, "again.json") == result_of(shell, "whole.json"));
}

TEST_CASE("Resume: a mixture keeps its species, and its pairs unless they are set") {
  const Shell shell;
  const std::string species =
      "box.size = [9, 9]\n[[species]]\nname = \"a\"\ncount = 20\n[[species]]\nname = \"b\"\n"
      "count = 5\ndiameter = 1.5\n";
  shell.write("s.toml", species);
  shell.write("heavy.toml", species + "mass = 9\n");
  shell.write("pair.toml", species + "[[pair]]\nspecies = [\"a\", \"b\"]\nrestitution = 0.9\n");
  const std::string line = " --set measure.burn_in=1 --quiet ";
  REQUIRE(shell.run("clatter measure s.toml --until 4 --out a.json --checkpoint c" + line).code ==
          0);
  const std::string resume = " --until 6 --out b.json --resume c" + line;
  CHECK(shell.run("clatter measure s.toml" + resume).code == 0);
  const Outcome heavy = shell.run("clatter measure heavy.toml" + resume);
  CHECK(heavy.code == kWrongUse);
  CHECK(says(heavy.err, "species.b.density is 1.0 in the checkpoint and absent in the scene"));
  const Outcome pair = shell.run("clatter measure pair.toml" + resume);
  CHECK(pair.code == kWrongUse);
  CHECK(says(pair.err, "--set pair.a.b.restitution=0.9"));
  CHECK(shell.run("clatter measure s.toml --set pair.b.a.restitution=0.9" + resume).code == 0);
}

TEST_CASE("Resume: a measurement of a given accuracy ends in the same result") {
  const Shell shell;
  const std::string line = kLongRun + "--accuracy 0.5% ";
  REQUIRE(shell.run(line + "--out whole.json").code == 0);
  const json whole = result_of(shell, "whole.json");
  REQUIRE(whole.at("time").at("measured") < 5979.0);
  REQUIRE(cut_off(shell, line + "--out part.json", "KILL").code == 137);
  REQUIRE(shell.run(line + "--resume c --out resumed.json").code == 0);
  CHECK(result_of(shell, "resumed.json") == whole);
}

TEST_CASE("Resume: an interrupted run leaves a checkpoint beside its result and names it") {
  const Shell shell;
  const auto leaves = [&](const std::string& line, const std::string& file,
                          const std::string& signal = "TERM") {
    CAPTURE(line);
    const Outcome outcome = shell.run("timeout --preserve-status -s " + signal + " 1 " + line);
    CAPTURE(outcome.err);
    CHECK(outcome.code == 130);
    CHECK(says(outcome.err, "continue with --resume " + file + "\n"));
    CHECK_FALSE(shell.read(file).empty());
  };
  shell.run("mkdir folder && clatter check vibrated > folder/mine.toml");
  leaves("clatter measure vibrated --until 1e6 --out folder/r.json", "folder/r.checkpoint");
  leaves("clatter measure vibrated --until 1e6", "vibrated-seed1.checkpoint");
  shell.run("mkfifo pipe");
  leaves("clatter measure folder/mine.toml --until 1e6 --out pipe & cat pipe > piped; wait $!",
         "mine-seed1.checkpoint");
  CHECK(json::accept(shell.read("piped")));
  CHECK(shell.run("test -p pipe").code == 0);
  leaves("clatter measure vibrated --until 1e6 --checkpoint c", "c", "HUP");
  leaves("clatter render vibrated --size 64x64 --to 1e5 --out film.mp4", "film.checkpoint");
  leaves("clatter render vibrated --size 64x64 --to 1e5 --out frames/", "frames.checkpoint");
}

TEST_CASE("Resume: a picture has the averages, plots and gases from before its checkpoint") {
  const Shell shell;
  const std::string view =
      "clatter render vibrated --size 320x240 --quiet "
      "--set view.field=temperature --set view.window=5 "
      "--set 'view.plots=[\"temperature\"]' "
      "--compare particles.restitution=0.7 ";
  REQUIRE(shell.run(view + "--to 20 --out whole.png").code == 0);
  for (const std::string first :
       {"--to 17 --out first.png ", "--to 17 --fps 1 --out frames --overwrite "}) {
    CAPTURE(first);
    REQUIRE(shell.run("rm -f c; " + view + first + "--checkpoint c").code == 0);
    CHECK(shell.run(view + "--to 20 --out again.png --resume c && cmp again.png whole.png").code ==
          0);
  }
  // Another view has new averages, from the checkpoint on.
  const std::string other = view + "--set view.field=density --to 20 ";
  REQUIRE(shell.run(other + "--out other.png").code == 0);
  REQUIRE(shell.run(other + "--out new.png --resume c").code == 0);
  CHECK(shell.run("cmp -s other.png new.png").code == 1);
}

TEST_CASE("Resume: an interrupt is obeyed before the run, between windows, and while drawing") {
  // A fluid of a million disks, which starts from a lattice that melts slowly.
  const std::string many = "--set box.size=[1144,1144] --set particles.count=1000000";
  const std::string nothing = "interrupted before the run began; nothing was saved";
  struct Interrupt {
    std::string line, words;
    std::vector<std::string> files = {};
  };
  for (const auto& [line, words, files] :
       {Interrupt{"measure vibrated --out r.json " + many, nothing},
        Interrupt{"render vibrated --out a.png " + many, nothing},
        // However many windows a picture has.
        Interrupt{"render vibrated --out a.png --to 0.1 --set view.window=1e-8 "
                  "--set view.field=density",
                  "continue with --resume a.checkpoint",
                  {"a.checkpoint"}},
        // The picture has 16384 samples along a side, which takes seconds of CPU time.
        Interrupt{"render vibrated --to 0.1 --out a.png --size 4096x4096 --supersample 4",
                  "clatter: writing the checkpoint\nclatter: interrupted at t = 0.1; "
                  "continue with --resume a.checkpoint\n",
                  {"a.checkpoint"}}}) {
    CAPTURE(line);
    const Shell shell;
    const Outcome outcome = shell.run("timeout --preserve-status -s INT 1 clatter " + line);
    CAPTURE(outcome.err);
    CHECK(outcome.code == 130);
    CHECK(says(outcome.err, words));
    CHECK(shell.files() == files);
  }
}

TEST_CASE("Resume: only the end of a complete run can go without a checkpoint") {
  const Shell shell;
  MeasureOptions options;
  options.common.scene = "vibrated";
  options.common.until = 1.0;
  options.common.quiet = true;
  options.out = shell.path("r.json");
  options.checkpoints.file = shell.path("c");
  options.checkpoints.of_end = false;
  CHECK(measure(options) == kOk);
  CHECK(shell.files() == std::vector<std::string>{"r.json"});
  options.out = "/dev/full";
  CHECK_THROWS_WITH_AS(measure(options), doctest::Contains("continue with --resume"), RunError);
  CHECK(shell.files() == std::vector<std::string>{"c", "r.json"});
}

TEST_CASE("Resume: a run that is continued for longer equals one long run") {
  const Shell shell;
  const std::string line = "clatter measure vibrated --set measure.burn_in=20 --quiet ";
  CHECK(shell.run(line + "--until 60 --out a.json --checkpoint c").code == 0);
  CHECK(shell.run(line + "--until 120 --out b.json --resume c").code == 0);
  CHECK(shell.run(line + "--until 120 --out c.json").code == 0);
  const json resumed = result_of(shell, "b.json"), whole = result_of(shell, "c.json");
  CHECK(resumed.at("state_hash") == whole.at("state_hash"));
  CHECK(resumed.at("time").at("measured").get<double>() == doctest::Approx(100.0));
  CHECK(resumed.at("temperature_series") == whole.at("temperature_series"));
  CHECK(resumed.at("events") == whole.at("events"));
  check_refused(shell, line + "--until 59 --resume c",
                {"--until", "t = 60", "give a time after the checkpoint"});
  // The same state as after a kill between the last checkpoint and the results.
  CHECK(shell.run(line + "--until 60 --resume c --out d.json").code == 0);
  CHECK(result_of(shell, "d.json") == result_of(shell, "a.json"));
  // With other laws there are no averages to write.
  check_refused(shell, line + "--until 60 --resume c --set particles.restitution=0.8",
                {"--until", "t = 60", "give a time after the checkpoint"});
}

TEST_CASE("Resume: legs that end within the burn-in lead to the averages of one run") {
  const Shell shell;
  shell.run("clatter check vibrated --set measure.burn_in=20 --set measure.duration=40 > s.toml");
  const std::string line = "clatter measure s.toml --quiet ";
  REQUIRE(shell.run(line + "--out whole.json").code == 0);
  REQUIRE(shell.run(line + "--until 6 --out a.json --checkpoint c").code == 0);
  REQUIRE(shell.run(line + "--until 13 --out b.json --resume c --checkpoint d").code == 0);
  REQUIRE(shell.run(line + "--out resumed.json --resume d --checkpoint e").code == 0);
  CHECK(result_of(shell, "resumed.json") == result_of(shell, "whole.json"));
  // Legs have averages of their own.
  CHECK(result_of(shell, "a.json").at("time").at("burn_in") == 2.0);
  CHECK(result_of(shell, "a.json").at("time").at("measured") == doctest::Approx(4.0).epsilon(0.02));
  CHECK(result_of(shell, "b.json").at("time").at("burn_in") == 6.0);
  CHECK(result_of(shell, "b.json").at("temperature_series").at("time").size() == 14);
  // An interrupted leg continues with its own burn-in.
  REQUIRE(shell.run(line + "--until 6 --out a2.json --resume c").code == 0);
  CHECK(result_of(shell, "a2.json") == result_of(shell, "a.json"));
  check_refused(shell, line + "--resume e --until 90 --set measure.burn_in=50",
                {"e: ", "measure.burn_in", "--set measure.burn_in=20"});
}

TEST_CASE(
    "Resume: films continue from checkpoints of measurements, and measurements from those of "
    "films") {
  const Shell shell;
  const std::string render = "clatter render vibrated --size 64x64 --quiet ";
  CHECK(shell.run(render + "--to 30 --out whole.png").code == 0);
  CHECK(shell
            .run("clatter measure vibrated --set measure.burn_in=1 --until 25 --quiet --out r.json "
                 "--checkpoint c")
            .code == 0);
  CHECK(shell.run(render + "--to 30 --resume c --out resumed.png").code == 0);
  // The average of the field differs: it begins at the checkpoint.
  CHECK(shell.run(render + "--to 30 --set view.window=0.5 --out whole.png").code == 0);
  CHECK(shell.run(render + "--to 30 --set view.window=0.5 --resume c --out resumed.png").code == 0);
  CHECK(shell.read("resumed.png") == shell.read("whole.png"));
  check_refused(shell, render + "--to 20 --resume c --out x.png", {"--to", "25", "--resume"});
  check_refused(shell, render + "--from 20 --resume c --out x.png", {"--from", "25"});

  const Outcome film =
      shell.run(render + "--to 26 --resume c --fps 4 --speed 1 --out f/ --checkpoint d");
  CHECK(film.code == 0);
  CHECK(shell.run("ls f | wc -l").out == "4\n");
  const Outcome measured = shell.run(
      "clatter measure vibrated --set measure.burn_in=1 --until 40 --resume d --out m.json");
  CHECK(measured.code == 0);
  CHECK(says(measured.err, "averages restart at t = 25.75"));
  CHECK(result_of(shell, "m.json").at("time").at("burn_in") == 25.75);
}

TEST_CASE("Resume: laws may change at a checkpoint, and are named") {
  const Shell shell;
  const std::string line = "clatter measure vibrated --set measure.burn_in=1 ";
  REQUIRE(shell.run(line + "--until 5 --checkpoint c --out a.json").code == 0);
  const Outcome outcome = shell.run(line +
                                    "--until 9 --resume c --set particles.restitution=0.8 "
                                    "--set walls.left.drive_speed=2 --set view.speed=7");
  CHECK(outcome.code == 0);
  CHECK(
      says(outcome.err, "laws changed at t = 5: particles.restitution, walls.left.drive_speed\n"));

  // Another seed or another scene would be another run, with its own checkpoint.
  check_refused(shell, line + "--until 9 --resume c --seed 3", {"c: ", "the seed 1; omit --seed"});
  shell.run("clatter check vibrated --set walls.right.restitution=0.5 > other.toml");
  check_refused(shell, "clatter measure other.toml --set measure.burn_in=1 --until 9 --resume c",
                {"c: walls.right.restitution is 1.0 in the checkpoint and 0.5 in the scene",
                 "--set walls.right.restitution=0.5"});

  // A flight is booked at its end. Averages therefore cannot include two gravities.
  const Outcome fallen =
      shell.run(line + "--until 9 --resume c --set gravity.acceleration=[0.1,0]");
  CHECK(fallen.code == 0);
  CHECK(says(fallen.err, "laws changed at t = 5: gravity.acceleration\n"));
  CHECK(says(fallen.err, "averages restart at t = 5\n"));
  CHECK(json::parse(fallen.out).at("time").at("burn_in") == 5.0);
}

// A wall with another motion restarts flights. A wall with another gain does not.
TEST_CASE(
    "Resume: averages continue if a wall changes its gain, and restart if it moves differently") {
  const Shell shell;
  const std::string line =
      "clatter measure vibrated --set measure.burn_in=1 --set 'walls.left={kind=\"sawtooth\","
      "stroke=0.1,frequency=2}' ";
  REQUIRE(shell.run(line + "--until 5 --checkpoint c --out a.json").code == 0);
  for (const auto& [change, burn_in] :
       {std::pair{"left.stroke=0.05", 5.0}, std::pair{"left.frequency=3", 5.0},
        std::pair{"left.phase=0.5", 5.0}, std::pair{"left.kind=sinusoidal", 5.0},
        std::pair{"right.restitution=0.5", 1.0}, std::pair{"left.restitution=0.9", 1.0}}) {
    CAPTURE(change);
    const Outcome outcome = shell.run(line + "--until 9 --resume c --set walls." + change);
    CAPTURE(outcome.err);
    CHECK(outcome.code == 0);
    CHECK(says(outcome.err, "averages restart at t = 5\n") == (burn_in == 5.0));
    CHECK(json::parse(outcome.out).at("time").at("burn_in") == burn_in);
  }
}

TEST_CASE("Resume: a run stopped by an impossible change of a wall continues with another change") {
  const Shell shell;
  const auto write_change_at = [&](const std::string& time) {
    shell.write("s.toml",
                "box.size = [12, 10]\nparticles = { count = 60, restitution = 0.9 }\n"
                "walls.left = { kind = 'sawtooth', stroke = 0.5, frequency = 1 }\n"
                "walls.right = { kind = 'thermal', temperature = 1.5 }\nmeasure.burn_in = 1\n"
                "[[change]]\ntime = " +
                    time + "\nset = { 'walls.left.stroke' = 4 }\n");
  };
  const std::string line = "clatter measure s.toml --until 11.2 --out r.json ";
  write_change_at("10.75");
  for (const std::string resume : {"", "--resume r.checkpoint"}) {
    const Outcome stopped = shell.run(line + resume);
    CAPTURE(stopped.err);
    CHECK(stopped.code == 3);
    CHECK(says(stopped.err, "the change of walls.left at t = 10.75 moves a wall into a particle"));
    CHECK(says(stopped.err, "at its rest position, as at t = 11.0001"));
  }
  write_change_at("11.0001");
  CHECK(shell.run(line + "--resume r.checkpoint").code == 0);
}

TEST_CASE("Resume: a run continues without the file of its start state") {
  const Shell shell;
  shell.run("clatter measure vibrated --until 501 --out r.json --save-state start.csv --quiet");
  shell.write("s.toml",
              "particles = { start = { layout = 'file', file = 'start.csv' }, restitution = 0.9 }\n"
              "walls.left = { kind = 'static' }\nwalls.right = { kind = 'static' }\n"
              "measure.burn_in = 1\n");
  REQUIRE(shell.run("clatter measure s.toml --until 20 --out whole.json").code == 0);
  REQUIRE(shell.run("clatter measure s.toml --until 10 --out part.json --checkpoint c").code == 0);
  shell.run("rm start.csv");
  const Outcome outcome = shell.run("clatter measure s.toml --until 20 --out on.json --resume c");
  CAPTURE(outcome.err);
  CHECK(outcome.code == 0);
  const json resumed = result_of(shell, "on.json"), whole = result_of(shell, "whole.json");
  CHECK(resumed.at("state_hash") == whole.at("state_hash"));
  CHECK(resumed.at("scene") == whole.at("scene"));
  // The temperature comes from the file.
  CHECK(resumed.at("theory").at("haff_rate") == whole.at("theory").at("haff_rate"));
  check_refused(shell, "clatter measure s.toml --until 20 --resume c --set particles.count=7",
                {"c: ", "particles.count is 200 in the checkpoint and 7 in the scene"});
}

// The checks of a run are part of its checkpoint, so that a checkpoint can represent a run with an
// overlap.
TEST_CASE("Resume: a picture of disks that overlapped is written, and the run fails") {
  const Shell shell;
  REQUIRE(shell.run("clatter measure vibrated --until 501 --checkpoint c --out r.json").code == 0);
  Checkpoint checkpoint = read_checkpoint(shell.path("c"));
  for (const auto& [overlap, code] : {std::pair{0.5e-9, 0}, std::pair{2e-9, 3}}) {
    CAPTURE(overlap);
    std::get<RunState<2>>(checkpoint.saved).checks.deepest_overlap = overlap;
    write_checkpoint(shell.path("c"), checkpoint);
    const Outcome outcome = shell.run(
        "rm -f x.png; clatter render vibrated --size 64x64 --quiet --to 502 --resume c --out "
        "x.png");
    CAPTURE(outcome.err);
    CHECK(outcome.code == code);
    CHECK(says(outcome.err, "particles overlapped by 2e-09 diameters") == (code == 3));
    CHECK_FALSE(shell.read("x.png").empty());
  }
}

TEST_CASE("Resume: a checkpoint that does not fit is refused") {
  const Shell shell;
  const std::string line = "clatter measure vibrated --set measure.burn_in=1 --until 9 --resume c ";
  check_refused(shell, line, {"c: ", "there is no such file"});
  REQUIRE(shell
              .run("clatter measure vibrated --set measure.burn_in=1 --until 5 --checkpoint c "
                   "--out a.json")
              .code == 0);
  for (const auto& [flags, words] : std::vector<std::pair<std::string, std::string>>{
           {"particles.count=201", "particles.count is 200 in the checkpoint and 201 in the scene"},
           {"box.size=[20,26]", "box.size"},
           {"walls.top.kind=static --set walls.bottom.kind=static", "walls.bottom.kind is absent"},
           {"measure.burn_in=2", "--set measure.burn_in=1"},
           {"measure.cells=[7,7]", "measure.cells"},
           {"'measure.fields=[\"density\"]'", "measure.fields"}}) {
    check_refused(shell, line + "--set " + flags, {"c: ", words});
  }
  CHECK(shell.run(line + "--set measure.duration=2").code == 0);

  shell.write("c", shell.read("c").substr(0, 5000));
  check_refused(shell, line, {"c: ", "truncated"});
  check_refused(shell, "clatter render vibrated --out x.png --resume c", {"c: ", "truncated"});
  shell.write("c", "no checkpoint");
  check_refused(shell, line, {"c: ", "this is not a checkpoint"});
  const std::string named = "clatter measure vibrated --checkpoint";
  check_refused(shell, named + " c", {"--checkpoint", "c exists"});
  check_refused(shell, named + " no/c", {"--checkpoint", "folder no"});
  check_refused(shell, named + "-every 5", {"--checkpoint"});
  check_refused(shell, named + " d --checkpoint-every 0", {"--checkpoint-every"});
}

// Endless cooling: at a restitution of 0.1 an inelastic collapse occurs at an early finite time.
TEST_CASE("Resume: a collapse leaves results, a checkpoint and the command that continues") {
  const Shell shell;
  const std::string scene =
      "equilibrium --set particles.restitution=0.1 --set particles.count=300 "
      "--set box.size=[25,25] --set measure.burn_in=0 --set measure.series_interval=0.125 "
      "--until 1000 ";
  const Outcome stopped = shell.run("clatter measure " + scene + "--quiet --out r.json");
  CHECK(stopped.code == 3);
  CHECK(says(stopped.err, "inelastic collapse"));
  const std::size_t way = stopped.err.find("--resume r.checkpoint --set collapse.contact_time=");
  REQUIRE(way != std::string::npos);
  const double time = json::parse(shell.read("r.json")).at("temperature_series").at("time").back();
  CHECK(time > 0.0);
  CHECK(time < 1000.0);

  // The continuation of the message is a valid command line.
  const Outcome resumed =
      shell.run("clatter measure " + scene + "--out s.json " + stopped.err.substr(way));
  CAPTURE(resumed.err);
  CHECK(resumed.code == 0);
  CHECK(says(resumed.err, ": collapse.contact_time\n"));
  CHECK(json::parse(shell.read("s.json")).at("temperature_series").at("time").back() == 1000.0);

  const Outcome film =
      shell.run("clatter render " + scene + "--size 64x64 --speed 50 --out film.mp4");
  CHECK(film.code == 3);
  CHECK(says(film.err, "--resume film.checkpoint --set collapse.contact_time="));
  CHECK_FALSE(shell.read("film.mp4").empty());
}

TEST_CASE("Resume: a checkpoint that cannot be written costs no result") {
  const Shell shell;
  const Outcome outcome = shell.run(
      "clatter measure vibrated --until 1e6 --out r.json & pid=$!; sleep 1\n"
      "mkdir r.checkpoint; kill -TERM $pid; wait $pid");
  CHECK(outcome.code == 1);
  CHECK(says(outcome.err, "no checkpoint was written: cannot write r.checkpoint: Is a directory"));
  CHECK(json::accept(shell.read("r.json")));
}

}  // namespace clatter
