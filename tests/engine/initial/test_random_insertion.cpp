#include <doctest/doctest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <vector>

#include "engine/initial/random_insertion.h"
#include "engine/physics/theory.h"
#include "tests/engine/support/rooms.h"
#include "tests/support/statistics.h"

using namespace clatter;
using namespace clatter::testing;

namespace {

Random placement(std::uint64_t seed) {
  return {seed, Stream::Placement, 0, 0};
}

/// Number of particles that fill this fraction of a room.
template <int D>
int count_at(double fraction, const Room<D>& room) {
  return static_cast<int>(fraction / packing_fraction(D, 1.0 / room.box.prod()));
}

/// The room's axes are walled, or periodic.
template <int D>
Room<D> room_of(const Vec<D>& box, bool walled) {
  Room<D> room{.box = box};
  room.walled.fill(walled);
  return room;
}

/// A point in units of the range of centres along each axis.
template <int D>
Vec<D> shares(const Room<D>& room, const Vec<D>& point) {
  Vec<D> share;
  for (int k = 0; k < D; ++k) {
    const double margin = !room.walled[k] ? 0.0 : 0.5 * room.diameter;
    share[k] = (point[k] - margin) / (room.box[k] - 2.0 * margin);
    REQUIRE(share[k] >= 0.0);
    REQUIRE(share[k] < 1.0);
  }
  return share;
}

/// Histogram of the centres of many seeds, on a grid over the range of centres.
template <int D>
std::vector<double> pooled_counts(const Room<D>& room, int count, int seeds, int cells) {
  std::vector<double> counts(static_cast<std::size_t>(std::pow(cells, D)));
  for (int seed = 1; seed <= seeds; ++seed) {
    Random random = placement(static_cast<std::uint64_t>(seed));
    for (const Vec<D>& r : random_insertion(room, count, random)) {
      const IntVec<D> cell = (cells * shares(room, r)).template cast<int>();
      int index = 0;
      for (int k = D - 1; k >= 0; --k) index = index * cells + cell[k];
      counts[static_cast<std::size_t>(index)] += 1.0;
    }
  }
  return counts;
}

/// Checks that all cells have equal probability: chi^2 of all, and no deviation above 5 standard
/// errors.
void check_uniform(const std::vector<double>& counts) {
  double total = 0.0;
  for (const double count : counts) total += count;
  const double mean = total / static_cast<double>(counts.size());
  CHECK(counts_p(counts, std::vector(counts.size(), mean)) > kMinProbability);
  for (const double count : counts) CHECK(std::fabs(count - mean) < 5.0 * std::sqrt(mean));
}

template <int D>
void check_apart(const Vec<D>& box, const std::vector<double>& fractions) {
  for (const auto& walled : all_walls<D>()) {
    for (const double fraction : fractions) {
      CAPTURE(walled[0]);
      CAPTURE(walled[1]);
      CAPTURE(walled[D - 1]);
      CAPTURE(fraction);
      const Room<D> room{box, walled};
      Random random = placement(61);
      const int count = count_at(fraction, room);
      const auto centres = random_insertion(room, count, random);
      REQUIRE(static_cast<int>(centres.size()) == count);
      CHECK(least_distance(room, centres) >= 1.0);
      CHECK(all_inside(room, centres));
    }
  }
}

template <int D>
void check_small_rooms(double fraction) {
  for (double edge = 1.05; edge < 4.2; edge += 0.1) {
    for (const bool walled : {false, true}) {
      CAPTURE(edge);
      CAPTURE(walled);
      const Room<D> room = room_of<D>(Vec<D>::Constant(edge), walled);
      for (std::uint64_t seed = 1; seed <= 30; ++seed) {
        Random random = placement(seed);
        const auto centres = random_insertion(room, count_at(fraction, room), random);
        CHECK(least_distance(room, centres) >= 1.0);
        CHECK(all_inside(room, centres));
      }
    }
  }
}

/// 20,000 particles along each axis in 200 bins of 100: a gap as wide as a bin would empty one.
template <int D>
void check_no_gaps(const Room<D>& room) {
  std::array<std::vector<double>, D> counts;
  counts.fill(std::vector(200, 0.0));
  for (std::uint64_t seed = 1; seed <= 20000; ++seed) {
    Random random = placement(seed);
    const Vec<D> share = shares(room, random_insertion(room, 1, random)[0]);
    for (int k = 0; k < D; ++k) counts[k][static_cast<std::size_t>(200.0 * share[k])] += 1.0;
  }
  for (const auto& along : counts) check_uniform(along);
}

/// In a periodic box the second centre is uniform outside the first one's disk or ball. In a share
/// `share` of the seeds the two are closer than 1.5.
template <int D>
void check_distances(double share) {
  constexpr int kSeeds = 10000;
  const Room<D> room{Vec<D>::Constant(4.0)};
  int near = 0;
  for (int seed = 1; seed <= kSeeds; ++seed) {
    Random random = placement(static_cast<std::uint64_t>(seed));
    near += least_distance(room, random_insertion(room, 2, random)) < 1.5;
  }
  CHECK(std::fabs(near - kSeeds * share) < 5.0 * std::sqrt(kSeeds * share * (1.0 - share)));
}

/// Tries seeds at a fraction that the process reaches, and at one that it does not.
template <int D>
void check_jamming(double edge, double reached, double out_of_reach) {
  const Room<D> room{Vec<D>::Constant(edge)};
  for (const std::uint64_t seed : {62u, 66u, 67u}) {
    Random random = placement(seed);
    const auto centres = random_insertion(room, count_at(reached, room), random);
    REQUIRE(static_cast<int>(centres.size()) == count_at(reached, room));
    CHECK(least_distance(room, centres) >= 1.0);
    CHECK(random_insertion(room, count_at(out_of_reach, room), random).empty());
  }
}

template <int D>
void check_insertion_seeds(const Room<D>& room) {
  Random random = placement(63);
  CHECK(random_insertion(room, 0, random).empty());
  CHECK(random_insertion(room, 1, random).size() == 1);

  Random a = placement(64), b = placement(65);
  const auto one = random_insertion(room, 12, a), other = random_insertion(room, 12, b);
  REQUIRE(one.size() == 12);
  for (int axis = 0; axis < D; ++axis) CHECK(one[0][axis] != other[0][axis]);
}

}  // namespace

TEST_CASE("Random insertion: no two particles overlap, and all centres are in the room") {
  check_apart<2>({21.3, 17.9}, {0.1, 0.3, 0.5});
  check_apart<3>({7.3, 5.9, 6.4}, {0.1, 0.2, 0.3});
  // Dilute, but in a room that is narrow enough for contacts.
  check_apart<2>({1.1, 1000.0}, {0.015});
  check_apart<3>({1.1, 1000.0, 1.2}, {0.01});
}

TEST_CASE("Random insertion: no two centres overlap in rooms of a few diameters") {
  check_small_rooms<2>(0.3);
  check_small_rooms<3>(0.25);
}

TEST_CASE(
    "Random insertion: a single particle is equally likely everywhere, up to walls and corners") {
  // 20,000 particles, 100 cells of 200 each: 7 % per cell. The sides of the room are not multiples
  // of a cell.
  for (const bool walled : {false, true}) {
    CAPTURE(walled);
    check_uniform(pooled_counts(room_of<2>({5.3, 3.7}, walled), 1, 20000, 10));
    // 125 cells of 160 each: 8 % per cell.
    check_uniform(pooled_counts(room_of<3>({5.3, 3.7, 2.3}, walled), 1, 20000, 5));
  }
}

TEST_CASE("Random insertion: there are no gaps between its cells") {
  check_no_gaps<2>({{5.3, 3.7}, {false, true}});
  check_no_gaps<3>({{5.3, 3.7, 2.3}, {false, true, false}});
}

TEST_CASE("Random insertion: positions in a periodic room are uniform at any density") {
  // phi = .44 in a box in which a particle excludes its own images: 9 particles, 2000 seeds, 36
  // cells of 500 each.
  check_uniform(pooled_counts<2>({{4.0, 4.0}}, 9, 2000, 6));
  // The same at phi = .27: 14 particles, 2000 seeds, 64 cells of 437 each.
  check_uniform(pooled_counts<3>({{3.0, 3.0, 3.0}}, 14, 2000, 4));
}

TEST_CASE("Random insertion: walls, edges and corners get their share of a thin gas") {
  // phi = .004, so that particles hardly exclude each other from the centre (the cells' density
  // differs by about phi). 2 particles, 10,000 seeds, 100 cells of 200 each.
  check_uniform(pooled_counts(room_of<2>({20.0, 20.0}, true), 2, 10000, 10));
  // phi = .0006, 125 cells of 160 each.
  check_uniform(pooled_counts(room_of<3>({12.0, 12.0, 12.0}, true), 2, 10000, 5));
}

TEST_CASE(
    "Random insertion: the distance of two particles has the distribution of independent ones") {
  // 10,000 seeds. pi (1.5^2 - 1)/(16 - pi), and (4 pi/3) (1.5^3 - 1)/(64 - 4 pi/3).
  check_distances<2>(0.3054);
  check_distances<3>(0.1663);
}

TEST_CASE("Random insertion: it gives up where it jams, and not before") {
  // Random sequential addition jams at phi = .547 (Feder 1980) and .384 (Torquato, Uche &
  // Stillinger 2006).
  check_jamming<2>(20.0, 0.53, 0.60);
  check_jamming<3>(7.0, 0.37, 0.41);
  // A second particle never fits here.
  Random random = placement(62);
  CHECK(random_insertion<2>({{1.9, 1.9}, {true, true}}, 3, random).empty());
  CHECK(random_insertion<3>({{1.5, 1.5, 1.5}, {true, true, true}}, 2, random).empty());
}

TEST_CASE("Random insertion: another seed gives other places") {
  check_insertion_seeds<2>({{6.0, 6.0}, {true, false}});
  check_insertion_seeds<3>({{4.0, 4.0, 4.0}, {true, false, true}});
}
