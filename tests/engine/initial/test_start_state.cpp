#include <doctest/doctest.h>

#include <algorithm>
#include <cmath>
#include <complex>
#include <numbers>
#include <set>
#include <string>
#include <vector>

#include "engine/error.h"
#include "engine/initial/start_state.h"
#include "engine/physics/theory.h"
#include "engine/scene/scene_file.h"
#include "engine/scene/state_file.h"
#include "tests/engine/support/gas.h"
#include "tests/engine/support/rooms.h"
#include "tests/support/statistics.h"

using namespace clatter;
using namespace clatter::testing;

namespace {

struct StartCase {
  double fraction;
  const char* how;
};

/// One case for each method of a random layout.
template <int D>
std::vector<StartCase> cases() {
  if (D == 2) {
    return {{0.1, "insertion"}, {0.3, "insertion"}, {0.5, "insertion"},
            {0.6, "melting"},   {0.69, "melting"},  {0.75, "lattice"}};
  }
  return {{0.1, "insertion"}, {0.3, "insertion"}, {0.36, "insertion"}, {0.4, "melting"},
          {0.48, "melting"},  {0.53, "melting"},  {0.58, "lattice"}};
}

/// A fraction at which the random layout of disks or spheres starts from a melted lattice.
template <int D>
constexpr double kMelted = D == 2 ? 0.6 : 0.45;

/// Sides that are exact in binary, so that positions can be shifted without rounding.
template <int D>
Vec<D> box_of() {
  if constexpr (D == 2) {
    return {25.0, 22.0};
  } else {
    return {6.125, 7.125, 6.25};
  }
}

template <int D>
Room<D> room_of(const Scene& scene) {
  return scene.start_room<D>();
}

/// About 500 disks or 250 spheres, at most the capacity of a lattice, which walls reduce.
template <int D>
Scene scene_of(double fraction, std::array<bool, D> walled, const Vec<D>& box = box_of<D>()) {
  Scene scene = default_scene(D);
  scene.box = box;
  for (int axis = 0; axis < D; ++axis) {
    if (walled[axis]) scene.walls[2 * axis] = scene.walls[2 * axis + 1] = Wall{};
  }
  const auto count = static_cast<int>(fraction / packing_fraction(D, 1.0 / scene.box.prod()));
  scene.particles.count = std::min(count, lattice_capacity(room_of<D>(scene)));
  scene.particles.start.temperature = 1.7;
  return scene;
}

/// Walls along x only.
template <int D>
Scene channel(double fraction) {
  return scene_of<D>(fraction, {true});
}

/// 5000 particles in a dilute gas.
template <int D>
Scene thin_gas() {
  Scene scene = default_scene(D);
  scene.box = Vec<D>::Constant(D == 2 ? 200.0 : 40.0);
  scene.particles.count = 5000;
  return scene;
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

/// The largest |<exp(2 pi i n r_k/L_k)>| of any number n of layers across a periodic axis, at least
/// half a diameter apart: 1 for a lattice, about 1/sqrt(N) without order.
double layering(const Scene& scene, const std::vector<Vec<3>>& centres, int axis) {
  double largest = 0.0;
  for (int n = 2; n <= 2.0 * scene.box[axis]; ++n) {
    std::complex<double> sum = 0.0;
    for (const Vec<3>& r : centres) {
      sum += std::polar(1.0, 2.0 * std::numbers::pi * n * r[axis] / scene.box[axis]);
    }
    largest = std::max(largest, std::abs(sum) / static_cast<double>(centres.size()));
  }
  return largest;
}

template <int D>
double temperature(const State<D>& state) {
  double sum = 0.0;
  for (const Vec<D>& v : state.velocities) sum += v.squaredNorm();
  return sum / (D * static_cast<double>(state.velocities.size()));
}

/// Checks that the values of a component are Gaussian with mean 0: chi^2 of 20 bins, the outer ones
/// from 2.7 standard deviations on.
template <class Vector>
void check_gaussian(const std::vector<Vector>& vectors, int component, double variance) {
  constexpr int kBins = 20;
  constexpr double kWidth = 0.3;    // standard deviations
  const auto below = [](int bin) {  // probability
    if (bin == 0 || bin == kBins) return bin == 0 ? 0.0 : 1.0;
    return 0.5 * std::erfc(-kWidth * (bin - kBins / 2) / std::numbers::sqrt2);
  };
  std::vector<double> observed(kBins), expected(kBins);
  for (const Vector& vector : vectors) {
    const double bin = std::floor(vector[component] / (kWidth * std::sqrt(variance))) + kBins / 2;
    observed[static_cast<std::size_t>(std::clamp(bin, 0.0, kBins - 1.0))] += 1.0;
  }
  for (int bin = 0; bin < kBins; ++bin) {
    expected[static_cast<std::size_t>(bin)] =
        static_cast<double>(vectors.size()) * (below(bin + 1) - below(bin));
  }
  CAPTURE(component);
  CHECK(counts_p(observed, expected) > kMinProbability);
}

template <int D>
void check_no_overlap(const std::vector<std::array<bool, D>>& walls) {
  for (const std::array<bool, D>& walled : walls) {
    for (const StartCase& c : cases<D>()) {
      const Scene scene = scene_of<D>(c.fraction, walled);
      CAPTURE(c.fraction);
      CAPTURE(c.how);
      CAPTURE(walled[0]);
      CAPTURE(walled[1]);
      CAPTURE(walled[D - 1]);
      const State<D> state = start_state<D>(scene, 71);
      REQUIRE(static_cast<int>(state.positions.size()) == scene.particles.count);
      CHECK(least_distance(room_of<D>(scene), state.positions) >= 1.0 - 1e-12);
      CHECK(all_inside(room_of<D>(scene), state.positions, 1e-12));
    }
  }
}

template <int D>
void check_temperature() {
  for (const int count : {2, 3, 10, 100}) {
    Scene scene = channel<D>(0.1);
    scene.particles.count = count;
    const State<D> state = start_state<D>(scene, 72);
    CAPTURE(count);
    CHECK(temperature(state) == doctest::Approx(1.7).epsilon(1e-14));
    CHECK(momentum(state).norm() < 1e-12);
  }
}

template <int D>
void check_velocities() {
  const State<D> state = start_state<D>(thin_gas<D>(), 73);
  double fourth = 0.0;
  Eigen::Matrix<double, D, D> mixed = Eigen::Matrix<double, D, D>::Zero();
  for (const Vec<D>& v : state.velocities) {
    fourth += v.cwiseAbs2().squaredNorm() / (D * 5000.0);
    mixed += v * v.transpose() / 5000.0;
  }
  CHECK(std::fabs(fourth - 3.0) < 5.0 * std::sqrt(24.0 / (D * 5000.0)));
  for (int k = 0; k < D; ++k) {
    check_gaussian(state.velocities, k, 1.0);
    for (int l = 0; l < k; ++l) CHECK(std::fabs(mixed(k, l)) < 5.0 / std::sqrt(5000.0));
  }
}

template <int D>
void check_seeds() {
  for (const StartCase& c : cases<D>()) {
    CAPTURE(c.fraction);
    const Scene scene = channel<D>(c.fraction);
    const State<D> state = start_state<D>(scene, 74);
    const State<D> other = start_state<D>(scene, 75);
    CHECK(state.positions != other.positions);
    CHECK(state.velocities != other.velocities);
  }
}

template <int D>
void check_cold() {
  Scene scene = scene_of<D>(kMelted<D>, {});
  const State<D> warm = start_state<D>(scene, 76);
  scene.particles.start.temperature = 0.0;
  const State<D> cold = start_state<D>(scene, 76);
  CHECK(warm.positions == cold.positions);
  CHECK(std::ranges::all_of(cold.velocities, [](const Vec<D>& v) { return v.isZero(0.0); }));
}

template <int D>
void check_few() {
  for (const Layout layout : {Layout::Random, Layout::Lattice}) {
    for (const int count : {0, 1, 2}) {
      CAPTURE(count);
      Scene scene = channel<D>(0.1);
      scene.particles.count = count;
      scene.particles.start.layout = layout;
      const State<D> state = start_state<D>(scene, 81);
      REQUIRE(static_cast<int>(state.positions.size()) == count);
      REQUIRE(static_cast<int>(state.velocities.size()) == count);
      CHECK(all_inside(room_of<D>(scene), state.positions));
      if (count > 0) CHECK(temperature(state) == doctest::Approx(1.7).epsilon(1e-14));
      CHECK((count == 1) == (momentum(state).norm() > 0.1));  // one keeps its momentum
    }
  }
}

/// At a density beyond random insertion, with no partner for the particle while the lattice melts.
template <int D>
void check_alone(const Vec<D>& box) {
  for (const bool walled : {false, true}) {
    Scene scene = default_scene(D);
    scene.box = box;
    scene.particles.count = 1;
    if (walled) scene.walls[kLeft] = scene.walls[kRight] = Wall{};
    const State<D> state = start_state<D>(scene, 82);
    REQUIRE(state.positions.size() == 1);
    CHECK(all_inside(room_of<D>(scene), state.positions, 1e-12));
  }
}

template <int D>
void check_spins() {
  Scene scene = thin_gas<D>();
  scene.particles.roughness.friction = 0.5;
  scene.particles.inertia = 0.4;
  scene.particles.start.spin_temperature = 2.3;
  const double moment = 0.1;  // I = q/4
  const State<D> state = start_state<D>(scene, 83);
  REQUIRE(state.spins.size() == 5000);
  constexpr double kNumbers = 5000.0 * kSpinSize<D>;
  Spin<D> mean = Spin<D>::Zero(), mixed = Spin<D>::Zero();
  double square = 0.0, fourth = 0.0;
  for (std::size_t i = 0; i < state.spins.size(); ++i) {
    const Spin<D>& omega = state.spins[i];
    mean += omega / 5000.0;
    square += omega.squaredNorm() / kNumbers;
    fourth += omega.cwiseAbs2().squaredNorm() / kNumbers;
    mixed += omega.cwiseProduct(state.velocities[i].template head<kSpinSize<D>>()) / 5000.0;
  }
  CHECK(moment * square == doctest::Approx(2.3).epsilon(1e-14));
  CHECK(std::fabs(fourth / (square * square) - 3.0) < 5.0 * std::sqrt(24.0 / kNumbers));
  for (int k = 0; k < kSpinSize<D>; ++k) {
    check_gaussian(state.spins, k, square);
    CHECK(std::fabs(mean[k]) < 5.0 * std::sqrt(square / 5000.0));
    CHECK(std::fabs(mean[k]) > 1e-6);
    CHECK(std::fabs(mixed[k]) < 5.0 * std::sqrt(square / 5000.0));
  }
  CHECK(start_state<D>(scene, 84).spins != state.spins);
}

template <int D>
void check_still_spins() {
  Scene scene = channel<D>(kMelted<D>);
  const State<D> smooth = start_state<D>(scene, 85);
  CHECK(smooth.spins.empty());
  scene.walls[kLeft]->roughness.tangential_restitution = 0.5;
  const State<D> still = start_state<D>(scene, 85);
  REQUIRE(still.spins.size() == smooth.positions.size());
  CHECK(std::ranges::all_of(still.spins, [](const Spin<D>& spin) { return spin.isZero(0.0); }));
  CHECK(still.positions == smooth.positions);
  CHECK(still.velocities == smooth.velocities);
  scene.particles.start.spin_temperature = 1.0;
  scene.particles.count = 1;
  scene.particles.inertia = 0.5;
  CHECK(start_state<D>(scene, 85).spins[0].norm() ==
        doctest::Approx(std::sqrt(8.0 * kSpinSize<D>)));
}

template <int D>
void check_moving_walls() {
  for (const StartCase& c : cases<D>()) {
    // The free region of the other cases, surrounded by the range of the walls.
    std::array<bool, D> walled;
    walled.fill(true);
    const Scene still = scene_of<D>(c.fraction, walled);
    Scene scene = still;
    scene.walls = {Wall{.kind = WallKind::Sawtooth, .stroke = 1.5, .frequency = 1.0},
                   Wall{.kind = WallKind::Sinusoidal, .stroke = 0.5, .frequency = 1.0},
                   Wall{.kind = WallKind::Sawtooth, .stroke = 0.25, .frequency = 1.0},
                   Wall{.kind = WallKind::Sinusoidal, .stroke = 3.0, .frequency = 1.0}};
    if (D == 3) {
      scene.walls[kBack] = Wall{.kind = WallKind::Sinusoidal, .stroke = 1.0, .frequency = 1.0};
      scene.walls[kFront] = Wall{.kind = WallKind::Sawtooth, .stroke = 2.0, .frequency = 1.0};
    }
    const Vec<D> corner = Vec<3>(1.5, 0.25, 0.5).head<D>();
    scene.box = box_of<D>() + corner + Vec<3>(0.25, 1.5, 2.0).head<D>();
    CAPTURE(c.fraction);
    CAPTURE(c.how);
    const State<D> state = start_state<D>(scene, 86);
    const State<D> expected = start_state<D>(still, 86);
    REQUIRE(state.positions.size() == expected.positions.size());
    for (std::size_t i = 0; i < state.positions.size(); ++i) {
      CHECK(state.positions[i] == expected.positions[i] + corner);
    }
    CHECK(state.velocities == expected.velocities);
  }
}

template <int D>
void check_other_laws() {
  Scene scene = channel<D>(kMelted<D>);
  const State<D> plain = start_state<D>(scene, 87);
  scene.gravity = Vec<3>(1.0, -5.0, 2.0).head<D>();
  scene.bulk_drive = {.interval = 0.01, .kick_speed = 3.0, .kick_spin = 1.0};
  scene.contact_time = 0.1;
  scene.particles.restitution = 0.5;
  scene.particles.roughness.friction = 0.5;
  scene.particles.start.spin_temperature = 2.0;
  const State<D> other = start_state<D>(scene, 87);
  CHECK(other.positions == plain.positions);
  CHECK(other.velocities == plain.velocities);
}

// The number of times that a start state asks whether to stop, if the answer is yes from number
// `yes` on. Requires that it then stops.
template <int D>
int looks_until(const Scene& scene, int yes) {
  int looks = 0;
  CHECK_THROWS_AS(start_state<D>(scene, 89, [&] { return ++looks >= yes; }), Interrupted);
  return looks;
}

template <int D>
void check_interrupted() {
  for (const StartCase& c : cases<D>()) {
    CAPTURE(c.fraction);
    CAPTURE(c.how);
    const Scene scene = scene_of<D>(c.fraction, {});
    int all = 0;
    start_state<D>(scene, 89, [&] { return ++all < 0; });
    CHECK(all >= scene.particles.count / static_cast<int>(kStepsPerQuestion));
    for (const int yes : {1, 2, all / 2, all}) CHECK(looks_until<D>(scene, yes) == yes);
  }
  Scene thin = thin_gas<D>();
  thin.particles.count = 800;
  CHECK(looks_until<D>(thin, 20) == 20);
}

// Checks the state of a maker that pauses at every second look. Returns the number of pauses.
template <int D>
int pauses_of(const Scene& scene) {
  StartMaker maker(scene, 90);
  int looks = 0, pauses = 0;
  while (!maker.advance([&] { return ++looks % 2 == 0; })) {
    ++pauses;
    REQUIRE(pauses < 1'000'000);
    REQUIRE(maker.progress() >= 0.0);
    REQUIRE(maker.progress() <= 1.0);
  }
  CHECK(maker.progress() == 1.0);
  const auto state = std::get<State<D>>(maker.take());
  const State<D> expected = start_state<D>(scene, 90);
  CHECK(state.positions == expected.positions);
  CHECK(state.velocities == expected.velocities);
  return pauses;
}

template <int D>
void check_pauses() {
  for (const StartCase& c : cases<D>()) {
    CAPTURE(c.fraction);
    CAPTURE(c.how);
    const int pauses = pauses_of<D>(scene_of<D>(c.fraction, {}));
    if (c.fraction <= kMelted<D>) CHECK(pauses > 3);
  }
  Scene thin = thin_gas<D>();
  thin.particles.count = 800;
  CHECK(pauses_of<D>(thin) >= 40);
}

template <int D>
void check_saved() {
  const auto restarted = [](Scene scene, const State<D>& saved) {
    scene.particles.start.layout = Layout::File;
    scene.particles.start.state = parse_state(state_to_csv(saved), "a.csv", scene);
    return start_state<D>(scene, 1);
  };
  Scene scene = channel<D>(0.3);
  Simulation<D> simulation(model_of<D>(scene, 88), start_state<D>(scene, 88));
  simulation.run_until(1.7);
  const State<D> state = restarted(scene, simulation.state());
  CHECK(state.positions == simulation.state().positions);
  CHECK(state.velocities == simulation.state().velocities);
  CHECK(state.spins.empty());
  CHECK(Simulation<D>(model_of<D>(scene, 1), state).state_hash() == simulation.state_hash());

  scene.particles.roughness.friction = 0.5;
  scene.particles.start.spin_temperature = 2.0;
  const State<D> spinning = start_state<D>(scene, 88);
  CHECK(restarted(scene, spinning).spins == spinning.spins);
}

}  // namespace

TEST_CASE("Start state: no particles overlap each other or a wall, at any density") {
  check_no_overlap<2>(all_walls<2>());
  check_no_overlap<3>(
      {{false, false, false}, {false, false, true}, {false, true, true}, {true, true, true}});
}

TEST_CASE("Start state: the temperature is met exactly, the mean velocity is removed") {
  check_temperature<2>();
  check_temperature<3>();
}

TEST_CASE("Start state: velocities are Gaussian") {
  // 5000 particles: each component by chi^2; the kurtosis <v^4>/<v^2>^2 = 3 with standard error
  // sqrt(24/(5000 D)) over all components, <v_k v_l> = 0 with T/sqrt(5000).
  check_velocities<2>();
  check_velocities<3>();
}

TEST_CASE("Start state: another seed gives another state") {
  check_seeds<2>();
  check_seeds<3>();
}

TEST_CASE("Start state: places do not depend on the temperature") {
  check_cold<2>();
  check_cold<3>();
}

TEST_CASE("Start state: a melted lattice of disks has no more order than a fluid") {
  // Without order |psi_m| = 1/sqrt(independent bonds), about .03 for 500 particles. A hard-particle
  // fluid near freezing is correlated over some diameters. The initial lattice has |psi_4| near 1.
  for (const double fraction : {0.6, 0.69}) {
    for (const std::array<bool, 2> walled : {std::array{false, false}, {true, true}}) {
      const Scene scene = scene_of<2>(fraction, walled);
      CAPTURE(fraction);
      for (const std::uint64_t seed : {77u, 78u, 79u}) {
        const State<2> state = start_state<2>(scene, seed);
        CHECK(bond_order(scene, state.positions, 4) < 0.15);
      }
    }
  }
  const Scene scene = scene_of<2>(0.6, {});
  const auto sites = primitive_lattice(room_of<2>(scene), scene.particles.count);
  CHECK(bond_order(scene, sites, 4) > 0.9);
}

TEST_CASE("Start state: a melted lattice of spheres has no more order than a fluid") {
  // Without long-range order the squared layering is exponentially distributed with mean S(k)/N.
  // This is at most 3/200 = .015 at the peak of a fluid near freezing, so that .25 is practically
  // impossible. The first box fits a cubic lattice of this number of spheres, the second fits fcc
  // only.
  for (const Vec<3>& box : {box_of<3>(), Vec<3>(7.75, 7.8, 7.9)}) {
    for (const bool walled : {false, true}) {
      for (const double fraction : {0.4, 0.48}) {
        const Scene scene = scene_of<3>(fraction, {false, walled, false}, box);
        CAPTURE(box.transpose());
        CAPTURE(walled);
        CAPTURE(fraction);
        const bool cubic = !primitive_lattice(room_of<3>(scene), scene.particles.count).empty();
        CHECK(cubic == (box == box_of<3>()));
        for (const std::uint64_t seed : {77u, 78u, 79u}) {
          const State<3> state = start_state<3>(scene, seed);
          for (const int axis : {0, 2}) CHECK(layering(scene, state.positions, axis) < 0.5);
        }
      }
    }
  }
}

TEST_CASE("Start state: a lattice of disks stays a lattice if asked for, or too dense to melt") {
  Scene scene = scene_of<2>(0.75, {});
  CHECK(bond_order(scene, start_state<2>(scene, 80).positions, 6) > 0.9);
  scene = channel<2>(0.2);
  scene.particles.start.layout = Layout::Lattice;
  const State<2> state = start_state<2>(scene, 80);
  CHECK(least_distance(room_of<2>(scene), state.positions) > 1.5);
  // Few different heights or few different positions along x: the sites are in rows.
  std::set<long> x, y;
  for (const Vec2& r : state.positions) {
    x.insert(std::lround(1e6 * r.x()));
    y.insert(std::lround(1e6 * r.y()));
  }
  CHECK(std::min(x.size(), y.size()) < state.positions.size() / 4);
}

TEST_CASE("Start state: a lattice of spheres stays a lattice if asked for, or too dense to melt") {
  Scene scene = scene_of<3>(0.58, {});
  CHECK(scene.packing_fraction() > 0.57);
  const State<3> dense = start_state<3>(scene, 80);
  scene = channel<3>(0.1);
  scene.particles.start.layout = Layout::Lattice;
  const State<3> thin = start_state<3>(scene, 80);
  CHECK(least_distance(room_of<3>(scene), thin.positions) > 1.5);
  for (const int axis : {1, 2}) {
    CHECK(layering(scene, dense.positions, axis) == doctest::Approx(1.0));
    CHECK(layering(scene, thin.positions, axis) == doctest::Approx(1.0));
  }
}

TEST_CASE("Start state: there may be no particle, one or two") {
  check_few<2>();
  check_few<3>();
}

TEST_CASE("Start state: one particle may nearly fill its box") {
  check_alone<2>({1.2, 1.19});         // phi = .55
  check_alone<3>({1.08, 1.09, 1.07});  // phi = .42
}

TEST_CASE("Start state: spins have exactly their temperature, and a random mean") {
  // 5000 particles: each component of omega by chi^2. Its mean is 0 with standard error
  // sqrt(T_rot/(I N)); a nonzero value shows that the mean was not removed. The kurtosis is 3 with
  // standard error sqrt(24/5000), of three components sqrt(24/15000).
  check_spins<2>();
  check_spins<3>();
}

TEST_CASE("Start state: spins exist only where the scene has them, and change nothing else") {
  check_still_spins<2>();
  check_still_spins<3>();
}

TEST_CASE("Start state: particles keep clear of moving walls, at any density") {
  check_moving_walls<2>();
  check_moving_walls<3>();
}

TEST_CASE("Start state: forces, roughness and driving do not change the places") {
  check_other_laws<2>();
  check_other_laws<3>();
}

TEST_CASE("Start state: a request stops the making of it at any place, at once") {
  check_interrupted<2>();
  check_interrupted<3>();
}

TEST_CASE("Start state: pauses while it is made do not change it") {
  check_pauses<2>();
  check_pauses<3>();
}

TEST_CASE("Start state: a saved state starts a run, bit for bit") {
  check_saved<2>();
  check_saved<3>();
}

TEST_CASE("Start state: a mixture that finds no random places may have a lattice") {
  // A face-centred lattice of 4 x 27 spheres fits.
  const auto error_of = [](const std::string& diameter, int count) {
    const Scene scene = parse_scene(
        "box.size = [4.25, 4.25, 4.25]\n[[species]]\nname = \"a\"\ncount = 50\n"
        "[[species]]\nname = \"b\"\ndiameter = " +
            diameter + "\ncount = " + std::to_string(count),
        "scene");
    try {
      start_state<3>(scene, 1);
    } catch (const UserError& error) {
      return std::string(error.what());
    }
    return std::string();
  };
  CHECK(error_of("0.98", 58).find("or set particles.start.layout = \"lattice\"") !=
        std::string::npos);
  const std::string small = error_of("0.5", 420);
  CHECK(small.find("or a larger box") != std::string::npos);
  CHECK(small.find("lattice") == std::string::npos);
}

TEST_CASE("Start state: species of one diameter have the places of equal particles, at random") {
  for (const int count : {200, 380}) {  // insertion, melting
    CAPTURE(count);
    const std::string box = "box.size = [24, 20]\n";
    const Scene alike = parse_scene(box + "particles.count = " + std::to_string(count), "scene");
    const std::string half = "count = " + std::to_string(count / 2);
    const Scene mixed = parse_scene(box + "[[species]]\nname = \"a\"\n" + half +
                                        "\n[[species]]\nname = \"b\"\nmass = 4\n" + half,
                                    "scene");
    const State<2> state = start_state<2>(mixed, 3);
    const auto sorted = [](std::vector<Vec2> places) {
      std::ranges::sort(places, {}, [](const Vec2& r) { return std::pair(r[0], r[1]); });
      return places;
    };
    CHECK(sorted(state.positions) == sorted(start_state<2>(alike, 3).positions));
    Vec2 mean = Vec2::Zero();
    for (std::size_t i = 0; i < state.positions.size(); ++i) {
      const bool first = 2 * i < state.positions.size();
      CHECK(state.grains[i].species == (first ? 0 : 1));
      if (first) mean += state.positions[i] / (count / 2);
    }
    // Four standard errors of half the places.
    CHECK(std::fabs(mean[0] - 12.0) < 4.0 * 24.0 / std::sqrt(12.0 * count));
    CHECK(std::fabs(mean[1] - 10.0) < 4.0 * 20.0 / std::sqrt(12.0 * count));
  }
}
