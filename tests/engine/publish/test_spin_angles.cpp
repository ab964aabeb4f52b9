#include <doctest/doctest.h>

#include <cmath>
#include <numbers>
#include <vector>

#include "engine/checkpoint/archive.h"
#include "engine/publish/spin_angles.h"
#include "tests/engine/measure/scenes.h"

using namespace clatter;
using namespace clatter::testing;

namespace {

Scene rough_gas() {
  Scene scene = gas(9.0, 8.0, 30, 0.9);
  scene.particles.roughness.friction = 0.5;
  scene.particles.start.spin_temperature = 1.0;
  wall_in(scene, 0, {.kind = WallKind::Static});
  scene.walls[kLeft]->roughness.tangential_restitution = 0.5;
  scene.bulk_drive = BulkDrive{.interval = 0.7, .kick_speed = 0.5, .kick_spin = 0.4};
  return scene;
}

// Difference of two angles, without whole turns.
double between(double a, double b) {
  return std::fabs(std::remainder(a - b, 2.0 * std::numbers::pi));
}

}  // namespace

TEST_CASE("SpinAngles: a particle turns by its spin, summed over time") {
  const auto simulation = simulation_of<2>(rough_gas(), 3);
  SpinAngles angles(*simulation);
  std::vector<double> summed(30, 0.0);
  // The error of a step with a spin change is at most the change times the step. A particle has
  // some 80 of these here, of about 1 each.
  constexpr double kStep = 1.0 / 16384.0;
  for (int k = 1; k <= 16384 * 16; ++k) {
    for (std::size_t i = 0; i < summed.size(); ++i) summed[i] += simulation->spins()[i][0] * kStep;
    simulation->run_until(k * kStep);
  }
  REQUIRE(simulation->counts().collisions() > 16 * 30);
  const std::vector<double> turned = angles.angles();
  for (std::size_t i = 0; i < summed.size(); ++i) {
    CHECK(std::fabs(turned[i]) <= std::numbers::pi);
    CHECK(between(turned[i], summed[i]) < 5e-3);
  }
}

TEST_CASE("SpinAngles: the hash is the same, and angles do not depend on when they are asked for") {
  const auto plain = simulation_of<2>(rough_gas(), 4), watched = simulation_of<2>(rough_gas(), 4);
  const auto asked = simulation_of<2>(rough_gas(), 4);
  SpinAngles angles(*watched), often(*asked);
  plain->run_until(9.0);
  watched->run_until(9.0);
  for (int k = 1; k <= 90; ++k) {
    asked->run_until(0.1 * k);
    often.angles();
  }
  CHECK(watched->state_hash() == plain->state_hash());
  CHECK(often.angles() == angles.angles());
}

TEST_CASE("SpinAngles: a resumed run has its angles, also under other laws") {
  const Scene scene = rough_gas();
  const auto simulation = simulation_of<2>(scene, 5);
  SpinAngles angles(*simulation);
  simulation->run_until(6.0);
  ArchiveWriter writer;
  writer(angles);

  Simulation<2> resumed(model_of<2>(scene, 5), simulation->save());
  SpinAngles read(resumed);
  ArchiveReader reader(writer.written(), "");
  reader(read);
  reader.finish();
  Simulation<2> handed(model_of<2>(scene, 5), simulation->save());
  SpinAngles moved(handed, SpinAngles(read));
  CHECK(read.angles() == angles.angles());
  CHECK(moved.angles() == angles.angles());
  simulation->run_until(12.0);
  resumed.run_until(12.0);
  CHECK(read.angles() == angles.angles());
}

namespace {

Scene rough_spheres() {
  Scene scene = default_scene(3);
  scene.box = Vec<3>(5.0, 5.0, 5.0);
  scene.particles.count = 25;
  scene.particles.restitution = 0.9;
  scene.particles.roughness.friction = 0.5;
  scene.particles.start.spin_temperature = 1.0;
  scene.bulk_drive = BulkDrive{.interval = 0.7, .kick_speed = 0.5, .kick_spin = 0.4};
  return scene;
}

}  // namespace

TEST_CASE("SpinOrientations: a free sphere turns about its spin by its angle") {
  Scene scene = rough_spheres();
  scene.bulk_drive.reset();
  scene.particles.count = 1;
  const auto simulation = simulation_of<3>(scene, 3);
  const Vec<3> spin = simulation->spins()[0];
  SpinOrientations orientations(*simulation);
  for (const double time : {0.0, 0.7, 5.0}) {
    simulation->run_until(time);
    const Eigen::Quaterniond turned = orientations.orientations()[0];
    // Rodrigues' formula.
    const Vec<3> u = spin.normalized(), start(0.3, -0.5, 0.8);
    const double c = std::cos(time * spin.norm()), s = std::sin(time * spin.norm());
    const Vec<3> end = c * start + s * u.cross(start) + (1.0 - c) * u.dot(start) * u;
    CHECK((turned * start - end).norm() < 1e-12);
  }
}

TEST_CASE("SpinOrientations: a sphere turns by its spins, one after the other") {
  const auto simulation = simulation_of<3>(rough_spheres(), 3);
  SpinOrientations orientations(*simulation);
  std::vector<Eigen::Matrix3d> turned(25, Eigen::Matrix3d::Identity());
  constexpr double kStep = 1.0 / 16384.0;
  for (int k = 1; k <= 16384 * 6; ++k) {
    for (std::size_t i = 0; i < turned.size(); ++i) {
      const Vec<3> spin = simulation->spins()[i];
      const double angle = spin.norm() * kStep;
      if (angle > 0.0) turned[i] = Eigen::AngleAxisd(angle, spin.normalized()) * turned[i];
    }
    simulation->run_until(k * kStep);
  }
  REQUIRE(simulation->counts().collisions() > 3 * 25);
  const auto found = orientations.orientations();
  for (std::size_t i = 0; i < turned.size(); ++i) {
    CHECK((found[i].toRotationMatrix() - turned[i]).norm() < 1e-2);
  }
}

TEST_CASE("SpinOrientations: a resumed run has them, also under other laws") {
  const Scene scene = rough_spheres();
  const auto simulation = simulation_of<3>(scene, 5);
  SpinOrientations orientations(*simulation);
  simulation->run_until(4.0);
  ArchiveWriter writer;
  writer(orientations);

  Simulation<3> resumed(model_of<3>(scene, 5), simulation->save());
  SpinOrientations read(resumed);
  ArchiveReader reader(writer.written(), "");
  reader(read);
  reader.finish();
  Simulation<3> handed(model_of<3>(scene, 5), simulation->save());
  SpinOrientations moved(handed, SpinOrientations(read));
  for (Simulation<3>* run : {simulation.get(), &resumed, &handed}) run->run_until(9.0);
  const auto expected = orientations.orientations();
  for (std::size_t i = 0; i < expected.size(); ++i) {
    CHECK(read.orientations()[i].coeffs() == expected[i].coeffs());
    CHECK(moved.orientations()[i].coeffs() == expected[i].coeffs());
  }
}
