#include <doctest/doctest.h>

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <limits>
#include <numbers>
#include <vector>

#include "engine/physics/random.h"
#include "engine/physics/walls.h"
#include "tests/support/contact_laws.h"
#include "tests/support/statistics.h"

using namespace clatter;
using namespace clatter::testing;

namespace {

/// A rough particle (D = 3: a sphere) at a wall, before and after.
template <int D>
struct RoughHit {
  Vec<D> v, smooth, after;
  Spin<D> spin, spin_after;
  int axis;
  double inward;
  ContactLaw law;
  double inertia, diameter;

  Vec<D> n() const { return inward * Vec<D>::Unit(axis); }
  double normal_change() const { return std::fabs(after[axis] - v[axis]); }
  Grain grain() const { return {.radius = 0.5 * diameter, .inertia = inertia}; }
  MotionChange<D> friction() const { return wall_friction<D>(v, smooth, spin, n(), law, grain()); }
  Vec<D> surface_velocity() const { return v + 0.5 * diameter * cross_spin<D>(n(), spin); }
  double moment_of_inertia() const { return 0.25 * inertia * diameter * diameter; }
};

// Driven and moving walls alternate.
template <int D>
RoughHit<D> random_hit(std::uint32_t number) {
  Random random(42, Stream::Velocity, number, D);
  RoughHit<D> hit;
  hit.law = random_law(random);
  hit.inertia = random_inertia(random);
  hit.diameter = 0.5 + random.uniform();
  hit.axis = static_cast<int>(random.below(D));
  hit.inward = random.below(2) ? 1.0 : -1.0;
  hit.v = random_vector<Vec<D>>(random);
  hit.v[hit.axis] = -hit.inward * std::fabs(hit.v[hit.axis]);
  hit.spin = 2.0 * random.uniform() / hit.diameter * random_vector<Spin<D>>(random);
  const double speed = random.below(2) ? random.uniform() : 0.0;
  hit.smooth = number % 2 ? reflect<D>(hit.v, hit.n(), hit.law.restitution, speed)
                          : reflect_moving<D>(hit.v, hit.n(), hit.law.restitution, speed);
  const MotionChange<D> friction = hit.friction();
  hit.after = hit.smooth + friction.velocity;
  hit.spin_after = hit.spin + friction.spin;
  return hit;
}

constexpr std::uint32_t kHits = 100000;

}  // namespace

// (theory 4.1): v_n' = alpha_w |v_n| + v_dr, along the normal into the box.
TEST_CASE("Walls: reflection off each of the four walls follows theory 4.1") {
  CHECK(reflect<2>({-2.0, 3.0}, {1.0, 0.0}, 1.0, 0.0) == Vec2(2.0, 3.0));
  CHECK(reflect<2>({2.0, 3.0}, {-1.0, 0.0}, 0.5, 0.0) == Vec2(-1.0, 3.0));
  CHECK(reflect<2>({-2.0, -3.0}, {0.0, 1.0}, 0.5, 0.25) == Vec2(-2.0, 1.75));
  CHECK(reflect<2>({-2.0, 3.0}, {0.0, -1.0}, 0.0, 0.25) == Vec2(-2.0, -0.25));
  CHECK(reflect<2>({-2.0, 3.0}, {1.0, 0.0}, 1.5, 0.0) == Vec2(3.0, 3.0));
}

// (theory 4.7): v_n has the flux-weighted density (v/T) exp(-v^2/2T). Its mean is sqrt(pi T/2), its
// mean square 2 T, the variance of the square 4 T^2, the share below v 1 - exp(-v^2/2T). v_t is
// Gaussian with variance T.
TEST_CASE("Walls: a thermal wall emits flux-weighted velocities") {
  constexpr int kSamples = 400000, kBins = 50;
  constexpr double kT = 2.25;
  std::vector<double> normal_bins(kBins), tangential_bins(kBins);
  double sum = 0.0, squares = 0.0, tangential = 0.0, tangential_squares = 0.0;
  for (std::uint32_t i = 0; i < kSamples; ++i) {
    Random random(41, Stream::ThermalWall, i, 0);
    const double uniform = random.uniform();
    const double normal = random.normal();
    const Vec2 v = emit<2>({0.0, -1.0}, kT, uniform, &normal);
    REQUIRE(v.y() < 0.0);
    const double u = -v.y();
    sum += u;
    squares += u * u;
    tangential += v.x();
    tangential_squares += v.x() * v.x();
    const double share = 1.0 - std::exp(-u * u / (2.0 * kT));
    const double tangential_share = 0.5 * std::erfc(-v.x() / std::sqrt(2.0 * kT));
    ++normal_bins[std::min(kBins - 1, static_cast<int>(kBins * share))];
    ++tangential_bins[std::min(kBins - 1, static_cast<int>(kBins * tangential_share))];
  }
  const std::vector<double> expected(kBins, kSamples / double{kBins});
  CHECK(counts_p(normal_bins, expected) > kMinProbability);
  CHECK(counts_p(tangential_bins, expected) > kMinProbability);
  const double mean = std::sqrt(std::numbers::pi * kT / 2.0);
  CHECK(std::fabs(standard_errors_off(sum, kSamples, mean, 2.0 * kT - mean * mean)) < 5.0);
  CHECK(std::fabs(standard_errors_off(squares, kSamples, 2.0 * kT, 4.0 * kT * kT)) < 5.0);
  CHECK(std::fabs(standard_errors_off(tangential, kSamples, 0.0, kT)) < 5.0);
  CHECK(std::fabs(standard_errors_off(tangential_squares, kSamples, kT, 2.0 * kT * kT)) < 5.0);
}

TEST_CASE("Walls: a thermal wall at T_w = 0 stops the particle") {
  const double normal = -1.5;
  CHECK(emit<2>({1.0, 0.0}, 0.0, 0.3, &normal) == Vec2(0.0, 0.0));
}

// (theory 4.2): in the wall's frame v_n' = -alpha_w v_n.
TEST_CASE("Walls: a moving wall reflects in its own frame, also from behind") {
  CHECK(reflect_moving<2>({-2.0, 3.0}, {1.0, 0.0}, 1.0, 0.0) == Vec2(2.0, 3.0));
  CHECK(reflect_moving<2>({-2.0, 3.0}, {1.0, 0.0}, 0.5, 1.0) == Vec2(2.5, 3.0));
  CHECK(reflect_moving<2>({3.0, 2.0}, {0.0, -1.0}, 0.5, 1.0) == Vec2(3.0, -2.5));
  CHECK(reflect_moving<2>({0.5, 3.0}, {1.0, 0.0}, 1.0, 1.0) == Vec2(1.5, 3.0));
  CHECK(reflect_moving<2>({0.5, 3.0}, {1.0, 0.0}, 0.0, 1.0) == Vec2(1.0, 3.0));
  CHECK(reflect_moving<2>({-2.0, 3.0}, {1.0, 0.0}, 0.5, -1.0) == Vec2(-0.5, 3.0));
  // A wall of speed u that moves inwards is equal to a driven wall of v_dr = (1 + alpha_w) u.
  CHECK(reflect_moving<2>({-1.25, 3.0}, {1.0, 0.0}, 0.5, 0.75) ==
        reflect<2>({-1.25, 3.0}, {1.0, 0.0}, 0.5, 1.125));
}

TEST_CASE_TEMPLATE("Walls: friction is Walton's and Coulomb's at a wall of infinite mass",
                   Dimension, Plane, Space) {
  constexpr int D = Dimension::value;
  double impulse_off = 0.0, torque_off = 0.0, coulomb_excess = -1.0;
  int normal_changed = 0;
  for (std::uint32_t i = 0; i < kHits; ++i) {
    const RoughHit<D> hit = random_hit<D>(i);
    const MotionChange<D> friction = hit.friction();
    const Vec<D> g = hit.surface_velocity();
    const Vec<D> dragged =
        friction_by_law<D>(hit.n(), g, hit.normal_change(), hit.law, 1.0 + 1.0 / hit.inertia);
    impulse_off = std::max(impulse_off, (friction.velocity - dragged).norm() / g.norm());
    normal_changed += hit.after[hit.axis] != hit.smooth[hit.axis];
    if (!hit.law.rough()) {
      REQUIRE(friction.velocity == Vec<D>(Vec<D>::Zero()));
      REQUIRE(friction.spin == Spin<D>(Spin<D>::Zero()));
    }
    // The force of the wall acts at the contact point, so that the angular momentum about it is
    // conserved.
    const double arm = 0.5 * hit.diameter;
    const Spin<D> torque =
        arm * cross<D>(hit.n(), friction.velocity) + hit.moment_of_inertia() * friction.spin;
    torque_off = std::max(torque_off, torque.norm() / (arm * g.norm()));
    if (hit.law.friction == 0.0) continue;
    const double share = friction.velocity.norm() / (hit.law.friction * hit.normal_change());
    coulomb_excess = std::max(coulomb_excess, share - 1.0);
  }
  CHECK(impulse_off < 1e-13);
  CHECK(torque_off < 1e-13);
  CHECK(normal_changed == 0);
  CHECK(coulomb_excess < 1e-13);
  CHECK(coulomb_excess > -1e-13);  // sliding particles reach the Coulomb limit
}

TEST_CASE_TEMPLATE("Walls: friction takes energy, or turns the slip round without loss", Dimension,
                   Plane, Space) {
  constexpr int D = Dimension::value;
  double gained = 0.0, lost_without_loss = 0.0;
  int losing = 0, conserving = 0;
  for (std::uint32_t i = 0; i < kHits; ++i) {
    const RoughHit<D> hit = random_hit<D>(i);
    const double before =
        0.5 * (hit.smooth.squaredNorm() + hit.moment_of_inertia() * hit.spin.squaredNorm());
    const double after =
        0.5 * (hit.after.squaredNorm() + hit.moment_of_inertia() * hit.spin_after.squaredNorm());
    const double lost = (before - after) / before;
    gained = std::max(gained, -lost);
    losing += lost > 1e-6;
    if (!keeps_spin_and_slip_energy(hit.law)) continue;
    ++conserving;
    lost_without_loss = std::max(lost_without_loss, lost);
  }
  CHECK(gained < 1e-13);
  CHECK(lost_without_loss < 1e-13);
  CHECK(losing > 10000);
  CHECK(conserving > 10000);
}

TEST_CASE_TEMPLATE("Walls: scaling by powers of two changes no bit of friction", Dimension, Plane,
                   Space) {
  constexpr int D = Dimension::value;
  constexpr double kLength = 0x1p-7, kSpeed = 0x1p-45;
  int different = 0;
  for (std::uint32_t i = 0; i < kHits; ++i) {
    const RoughHit<D> hit = random_hit<D>(i);
    RoughHit<D> scaled = hit;
    scaled.diameter *= kLength;
    scaled.v *= kSpeed;
    scaled.smooth *= kSpeed;
    scaled.spin *= kSpeed / kLength;
    different += scaled.friction().velocity != hit.friction().velocity * kSpeed;
    different += scaled.friction().spin != hit.friction().spin * (kSpeed / kLength);
  }
  CHECK(different == 0);
}

TEST_CASE("Walls: friction has the impulses computed by hand") {
  // n = (-1,0), a = 1, q = 1/2: g_t = v_y + omega/2.
  const double infinity = std::numeric_limits<double>::infinity();
  const auto hit = [](const ContactLaw& law, Vec2 v, double spin, double normal_after) {
    return wall_friction<2>(v, {normal_after, v.y()}, Spin<2>(spin), {-1.0, 0.0}, law, Grain());
  };
  // g_t = 3 - 6/2 = 0.
  CHECK(hit({1.0, infinity, 1.0}, {2.0, 3.0}, -6.0, -2.0).velocity == Vec2(0.0, 0.0));
  CHECK(hit({1.0, 0.1, 1.0}, {2.0, 3.0}, -6.0, -2.0).spin[0] == 0.0);
  // eta = .5 * 2/(2 * 1.5) = 1/3: momentum -2, spin -4 (1/3) 3/.5 = -8.
  CHECK(hit({1.0, infinity, 1.0}, {2.0, 3.0}, 0.0, -2.0).velocity.isApprox(Vec2(0.0, -2.0), 1e-15));
  CHECK(hit({1.0, infinity, 1.0}, {2.0, 3.0}, 0.0, -2.0).spin[0] ==
        doctest::Approx(-8.0).epsilon(1e-15));
  // Coulomb, with the normal impulse of a driven wall: |J_t| = .1 * (2 + 3) = .5, spin -2 |J_t|/q =
  // -2.
  CHECK(hit({1.0, 0.1, 1.0}, {2.0, 3.0}, 0.0, -3.0).velocity.isApprox(Vec2(0.0, -0.5), 1e-15));
  CHECK(hit({1.0, 0.1, 1.0}, {2.0, 3.0}, 0.0, -3.0).spin[0] ==
        doctest::Approx(-2.0).epsilon(1e-15));
  // Smooth.
  for (const ContactLaw& law : {ContactLaw{1.0, 0.0, 1.0}, ContactLaw{1.0, infinity, -1.0}}) {
    CHECK(hit(law, {2.0, 3.0}, 1.0, -2.0).velocity == Vec2(0.0, 0.0));
    CHECK(hit(law, {2.0, 3.0}, 1.0, -2.0).spin[0] == 0.0);
  }
}

// T_rot = I <omega^2> = T_w, I = q m a^2/4: variance 4 T_w/(q m a^2).
TEST_CASE_TEMPLATE("Walls: a thermal wall emits spins at its temperature", Dimension, Plane,
                   Space) {
  constexpr int D = Dimension::value, kSpins = D * (D - 1) / 2;
  constexpr int kSamples = 100000;
  constexpr double kT = 2.25, kInertia = 0.4, kDiameter = 1.5, kMass = 5.0;
  constexpr double kVariance = kT / (0.25 * kMass * kInertia * kDiameter * kDiameter);  // 2
  const Grain grain = {.radius = 0.5 * kDiameter, .mass = kMass, .inertia = kInertia};
  double sum = 0.0, squares = 0.0;
  for (std::uint32_t i = 0; i < kSamples; ++i) {
    Random random(43, Stream::ThermalWall, i, 0);
    const Spin<D> normals = random_vector<Spin<D>>(random);
    const Spin<D> spin = emit_spin<D>(kT, grain, normals.data());
    sum += spin.sum();
    squares += spin.squaredNorm();
  }
  const double drawn = double{kSpins} * kSamples;
  CHECK(std::fabs(standard_errors_off(sum, drawn, 0.0, kVariance)) < 5.0);
  CHECK(std::fabs(standard_errors_off(squares, drawn, kVariance, 2.0 * kVariance * kVariance)) <
        5.0);
}
