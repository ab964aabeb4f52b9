#include <doctest/doctest.h>

#include <cmath>
#include <utility>
#include <vector>

#include "engine/physics/two_compartments.h"

namespace clatter::two_compartments_theory {

// The maximum of the flux over an elastic floor, from an independent solution (Eggers 1999 has the
// limit of small fillings).
TEST_CASE("Two compartments: an equal split becomes unstable at the maximum of the flux") {
  const std::vector<std::pair<double, double>> table = {{0.2, 2.82}, {0.25, 2.37}, {0.4, 1.66},
                                                        {0.5, 1.41}, {1.0, 0.864}, {3.0, 0.424}};
  for (const auto& row : table) {
    const double height = row.first, threshold = row.second;
    CAPTURE(height);
    TwoCompartments gas{.width = 1.0, .restitution = std::sqrt(0.5), .height = height};
    const double of_one = 0.5;  // Y of each particle in a compartment of width 1
    gas.count = 2.0 * 0.99 * threshold / of_one;
    CHECK(gas.fuller_share() == 0.5);
    gas.count = 2.0 * 1.02 * threshold / of_one;
    CHECK(gas.fuller_share() > 0.5);
    CHECK(gas.flux(gas.fuller_share() * gas.count * of_one) ==
          doctest::Approx(gas.flux((1.0 - gas.fuller_share()) * gas.count * of_one)).epsilon(1e-9));
  }
}

// With a floor of restitution 0 every particle leaves with v_dr. Its power is then
// (v_dr^2 - 2 s^2 v_dr^2) per hit, and the quadratic has the root s^2 = 1/(sqrt(2) pi Y + 2).
TEST_CASE("Two compartments: an inelastic floor bounds the temperature") {
  const TwoCompartments gas{.restitution = 0.9,
                            .drive_speed = 2.0,
                            .floor_restitution = 0.0,
                            .gravity = 1.5,
                            .height = 3.0};
  const double filling = 0.7, square = 1.0 / (std::sqrt(2.0) * 3.14159265358979 * filling + 2.0);
  const double climb = 1.5 * 3.0 / 4.0;
  CHECK(gas.flux(filling) ==
        doctest::Approx(filling / std::sqrt(square) * std::exp(-climb / square)).epsilon(1e-12));
}

}  // namespace clatter::two_compartments_theory
