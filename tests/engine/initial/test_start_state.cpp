#include <doctest/doctest.h>

#include <algorithm>
#include <cmath>
#include <complex>
#include <numbers>
#include <set>
#include <vector>

#include "engine/initial/start_state.h"
#include "engine/scene/state_file.h"
#include "tests/engine/support/gas.h"
#include "tests/engine/support/rooms.h"

using namespace clatter;
using namespace clatter::testing;

namespace {

struct Case {
  double fraction;
  const char* how;
};

/// One of each way in which a random layout is made.
const Case kCases[] = {{0.1, "insertion"}, {0.3, "insertion"}, {0.5, "insertion"},
                       {0.6, "melting"},   {0.69, "melting"},  {0.75, "lattice"}};

/// About 500 particles; walls reduce what a lattice holds, so the fraction is a little lower there.
Scene scene_of(double fraction, std::array<bool, 2> walled) {
  Scene scene;
  scene.box = Vec2(25.0, 22.0);
  for (int axis = 0; axis < 2; ++axis) {
    if (walled[axis]) scene.walls[2 * axis] = scene.walls[2 * axis + 1] = Wall{};
  }
  scene.particles.count = static_cast<int>(fraction * scene.box.prod() * 4.0 / std::numbers::pi);
  scene.particles.start.temperature = 1.7;
  return scene;
}

Room<2> room_of(const Scene& scene) {
  return {scene.box, {!scene.periodic(0), !scene.periodic(1)}};
}

Vec2 nearest(const Scene& scene, Vec2 x) {
  for (int k = 0; k < 2; ++k) {
    if (scene.periodic(k)) x[k] -= scene.box[k] * std::round(x[k] / scene.box[k]);
  }
  return x;
}

/// |<exp(i m theta)>| over all pairs closer than 1.5: 1 for a lattice, about 1/sqrt(bonds) without
/// order.
double bond_order(const Scene& scene, const std::vector<Vec2>& centres, int m) {
  std::complex<double> sum = 0.0;
  double bonds = 0.0;
  for (const Vec2& a : centres) {
    for (const Vec2& b : centres) {
      const Vec2 x = nearest(scene, a - b);
      if (&a == &b || x.norm() > 1.5) continue;
      sum += std::polar(1.0, m * std::atan2(x.y(), x.x()));
      bonds += 1.0;
    }
  }
  return bonds > 0.0 ? std::abs(sum) / bonds : 0.0;
}

double temperature(const State<2>& state) {
  double sum = 0.0;
  for (const Vec2& v : state.velocities) sum += v.squaredNorm();
  return sum / (2.0 * static_cast<double>(state.velocities.size()));
}

}  // namespace

TEST_CASE("Start state: no particles overlap each other or a wall, at any density") {
  for (const std::array<bool, 2> walled : {std::array{false, false}, {true, false}, {true, true}}) {
    for (const Case& c : kCases) {
      const Scene scene = scene_of(c.fraction, walled);
      CAPTURE(c.fraction);
      CAPTURE(c.how);
      CAPTURE(walled[0]);
      CAPTURE(walled[1]);
      REQUIRE(scene.particles.count <= lattice_capacity(room_of(scene)));
      const State<2> state = start_state<2>(scene, 71);
      REQUIRE(static_cast<int>(state.positions.size()) == scene.particles.count);
      CHECK(least_distance(room_of(scene), state.positions) >= 1.0 - 1e-12);
      CHECK(all_inside(room_of(scene), state.positions, 1e-12));
    }
  }
}

TEST_CASE("Start state: the temperature is met exactly, the mean velocity is removed") {
  for (const int count : {2, 3, 10, 400}) {
    Scene scene = scene_of(0.1, {false, true});
    scene.particles.count = count;
    const State<2> state = start_state<2>(scene, 72);
    CAPTURE(count);
    CHECK(temperature(state) == doctest::Approx(1.7).epsilon(1e-14));
    CHECK(momentum(state).norm() < 1e-12);
  }
}

TEST_CASE("Start state: velocities are Gaussian") {
  // 5000 particles: kurtosis <v^4>/<v^2>^2 = 3 with standard error sqrt(24/10000) = .049 over both
  // components, <v_x v_y> = 0 with T/sqrt(5000).
  Scene scene;
  scene.box = Vec2(200.0, 200.0);
  scene.particles.count = 5000;
  const State<2> state = start_state<2>(scene, 73);
  double fourth = 0.0, mixed = 0.0;
  for (const Vec2& v : state.velocities) {
    fourth += v.cwiseAbs2().squaredNorm() / 10000.0;
    mixed += v.x() * v.y() / 5000.0;
  }
  CHECK(std::fabs(fourth - 3.0) < 5.0 * 0.049);
  CHECK(std::fabs(mixed) < 5.0 / std::sqrt(5000.0));
}

TEST_CASE("Start state: another seed gives another state") {
  for (const Case& c : kCases) {
    CAPTURE(c.fraction);
    const Scene scene = scene_of(c.fraction, {true, false});
    const State<2> state = start_state<2>(scene, 74);
    const State<2> other = start_state<2>(scene, 75);
    CHECK(state.positions != other.positions);
    CHECK(state.velocities != other.velocities);
  }
}

TEST_CASE("Start state: places do not depend on the temperature") {
  Scene scene = scene_of(0.6, {false, false});
  const State<2> warm = start_state<2>(scene, 76);
  scene.particles.start.temperature = 0.0;
  const State<2> cold = start_state<2>(scene, 76);
  CHECK(warm.positions == cold.positions);
  CHECK(std::ranges::all_of(cold.velocities, [](const Vec2& v) { return v == Vec2(0.0, 0.0); }));
}

TEST_CASE("Start state: a melted lattice has no more order than a fluid") {
  // Without order |psi_m| = 1/sqrt(independent bonds), for 500 particles about .03; a hard-particle
  // fluid near freezing is correlated over some diameters. The lattice that is melted has |psi_4|
  // near 1.
  for (const double fraction : {0.6, 0.69}) {
    for (const std::array<bool, 2> walled : {std::array{false, false}, {true, true}}) {
      const Scene scene = scene_of(fraction, walled);
      CAPTURE(fraction);
      for (const std::uint64_t seed : {77u, 78u, 79u}) {
        const State<2> state = start_state<2>(scene, seed);
        CHECK(bond_order(scene, state.positions, 4) < 0.15);
      }
    }
  }
  const Scene scene = scene_of(0.6, {false, false});
  const auto sites = primitive_lattice(room_of(scene), scene.particles.count);
  CHECK(bond_order(scene, sites, 4) > 0.9);
}

TEST_CASE("Start state: a lattice stays a lattice if asked for, or too dense to melt") {
  Scene scene = scene_of(0.75, {false, false});
  CHECK(bond_order(scene, start_state<2>(scene, 80).positions, 6) > 0.9);
  scene = scene_of(0.2, {true, false});
  scene.particles.start.layout = Layout::Lattice;
  const State<2> state = start_state<2>(scene, 80);
  CHECK(least_distance(room_of(scene), state.positions) > 1.5);
  // Few different heights or few different places along x: the sites lie in rows.
  std::set<long> x, y;
  for (const Vec2& r : state.positions) {
    x.insert(std::lround(1e6 * r.x()));
    y.insert(std::lround(1e6 * r.y()));
  }
  CHECK(std::min(x.size(), y.size()) < state.positions.size() / 4);
}

TEST_CASE("Start state: there may be no particle, one or two") {
  for (const Layout layout : {Layout::Random, Layout::Lattice}) {
    for (const int count : {0, 1, 2}) {
      CAPTURE(count);
      Scene scene = scene_of(0.1, {true, false});
      scene.particles.count = count;
      scene.particles.start.layout = layout;
      const State<2> state = start_state<2>(scene, 81);
      REQUIRE(static_cast<int>(state.positions.size()) == count);
      REQUIRE(static_cast<int>(state.velocities.size()) == count);
      if (count > 0) CHECK(temperature(state) == doctest::Approx(1.7).epsilon(1e-14));
      CHECK((count == 1) == (momentum(state).norm() > 0.1));  // one keeps its momentum
    }
  }
}

TEST_CASE("Start state: one particle may nearly fill its box") {
  // phi = .55, beyond random insertion; nothing that it could collide with while melting.
  for (const bool walled : {false, true}) {
    Scene scene;
    scene.box = Vec2(1.2, 1.19);
    scene.particles.count = 1;
    if (walled) scene.walls[kLeft] = scene.walls[kRight] = Wall{};
    CHECK(start_state<2>(scene, 82).positions.size() == 1);
  }
}

TEST_CASE("Start state: spins have exactly their temperature, and a random mean") {
  // 5000 particles: the mean of omega is 0 with standard error sqrt(T_rot/(I N)), and what is left
  // of it shows that none was taken out; the kurtosis is 3 with standard error sqrt(24/5000) =
  // .069.
  Scene scene;
  scene.box = Vec2(200.0, 200.0);
  scene.particles.count = 5000;
  scene.particles.roughness.friction = 0.5;
  scene.particles.inertia = 0.4;
  scene.particles.start.spin_temperature = 2.3;
  const double moment = 0.1;  // I = q/4
  const State<2> state = start_state<2>(scene, 83);
  REQUIRE(state.spins.size() == 5000);
  double mean = 0.0, square = 0.0, fourth = 0.0, mixed = 0.0;
  for (std::size_t i = 0; i < state.spins.size(); ++i) {
    const double omega = state.spins[i][0];
    mean += omega / 5000.0;
    square += omega * omega / 5000.0;
    fourth += std::pow(omega, 4) / 5000.0;
    mixed += omega * state.velocities[i].x() / 5000.0;
  }
  CHECK(moment * square == doctest::Approx(2.3).epsilon(1e-14));
  CHECK(std::fabs(mean) < 5.0 * std::sqrt(2.3 / moment / 5000.0));
  CHECK(std::fabs(mean) > 1e-6);
  CHECK(std::fabs(fourth / (square * square) - 3.0) < 5.0 * 0.069);
  CHECK(std::fabs(mixed) < 5.0 * std::sqrt(square / 5000.0));
  CHECK(start_state<2>(scene, 84).spins != state.spins);
}

TEST_CASE("Start state: spins exist only where the scene has them, and change nothing else") {
  Scene scene = scene_of(0.6, {true, false});
  const State<2> smooth = start_state<2>(scene, 85);
  CHECK(smooth.spins.empty());
  scene.walls[kLeft]->roughness.tangential_restitution = 0.5;
  const State<2> still = start_state<2>(scene, 85);
  REQUIRE(still.spins.size() == smooth.positions.size());
  CHECK(std::ranges::all_of(still.spins, [](const Spin<2>& spin) { return spin[0] == 0.0; }));
  CHECK(still.positions == smooth.positions);
  CHECK(still.velocities == smooth.velocities);
  scene.particles.start.spin_temperature = 1.0;
  scene.particles.count = 1;
  scene.particles.inertia = 0.5;
  CHECK(std::fabs(start_state<2>(scene, 85).spins[0][0]) == doctest::Approx(std::sqrt(8.0)));
}

TEST_CASE("Start state: particles keep clear of moving walls, at any density") {
  for (const Case& c : kCases) {
    // The room of 25 x 22 that other cases fill, and what the walls sweep around it.
    const Scene still = scene_of(c.fraction, {true, true});
    Scene scene = still;
    scene.walls[kLeft] = Wall{.kind = WallKind::Sawtooth, .stroke = 1.5, .frequency = 1.0};
    scene.walls[kTop] = Wall{.kind = WallKind::Sinusoidal, .stroke = 3.0, .frequency = 1.0};
    scene.walls[kBottom] = Wall{.kind = WallKind::Sawtooth, .stroke = 0.25, .frequency = 1.0};
    scene.box = Vec2(26.5, 23.75);
    CAPTURE(c.fraction);
    CAPTURE(c.how);
    const State<2> state = start_state<2>(scene, 86);
    const State<2> expected = start_state<2>(still, 86);
    REQUIRE(state.positions.size() == expected.positions.size());
    for (std::size_t i = 0; i < state.positions.size(); ++i) {
      CHECK(state.positions[i] == expected.positions[i] + Vec2(1.5, 0.25));
    }
    CHECK(state.velocities == expected.velocities);
  }
}

TEST_CASE("Start state: forces, roughness and driving do not change the places") {
  Scene scene = scene_of(0.6, {false, true});
  const State<2> plain = start_state<2>(scene, 87);
  scene.gravity = Vec2(1.0, -5.0);
  scene.bulk_drive = {.interval = 0.01, .kick_speed = 3.0, .kick_spin = 1.0};
  scene.contact_time = 0.1;
  scene.particles.restitution = 0.5;
  scene.particles.roughness.friction = 0.5;
  scene.particles.start.spin_temperature = 2.0;
  const State<2> other = start_state<2>(scene, 87);
  CHECK(other.positions == plain.positions);
  CHECK(other.velocities == plain.velocities);
}

TEST_CASE("Start state: a saved state starts a run, bit for bit") {
  const auto restarted = [](Scene scene, const State<2>& saved) {
    scene.particles.start.layout = Layout::File;
    scene.particles.start.state = parse_state(state_to_csv(saved), "a.csv", scene);
    return start_state<2>(scene, 1);
  };
  Scene scene = scene_of(0.3, {true, false});
  Simulation<2> simulation(model_of<2>(scene, 88), start_state<2>(scene, 88));
  simulation.run_until(1.7);
  const State<2> state = restarted(scene, simulation.state());
  CHECK(state.positions == simulation.state().positions);
  CHECK(state.velocities == simulation.state().velocities);
  CHECK(state.spins.empty());
  CHECK(Simulation<2>(model_of<2>(scene, 1), state).state_hash() == simulation.state_hash());

  scene.particles.roughness.friction = 0.5;
  scene.particles.start.spin_temperature = 2.0;
  const State<2> spinning = start_state<2>(scene, 88);
  CHECK(restarted(scene, spinning).spins == spinning.spins);
}
