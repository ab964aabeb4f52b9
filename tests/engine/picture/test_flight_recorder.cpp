#include <doctest/doctest.h>

#include <algorithm>
#include <cmath>
#include <vector>

#include "engine/picture/flight_recorder.h"
#include "engine/picture/snapshot.h"
#include "tests/engine/measure/scenes.h"
#include "tests/support/dimensions.h"

using namespace clatter;
using namespace clatter::testing;

namespace {

// Walls along x, gravity, kicks.
Scene falling_gas(int dimension) {
  Scene scene = default_scene(dimension);
  scene.box = Vec<3>(dimension == 2 ? 10.0 : 5.0, dimension == 2 ? 8.0 : 4.0, 6.0).head(dimension);
  scene.particles.count = 40;
  scene.particles.restitution = 0.9;
  wall_in(scene, 0, {.kind = WallKind::Thermal, .temperature = 1.0});
  scene.gravity = Vec<3>(0.0, -0.7, 0.4).head(dimension);
  scene.bulk_drive = BulkDrive{.interval = 0.4, .kick_speed = 0.3};
  return scene;
}

// The distance of two positions through the nearest image.
double distance(const VecX& a, const VecX& b, const Snapshot& snapshot) {
  VecX off = a - b;
  for (int axis = 0; axis < off.size(); ++axis) {
    if (!snapshot.walls[2 * axis]) off[axis] = std::remainder(off[axis], snapshot.box[axis]);
  }
  return off.norm();
}

// Checks that each particle has one path without gaps, from `reach` ago to its position. Returns
// the number of pieces.
template <int D>
std::size_t check_paths(const FlightRecorder<D>& recorder, const Simulation<D>& simulation,
                        double reach) {
  CHECK(recorder.reach() == doctest::Approx(reach).epsilon(1e-12));
  const Snapshot snapshot = snapshot_of(simulation);
  const std::vector<FlightPiece> pieces = recorder.pieces();
  for (std::uint32_t i = 0; i < snapshot.count(); ++i) {
    double time = -recorder.reach();
    std::optional<VecX> place;
    for (const FlightPiece& piece : pieces) {
      if (piece.particle != i) continue;
      REQUIRE(piece.from < piece.to);
      REQUIRE((piece.position.array() >= 0.0).all());
      REQUIRE((piece.position.array() <= snapshot.box.array()).all());
      REQUIRE(std::fabs(piece.from - time) < 1e-12);
      if (place) REQUIRE(distance(*place, piece.position, snapshot) < 1e-10);
      time = piece.to;
      place = piece.at(piece.to);
    }
    REQUIRE(time == 0.0);
    REQUIRE(distance(*place, snapshot.positions.col(i), snapshot) < 1e-10);
  }
  return pieces.size();
}

}  // namespace

TEST_CASE_TEMPLATE("FlightRecorder: the pieces of a particle are its path, without gaps", Dimension,
                   Plane, Space) {
  constexpr int D = Dimension::value;
  const auto simulation = simulation_of<D>(falling_gas(D), 5);
  FlightRecorder<D> recorder(*simulation, 1.5);
  CHECK(recorder.pieces().empty());
  simulation->run_until(0.25);
  check_paths(recorder, *simulation, 0.25);
  for (double time = 3.0; time < 60.0; time += 0.37) {
    simulation->run_until(time);
    CHECK(check_paths(recorder, *simulation, 1.5) > 4 * 40);
  }
}

TEST_CASE_TEMPLATE("FlightRecorder: paths continue across changes of laws and of their span",
                   Dimension, Plane, Space) {
  constexpr int D = Dimension::value;
  Scene scene = falling_gas(D);
  const auto before = simulation_of<D>(scene, 7);
  FlightRecorder<D> first(*before, 1.0);
  before->run_until(4.0);
  scene.gravity = Vec<3>(0.5, 0.9, -0.3).head<D>();
  Simulation<D> after(model_of<D>(scene, 7), before->save());
  FlightRecorder<D> second(after, 2.0, std::move(first));
  check_paths(second, after, 1.0);
  after.run_until(4.3);
  check_paths(second, after, 1.3);
  after.run_until(9.0);
  check_paths(second, after, 2.0);
}

TEST_CASE_TEMPLATE("FlightRecorder: the path of one particle is its part of all paths", Dimension,
                   Plane, Space) {
  constexpr int D = Dimension::value;
  static constexpr std::uint32_t kTraced = 17;
  Scene scene = falling_gas(D);
  const auto before = simulation_of<D>(scene, 9);
  FlightRecorder<D> all(*before, 6.0), one(*before, 6.0, kTraced);
  const auto check = [](const FlightRecorder<D>& whole, const FlightRecorder<D>& traced) {
    std::vector<FlightPiece> expected = whole.pieces();
    std::erase_if(expected, [](const FlightPiece& piece) { return piece.particle != kTraced; });
    const std::vector<FlightPiece> pieces = traced.pieces();
    CHECK(pieces.size() > 5);
    REQUIRE(pieces.size() == expected.size());
    for (std::size_t i = 0; i < pieces.size(); ++i) {
      CHECK(pieces[i].particle == kTraced);
      CHECK(pieces[i].from == expected[i].from);
      CHECK(pieces[i].to == expected[i].to);
      CHECK(pieces[i].position == expected[i].position);
    }
  };
  before->run_until(5.0);
  check(all, one);
  scene.gravity = Vec<3>(0.5, 0.9, -0.3).head<D>();
  Simulation<D> after(model_of<D>(scene, 9), before->save());
  FlightRecorder<D> all_after(after, 6.0, std::move(all)), one_after(after, 6.0, std::move(one));
  after.run_until(9.0);
  check(all_after, one_after);
}
