#include <doctest/doctest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>
#include <vector>

#include "engine/initial/random_insertion.h"
#include "tests/engine/support/rooms.h"
#include "tests/support/statistics.h"

using namespace clatter;
using namespace clatter::testing;

namespace {

Random placement(std::uint64_t seed) {
  return {seed, Stream::Placement, 0, 0};
}

/// Counts of the centres of many seeds on a grid over all of the places that a centre can take.
std::vector<double> pooled_counts(const Room<2>& room, int count, int seeds, int cells) {
  std::vector<double> counts(static_cast<std::size_t>(cells * cells));
  for (int seed = 1; seed <= seeds; ++seed) {
    Random random = placement(static_cast<std::uint64_t>(seed));
    for (const Vec2& r : random_insertion(room, count, random)) {
      std::array<int, 2> cell;
      for (int k = 0; k < 2; ++k) {
        const double margin = !room.walled[k] ? 0.0 : 0.5 * room.diameter;
        cell[k] = static_cast<int>((r[k] - margin) / (room.box[k] - 2.0 * margin) * cells);
        REQUIRE(cell[k] >= 0);
        REQUIRE(cell[k] < cells);
      }
      counts[static_cast<std::size_t>(cell[0] + cells * cell[1])] += 1.0;
    }
  }
  return counts;
}

/// Checks that all cells were met alike: chi^2 of all, and none beyond 5 standard errors.
void check_uniform(const std::vector<double>& counts) {
  double total = 0.0;
  for (const double count : counts) total += count;
  const double mean = total / static_cast<double>(counts.size());
  CHECK(counts_p(counts, std::vector(counts.size(), mean)) > kMinProbability);
  for (const double count : counts) CHECK(std::fabs(count - mean) < 5.0 * std::sqrt(mean));
}

}  // namespace

TEST_CASE("Random insertion: no two centres overlap, all lie in the room") {
  for (const bool walled : {false, true}) {
    for (const double fraction : {0.1, 0.3, 0.5}) {
      CAPTURE(walled);
      CAPTURE(fraction);
      const Room<2> room{{21.3, 17.9}, {walled, !walled}};
      const int count = static_cast<int>(fraction * room.box.prod() * 4.0 / std::numbers::pi);
      Random random = placement(61);
      const auto centres = random_insertion(room, count, random);
      REQUIRE(static_cast<int>(centres.size()) == count);
      CHECK(least_distance(room, centres) >= 1.0);
      CHECK(all_inside(room, centres));
    }
  }
}

TEST_CASE(
    "Random insertion: a single particle is equally likely everywhere, up to walls and corners") {
  // 20,000 particles, 100 cells of 200 each: 7 % per cell. The room's sides are no multiples of a
  // cell.
  for (const bool walled : {false, true}) {
    CAPTURE(walled);
    const Room<2> room{{5.3, 3.7}, {walled, walled}};
    check_uniform(pooled_counts(room, 1, 20000, 10));
  }
}

TEST_CASE("Random insertion: there are no gaps between its cells") {
  // 20,000 particles along each axis in 200 bins of 100: a gap as wide as a bin would empty one.
  const Room<2> room{{5.3, 3.7}, {false, true}};
  const Vec2 low = {0.0, 0.5}, extent = {5.3, 2.7};
  std::array<std::vector<double>, 2> counts = {std::vector(200, 0.0), std::vector(200, 0.0)};
  for (std::uint64_t seed = 1; seed <= 20000; ++seed) {
    Random random = placement(seed);
    const Vec2 share = (random_insertion(room, 1, random)[0] - low).cwiseQuotient(extent);
    for (int k = 0; k < 2; ++k) counts[k][static_cast<std::size_t>(200.0 * share[k])] += 1.0;
  }
  check_uniform(counts[0]);
  check_uniform(counts[1]);
}

TEST_CASE("Random insertion: all places of a periodic room are alike, however full it is") {
  // phi = .44 in a box in which a particle feels its images: 9 particles, 2000 seeds, 36 cells of
  // 500 each.
  check_uniform(pooled_counts({{4.0, 4.0}}, 9, 2000, 6));
}

TEST_CASE("Random insertion: walls and corners get their share of a thin gas") {
  // phi = .004, so that particles hardly keep each other off the middle (the cells' density differs
  // by about phi). 2 particles, 10,000 seeds, 100 cells of 200 each.
  check_uniform(pooled_counts({{20.0, 20.0}, {true, true}}, 2, 10000, 10));
}

TEST_CASE(
    "Random insertion: the distance of two particles has the distribution of independent ones") {
  // In a periodic box the second centre is uniform outside of the first one's circle, so the share
  // of seeds with the two nearer than 1.5 is pi (1.5^2 - 1)/(16 - pi) = .3054. 10,000 seeds.
  constexpr int kSeeds = 10000;
  const Room<2> room{{4.0, 4.0}};
  int near = 0;
  for (int seed = 1; seed <= kSeeds; ++seed) {
    Random random = placement(static_cast<std::uint64_t>(seed));
    near += least_distance(room, random_insertion(room, 2, random)) < 1.5;
  }
  const double share = std::numbers::pi * 1.25 / (16.0 - std::numbers::pi);
  CHECK(std::fabs(near - kSeeds * share) < 5.0 * std::sqrt(kSeeds * share * (1.0 - share)));
}

TEST_CASE("Random insertion: it gives up where it jams") {
  // Random sequential addition jams at phi = .547 (Feder 1980), .60 is out of reach.
  const Room<2> room{{20.0, 20.0}};
  Random random = placement(62);
  CHECK(random_insertion(room, 306, random).empty());
  // A second particle never fits here.
  CHECK(random_insertion<2>({{1.9, 1.9}, {true, true}}, 3, random).empty());
}

TEST_CASE("Random insertion: another seed gives other places") {
  const Room<2> room{{6.0, 6.0}, {true, false}};
  Random random = placement(63);
  CHECK(random_insertion(room, 0, random).empty());
  CHECK(random_insertion(room, 1, random).size() == 1);

  Random a = placement(64), b = placement(65);
  CHECK(random_insertion(room, 12, a) != random_insertion(room, 12, b));
}
