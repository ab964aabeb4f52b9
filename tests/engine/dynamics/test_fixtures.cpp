#include <doctest/doctest.h>

#include <string>

#include "engine/dynamics/simulation.h"
#include "engine/initial/start_state.h"
#include "engine/laws/fixture.h"
#include "engine/scene/scene.h"
#include "engine/scene/scene_file.h"
#include "tests/engine/support/reference.h"

namespace clatter::fixtures {

using namespace testing;

namespace {

// The gas of a scene must equal the reference to the last bit, and no particle enters a fixture.
template <int D>
void compare_scene(const std::string& text, std::uint64_t collisions) {
  CAPTURE(text);
  const Scene scene = parse_scene(text, "");
  const Model<D> model = model_of<D>(scene, 5);
  const State<D> start = start_state<D>(scene, 5);
  Simulation<D> simulation(model, start);
  run_beside_reference(simulation, start, collisions);
  CHECK(simulation.counts().wall_collisions > 20);
  const State<D> end = simulation.state();
  const FixtureImages<D> fixtures(model.fixtures, model.domain());
  for (std::uint32_t i = 0; i < end.positions.size(); ++i) {
    const Grain grain = simulation.grain(i);
    CHECK(fixtures.depth(end.positions[i], grain.radius, grain.species) < 1e-12);
  }
}

const std::string kThings = R"(
[[obstacle]]
kind = "ball"
centre = [0.5, 4.0]
radius = 1.2
[[obstacle]]
kind = "polygon"
corners = [[3.0, 2.0], [5.5, 2.5], [4.5, 3.0], [5.0, 5.0]]
restitution = 0.9
[[obstacle]]
kind = "box"
from = [6.5, 0.0]
to = [7.5, 1.0]
temperature = 2.0
[[partition]]
axis = "y"
position = 6.0
holes = [{ from = [1.0], to = [2.5] }, { from = [5.0], to = [7.0] }]
drive_speed = 0.3
)";

const std::string kThingsInSpace = R"(
[[obstacle]]
kind = "ball"
centre = [0.3, 2.0, 2.0]
radius = 0.9
[[obstacle]]
kind = "box"
from = [2.5, 0.5, 0.5]
to = [3.5, 2.0, 3.0]
restitution = 0.9
[[partition]]
axis = "y"
position = 4.0
holes = [{ from = [0.5, 0.5], to = [2.0, 2.5] }, { from = [2.5, 0.0], to = [3.8, 4.5] }]
temperature = 1.5
)";

const std::string kWalls = R"(
[walls.left]
kind = "static"
[walls.right]
kind = "static"
[walls.bottom]
kind = "driven"
drive_speed = 0.5
[walls.top]
kind = "static"
restitution = 0.9
)";

std::string gas(const std::string& box, int count, const std::string& more = "") {
  return "[box]\nsize = " + box + "\n[particles]\ncount = " + std::to_string(count) +
         "\nrestitution = 0.95\n" + more;
}

}  // namespace

TEST_CASE("Fixtures: disks among bodies and partitions equal the reference") {
  const std::string box = "[9.0, 8.0]", rough = "friction = 0.4\ntangential_restitution = 0.5\n";
  for (const int count : {1, 2, 12}) {
    CAPTURE(count);
    const std::string fall = "[gravity]\nacceleration = [0.2, -0.5]\n";
    compare_scene<2>(gas(box, count) + kThings, 400);
    compare_scene<2>(gas(box, count) + kWalls + kThings, 400);
    compare_scene<2>(gas(box, count, rough) + kWalls + kThings + fall, 400);
    compare_scene<2>(gas(box, count, rough) + kThings + fall + "[collapse]\ncontact_time = 0.01\n",
                     400);
  }
}

TEST_CASE("Fixtures: spheres among bodies and partitions equal the reference") {
  const std::string box = "[4.0, 6.0, 4.5]";
  for (const int count : {1, 2, 15}) {
    CAPTURE(count);
    const std::string fall = "[gravity]\nacceleration = [0.2, 0.1, -0.5]\n";
    compare_scene<3>(gas(box, count) + kThingsInSpace, 200);
    compare_scene<3>(gas(box, count, "friction = 0.4\n") + kWalls + kThingsInSpace + fall, 200);
  }
}

TEST_CASE("Fixtures: each species meets its law, and a membrane lets one pass") {
  const std::string mixture = R"(
[box]
size = [14.0, 10.0]
[particles]
restitution = 0.95
[[species]]
name = "small"
count = 20
diameter = 0.6
[[species]]
name = "large"
count = 6
diameter = 1.4
[[partition]]
axis = "x"
position = 4.0
passes = ["small"]
[[partition]]
axis = "x"
position = 11.0
holes = [{ from = [3.0], to = [5.0] }]
drive_speed = 0.2
species = { large = { restitution = 0.5 } }
[[obstacle]]
kind = "ball"
centre = [7.5, 5.0]
radius = 1.0
temperature = 1.0
species = { small = { temperature = 3.0 } }
)";
  compare_scene<2>(mixture, 600);
}

// A hole as wide as one diameter: disks pass only in the middle, to the last bit.
TEST_CASE("Fixtures: a hole of exactly one diameter") {
  compare_scene<2>(gas("[6.0, 5.0]", 4) + kWalls + R"(
[[partition]]
axis = "x"
position = 3.0
holes = [{ from = [2.0], to = [3.0] }]
)",
                   2000);
}

// Valves pass by speed and side, also in flights that gravity bends back to them.
TEST_CASE("Fixtures: valves equal the reference") {
  const std::string demon = R"(
[[partition]]
axis = "x"
position = 4.5
restitution = 0.9
holes = [{ from = [1.0], to = [3.0], valve = { faster_than = 1.0, from = "left" } },
         { from = [4.0], to = [6.0], valve = { slower_than = 1.2, from = "right" } }]
[[partition]]
axis = "y"
position = 6.5
holes = [{ from = [2.0], to = [7.0], valve = { faster_than = 0.5, slower_than = 1.5 } }]
)";
  const std::string fall = "[gravity]\nacceleration = [0.3, -0.5]\n";
  for (const int count : {1, 2, 14}) {
    CAPTURE(count);
    compare_scene<2>(gas("[9.0, 8.0]", count) + kWalls + demon, 500);
    compare_scene<2>(gas("[9.0, 8.0]", count) + kWalls + demon + fall, 500);
  }
  compare_scene<3>(gas("[5.0, 5.0, 4.0]", 20) + kWalls + R"(
[[partition]]
axis = "x"
position = 2.5
holes = [{ from = [0.5, 0.5], to = [3.5, 3.0], valve = { faster_than = 1.0 } }]
)",
                   500);
}

// One way: all particles come to rest behind the valve.
TEST_CASE("Fixtures: a valve from one side empties it") {
  const Scene scene = parse_scene(gas("[12.0, 8.0]", 10) + kWalls + R"(
[[partition]]
axis = "x"
position = 4.0
holes = [{ from = [2.0], to = [6.0], valve = { from = "left" } }]
)",
                                  "");
  Simulation<2> gas(model_of<2>(scene, 1), start_state<2>(scene, 1));
  const auto left = [&] {
    int count = 0;
    for (const Vec2& r : gas.positions()) count += r.x() < 4.0;
    return count;
  };
  CHECK(left() > 0);
  gas.run_until(500.0);
  CHECK(left() == 0);
}

}  // namespace clatter::fixtures
