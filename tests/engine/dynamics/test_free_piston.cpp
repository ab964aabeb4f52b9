#include <doctest/doctest.h>

#include <array>
#include <cmath>
#include <string>

#include "engine/dynamics/simulation.h"
#include "engine/initial/start_state.h"
#include "engine/scene/scene.h"
#include "engine/scene/scene_file.h"
#include "tests/engine/support/reference.h"

namespace clatter::free_pistons {

using namespace testing;

namespace {

// The gas of a scene must equal the reference to the last bit, and no particle enters the piston or
// changes its side.
template <int D>
void compare_piston(const std::string& text, std::uint64_t collisions) {
  CAPTURE(text);
  const Scene scene = parse_scene(text, "");
  const Model<D> model = model_of<D>(scene, 5);
  const State<D> start = start_state<D>(scene, 5);
  Simulation<D> simulation(model, start);
  run_beside_reference(simulation, start, collisions);
  CHECK(simulation.counts().wall_collisions > 20);
  const State<D> end = simulation.state();
  const FreePiston& piston = *model.free_piston;
  for (std::uint32_t i = 0; i < end.positions.size(); ++i) {
    const double before = start.positions[i][piston.axis] - piston.position;
    const double way = end.positions[i][piston.axis] - end.piston->place;
    CHECK((before < 0.0) == (way < 0.0));
    CHECK(std::fabs(way) > 0.5 * piston.thickness + simulation.grain(i).radius - 1e-12);
  }
  CHECK(simulation.deepest_overlap() < 1e-12);
}

std::string gas(const std::string& box, int count, const std::string& more = "") {
  return "[box]\nsize = " + box + "\n[particles]\ncount = " + std::to_string(count) +
         "\nrestitution = 0.95\n" + more;
}

const std::string kEnds = R"(
[walls.left]
kind = "static"
[walls.right]
kind = "static"
)";

// The table of the piston is the last one.
const std::string kMixture = R"(
[box]
size = [20.0, 8.0]
[particles]
restitution = 0.95
[[species]]
name = "small"
count = 20
count_left = 15
diameter = 0.6
[[species]]
name = "large"
count = 6
count_left = 1
diameter = 1.4
[piston]
position = 9.0
mass = 4.0
)";

const std::string kFloor = R"(
[walls.bottom]
kind = "sawtooth"
stroke = 0.2
frequency = 3.0
[walls.top]
kind = "thermal"
temperature = 2.0
)";

}  // namespace

TEST_CASE("Free piston: a gas of disks equals the reference") {
  const std::string rough = "friction = 0.4\ntangential_restitution = 0.5\n";
  for (const int count : {1, 2, 15}) {
    CAPTURE(count);
    const std::string box = gas("[12.0, 5.0]", count) + kEnds;
    compare_piston<2>(box + "[piston]\nposition = 6.0\nmass = 5.0\n", 1000);
    compare_piston<2>(box + "[piston]\nposition = 3.5\nmass = 0.02\nthickness = 0.6\nspeed = 3.0\n",
                      1000);
    compare_piston<2>(gas("[12.0, 5.0]", count, rough) + kEnds + kFloor +
                          "[gravity]\nacceleration = [0.3, -0.2]\n[collapse]\ncontact_time = 0.01\n"
                          "[piston]\nposition = 6.0\nmass = 8.0\nforce = -1.5\nrestitution = 0.8\n"
                          "friction = 0.3\n",
                      1000);
    compare_piston<2>(gas("[5.0, 14.0]", count) + kFloor +
                          "[gravity]\nacceleration = [0.0, -0.2]\n"
                          "[piston]\naxis = \"y\"\nposition = 9.0\nmass = 30.0\nforce = -10.0\n",
                      1000);
  }
}

TEST_CASE("Free piston: a gas of spheres equals the reference") {
  for (const int count : {1, 2, 20}) {
    CAPTURE(count);
    compare_piston<3>(gas("[9.0, 3.0, 3.0]", count) + kEnds +
                          "[piston]\nposition = 4.0\nmass = 3.0\nthickness = 0.5\n",
                      600);
  }
  // Spheres in a dense gas have lists of their own.
  compare_piston<3>(gas("[9.0, 5.0, 5.0]", 194) + kEnds + "[piston]\nposition = 4.4\nmass = 9.0\n",
                    3000);
}

TEST_CASE("Free piston: each species meets its law") {
  compare_piston<2>(kMixture +
                        "thickness = 0.2\nspecies = { large = { restitution = 0.5, "
                        "friction = 0.2 } }\n" +
                        kEnds,
                    3000);
}

TEST_CASE("Free piston: species start on their sides") {
  const State<2> state = start_state<2>(parse_scene(kMixture + kEnds, ""), 7);
  std::array<int, 2> left{};
  for (std::size_t i = 0; i < state.positions.size(); ++i) {
    if (state.positions[i].x() < 9.0) ++left[state.grains[i].species];
  }
  CHECK(left[0] == 15);
  CHECK(left[1] == 1);
}

// A pinned piston reflects as a partition does, which has another kind of contact.
TEST_CASE("Free piston: pinned it acts as a partition") {
  const std::string box = gas("[12.0, 5.0]", 14) + kEnds;
  const Scene pinned =
      parse_scene(box +
                      "[piston]\nposition = 6.0\nmass = 5.0\nspeed = 2.0\npinned = true\n"
                      "restitution = 0.9\nfriction = 0.3\n",
                  "");
  const Scene divided = parse_scene(box +
                                        "[[partition]]\naxis = \"x\"\nposition = 6.0\n"
                                        "restitution = 0.9\nfriction = 0.3\n",
                                    "");
  const State<2> start = start_state<2>(pinned, 3);
  Simulation<2> one(model_of<2>(pinned, 3), start), other(model_of<2>(divided, 3), start);
  one.run_until(10.0);
  other.run_until(10.0);
  CHECK(one.counts().pair_collisions == other.counts().pair_collisions);
  CHECK(one.counts().wall_collisions == other.counts().wall_collisions);
  CHECK(one.counts().wall_collisions > 20);
  const State<2> end = one.state();
  for (std::size_t i = 0; i < start.positions.size(); ++i) {
    CHECK((end.positions[i] - other.state().positions[i]).norm() < 1e-6);
  }
  CHECK(end.piston == PistonState{6.0, 0.0});
}

// A freed piston starts from rest where it is, and a weight begins to act at once.
TEST_CASE("Free piston: its laws change during a run") {
  const Scene scene = parse_scene("box.size = [30.0, 5.0]\nparticles.count = 0\n" + kEnds +
                                      "[piston]\nposition = 6.0\nmass = 5.0\nspeed = 2.0\n",
                                  "");
  const auto laws = [&](bool pinned, double force) {
    Model<2> model = model_of<2>(scene, 1);
    model.free_piston->pinned = pinned;
    model.free_piston->force = force;
    return model;
  };
  Simulation<2> gas(laws(false, 0.0), start_state<2>(scene, 1));
  gas.run_until(1.0);
  CHECK(gas.state().piston == PistonState{8.0, 2.0});
  gas.set_laws(laws(true, 0.0));
  gas.run_until(2.0);
  CHECK(gas.state().piston == PistonState{8.0, 0.0});
  gas.set_laws(laws(false, 10.0));
  gas.run_until(4.0);
  CHECK(gas.state().piston == PistonState{12.0, 4.0});
  // At x = 30 the wall turns it: 12 + 4 t + t^2 = 30 at t = sqrt(22) - 2, with the speed
  // 2 sqrt(22). It then comes back like a ball.
  gas.run_until(4.0 + 2.0 * (std::sqrt(22.0) - 2.0));
  CHECK(gas.state().piston->place == doctest::Approx(12.0).epsilon(1e-12));
  CHECK(gas.state().piston->velocity == doctest::Approx(-4.0).epsilon(1e-12));
}

TEST_CASE("Reversal: an elastic gas with spins and a piston runs back to its start") {
  const Scene scene = parse_scene(R"(
[box]
size = [16.0, 9.0]
[particles]
count = 40
friction = inf
tangential_restitution = 1.0
[particles.start]
spin_temperature = 1.0
[gravity]
acceleration = [0.0, -0.3]
[piston]
position = 8.0
mass = 4.0
force = 0.5
)" + kEnds,
                                  "");
  const State<2> start = start_state<2>(scene, 2);
  Simulation<2> gas(model_of<2>(scene, 2), start);
  gas.run_until(4.0);
  CHECK(gas.counts().pair_collisions > 40);
  gas.reverse();
  gas.run_until(8.0);
  const State<2> end = gas.state();
  for (std::size_t i = 0; i < start.positions.size(); ++i) {
    CHECK((end.positions[i] - start.positions[i]).norm() < 1e-6);
    CHECK((end.velocities[i] + start.velocities[i]).norm() < 1e-6);
    CHECK((end.spins[i] + start.spins[i]).norm() < 1e-6);
  }
  CHECK(end.piston->place == doctest::Approx(8.0).epsilon(1e-6));
  CHECK(gas.counts().nudges == 1);
}

}  // namespace clatter::free_pistons
