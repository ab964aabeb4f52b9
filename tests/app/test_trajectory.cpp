// Trajectories of `clatter measure`.

#include <doctest/doctest.h>

#include <array>
#include <map>
#include <nlohmann/json.hpp>

#include "tests/app/trajectory_scenes.h"
#include "tests/support/shell.h"

namespace clatter {

using nlohmann::json;
using namespace testing;

TEST_CASE("Trajectory: each frame is the state that a run up to its time saves, to the bit") {
  for (const char* scene : {kDisks, kSpheres}) {
    const Shell shell;
    shell.write("s.toml", scene);
    REQUIRE(shell.run(kRun + "--trajectory t.csv --every 2.5").code == 0);
    const std::vector<Row> rows = rows_in(shell.read("t.csv"));
    std::size_t next = 0;
    for (const std::string time : {"1e-300", "2.5", "5", "7.5", "10", "12.5", "15", "17.5", "20"}) {
      CAPTURE(time);
      REQUIRE(
          shell.run(kRun + "--set measure.burn_in=0 --save-state end.csv --until " + time).code ==
          0);
      const std::vector<Row> states = rows_in(shell.read("end.csv"));
      for (std::size_t i = 0; i < states.size(); ++i, ++next) {
        Row row = rows.at(next);
        CHECK(row["time"] == (time == "1e-300" ? "0" : time));
        CHECK(row["particle"] == std::to_string(i));
        for (const auto& [name, value] : states[i]) CHECK(row[name] == value);
      }
    }
    CHECK(next == rows.size());
  }
}

TEST_CASE("Trajectory: the times are decimal numbers, and the last frame is at the end") {
  const Shell shell;
  shell.write("s.toml", kDisks);
  const std::vector<std::array<std::string, 3>> runs = {
      {"0.1", "0.3", "0 0.1 0.2 0.3"}, {"0.7", "2.1", "0 0.7 1.4 2.1"}, {"2", "5", "0 2 4"}};
  for (const auto& [every, end, times] : runs) {
    CAPTURE(every);
    REQUIRE(shell.run(kRun + "--trajectory t.csv --every " + every + " --until " + end).code == 0);
    CHECK(shell.run("tail -n +2 t.csv | cut -d, -f1 | uniq | xargs").out == times + '\n');
  }
}

TEST_CASE("Trajectory: a run with it has the same result") {
  const Shell shell;
  shell.write("s.toml", kDisks);
  const std::string keep = " && sed '/\"performance\"/,$d' r.json";
  const std::string alone = shell.run(kRun + keep).out;
  CHECK(alone.find("state_hash") != alone.npos);
  CHECK(shell.run(kRun + "--trajectory t.csv --every 0.3" + keep).out == alone);
}

TEST_CASE("Trajectory: images continue where laws change") {
  const Shell shell;
  shell.write("s.toml", kSpheres);
  // Since inertia is a law of rough spheres, the run continues in a new simulation. Up to the first
  // collision after the change its motion is the same.
  shell.write("b.toml", std::string(kSpheres) +
                            "[[change]]\ntime = 10.0\nset = { \"particles.inertia\" = 0.3 }\n");
  const std::string flags = "--until 10.01 --every 10.005 --trajectory ";
  REQUIRE(shell.run(kRun + flags + "a.csv").code == 0);
  REQUIRE(shell.run("cp b.toml s.toml; " + kRun + flags + "b.csv").code == 0);
  const std::vector<Row> one = rows_in(shell.read("a.csv")), two = rows_in(shell.read("b.csv"));
  REQUIRE(one.size() == 18);
  CHECK(Row(one[9])["time"] == "10.005");
  int away = 0;
  for (std::size_t i = 0; i < one.size(); ++i) {
    CHECK(one[i] == two[i]);
    away += Row(one[i])["image_x"] != "0" && Row(one[i])["image_y"] != "0";
  }
  CHECK(away > 0);
}

TEST_CASE("Trajectory: ASE and MDAnalysis read the states, and names are those of the formats") {
  for (const char* scene : {kDisks, kSpheres}) {
    const bool disks = scene == kDisks;
    const std::size_t particles = disks ? 7 : 9;
    const Shell shell;
    shell.write("s.toml", scene);
    for (const std::string file : {"t.csv", "t.xyz", "t.lammpstrj"}) {
      REQUIRE(shell.run(kRun + "--every 4 --trajectory " + file).code == 0);
    }
    const Outcome outcome = shell.run(CLATTER_READERS "read_trajectory.py t.xyz t.lammpstrj");
    CAPTURE(outcome.err);  // names a missing module, which ./run test installs
    REQUIRE(outcome.code == 0);
    const json read = json::parse(outcome.out);
    REQUIRE(read.at("t.xyz").size() == 6);
    REQUIRE(read.at("t.lammpstrj").size() == 6);
    const std::vector<Row> rows = rows_in(shell.read("t.csv"));
    REQUIRE(rows.size() == 6 * particles);
    bool moved = false;
    for (std::size_t k = 0; k < rows.size(); ++k) {
      const Row& row = rows[k];
      const std::size_t i = k % particles;
      const json& frame = read.at("t.xyz").at(k / particles);
      CHECK(frame.at("time") == std::stod(row.at("time")));
      CHECK(frame.at("box") == json{8.0, 6.0, disks ? 1.0 : 5.0});
      CHECK(frame.at("periodic") == json{true, !disks, false});
      CHECK(frame.at("symbol") == "X");
      CHECK(frame.at("positions").at(i) == json(position_of(row)));
      CHECK(frame.at("velo").at(i) == json(velocity_of(row)));
      CHECK(frame.at("omega").at(i) == json(spin_of(row)));
      CHECK(frame.at("map_shift").at(i) == json(image_of(row)));
      CHECK(frame.at("radius").at(i) == 0.5);
      moved = moved || image_of(row)[0] != 0.0;
      // MDAnalysis has single precision, and shifts the box to begin at 0.
      const json& single = read.at("t.lammpstrj").at(k / particles).at(i);
      for (std::size_t axis = 0; axis < (disks ? 2 : 3); ++axis) {
        CHECK(single.at(axis) == static_cast<float>(position_of(row)[axis]));
      }
    }
    CHECK(moved);
    CHECK(says(shell.read("t.xyz"), disks ? " Origin=\"0 0 -0.5\" pbc=\"T F F\" Time=4 "
                                          : "=\"8 0 0 0 6 0 0 0 5\" pbc=\"T T F\" Time=4 "));
    const std::string bounds =
        disks ? "pp ff ff\n0 8\n0 6\n-0.5 0.5\n" : "pp pp ff\n0 8\n0 6\n0 5\n";
    CHECK(says(
        shell.read("t.lammpstrj"),
        "ITEM: TIMESTEP\n1\nITEM: NUMBER OF ATOMS\n" + std::to_string(particles) +
            "\nITEM: BOX BOUNDS " + bounds +
            "ITEM: ATOMS id type radius x y z ix iy iz vx vy vz omegax omegay omegaz\n1 1 0.5"));
  }
}

TEST_CASE("Trajectory: a resumed run continues it without a gap or a double frame") {
  const Shell shell;
  shell.write("s.toml", kDisks);
  const std::string part = kRun + "--trajectory part.csv ";
  REQUIRE(shell.run(kRun + "--trajectory whole.csv --every 0.7").code == 0);
  for (const std::string end : {"6.9", "7"}) {
    CAPTURE(end);
    REQUIRE(shell.run(part + "--every 0.7 --checkpoint c --until " + end).code == 0);
    check_refused(shell, part + "--every 0.8 --resume c",
                  {"--every: the trajectory of the checkpoint has the interval 0.7"});
    check_refused(shell, kRun + "--trajectory none.csv --every 0.7 --resume c",
                  {"none.csv: lacks records that precede the checkpoint"});
    check_refused(shell, kRun + "--trajectory s.toml.xyz --every 0.7 --resume c",
                  {"s.toml.xyz has another format than the trajectory of the checkpoint"});
    // A killed run has written frames, and a part of one, after its last checkpoint.
    shell.run("tail -n 5 whole.csv | head -c 100 >>part.csv");
    const Outcome resumed =
        shell.run(part + "--every 0.7 --resume c && cmp part.csv whole.csv && rm part.csv");
    CAPTURE(resumed.err);
    CHECK(resumed.code == 0);
  }
  // A checkpoint without trajectory: the first frame is the next multiple of the interval.
  REQUIRE(shell.run(kRun + "--checkpoint c --until 6.9").code == 0);
  REQUIRE(shell.run(kRun + "--resume c --trajectory late.csv --every 0.7").code == 0);
  check_refused(shell, kRun + "--resume c --trajectory whole.csv --every 0.7",
                {"--trajectory: whole.csv exists, and the checkpoint has no trajectory"});
  const std::vector<Row> late = rows_in(shell.read("late.csv"));
  CHECK(Row(late.at(0))["time"] == "7");
  CHECK(Row(late.at(0))["image_x"] == "0");
}

TEST_CASE("Trajectory: a run that was killed and resumed has the bytes of an undisturbed run") {
  for (const std::string file : {"t.csv", "t.gsd", "t.h5md"}) {
    CAPTURE(file);
    const Shell shell;
    shell.write("s.toml", kDisks);
    const std::string run = kRun + "--until 4000 --every 2 --trajectory ";
    REQUIRE(shell.run(run + "whole_" + file).code == 0);
    // The kill may come between the two renames of a checkpoint, or after the end of the run.
    shell.run(run + file +
              " --checkpoint c --checkpoint-every 1e-9 & pid=$!; "
              "while test ! -e c; do sleep 0.01; done; sleep 0.1; kill -9 $pid; wait $pid; "
              "test -e c || cp c.previous c");
    const Outcome resumed = shell.run(run + file + " --resume c");
    CAPTURE(resumed.err);
    REQUIRE(resumed.code == 0);
    CHECK(shell.run("cmp " + file + " whole_" + file).code == 0);
  }
}

TEST_CASE("Trajectory: the columns stay where spins appear or disappear") {
  const Shell shell;
  for (const bool first : {true, false}) {  // whether particles spin before the change, or after
    CAPTURE(first);
    const std::string before = first ? "0.3" : "-1.0", after = first ? "-1.0" : "0.3";
    shell.write("s.toml",
                "title = \"T\"\nbox.size = [8, 6]\n"
                "particles = { count = 7, restitution = 0.9, tangential_restitution = " +
                    before +
                    " }\nmeasure = { burn_in = 1.0, duration = 20.0 }\n[[change]]\ntime = 5.0\n"
                    "set = { \"particles.tangential_restitution\" = " +
                    after + " }\n");
    const Outcome run = shell.run(kRun + "--trajectory t.csv --every 2");
    CAPTURE(run.err);
    REQUIRE(run.code == 0);
    std::map<bool, bool> spin;  // by whether the time is after the change
    for (Row row : rows_in(shell.read("t.csv"))) {
      REQUIRE(row.contains("omega"));
      if (row["omega"] != "0") spin[std::stod(row["time"]) > 5.0] = true;
    }
    CHECK(spin[!first]);
  }
}

TEST_CASE("Trajectory: a lost frame is an error, although the system reports it once") {
  const Shell shell;
  shell.write("s.toml", kDisks);
  if (is_sanitized()) {
    MESSAGE("[skipped] a sanitizer prevents LD_PRELOAD");
    return;
  }
  const std::string run = "env LD_PRELOAD=" CLATTER_FAILED_SYNC " " + kRun + "--every 1 ";
  const std::string lost = "cannot write t.csv: Input/output error";
  const Outcome at_end = shell.run(run + "--trajectory t.csv");
  CHECK(at_end.code == 1);
  CHECK(says(at_end.err, lost));
  CHECK(says(shell.read("r.json"), "state_hash"));
  // The first checkpoint reports the error, and the last one too.
  const Outcome at_checkpoint =
      shell.run(run + "--trajectory t.csv --checkpoint c --checkpoint-every 1e-9");
  CHECK(at_checkpoint.code == 1);
  CHECK(says(at_checkpoint.err, "no checkpoint was written: " + lost));
}

TEST_CASE("Trajectory: a failed write leaves a checkpoint, and wrong use is refused") {
  const Shell shell;
  shell.write("s.toml", kDisks);
  const Outcome full =
      shell.run("ulimit -f 100; " + kRun + "--trajectory t.xyz --every 0.1 --checkpoint c");
  CHECK(full.code == 1);
  CHECK(says(full.err,
             "cannot write t.xyz: File too large; continue with --resume c "
             "--trajectory t.xyz --every 0.1\n"));
  const Outcome without = shell.run("clatter measure s.toml --out r.json --resume c");
  CHECK(without.code == 0);
  CHECK(says(without.err, "note: the trajectory of c does not continue without --trajectory"));
  REQUIRE(shell.run(kRun + "--trajectory t.xyz --every 0.1 --resume c").code == 0);
  CHECK(shell.run(kRun + "--trajectory u.xyz --every 0.1 && cmp t.xyz u.xyz").code == 0);

  shell.run("mkfifo pipe.csv; ln -s /dev/stdout out.csv");
  for (const auto& [flags, words] : std::vector<std::pair<std::string, std::string>>{
           {"--trajectory t.h5md --every 1 --save-state t.h5md.records", "t.h5md.records"},
           {"--trajectory t.foo --every 1", "t.foo has no extension of a trajectory"},
           {"--trajectory pipe.csv --every 1", "pipe.csv is not a regular file"},
           {"--trajectory out.csv --every 1", "out.csv is not a regular file"},
           {"--trajectory v.xyz", "--trajectory requires --every"},
           {"--every 1", "--every requires --trajectory"},
           {"--trajectory v.xyz --every 0", "--every"},
           {"--trajectory v.xyz --every 1e-7", "more than 1e7 frames"},
           {"--trajectory v.xyz --every 1 --replicas 2", "--replicas"},
           {"--trajectory s.csv --save-state s.csv --every 1", "s.csv"}}) {
    check_refused(shell, "timeout 10 " + kRun + flags, {words});
  }
}

}  // namespace clatter
