// Trajectories in the H5MD structure.

#include <doctest/doctest.h>

#include <array>
#include <nlohmann/json.hpp>

#include "tests/app/readers.h"
#include "tests/app/trajectory_scenes.h"
#include "tests/support/shell.h"

namespace clatter {

using nlohmann::json;
using namespace testing;

TEST_CASE("H5MD: h5py and MDAnalysis read the states to the bit") {
  struct Case {
    const char* scene;
    std::array<double, 3> box;
    json boundary;
    bool spins;
  };
  for (const Case& each : {Case{kDisks, {8, 6, 1}, {"periodic", "none", "none"}, true},
                           Case{kSmoothDisks, {7, 9, 1}, {"none", "periodic", "none"}, false},
                           Case{kSpheres, {8, 6, 5}, {"periodic", "periodic", "none"}, true}}) {
    const Shell shell;
    shell.write("s.toml", each.scene);
    CAPTURE(each.scene);
    for (const std::string file : {"t.csv", "t.h5md"}) {
      REQUIRE(shell.run(kRun + "--every 0.7 --trajectory " + file).code == 0);
    }
    const std::vector<Row> rows = rows_in(shell.read("t.csv"));
    const json frames = frames_of(shell, "t.h5md");
    REQUIRE(frames.size() == 31);
    const std::size_t particles = rows.size() / frames.size();
    bool moved = false;
    for (std::size_t k = 0; k < rows.size(); ++k) {
      const Row& row = rows[k];
      const json& frame = frames.at(k / particles);
      const std::size_t i = k % particles;
      CHECK(frame.at("step") == k / particles);
      CHECK(frame.at("time") == std::stod(row.at("time")));
      const auto& [x, y, z] = each.box;
      CHECK(frame.at("edges") == json{{x, 0.0, 0.0}, {0.0, y, 0.0}, {0.0, 0.0, z}});
      CHECK(frame.at("boundary") == each.boundary);
      CHECK(frame.at("mass").at(i) == 1.0);
      CHECK(frame.at("diameter").at(i) == 1.0);
      CHECK(frame.at("position").at(i) == json(position_of(row)));
      CHECK(frame.at("velocity").at(i) == json(velocity_of(row)));
      CHECK(frame.at("image").at(i) == json(image_of(row)));
      CHECK(frame.contains("angular_velocity") == each.spins);
      if (each.spins) CHECK(frame.at("angular_velocity").at(i) == json(spin_of(row)));
      moved = moved || image_of(row) != std::array<double, 3>{};
    }
    CHECK(moved);
    CHECK(shell.run("test -e t.h5md.records").code != 0);
  }
}

TEST_CASE("H5MD: a complete run continues, and a resumed run has the bytes of an undisturbed run") {
  for (const char* scene : {kDisks, kSmoothDisks}) {
    const Shell shell;
    shell.write("s.toml", scene);
    const std::string flags = kRun + "--every 0.1 --trajectory ";
    REQUIRE(shell.run(flags + "whole.h5md --until 9.5").code == 0);
    // The resumed runs read the frames of the complete file.
    REQUIRE(shell.run(flags + "t.h5md --checkpoint c --until 3.2 && cp c early").code == 0);
    REQUIRE(shell.run(flags + "t.h5md --resume c --until 12").code == 0);
    CHECK(frames_of(shell, "t.h5md").size() == 121);
    REQUIRE(shell.run(flags + "t.h5md --resume early --until 9.5").code == 0);
    CHECK(shell.run("cmp t.h5md whole.h5md && rm t.h5md").code == 0);
    check_refused(shell, flags + "none.h5md --resume early",
                  {"none.h5md.records: lacks records that precede the checkpoint"});
    shell.write("bad.h5md", "HDF5");
    check_refused(shell, flags + "bad.h5md --resume early",
                  {"bad.h5md: the file is damaged or not H5MD", "give a complete H5MD file"});
  }
}

TEST_CASE("H5MD: a complete run continues after an attempt that failed while it read the frames") {
  const Shell shell;
  shell.write("s.toml", kDisks);
  const std::string run = kRun + "--trajectory t.h5md --every 0.1 ";
  REQUIRE(shell.run(run + "--checkpoint c --until 9.5").code == 0);
  const std::vector<std::string> before = shell.files();
  const Outcome full = shell.run("ulimit -f 20; " + run + "--resume c --until 12");
  CHECK(full.code == 1);
  CHECK(says(full.err, "File too large"));
  CHECK(shell.files() == before);
  REQUIRE(shell.run(run + "--resume c --until 12").code == 0);
  CHECK(frames_of(shell, "t.h5md").size() == 121);
}

TEST_CASE("H5MD: if the complete file cannot be written, the run can be resumed") {
  const Shell shell;
  shell.write("s.toml", kDisks);
  const std::string run = kRun + "--trajectory t.h5md --every 10 ";
  const Outcome full = shell.run("ulimit -f 500; " + run);
  CAPTURE(full.err);
  CHECK(full.code == 1);
  CHECK(says(full.err, "cannot write t.h5md: "));
  CHECK(says(full.err, "; continue with --resume r.checkpoint --trajectory t.h5md --every 10\n"));
  CHECK(shell.files() ==
        std::vector<std::string>{"r.checkpoint", "r.json", "s.toml", "t.h5md.records"});
  REQUIRE(shell.run(run + "--resume r.checkpoint").code == 0);
  CHECK(frames_of(shell, "t.h5md").size() == 3);
}

TEST_CASE("H5MD: a run that a physical reason ends has its frames") {
  const Shell shell;
  shell.write("s.toml",
              "title = \"T\"\nbox.size = [8, 6]\n"
              "particles = { count = 20, restitution = 0.1 }\n"
              "gravity.acceleration = [0.0, -1.0]\nwalls.bottom.kind = \"static\"\n"
              "walls.top.kind = \"static\"\n"
              "measure = { burn_in = 0.0, duration = 1000.0 }\n");
  const Outcome stopped = shell.run(kRun + "--trajectory t.h5md --every 0.5");
  CAPTURE(stopped.err);
  REQUIRE(stopped.code == 3);
  CHECK(frames_of(shell, "t.h5md").size() > 1);
}

}  // namespace clatter
