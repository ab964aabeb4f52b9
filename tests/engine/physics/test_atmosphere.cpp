#include <doctest/doctest.h>

#include <cmath>
#include <numbers>
#include <vector>

#include "engine/physics/atmosphere.h"

namespace clatter {

namespace {

// The number of particles over the size of the floor, by the trapezoidal rule on the logarithms.
double column(const std::vector<Vec2>& profile) {
  double sum = 0.0;
  for (std::size_t i = 1; i < profile.size(); ++i) {
    const double step = profile[i].x() - profile[i - 1].x();
    sum += step * std::sqrt(profile[i].y() * profile[i - 1].y());
  }
  return sum;
}

}  // namespace

TEST_CASE("Atmosphere: a dilute gas has the barometric law") {
  const Atmosphere air{1e-3, 10.0, 31.0, 0.2, 2.0, 2};
  const std::vector<Vec2> profile = air.profile();
  // Centres are between 0.5 and 30.5. With g/T = 0.1: rho = 1e-4 0.1 exp(-0.1 h)/(1 - exp(-3)).
  CHECK(profile.front().x() == 0.5);
  CHECK(profile.back().x() == doctest::Approx(30.5));
  for (const Vec2& place : profile) {
    const double law = 1e-5 * std::exp(-0.1 * (place.x() - 0.5)) / (1.0 - std::exp(-3.0));
    CHECK(place.y() == doctest::Approx(law).epsilon(1e-4));
  }
}

TEST_CASE("Atmosphere: it holds all particles, and its pressure carries the weight above") {
  for (const int dimension : {2, 3}) {
    CAPTURE(dimension);
    const Atmosphere air{200.0, 30.0, 40.0, 1.0, 3.0, dimension};
    const std::vector<Vec2> profile = air.profile();
    CHECK(column(profile) == doctest::Approx(200.0 / 30.0).epsilon(2e-3));
    CHECK(profile.back().x() == doctest::Approx(39.5));
    // Henderson's disks (1975) and the spheres of Carnahan and Starling (1969), written out.
    const auto pressure = [&](double rho) {
      const double phi = (dimension == 2 ? 0.25 : 1.0 / 6.0) * std::numbers::pi * rho;
      const double z = dimension == 2
                           ? (1.0 + phi * phi / 8.0) / std::pow(1.0 - phi, 2)
                           : (1.0 + phi + phi * phi - std::pow(phi, 3)) / std::pow(1.0 - phi, 3);
      return 3.0 * rho * z;
    };
    const double fall = pressure(profile.front().y()) - pressure(profile.back().y());
    CHECK(fall == doctest::Approx(200.0 / 30.0).epsilon(1e-6));
    for (std::size_t i = 1; i < profile.size(); ++i) {
      CHECK(profile[i].y() < profile[i - 1].y());
    }
  }
}

TEST_CASE("Atmosphere: without much weight the gas is the same at all heights") {
  const Atmosphere air{60.0, 10.0, 11.0, 1e-9, 1.0, 2};
  for (const Vec2& place : air.profile()) CHECK(place.y() == doctest::Approx(0.6).epsilon(1e-6));
}

}  // namespace clatter
