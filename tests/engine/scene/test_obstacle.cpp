// Obstacles and partitions of a scene: their keys, mistakes, starts and changes.

#include <doctest/doctest.h>

#include <cmath>
#include <string>
#include <vector>

#include "engine/initial/start_state.h"
#include "engine/laws/fixture.h"
#include "engine/run/scheduled_run.h"
#include "tests/engine/scene/refusal.h"

namespace clatter::obstacle_keys {

using namespace testing;

namespace {

// Every key of fixtures, with values that are not the defaults.
const std::string kFixtures = R"(box.size = [30, 20]
[particles]
restitution = 0.9
[[species]]
name = "small"
count = 20
[[species]]
name = "large"
count = 5
diameter = 2.0
[[obstacle]]
kind = "ball"
name = "drum"
centre = [5.0, 6.0]
radius = 2.5
temperature = 2.0
species = { large = { temperature = 3.0 } }
[[obstacle]]
kind = "polygon"
corners = [[10.0, 2.0], [14.0, 2.0], [12.0, 5.0]]
restitution = 0.8
friction = 0.3
tangential_restitution = 0.4
drive_speed = 0.5
species = { small = { restitution = 0.7, friction = 0.1, drive_speed = 0.2 } }
[[obstacle]]
kind = "box"
present = false
from = [20.0, 3.0]
to = [22.0, 9.0]
[[partition]]
name = "wall"
axis = "y"
position = 12.0
passes = ["small"]
holes = [{ from = [3.0], to = [6.0] }, { from = [8.0], to = [9.5] }]
)";

/// A scene of disks with an obstacle or a partition.
std::string with(const std::string& fixture) {
  return kParticles + fixture;
}

}  // namespace

TEST_CASE("Fixture keys: a scene has the values of its keys, also when it is written and read") {
  const Scene scene = parse_scene(kFixtures, "");
  REQUIRE(scene.obstacles.size() == 3);
  REQUIRE(scene.partitions.size() == 1);
  const Obstacle &drum = scene.obstacles[0], &triangle = scene.obstacles[1];
  CHECK(drum.name == "drum");
  CHECK(drum.centre == Vec2(5.0, 6.0));
  CHECK(drum.radius == 2.5);
  CHECK(drum.law.wall(0).kind == WallKind::Thermal);
  CHECK(drum.law.wall(0).temperature == 2.0);
  CHECK(drum.law.wall(1).temperature == 3.0);
  CHECK(triangle.corners == std::vector<Vec2>{{10.0, 2.0}, {14.0, 2.0}, {12.0, 5.0}});
  CHECK(triangle.law.wall(1).kind == WallKind::Driven);
  CHECK(triangle.law.wall(1).restitution == 0.8);
  CHECK(triangle.law.wall(1).drive_speed == 0.5);
  CHECK(triangle.law.wall(1).roughness.friction == 0.3);
  CHECK(triangle.law.wall(0).restitution == 0.7);
  CHECK(triangle.law.wall(0).drive_speed == 0.2);
  CHECK(triangle.law.wall(0).roughness.friction == 0.1);
  CHECK(triangle.law.wall(0).roughness.tangential_restitution == 0.4);
  CHECK(!scene.obstacles[2].present);
  CHECK(scene.obstacles[2].to == Vec2(22.0, 9.0));
  CHECK(scene.obstacles[2].law.wall(0).kind == WallKind::Static);
  CHECK(scene.partitions[0].axis == Axis::Y);
  CHECK(scene.partitions[0].holes[1].to[0] == 9.5);
  CHECK(scene.partitions[0].passes == std::vector<std::string>{"small"});
  const Scene again = parse_scene(scene_to_toml(scene), "");
  CHECK(again.obstacles == scene.obstacles);
  CHECK(again.partitions == scene.partitions);
}

TEST_CASE("Fixture keys: overrides find a fixture by its name or its place") {
  const Scene scene = parse_scene(kFixtures, "",
                                  {{"obstacle.drum.radius", "1.5"},
                                   {"obstacle.obstacle_2.species.small.friction", "0.6"},
                                   {"partition.wall.holes", "[]"}});
  CHECK(scene.obstacles[0].radius == 1.5);
  CHECK(scene.obstacles[1].law.wall(0).roughness.friction == 0.6);
  CHECK(scene.partitions[0].holes.empty());
  CHECK(refusal(kFixtures, {{"obstacle.dram.radius", "1"}}).find("no obstacle \"dram\"") !=
        std::string::npos);
}

TEST_CASE("Fixture keys: mistakes have a place and a way out") {
  const auto refused = [](const std::string& fixture, const std::string& place,
                          const std::string& words) {
    const std::string message = refusal(with(fixture));
    CAPTURE(message);
    CHECK(message.find("s.toml:" + place) == 0);
    CHECK(message.find(words) != std::string::npos);
  };
  refused("[[obstacle]]\nkind = \"ball\"\nradius = 1\n", "3:1", "centre");
  refused("[[obstacle]]\nkind = \"ball\"\ncentre = [50, 5]\nradius = 1\n", "5:1", "outside");
  refused("[[obstacle]]\nkind = \"ball\"\ncentre = [5, 5]\nradius = 0\n", "6:1", "radius");
  refused("[[obstacle]]\nkind = \"ball\"\ncentre = [5, 5]\nradius = 11\n", "5:1", "own image");
  refused("[[obstacle]]\nkind = \"cone\"\n", "4:1", "ball");
  refused("[[obstacle]]\nkind = \"polygon\"\ncorners = [[1, 1], [2, 2]]\n", "5:1", "corner");
  refused("[[obstacle]]\nkind = \"polygon\"\ncorners = [[1, 1], [5, 5], [5, 1], [1, 5]]\n", "5:1",
          "meet");
  refused("[[obstacle]]\nkind = \"polygon\"\ncorners = [[1, 1], [5, 1], [3, 1]]\n", "5:1", "back");
  refused("[[obstacle]]\nkind = \"polygon\"\ncorners = [[1, 1], [1, 1], [5, 1], [3, 4]]\n", "5:1",
          "twice");
  refused("[[obstacle]]\nkind = \"box\"\nfrom = [2, 2]\nto = [1, 3]\n", "6:1", "to");
  refused("[[obstacle]]\nkind = \"ball\"\ncentre = [5, 5]\nradius = 1\nfrom = [1, 1]\n", "7:1",
          "kind of obstacle");
  refused(
      "[[obstacle]]\nkind = \"ball\"\ncentre = [5, 5]\nradius = 1\ntemperature = 1\n"
      "restitution = 0.5\n",
      "8:1", "temperature");
  refused("[[partition]]\nposition = 30\n", "4:1", "inside the box");
  refused("[[partition]]\naxis = \"z\"\nposition = 5\n", "4:1", "z");
  refused("[[partition]]\nposition = 5\nholes = [{ from = [4], to = [3] }]\n", "5:1", "hole");
  refused("[[partition]]\nposition = 5\nholes = [{ from = [0], to = [3] }]\n", "5:1", "periodic");
  refused(
      "[[partition]]\nposition = 5\nholes = [{ from = [1], to = [3] }, { from = [2], to = [5] "
      "}]\n",
      "5:1", "two holes");
  refused("[[partition]]\nposition = 5\npasses = [\"small\"]\n", "5:1", "no species");
  refused("[[partition]]\nname = \"a.b\"\nposition = 5\n", "4:1", "name");
  refused(
      "[[obstacle]]\nname = \"a\"\nkind = \"ball\"\ncentre = [5, 5]\nradius = 1\n"
      "[[partition]]\nname = \"a\"\nposition = 15\n",
      "9:1", "second fixture");
  const std::string in_space =
      refusal(kSpheres + "[[obstacle]]\nkind = \"polygon\"\ncorners = [[1, 1], [5, 1], [3, 4]]\n");
  CHECK(in_space.find("spheres") != std::string::npos);
}

TEST_CASE("Fixture keys: no particle begins in a fixture, whatever the layout") {
  for (const std::string layout : {"random", "lattice"}) {
    for (const double fraction : {0.05, 0.4, 0.5}) {
      CAPTURE(layout);
      CAPTURE(fraction);
      const Scene scene = parse_scene(
          "box.size = [20, 20]\nparticles = { area_fraction = " + std::to_string(fraction) +
              ", start.layout = \"" + layout + R"(" }
obstacle = [{ kind = "ball", centre = [0.0, 10.0], radius = 3.0 },
            { kind = "polygon", corners = [[8, 8], [14, 9], [9, 14]] }]
partition = [{ axis = "y", position = 4.0 }]
)",
          "");
      const Model<2> model = model_of<2>(scene, 1);
      const State<2> state = start_state<2>(scene, 1);
      CHECK(static_cast<int>(state.positions.size()) == scene.particles.count);
      const FixtureImages<2> fixtures(model.fixtures, model.domain());
      for (const Vec2& place : state.positions) CHECK(fixtures.depth(place, 0.5, 0) < 1e-12);
      CHECK_NOTHROW(Simulation<2>(model, state));
    }
  }
  const std::string filled = refusal_of([] {
    start_state<2>(parse_scene("box.size = [20, 20]\nparticles.area_fraction = 0.4\n"
                               "obstacle = [{ kind = \"box\", from = [0, 0], to = [20, 12] }]\n",
                               ""),
                   1);
  });
  CHECK(filled.find("fewer") != std::string::npos);
}

// Depths are found from coordinates alone: a box whose corner is not a sum of powers of two.
TEST_CASE("Fixture keys: no sphere begins in a box, and no disk on a membrane that it sees") {
  const Scene space = parse_scene(R"(box.size = [10, 10, 10]
particles.count = 300
obstacle = [{ kind = "box", from = [2.1, -3.3, 2.7], to = [7.9, 6.3, 8.2] }]
)",
                                  "");
  for (const Vec<3>& place : start_state<3>(space, 1).positions) {
    const Vec<3> low(2.1, -3.3, 2.7), high(7.9, 6.3, 8.2);
    const Vec<3> outside = (low - place).cwiseMax(place - high);
    // The box has an image along y, from 6.7 on.
    const Vec<3> image = (low + Vec<3>(0, 10, 0) - place).cwiseMax(place - high - Vec<3>(0, 10, 0));
    CHECK(outside.cwiseMax(0.0).norm() >= 0.5);
    CHECK(image.cwiseMax(0.0).norm() >= 0.5);
  }
  for (const std::string seen : {"a", "b"}) {
    CAPTURE(seen);
    const Scene membrane = parse_scene(R"(box.size = [20, 20]
species = [{ name = "a", count = 75 }, { name = "b", count = 75 }]
partition = [{ axis = "x", position = 10, passes = [")" +
                                           std::string(seen == "a" ? "b" : "a") + "\"] }]\n",
                                       "");
    const State<2> start = start_state<2>(membrane, 2);
    CHECK_NOTHROW(Simulation<2>(model_of<2>(membrane, 2), start));
    int across = 0;
    for (std::size_t i = 0; i < start.positions.size(); ++i) {
      across += std::fabs(start.positions[i].x() - 10.0) < 0.5;
    }
    CHECK(across > 0);  // of the species that passes
  }
}

// A wall is put where particles are: the run ends, and says which.
TEST_CASE("Fixture keys: a change cannot put a fixture where a particle is") {
  const Scene scene = parse_scene(R"(box.size = [10, 10]
particles.area_fraction = 0.5
partition = [{ name = "gate", axis = "x", position = 5.0, present = false }]
change = [{ time = 1.0, set = { "partition.gate.present" = true } }]
)",
                                  "");
  ScheduledRun<2> gas(scene, 1, start_state<2>(scene, 1));
  std::string message;
  try {
    gas.run_until(2.0);
  } catch (const PhysicalStop& stop) {
    message = stop.what();
  }
  CAPTURE(message);
  CHECK(message.find("gate") != std::string::npos);
  CHECK(message.find("t = 1") != std::string::npos);
}

}  // namespace clatter::obstacle_keys
