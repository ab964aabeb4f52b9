// Mixing of species, from their numbers in cells.

#include <doctest/doctest.h>

#include <algorithm>
#include <cmath>
#include <vector>

#include "engine/physics/mixing.h"

namespace clatter::mixing {

// Cells (2, 0) and (1, 1): x = (3/4, 1/4), S_0 = 3/8, S = S_R = 1/8.
TEST_CASE("Mixing: indices of two cells, by hand") {
  const double quarters = -0.75 * std::log(0.75) - 0.25 * std::log(0.25);
  const Mixing mixing = mixing_of(std::vector<std::uint32_t>{2, 0, 1, 1}, 2);
  CHECK(mixing.lacey == doctest::Approx(1.0).epsilon(1e-14));
  CHECK(mixing.entropy == doctest::Approx(0.5 * std::log(2.0) / quarters).epsilon(1e-14));
  CHECK(mixing.random_entropy == doctest::Approx(mixing.entropy).epsilon(1e-14));
}

// Empty cells change nothing. With equal shares S = 0: L = 1/(1 - 1/11) of 2 cells of 6.
TEST_CASE("Mixing: separate species have 0, equal shares the entropy 1") {
  const Mixing apart = mixing_of(std::vector<std::uint32_t>{7, 0, 0, 0, 0, 0, 0, 4, 0, 0, 0, 2}, 3);
  CHECK(apart.lacey == doctest::Approx(0.0));
  CHECK(apart.entropy == 0.0);
  const Mixing even = mixing_of(std::vector<std::uint32_t>{2, 4, 0, 0, 2, 4}, 2);
  CHECK(even.lacey == doctest::Approx(1.1).epsilon(1e-14));
  CHECK(even.entropy == doctest::Approx(1.0).epsilon(1e-14));
}

TEST_CASE("Mixing: a single species has none") {
  CHECK(std::isnan(mixing_of(std::vector<std::uint32_t>{3, 0, 5, 0}, 2).lacey));
  CHECK(std::isnan(mixing_of(std::vector<std::uint32_t>{0, 0}, 2).entropy));
}

TEST_CASE("Mixing: particles that are alone in their cells have none") {
  CHECK(std::isnan(mixing_of(std::vector<std::uint32_t>{1, 0, 0, 1, 1, 0}, 2).lacey));
}

// All ways in which three species (4, 3 and 2 particles) fill cells of 4, 1, 3 and 1 particles.
TEST_CASE("Mixing: the means over all permutations are those at random") {
  std::vector<std::size_t> species = {0, 0, 0, 0, 1, 1, 1, 2, 2};
  const std::vector<std::size_t> cell_of = {0, 0, 0, 0, 1, 2, 2, 2, 3};
  double ways = 0.0, lacey = 0.0, entropy = 0.0, random_entropy = 0.0;
  do {
    std::vector<std::uint32_t> numbers(12);
    for (std::size_t i = 0; i < species.size(); ++i) ++numbers[cell_of[i] * 3 + species[i]];
    const Mixing mixing = mixing_of(numbers, 3);
    ways += 1.0;
    lacey += mixing.lacey;
    entropy += mixing.entropy;
    random_entropy = mixing.random_entropy;
  } while (std::ranges::next_permutation(species).found);
  REQUIRE(ways == 1260.0);
  CHECK(lacey / ways == doctest::Approx(1.0).epsilon(1e-12));
  CHECK(entropy / ways == doctest::Approx(random_entropy).epsilon(1e-12));
}

// The expansion of the expectation for large n: H_R = 1 - (1 - n/N)/(2 n H_0) of two species. Its
// next term is of the order of 1/n^2.
TEST_CASE("Mixing: the random value of large cells is that of its expansion") {
  const std::vector<std::uint32_t> numbers = {1000, 4000, 1000, 4000, 1000, 4000, 1000, 4000};
  const double whole = -0.2 * std::log(0.2) - 0.8 * std::log(0.8);
  CHECK(mixing_of(numbers, 2).random_entropy ==
        doctest::Approx(1.0 - 0.75 / (2.0 * 5000.0 * whole)).epsilon(1e-7));
}

}  // namespace clatter::mixing
