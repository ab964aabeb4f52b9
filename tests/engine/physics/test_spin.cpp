#include <doctest/doctest.h>

#include "engine/physics/spin.h"

using namespace clatter;

TEST_CASE("Spin: products in the plane are those in space") {
  const Vec<2> n = {0.6, -0.8}, g = {3.0, 5.0};
  const double omega = 2.0;
  const Vec<3> n_space = {0.6, -0.8, 0.0}, g_space = {3.0, 5.0, 0.0}, omega_space = {0.0, 0.0, 2.0};
  const Vec<2> turned = cross_spin<2>(n, Spin<2>(omega));
  CHECK(cross_spin<3>(n_space, omega_space) == Vec<3>(turned.x(), turned.y(), 0.0));
  CHECK(cross<3>(n_space, g_space) == Vec<3>(0.0, 0.0, cross<2>(n, g)[0]));
}

TEST_CASE("Spin: counterclockwise is positive, and moves the lower side to the right") {
  CHECK(cross_spin<2>({0.0, 1.0}, Spin<2>(2.0)) == Vec<2>(2.0, 0.0));
  CHECK(cross_spin<2>({1.0, 0.0}, Spin<2>(2.0)) == Vec<2>(0.0, -2.0));
  CHECK(cross<2>({1.0, 0.0}, {0.0, 3.0})[0] == 3.0);
  CHECK(cross<2>({0.0, 1.0}, {3.0, 0.0})[0] == -3.0);
}
