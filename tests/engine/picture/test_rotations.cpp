#include <doctest/doctest.h>

#include <cmath>
#include <numbers>
#include <utility>
#include <vector>

#include "engine/checkpoint/archive.h"
#include "engine/picture/rotations.h"
#include "tests/engine/measure/scenes.h"
#include "tests/support/dimensions.h"

using namespace clatter;
using namespace clatter::testing;

namespace {

Scene rough_disks() {
  Scene scene = gas(9.0, 8.0, 30, 0.9);
  scene.particles.roughness.friction = 0.5;
  scene.particles.start.spin_temperature = 1.0;
  wall_in(scene, 0, {.kind = WallKind::Static});
  scene.walls[kLeft]->roughness.tangential_restitution = 0.5;
  scene.bulk_drive = BulkDrive{.interval = 0.7, .kick_speed = 0.5, .kick_spin = 0.4};
  return scene;
}

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

template <int D>
Scene rough_gas() {
  if constexpr (D == 2) return rough_disks();
  return rough_spheres();
}

bool same(const DiskRotation& a, const DiskRotation& b) {
  return a.angle == b.angle;
}
bool same(const SphereRotation& a, const SphereRotation& b) {
  return a.coefficients == b.coefficients;
}

// Whether all particles have turned, and the rotations have the same bits.
template <int D>
bool same(const Rotations<D>& a, const Rotations<D>& b) {
  const auto left = a.rotations(), right = b.rotations();
  bool all = left.size() == right.size();
  for (std::size_t i = 0; all && i < left.size(); ++i) {
    all = same(left[i], right[i]) && !same(left[i], Rotation<D>{});
  }
  return all;
}

// Difference of two angles, without whole turns.
double between(double a, double b) {
  return std::fabs(std::remainder(a - b, 2.0 * std::numbers::pi));
}

}  // namespace

TEST_CASE("Rotations: a disk turns by its spin, summed over time") {
  const auto simulation = simulation_of<2>(rough_disks(), 3);
  Rotations<2> rotations(*simulation);
  std::vector<double> summed(30, 0.0);
  // The error of a step with a spin change is at most the change times the step. A particle has
  // some 80 of these here, of about 1 each.
  constexpr double kStep = 1.0 / 16384.0;
  for (int k = 1; k <= 16384 * 16; ++k) {
    for (std::size_t i = 0; i < summed.size(); ++i) summed[i] += simulation->spins()[i][0] * kStep;
    simulation->run_until(k * kStep);
  }
  REQUIRE(simulation->counts().collisions() > 16 * 30);
  const std::vector<DiskRotation> turned = rotations.rotations();
  for (std::size_t i = 0; i < summed.size(); ++i) {
    CHECK(between(turned[i].angle, summed[i]) < 5e-3);
  }
}

TEST_CASE("Rotations: a free sphere turns about its spin by its angle") {
  Scene scene = rough_spheres();
  scene.bulk_drive.reset();
  scene.particles.count = 1;
  const auto simulation = simulation_of<3>(scene, 3);
  const Vec<3> spin = simulation->spins()[0];
  Rotations<3> rotations(*simulation);
  for (const double time : {0.0, 0.7, 5.0}) {
    simulation->run_until(time);
    const Eigen::Quaterniond turned = rotations.rotations()[0].quaternion();
    // Rodrigues' formula.
    const Vec<3> u = spin.normalized(), start(0.3, -0.5, 0.8);
    const double c = std::cos(time * spin.norm()), s = std::sin(time * spin.norm());
    const Vec<3> end = c * start + s * u.cross(start) + (1.0 - c) * u.dot(start) * u;
    CHECK((turned * start - end).norm() < 1e-12);
  }
}

TEST_CASE("Rotations: a sphere turns by its spins, one after the other") {
  const auto simulation = simulation_of<3>(rough_spheres(), 3);
  Rotations<3> rotations(*simulation);
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
  const auto found = rotations.rotations();
  for (std::size_t i = 0; i < turned.size(); ++i) {
    CHECK((found[i].quaternion().toRotationMatrix() - turned[i]).norm() < 1e-2);
  }
}

TEST_CASE_TEMPLATE("Rotations: a resumed run has them, and other laws keep them", Dimension, Plane,
                   Space) {
  constexpr int D = Dimension::value;
  const Scene scene = rough_gas<D>();
  const auto simulation = simulation_of<D>(scene, 5);
  Rotations<D> rotations(*simulation);
  simulation->run_until(6.0);
  ArchiveWriter writer;
  writer(rotations);

  Simulation<D> resumed(model_of<D>(scene, 5), simulation->save());
  Rotations<D> read(resumed);
  ArchiveReader reader(writer.written(), "");
  reader(read);
  reader.finish();
  CHECK(same(read, rotations));
  for (Simulation<D>* run : {simulation.get(), &resumed}) run->run_until(12.0);
  CHECK(same(read, rotations));
  Model<D> laws = simulation->model();
  laws.restitution = 0.5;
  laws.gravity[0] = 0.1;
  simulation->set_laws(laws);
  CHECK(same(read, rotations));
  const Rotations<D> moved(*simulation, std::move(rotations));
  CHECK(same(read, moved));
}
