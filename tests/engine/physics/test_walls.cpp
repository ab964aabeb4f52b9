#include <doctest/doctest.h>

#include <cmath>
#include <cstdint>
#include <numbers>
#include <vector>

#include "engine/physics/random.h"
#include "engine/physics/walls.h"
#include "tests/support/statistics.h"

using namespace clatter;
using namespace clatter::testing;

// Eq. (3.1): v_n' = alpha_w |v_n| + v_dr, along the normal into the box.
TEST_CASE("walls: reflection off each of the four walls") {
  CHECK(reflect<2>({-2.0, 3.0}, 0, 1.0, 1.0, 0.0) == Vec2(2.0, 3.0));
  CHECK(reflect<2>({2.0, 3.0}, 0, -1.0, 0.5, 0.0) == Vec2(-1.0, 3.0));
  CHECK(reflect<2>({-2.0, -3.0}, 1, 1.0, 0.5, 0.25) == Vec2(-2.0, 1.75));
  CHECK(reflect<2>({-2.0, 3.0}, 1, -1.0, 0.0, 0.25) == Vec2(-2.0, -0.25));
  CHECK(reflect<2>({-2.0, 3.0}, 0, 1.0, 1.5, 0.0) == Vec2(3.0, 3.0));
}

// Eq. (3.2): the gain in energy of one hit is (1/2) [v_dr^2 + 2 alpha_w |v_n| v_dr - (1 -
// alpha_w^2) v_n^2].
TEST_CASE("walls: the energy of a hit") {
  for (const double alpha : {0.0, 0.3, 1.0, 1.2}) {
    for (const double drive : {0.0, 0.7, 2.0}) {
      const Vec2 v = {-1.25, 0.5};
      const Vec2 w = reflect<2>(v, 0, 1.0, alpha, drive);
      const double gain = 0.5 * (w.squaredNorm() - v.squaredNorm());
      CHECK(gain == doctest::Approx(0.5 * (drive * drive + 2.0 * alpha * 1.25 * drive -
                                           (1.0 - alpha * alpha) * 1.25 * 1.25)));
    }
  }
}

// Section 3: v_n has the flux-weighted density (v/T) exp(-v^2/2T): mean sqrt(pi T/2), mean square
// 2 T, variance of the square 4 T^2, share below v 1 - exp(-v^2/2T); v_t is Gaussian of variance T.
TEST_CASE("walls: a thermal wall emits flux-weighted velocities") {
  constexpr int kSamples = 400000, kBins = 50;
  constexpr double kT = 2.25;
  std::vector<double> normal_bins(kBins), tangential_bins(kBins);
  double sum = 0.0, squares = 0.0, tangential = 0.0, tangential_squares = 0.0;
  for (std::uint32_t i = 0; i < kSamples; ++i) {
    Random random(41, Stream::ThermalWall, i, 0);
    const double uniform = random.uniform();
    const double normal = random.normal();
    const Vec2 v = emit<2>(1, -1.0, kT, uniform, &normal);
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
  CHECK(counts_p(normal_bins, expected) > kLeastProbability);
  CHECK(counts_p(tangential_bins, expected) > kLeastProbability);
  const double mean = std::sqrt(std::numbers::pi * kT / 2.0);
  CHECK(std::fabs(standard_errors_off(sum, kSamples, mean, 2.0 * kT - mean * mean)) < 5.0);
  CHECK(std::fabs(standard_errors_off(squares, kSamples, 2.0 * kT, 4.0 * kT * kT)) < 5.0);
  CHECK(std::fabs(standard_errors_off(tangential, kSamples, 0.0, kT)) < 5.0);
  CHECK(std::fabs(standard_errors_off(tangential_squares, kSamples, kT, 2.0 * kT * kT)) < 5.0);
}

TEST_CASE("walls: a thermal wall at T_w = 0 stops the disk") {
  const double normal = -1.5;
  CHECK(emit<2>(0, 1.0, 0.0, 0.3, &normal) == Vec2(0.0, 0.0));
}
