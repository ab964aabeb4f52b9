// Trajectories in the format of HOOMD-blue.

#include <doctest/doctest.h>

#include <array>
#include <nlohmann/json.hpp>

#include "tests/app/readers.h"
#include "tests/app/trajectory_scenes.h"
#include "tests/support/shell.h"

namespace clatter {

using nlohmann::json;
using namespace testing;

namespace {

json rounded(const std::array<double, 3>& vector) {
  json numbers;
  for (const double number : vector) numbers.push_back(static_cast<float>(number));
  return numbers;
}

}  // namespace

TEST_CASE("GSD: the package gsd and MDAnalysis read the states") {
  struct Case {
    const char* scene;
    int dimensions;
    std::array<double, 3> box;
    json periodic;
    double inertia;  // I = q/4; 0: no spins
  };
  for (const Case& each : {Case{kDisks, 2, {8, 6, 0}, {1, 0, 0}, 0.125},
                           Case{kSmoothDisks, 2, {7, 9, 0}, {0, 1, 0}, 0.0},
                           Case{kSpheres, 3, {8, 6, 5}, {1, 1, 0}, 0.1}}) {
    const Shell shell;
    shell.write("s.toml", each.scene);
    CAPTURE(each.scene);
    for (const std::string file : {"t.csv", "t.gsd"}) {
      REQUIRE(shell.run(kRun + "--every 0.2 --trajectory " + file).code == 0);
    }
    const std::vector<Row> rows = rows_in(shell.read("t.csv"));
    const json frames = frames_of(shell, "t.gsd");
    REQUIRE(frames.size() == 106);  // more than fit the first index
    const std::size_t particles = rows.size() / frames.size();
    bool moved = false;
    for (std::size_t k = 0; k < rows.size(); ++k) {
      const Row& row = rows[k];
      const json& frame = frames.at(k / particles);
      const json& exact = frame.at("log");
      const std::size_t i = k % particles;
      CHECK(frame.at("step") == k / particles);
      CHECK(frame.at("N") == particles);
      CHECK(frame.at("dimensions") == each.dimensions);
      CHECK(frame.at("box") == json{each.box[0], each.box[1], each.box[2], 0.0, 0.0, 0.0});
      CHECK(frame.at("mass").at(i) == 1.0);
      CHECK(frame.at("diameter").at(i) == 1.0);
      CHECK(exact.at("time").at(0) == std::stod(row.at("time")));
      CHECK(exact.at("configuration/box") == json(each.box));
      CHECK(exact.at("configuration/periodic") == each.periodic);
      const std::array<double, 3> position = position_of(row);
      CHECK(exact.at("particles/position").at(i) == json(position));
      CHECK(exact.at("particles/velocity").at(i) == json(velocity_of(row)));
      std::array<double, 3> centred = position;
      for (std::size_t axis = 0; axis < 3; ++axis) centred[axis] -= each.box[axis] / 2;
      CHECK(frame.at("position").at(i) == rounded(centred));
      CHECK(frame.at("velocity").at(i) == rounded(velocity_of(row)));
      CHECK(frame.at("image").at(i) == json(image_of(row)));
      moved = moved || image_of(row) != std::array<double, 3>{};
      CHECK(exact.contains("particles/angular_velocity") == (each.inertia > 0.0));
      if (each.inertia == 0.0) continue;
      const std::array<double, 3> spin = spin_of(row);
      CHECK(exact.at("particles/angular_velocity").at(i) == json(spin));
      const double along = each.dimensions == 2 ? 0.0 : each.inertia;
      CHECK(frame.at("moment_inertia").at(i) == rounded({along, along, each.inertia}));
      json momentum = {0.0};  // the quaternion (0, 2 I omega)
      for (const double number : spin) {
        momentum.push_back(static_cast<float>(2.0 * each.inertia * number));
      }
      CHECK(frame.at("angmom").at(i) == momentum);
    }
    CHECK(moved);
  }
}

TEST_CASE("GSD: a run that was killed and resumed has the bytes of an undisturbed run") {
  for (const char* scene : {kDisks, kSmoothDisks}) {
    const Shell shell;
    shell.write("s.toml", scene);
    const std::string flags = kRun + "--every 0.1 --trajectory ";
    REQUIRE(shell.run(flags + "whole.gsd --until 9.5").code == 0);
    for (const std::string end : {"1.05", "1.75", "1.8", "9"}) {
      CAPTURE(end);
      REQUIRE(shell.run(flags + "t.gsd --checkpoint c --until " + end + " && cp c early").code ==
              0);
      // Beyond the checkpoint the run has written frames and a later index.
      REQUIRE(shell.run(flags + "t.gsd --resume c --until 12 && cp t.gsd later.gsd").code == 0);
      CHECK(frames_of(shell, "later.gsd").size() == 121);
      REQUIRE(
          shell.run("printf abc >>t.gsd && " + flags + "t.gsd --resume early --until 9.5").code ==
          0);
      CHECK(shell.run("cmp t.gsd whole.gsd && rm t.gsd").code == 0);
    }
    shell.write("none.gsd", "GSD");
    check_refused(shell, flags + "none.gsd --resume early",
                  {"none.gsd: lacks records that precede the checkpoint"});
  }
}

TEST_CASE(
    "GSD: after a full disk the frames so far can be read, and a resumed run completes the file") {
  const Shell shell;
  shell.write("s.toml", kDisks);
  for (const std::string blocks : {"20", "100", "101"}) {
    CAPTURE(blocks);
    const Outcome full = shell.run("ulimit -f " + blocks + "; " + kRun +
                                   "--trajectory t.gsd --every 0.1 --checkpoint c");
    CHECK(full.code == 1);
    CHECK(says(full.err,
               "cannot write t.gsd: File too large; continue with --resume c "
               "--trajectory t.gsd --every 0.1\n"));
    CHECK(!frames_of(shell, "t.gsd").empty());
    REQUIRE(shell.run(kRun + "--trajectory t.gsd --every 0.1 --resume c").code == 0);
    CHECK(shell.run(kRun + "--trajectory u.gsd --every 0.1 && cmp t.gsd u.gsd; rm c*").code == 0);
  }
}

}  // namespace clatter
