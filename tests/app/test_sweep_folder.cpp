// The folder of a sweep: failures, interrupts and damaged files.

#include <doctest/doctest.h>

#include <nlohmann/json.hpp>

#include "tests/app/sweep_scene.h"

namespace clatter {

using nlohmann::json;

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
  CHECK(says(sweep.err, "300 particles have no place on a lattice in the box"));
  // Failures that would occur again are not repeated, and are printed with --quiet too.
  const Outcome again = shell.run("clatter sweep s.toml --out d --quiet");
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
  check_refused(shell, "clatter sweep s.toml --out other", {"--out: other exists"});
  check_refused(shell, "clatter sweep status other", {"other: this is not the folder of a sweep"});
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
  check_refused(shell, "clatter sweep s.toml --out .", {"--out: . exists"});
  CHECK(shell.read("scene.toml") == "# of the user\n");
}

TEST_CASE("Sweep: the start file of a scene is copied into the folder, and nowhere else") {
  const Shell shell;
  shell.write("a.toml", kSweepScene);
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
  CHECK(says(beside.err, "not below the folder of the scene"));
  const Outcome own = sweep("table.csv", "up/d");
  CHECK(own.code == 2);
  CHECK(says(own.err, "its own \"table.csv\"; rename the start file"));
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
  CHECK(says(missing.err, "run 2 (particles.restitution=0.7 walls.right.temperature=0.5, seed 2)"));
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
  CHECK(says(damaged.err, "d/runs/3.checkpoint: this is not a checkpoint; remove it"));
  const Outcome removed = shell.run("rm d/runs/3.checkpoint; clatter sweep s.toml --out d");
  CHECK(removed.code == 0);
  CHECK(removed.err == "sweep: 12 runs: 12 with result, 0 failed, 0 open\n");
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
      "1.5; kill -TERM $!; wait");
  CAPTURE(killed.err);
  const std::string run = " (particles.restitution=0.7 walls.right.temperature=0.5, seed ";
  CHECK(says(killed.err, "run 1" + run + "4) has ended without a result: Killed\n"));
  CHECK(says(killed.err, "run 2" + run + "2) has ended without a result: it was interrupted\n"));
  CHECK(killed.err.ends_with("interrupted; the same command continues the sweep\n"));
  CHECK(shell.run("ls d/failed").out == "");
}

TEST_CASE("Sweep: a folder that is removed during the sweep is not a success") {
  const Shell shell;
  write_sweep(shell);
  shell.run("sed -i 's/duration = 30/duration = 1e5/' a.toml");
  // The last process has ended before the sweep looks at the folder.
  const Outcome outcome = shell.run(
      "clatter sweep s.toml --out d --quiet --threads 1 & until ls d/results/1.json; do sleep "
      "0.01; "
      "done; rm -rf d; kill -TERM $!; wait $!");
  CHECK(outcome.code == 2);
  CHECK(says(outcome.err, "d: this is not the folder of a sweep"));
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
  struct Damage {
    std::string damage, line, problem;
  };
  const std::string missing = "manifest.jsonl is damaged: it has no run ";
  const std::string wrong = "manifest.jsonl is damaged: line ", status = "clatter sweep status d";
  for (const auto& [damage, line, problem] : {
           Damage{": > d/manifest.jsonl", start, missing},
           Damage{"rm d/manifest.jsonl", start, missing},
           Damage{"rm d/manifest.jsonl d/results/*; echo > d/runs/2.checkpoint", start, missing},
           Damage{"rm d/results/*; echo '{}' > d/failed/99.json", start, missing},
           Damage{"tac calm/manifest.jsonl > d/manifest.jsonl", status, wrong},
           Damage{"head -c 100 calm/manifest.jsonl > d/manifest.jsonl", status, wrong},
           Damage{"echo '{\"id\":\"1\"}' > d/manifest.jsonl", status, wrong},
           Damage{"sed -i 's/\"0.7\"/0.7/' d/manifest.jsonl", status, wrong},
           // A folder that cannot be read has an unknown number of runs.
           Damage{"rm -r d/results; touch d/results", collect, "cannot read d/results: "},
           Damage{"echo '{\"state_hash\":1}' > d/results/3.json", collect, "d/results/3.json"},
           Damage{"sed -i 's/\"profile\": *{/\"profile\":4, \"x\": {/' d/results/3.json", collect,
                  "d/results/3.json"},
           Damage{"cp d/results/2.json d/results/3.json", collect, "d/results/3.json"},
       }) {
    CAPTURE(damage);
    const Outcome outcome = damaged(damage, line);
    CHECK(outcome.code == 1);
    CHECK_MESSAGE(says(outcome.err, problem), outcome.err);
    CHECK(shell.run("cmp d/sweep.toml calm/sweep.toml").code == 0);
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

}  // namespace clatter
