#include <doctest/doctest.h>

#include <cmath>
#include <string>
#include <vector>

#include "engine/measure/balance.h"
#include "tests/engine/support/gas.h"
#include "tests/support/dimensions.h"

using namespace clatter;
using namespace clatter::testing;

namespace {

// Moving walls are rough here, so that friction contributes too.
Wall with_friction(Wall wall) {
  wall.roughness = {.friction = 0.3, .tangential_restitution = 0.5};
  return wall;
}
const Wall kRoughSawtooth = with_friction(kSawtooth);
const Wall kRoughSinusoidal = with_friction(kSinusoidal);

template <int D>
Model<D> with_spins(Model<D> model) {
  model.spins = true;
  return model;
}

/// A periodic box, of disks or of spheres.
template <int D>
Model<D> box() {
  if constexpr (D == 2) {
    return periodic_box(9.0, 8.0);
  } else {
    return periodic_box(6.0, 5.0, 4.5);
  }
}

template <int D = 2>
Model<D> between(const Wall& wall, int axis) {
  return with_walls(box<D>(), axis, wall);
}

/// Walls on all sides. The walls along z equal the walls along x.
template <int D>
Model<D> walled(const Wall& sides, const Wall& ends) {
  Model<D> model = with_walls(between<D>(sides, 0), 1, ends);
  return D == 3 ? with_walls(model, D - 1, sides) : model;
}

/// A box that is narrow along y.
template <int D>
Model<D> narrow(double height) {
  if constexpr (D == 2) {
    return periodic_box(12.0, height);
  } else {
    return periodic_box(5.0, height, 3.0);
  }
}

/// The first D of three components.
template <int D>
Vec<D> vector(double x, double y, double z = 0.0) {
  return Vec<3>(x, y, z).head<D>();
}

// A run that one balance watches.
template <int D>
struct Watched {
  Simulation<D> simulation;
  Balance<D> balance;

  Watched(const Model<D>& model, const State<D>& start, const IntVec<D>& cells, double time = 0.0)
      : simulation(model, start, time), balance(simulation, cells) {
    simulation.add_observer(balance);
  }
  BalanceWindow<D> close_at(double time) {
    simulation.run_until(time);
    return balance.close_window();
  }
};

// Every equation must close in every cell and window. Cells: coarse ones; single cells along one or
// both axes; halves of a diameter, with faces at contact positions on walls; cells much smaller
// than a particle. 1e-15 is typical. 1e-13 occurs in the shortest window, where gravity or a kick
// changes velocities by 1e-3.
template <int D>
void check_closure(const std::string& name, const Model<D>& model, const State<D>& start,
                   double start_time) {
  CAPTURE(D);
  CAPTURE(name);
  const IntVec<D> halves = (2.0 * model.box).array().round().matrix().template cast<int>();
  std::vector<IntVec<D>> grids = {IntVec<3>(7, 5, 3).head<D>(),
                                  IntVec<D>::Ones(),
                                  IntVec<3>(1, 4, 2).head<D>(),
                                  IntVec<3>(4, 1, 1).head<D>(),
                                  halves,
                                  IntVec<D>::Constant(2)};
  if (D == 2) grids.push_back(3 * halves);
  for (const IntVec<D>& cells : grids) {
    CAPTURE(cells.x());
    CAPTURE(cells.y());
    Watched<D> run(model, start, cells, start_time);
    double time = start_time;
    for (const double duration : {1.0, 0.01, 0.3, 2.5, 0.3}) {
      time += duration;
      CAPTURE(time);
      const BalanceWindow<D> window = run.close_at(time);
      CHECK(window.imbalances.largest()[0] == 0.0);
      CHECK(window.imbalances.largest().maxCoeff() < 1e-12);
    }
    CHECK(run.simulation.counts().pair_collisions > 0);
    bool walls = false;
    for (const auto& wall : model.walls) walls = walls || wall;
    CHECK((run.simulation.counts().wall_collisions > 0) == walls);
    CHECK((run.simulation.counts().kicks > 0) == model.bulk_drive.has_value());
    CHECK((run.simulation.counts().elasticised > 0) == model.contact_time.has_value());
  }
}

template <int D>
void check_closure(const std::string& name, const Model<D>& model, int count = 30,
                   double start_time = 0.0) {
  check_closure(name, model, clear_gas(model, count, 84), start_time);
}

}  // namespace

TEST_CASE_TEMPLATE("Balance: closes for smooth, inelastic and rough particles", Dimension, Plane,
                   Space) {
  constexpr int D = Dimension::value;
  check_closure("smooth", box<D>());
  check_closure("inelastic", inelastic(box<D>(), 0.8));
  check_closure("Coulomb", rough(inelastic(box<D>(), 0.9), 0.2, 1.0));
  check_closure("constant beta", rough(inelastic(box<D>(), 0.9), kInfinity, 0.4));
  check_closure("lossless rough", rough(box<D>(), kInfinity, 1.0));
}

TEST_CASE_TEMPLATE("Balance: closes under gravity, upwards, downwards, aslant and round the box",
                   Dimension, Plane, Space) {
  constexpr int D = Dimension::value;
  const auto fall = [](const Model<D>& model, double x, double y, double z = 0.0) {
    return falling(model, vector<D>(x, y, z));
  };
  check_closure("down, inelastic", fall(inelastic(between<D>(kDriven, 1), 0.9), 0.0, -0.7));
  check_closure("up", fall(inelastic(between<D>(kThermal, 1), 0.9), 0.0, 1.0));
  check_closure("right", fall(inelastic(between<D>(kDriven, 0), 0.9), 0.8, 0.0));
  check_closure("aslant", fall(inelastic(walled<D>(kDriven, kDriven), 0.95), 0.3, -0.7, 0.4));
  check_closure("along a periodic axis", fall(box<D>(), 0.5, 0.0));
  check_closure("along all", fall(inelastic(box<D>(), 0.9), -0.5, 0.8, 0.6));
  check_closure("strong, in a narrow channel",
                fall(inelastic(with_walls(narrow<D>(1.5), 1, kDriven), 0.9), 0.0, -30.0), 6);
}

TEST_CASE_TEMPLATE("Balance: closes with kicks", Dimension, Plane, Space) {
  constexpr int D = Dimension::value;
  check_closure("smooth", kicked(inelastic(box<D>(), 0.8), 0.05, 0.2));
  check_closure("rough", kicked(rough(inelastic(box<D>(), 0.8), 0.5, 0.5), 0.03, 0.2));
  check_closure("between walls, under gravity",
                falling(kicked(inelastic(walled<D>(kDriven, kStatic), 0.8), 0.11, 0.1),
                        vector<D>(0.0, -0.2)));
}

TEST_CASE_TEMPLATE("Balance: closes with every wall, rough and smooth, and at corners", Dimension,
                   Plane, Space) {
  constexpr int D = Dimension::value;
  check_closure("static", between<D>(kStatic, 0));
  check_closure("lossy", inelastic(between<D>(kLossy, 1), 0.9));
  check_closure("thermal", inelastic(between<D>(kThermal, 0), 0.7));
  check_closure("thermal, with spins", with_spins(inelastic(between<D>(kThermal, 1), 0.9)));
  check_closure("driven", inelastic(between<D>(kDriven, 0), 0.9));
  check_closure("rough driven", rough(inelastic(between<D>(kRoughDriven, 1), 0.9), 0.3, 0.5));
  check_closure("saw-tooth", with_spins(inelastic(between<D>(kRoughSawtooth, 0), 0.9)));
  check_closure("sinusoidal", with_spins(inelastic(between<D>(kRoughSinusoidal, 1), 0.9)));
  check_closure("along the last axis", inelastic(between<D>(kDriven, D - 1), 0.9));
  check_closure("lossless",
                rough(walled<D>(kStatic, Wall{.roughness = {kInfinity, 1.0}}), kInfinity, 1.0));
  check_closure("corners", inelastic(walled<D>(kDriven, kLossy), 0.9));
  check_closure("rough corners",
                rough(inelastic(walled<D>(kRoughSinusoidal, kRoughSawtooth), 0.9), 0.3, 0.5), 20);
  check_closure(
      "a shaken floor under gravity",
      falling(with_spins(inelastic(between<D>(kRoughSinusoidal, 1), 0.9)), vector<D>(0.0, -1.0)));
}

TEST_CASE("Balance: closes where a wall's stroke goes over several cells") {
  Wall swinging = kRoughSinusoidal;
  swinging.stroke = 5.0;
  swinging.frequency = 0.2;
  check_closure("disks",
                with_spins(inelastic(with_walls(periodic_box(14.0, 4.0), 0, swinging), 0.9)), 8);
  check_closure("spheres",
                with_spins(inelastic(with_walls(periodic_box(14.0, 2.5, 2.5), 0, swinging), 0.9)),
                10);
}

TEST_CASE_TEMPLATE("Balance: closes with the TC model", Dimension, Plane, Space) {
  constexpr int D = Dimension::value;
  check_closure("driven", with_contact_time(inelastic(walled<D>(kDriven, kLossy), 0.7), 0.1));
  check_closure("rough, under gravity",
                with_contact_time(
                    falling(rough(inelastic(walled<D>(kStatic, kRoughSinusoidal), 0.6), 0.3, 0.3),
                            vector<D>(0.0, -1.0)),
                    0.02),
                20);
}

TEST_CASE_TEMPLATE("Balance: closes where particles touch at images that are not the nearest",
                   Dimension, Plane, Space) {
  constexpr int D = Dimension::value;
  check_closure("elastic", narrow<D>(1.2), 6);
  if constexpr (D == 2) check_closure("one disk wide", periodic_box(1.2, 12.0), 6);
  if constexpr (D == 3) check_closure("one sphere wide", periodic_box(1.2, 1.3, 9.0), 6);
  check_closure("rough, driven",
                rough(inelastic(with_walls(narrow<D>(1.2), 0, kRoughDriven), 0.9), 0.3, 0.7), 6);
  check_closure("falling round", falling(inelastic(narrow<D>(1.2), 0.9), vector<D>(0.2, 1.0)), 6);
}

// The masses are powers of two and 3, so that the sums of masses are exact.
TEST_CASE_TEMPLATE("Balance: closes for mixtures", Dimension, Plane, Space) {
  constexpr int D = Dimension::value;
  const auto check = [](const std::string& name, const Model<D>& model) {
    check_closure(name, with_species(model), mixed_gas(model, 20, 85, 2.0), 0.0);
  };
  check("periodic", inelastic(box<D>(), 0.9));
  check("everything",
        with_contact_time(
            kicked(falling(rough(inelastic(walled<D>(kRoughSinusoidal, kThermal), 0.8), 0.4, 0.6),
                           vector<D>(0.2, -0.5, 0.3)),
                   0.17, 0.1),
            0.01));
}

TEST_CASE_TEMPLATE("Balance: closes with everything at once, at time 0 and at 1e9", Dimension,
                   Plane, Space) {
  constexpr int D = Dimension::value;
  const Model<D> model = with_contact_time(
      kicked(falling(rough(inelastic(walled<D>(kRoughSinusoidal, kRoughDriven), 0.8), 0.4, 0.6),
                     vector<D>(0.2, -0.5, 0.3)),
             0.17, 0.1),
      0.01);
  check_closure("all", model, 20);
  check_closure("all, late", model, 20, 1e9);
  check_closure("periodic, late", falling(box<D>(), vector<D>(0.5, 0.1)), 30, 1e9);
}

TEST_CASE("Balance: a watch that begins finds the particles where they are") {
  Simulation<2> simulation(periodic_box(9.0, 8.0), {{{2.5, 4.5}}, {{1.0, 0.0}}});
  simulation.run_until(3.0);
  Balance<2> balance(simulation, {9, 8});
  simulation.run_until(3.2);
  const BalanceWindow<2> window = balance.close_window();
  for (const Booked<2>& face : window.booked.faces[0]) CHECK(face.size[0] == 0.0);
}

// The faces are at whole numbers. The particle starts at x = 2.5 with speed 1 under gravity -1. At
// time 1 it turns on the face x = 3, and it returns to x = 2 with speed sqrt(2) at 1 + sqrt(2).
TEST_CASE("Balance: a particle carries its present momentum and energy through a face") {
  const Model<2> model = falling(periodic_box(9.0, 8.0), {-1.0, 0.0});
  Watched<2> run(model, {{{2.5, 4.5}}, {{1.0, 0.1}}}, {9, 8});
  const std::size_t row = 9 * 4;
  const BalanceWindow<2> rising = run.close_at(0.999);
  CHECK(rising.booked.faces[0][row + 2].size[0] == 0.0);
  CHECK(rising.booked.sources[row + 2].net[1] == doctest::Approx(-0.999));
  CHECK(rising.booked.sources[row + 2].net[3] == doctest::Approx(-0.4999995));
  CHECK(rising.imbalances.largest().maxCoeff() < 1e-13);
  const BalanceWindow<2> falling = run.close_at(1.5);
  CHECK(falling.booked.faces[0][row + 2].net.norm() < 1e-12);  // back and forth, or no crossing
  CHECK(falling.imbalances.largest().maxCoeff() < 1e-13);
  const BalanceWindow<2> back = run.close_at(2.5);
  const Conserved<2> left = back.booked.faces[0][row + 1].net;
  CHECK(left[0] == -1.0);
  CHECK(left[1] == doctest::Approx(std::sqrt(2.0)));  // -1 times the momentum -sqrt(2)
  CHECK(left[2] == doctest::Approx(-0.1));
  CHECK(left[3] == doctest::Approx(-0.5 * (2.0 + 0.01)));
  CHECK(back.imbalances.largest().maxCoeff() < 1e-13);
}

// A particle of velocity (1, 0) meets one at rest at half time: centres at 3.75 and 4.75, faces at
// 4 and 4.5. alpha = 1/2: the second gains 3/4, the first ends at 1/4.
TEST_CASE("Balance: a collision carries along its branch and dissipates at its ends") {
  Model<2> model = inelastic(periodic_box(9.0, 8.0), 0.5);
  Watched<2> run(model, {{{3.6, 4.1}, {4.75, 4.1}}, {{1.0, 0.0}, {0.0, 0.0}}}, {18, 16});
  const BalanceWindow<2> window = run.close_at(0.2);
  REQUIRE(run.simulation.counts().pair_collisions == 1);
  const std::size_t row = 18 * 8;
  const double gain = 0.5 * 0.75 * 0.75, loss = 0.5 * (0.0625 - 1.0);
  for (std::size_t face : {7, 8}) {
    const Conserved<2> passed = window.booked.faces[0][row + face].net;
    CHECK(passed[0] == 0.0);
    CHECK(passed[1] == doctest::Approx(0.75));
    CHECK(passed[2] == doctest::Approx(0.0));
    CHECK(passed[3] == doctest::Approx(0.5 * (gain - loss)));
  }
  for (std::size_t cell : {7, 9}) {
    CHECK(window.booked.sources[row + cell].net[3] == doctest::Approx(0.5 * (gain + loss)));
  }
  CHECK(window.booked.sources[row + 8].size.maxCoeff() == 0.0);
  CHECK(window.booked.faces[0][row + 6].size.maxCoeff() == 0.0);
  CHECK(window.booked.faces[0][row + 9].size.maxCoeff() == 0.0);
  CHECK(window.booked.faces[1][row + 8].size.maxCoeff() == 0.0);
  CHECK(window.booked.weights[row + 7][1] == doctest::Approx(0.75));
  CHECK(window.booked.weights[row + 7][3] == doctest::Approx(0.75 + gain));  // |v.dp| + dp^2/2
  CHECK(window.booked.weights[row + 9][3] == doctest::Approx(gain));
  CHECK(window.imbalances.largest().maxCoeff() < 1e-13);
  const BalanceWindow<2> quiet = run.close_at(0.21);
  CHECK(quiet.booked.weights[row + 7].norm() == 0.0);
  CHECK(quiet.booked.sources[row + 7].size.norm() == 0.0);
  CHECK(quiet.booked.faces[0][row + 7].size.norm() == 0.0);
}

// A particle at (3.5, 0.2) of velocity (1, 0) meets one at rest at (4.5, 1.0), or its image (4.5,
// -0.2), because the box is 1.2 high. Their direction is (-sqrt(0.84), 0.4). From the second, the
// branch crosses y = 0 upwards and then x = 4 to the left. It does not cross y = 0.8 and y = 0.4
// downwards.
TEST_CASE("Balance: a branch passes the faces between images that touch, in order") {
  for (const int moving : {0, 1}) {
    State<2> start{{{4.5, 1.0}, {4.5, 1.0}}, {{0.0, 0.0}, {0.0, 0.0}}};
    start.positions[moving] = {3.5, 0.2};
    start.velocities[moving] = {1.0, 0.0};
    Watched<2> run(periodic_box(9.0, 1.2), start, {9, 3});
    const BalanceWindow<2> window = run.close_at(0.1);
    REQUIRE(run.simulation.counts().pair_collisions == 1);
    const Conserved<2> given(0.0, -0.84, 0.4 * std::sqrt(0.84), -0.42);
    const std::size_t up = 9 * 2 + 4, left = 3;
    for (std::size_t cell = 0; cell < 27; ++cell) {
      const Conserved<2> through_x = window.booked.faces[0][cell].net;
      const Conserved<2> through_y = window.booked.faces[1][cell].net;
      CHECK((through_x + (cell == left ? 1.0 : 0.0) * given).norm() < 1e-14);
      CHECK((through_y - (cell == up ? 1.0 : 0.0) * given).norm() < 1e-14);
    }
    CHECK(window.imbalances.largest().maxCoeff() < 1e-13);
  }
}

// The particle, of velocity (1, 0), touches the far wall with its centre at 8.5; faces
// at 8.25, 8.5, 8.75. alpha_w = 0.8: it gains momentum -1.8 and energy -0.18.
TEST_CASE("Balance: momentum and energy from a wall enter at the contact point") {
  Watched<2> run(between(kLossy, 0), {{{8.4, 4.1}}, {{1.0, 0.0}}}, {36, 8});
  const BalanceWindow<2> window = run.close_at(0.15);
  REQUIRE(run.simulation.counts().wall_collisions == 1);
  const std::size_t row = 36 * 4;
  const Conserved<2> given = window.booked.sources[row + 35].net;
  CHECK(given[1] == doctest::Approx(-1.8));
  CHECK(given[3] == doctest::Approx(-0.18));
  const Conserved<2> passed = window.booked.faces[0][row + 34].net;
  CHECK(passed[0] == 0.0);
  CHECK(passed[1] == doctest::Approx(1.8));
  CHECK(passed[3] == doctest::Approx(0.18));
  CHECK(window.booked.faces[0][row + 35].size.maxCoeff() == 0.0);
  CHECK(window.booked.sources[row + 33].size.maxCoeff() == 0.0);
  CHECK(window.imbalances.largest().maxCoeff() < 1e-13);
}

// The left wall moves slowly inwards at 0.002. It is 1 inside when the particle of velocity (-1, 0)
// hits it at x = 1.0002, with its centre at 1.5002. Faces every 1/4. alpha_w = 0.9.
TEST_CASE("Balance: momentum and energy from a wall inside the box enter inside") {
  Model<2> model = periodic_box(9.0, 8.0);
  const Wall creeping{.kind = WallKind::Sawtooth,
                      .restitution = 0.9,
                      .stroke = 2.0,
                      .frequency = 0.001,
                      .phase = 0.5};
  model.walls = {creeping, kStatic, {}, {}};
  Watched<2> run(model, {{{1.6, 4.1}}, {{-1.0, 0.0}}}, {36, 8});
  const BalanceWindow<2> window = run.close_at(0.15);
  REQUIRE(run.simulation.counts().wall_collisions == 1);
  const std::size_t row = 36 * 4;
  for (std::size_t cell = 0; cell < 36; ++cell) {
    const double arisen = window.booked.sources[row + cell].net[1];
    const double passed = window.booked.faces[0][row + cell].net[1];
    CHECK(arisen == doctest::Approx(cell == 4 ? 1.9 + 1.9 * 0.002 : 0.0));
    CHECK(passed == doctest::Approx(cell == 4 || cell == 5 ? 1.9 + 1.9 * 0.002 : 0.0));
  }
  CHECK(window.imbalances.largest().maxCoeff() < 1e-13);
}

// One particle needs 9 windows to cross the box, and its flight never ends. At the end of each
// window it is on a face.
TEST_CASE("Balance: a flight over many windows, each ending on a face") {
  for (const Vec2& v : {Vec2(1.0, 0.0), Vec2(-1.0, 0.0), Vec2(1.0, -1.0), Vec2(0.1, 0.3)}) {
    Watched<2> run(periodic_box(9.0, 8.0), {{{2.0, 4.0}}, {v}}, {9, 8});
    double passed = 0.0;
    for (int window = 1; window <= 900; ++window) {
      const BalanceWindow<2> balance = run.close_at(window);
      CHECK(balance.imbalances.largest().maxCoeff() == 0.0);
      for (const Booked<2>& face : balance.booked.faces[0]) passed += face.net[0];
    }
    CHECK(std::fabs(passed - 900.0 * v.x()) <= 1.0);
  }
}

// Particles start on faces and corners, and collide there. All contributions must agree on the cell
// of a particle.
TEST_CASE("Balance: collisions on faces and at corners of cells") {
  for (const double restitution : {1.0, 0.5}) {
    for (const bool walled : {false, true}) {
      Model<2> model = inelastic(periodic_box(8.0, 8.0), restitution);
      if (walled) model = with_walls(with_walls(model, 0, kDriven), 1, kStatic);
      State<2> start;
      for (int i = 0; i < 16; ++i) {
        const Vec2 directions[] = {{1.0, 0.0}, {0.0, 1.0}, {-1.0, 0.0}, {0.0, -1.0}};
        start.positions.push_back({1.0 + 2.0 * (i % 4), 1.0 + 2.0 * (i / 4)});
        start.velocities.push_back(directions[(i + i / 4) % 4]);
      }
      Watched<2> run(model, start, {16, 16});
      for (int window = 1; window <= 20; ++window) {
        CHECK(run.close_at(0.5 * window).imbalances.largest().maxCoeff() < 1e-10);
      }
      CHECK(run.simulation.counts().pair_collisions > 10);
    }
  }
}

// The apex of the parabola is a rounding error above the face. The particle would cross it up and
// down within the time resolution at 1000.
TEST_CASE("Balance: a particle that turns on a face does not cross it for ever") {
  RunState<2> saved;
  saved.now = 1000.0;
  saved.until_base_moves = 64;
  saved.flights.push_back({{3.0, 4.5}, {1e-20, 0.0}, 1000.0, 0});
  Simulation<2> simulation(falling(periodic_box(9.0, 8.0), {-1.0, 0.0}), saved);
  Balance<2> balance(simulation, {9, 8});
  simulation.add_observer(balance);
  simulation.run_until(1000.5);
  const BalanceWindow<2> window = balance.close_window();
  CHECK(window.booked.faces[0][9 * 4 + 2].net[0] == -1.0);
  CHECK(window.imbalances.largest().maxCoeff() < 1e-12);
}

// The disks meet almost along y and exchange a momentum along x of a few hundred rounding errors of
// their velocities. A lone disk gains a similar amount under weak gravity.
TEST_CASE("Balance: changes as small as rounding are no false alarm") {
  Watched<2> pair(inelastic(periodic_box(9.0, 8.0), 0.83),
                  {{{4.6, 2.5}, {4.6 + 3e-14, 5.5}}, {{0.7, 1.01}, {0.7, -1.03}}}, {1, 2});
  const Imbalances<2> met = pair.close_at(1.5).imbalances;
  CHECK(pair.simulation.counts().pair_collisions == 1);
  CHECK(met.largest().maxCoeff() < 1e-6);
  for (const double gravity : {1e-13, 1e-16, 1e-20}) {
    CAPTURE(gravity);
    Watched<2> lone(falling(periodic_box(9.0, 8.0), {gravity, -0.3 * gravity}),
                    {{{4.6, 2.5}}, {{0.7, 1.0}}}, {9, 8});
    for (const double time : {0.3, 2.0, 31.0}) {
      CHECK(lone.close_at(time).imbalances.largest().maxCoeff() < 1e-6);
    }
  }
}

// The particle hits the far wall with momentum 1 and crosses the face x = 8 with -0.8 at 0.725. A
// balance without the wall event misses -1.8, first relative to nothing, then relative to 0.8.
TEST_CASE("Balance: residuals are relative to the booked amounts") {
  const Model<2> model = between(kLossy, 0);
  for (const auto& [end, residual] : {std::pair(0.5, -1.0), std::pair(0.9, -2.25)}) {
    Simulation<2> simulation(model, {{{8.4, 4.5}}, {{1.0, 0.0}}});
    Balance<2> unheard(simulation, {9, 8});
    simulation.run_until(end);
    const Imbalances<2> open = unheard.close_window().imbalances;
    const Conserved<2> at_wall = open.residual(9 * 4 + 8);
    CHECK(at_wall[0] == 0.0);
    CHECK(at_wall[1] == doctest::Approx(residual));
    CHECK(at_wall[2] == 0.0);
    CHECK(open.residual(9 * 4 + 7).cwiseAbs().maxCoeff() < 1e-13);
    CHECK(open.largest()[1] == doctest::Approx(-residual));
  }
}
