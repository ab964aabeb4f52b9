#include <doctest/doctest.h>

#include <cmath>
#include <cstdint>

#include "engine/physics/collision.h"
#include "engine/physics/random.h"

using namespace clatter;

// Eq. (2.4), (2.8) with beta = -1 and m = 1.
TEST_CASE("collision: momentum, energy and the tangential velocity over random pairs") {
  double energy_off = 0.0, tangential_off = 0.0, normal_off = 0.0;
  for (std::uint32_t i = 0; i < 100000; ++i) {
    Random random(31, Stream::Velocity, i, 0);
    const double angle = 7.0 * random.uniform();
    const Vec2 n = {std::cos(angle), std::sin(angle)};
    const Vec2 v_1 = {random.normal(), random.normal()};
    const Vec2 v_2 = {random.normal(), random.normal()};
    const Vec2 g = v_1 - v_2;
    const double alpha = i % 3 == 0 ? 1.0 : random.uniform();
    // x is not of unit length to the last bit, as at any contact.
    const Vec2 impulse = collision_impulse<2>(n * (1.0 + 1e-14), g, alpha);
    const Vec2 w_1 = v_1 + impulse, w_2 = v_2 - impulse;

    const double gain =
        0.5 * (w_1.squaredNorm() + w_2.squaredNorm() - v_1.squaredNorm() - v_2.squaredNorm());
    const double g_n = n.dot(g);
    energy_off = std::max(energy_off, std::fabs(gain + 0.25 * (1.0 - alpha * alpha) * g_n * g_n));
    normal_off = std::max(normal_off, std::fabs(n.dot(w_1 - w_2) + alpha * g_n));
    const Vec2 t = {-n.y(), n.x()};
    tangential_off = std::max(tangential_off, std::fabs(t.dot(impulse)));
  }
  CHECK(energy_off < 1e-13);
  CHECK(normal_off < 1e-13);
  CHECK(tangential_off < 1e-13);
}

TEST_CASE("collision: momentum is exchanged to the last bit, and by either partner's reckoning") {
  int different = 0;
  double momentum_off = 0.0;
  for (std::uint32_t i = 0; i < 100000; ++i) {
    Random random(32, Stream::Velocity, i, 0);
    const Vec2 x = {random.normal(), random.normal()};
    const Vec2 v_1 = {random.normal(), random.normal()};
    const Vec2 v_2 = {random.normal(), random.normal()};
    const double alpha = random.uniform();
    const Vec2 gained = collision_impulse<2>(x, v_1 - v_2, alpha);
    different += gained != -collision_impulse<2>(-x, v_2 - v_1, alpha);
    momentum_off = std::max(momentum_off, ((v_1 + gained) + (v_2 - gained) - v_1 - v_2).norm());
  }
  CHECK(different == 0);
  CHECK(momentum_off < 1e-13);
}

TEST_CASE("collision: exact cases") {
  // Head on, elastic: velocities are exchanged. Wholly inelastic: both move on together.
  CHECK(collision_impulse<2>({1.0, 0.0}, {-2.0, 5.0}, 1.0) == Vec2(2.0, 0.0));
  CHECK(collision_impulse<2>({1.0, 0.0}, {-2.0, 5.0}, 0.0) == Vec2(1.0, 0.0));
  CHECK(collision_impulse<2>({0.0, -1.0}, {0.0, 4.0}, 0.5) == Vec2(0.0, -3.0));
}
