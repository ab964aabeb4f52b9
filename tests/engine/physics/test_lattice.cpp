#include <doctest/doctest.h>

#include <algorithm>
#include <climits>
#include <cmath>

#include "engine/physics/random.h"
#include "engine/physics/theory.h"
#include "tests/engine/support/rooms.h"

using namespace clatter;
using namespace clatter::testing;

namespace {

/// The k-th of `places` evenly spread places along an axis.
template <int D>
double place(const Room<D>& room, int axis, int k, int places) {
  if (!room.walled[axis]) return k * room.box[axis] / places;
  if (places == 1) return 0.5 * room.box[axis];
  return 0.5 * room.diameter + k * (room.box[axis] - room.diameter) / (places - 1);
}

/// Rows along x with a site at every place, or at every second place. Then neighbouring rows are
/// staggered.
template <int D>
std::vector<Vec<D>> rows_of(const Room<D>& room, const IntVec<D>& places, bool turns) {
  std::vector<Vec<D>> sites;
  IntVec<D> at = IntVec<D>::Zero();
  while (at[D - 1] < places[D - 1]) {
    const bool odd = turns && at.sum() % 2 != 0;
    for (at[0] = odd ? 1 : 0; at[0] < places[0]; at[0] += turns ? 2 : 1) {
      Vec<D>& site = sites.emplace_back();
      for (int axis = 0; axis < D; ++axis) site[axis] = place(room, axis, at[axis], places[axis]);
    }
    at[0] = 0;
    for (int axis = 1; ++at[axis] == places[axis] && axis < D - 1; ++axis) at[axis] = 0;
  }
  return sites;
}

/// Whether staggered rows match across all periodic borders.
template <int D>
bool closes(const Room<D>& room, const IntVec<D>& places) {
  for (int axis = 0; axis < D; ++axis) {
    if (!room.walled[axis] && places[axis] % 2 != 0) return false;
  }
  return true;
}

/// [n] The largest least distance of all these lattices with at least n sites, by brute force. Ends
/// at the largest number of sites with a distance of one diameter.
template <int D>
std::vector<double> brute_distances(const Room<D>& room, bool turns) {
  std::vector<double> largest(1, 0.0);
  const IntVec<D> most = (2.0 / room.diameter * room.box).template cast<int>().array() + 3;
  IntVec<D> places = IntVec<D>::Ones();
  while (places[D - 1] <= most[D - 1]) {
    if (!turns || closes(room, places)) {
      const auto sites = rows_of(room, places, turns);
      const double least = least_distance(room, sites, room.diameter);
      if (least >= room.diameter) {
        largest.resize(std::max(largest.size(), sites.size() + 1), 0.0);
        for (std::size_t n = 0; n <= sites.size(); ++n) largest[n] = std::max(largest[n], least);
      }
    }
    for (int axis = 0; ++places[axis] > most[axis] && axis < D - 1; ++axis) places[axis] = 1;
  }
  return largest;
}

/// The boxes with every combination of walls.
template <int D>
std::vector<Room<D>> rooms(const std::vector<Vec<D>>& boxes) {
  std::vector<Room<D>> all;
  for (const Vec<D>& box : boxes) {
    for (const auto& walled : all_walls<D>()) all.push_back({box, walled, 1.0});
  }
  return all;
}

/// Random boxes with edges between the diameter and a given length.
template <int D>
std::vector<Vec<D>> random_boxes(int count, double longest, std::uint64_t seed) {
  Random random(seed, Stream::Placement, 0, 0);
  std::vector<Vec<D>> boxes(static_cast<std::size_t>(count));
  for (Vec<D>& box : boxes) {
    for (double& edge : box) edge = 1.0 + (longest - 1.0) * random.uniform();
  }
  return boxes;
}

template <int D>
void check_sites(const std::vector<Vec<D>>& boxes) {
  for (Room<D> room : rooms<D>(boxes)) {
    for (const double diameter : {1.0, 0.37}) {
      room.diameter = diameter;
      const int capacity = lattice_capacity(room);
      for (const int count : {1, 2, 3, 7, capacity / 3, capacity / 2, capacity - 1, capacity}) {
        if (count < 1 || count > capacity) continue;
        CAPTURE(room.box.transpose());
        CAPTURE(count);
        bool held = false;
        for (const auto& sites :
             {primitive_lattice(room, count), face_centred_lattice(room, count)}) {
          if (sites.empty()) continue;
          held = true;
          CHECK(static_cast<int>(sites.size()) >= count);
          CHECK(all_inside(room, sites));
          if (sites.size() < 3000) CHECK(least_distance(room, sites) >= diameter);
        }
        CHECK(held);
      }
    }
  }
}

template <int D>
void check_against_brute_force(const std::vector<Vec<D>>& boxes) {
  for (const Room<D>& room : rooms<D>(boxes)) {
    CAPTURE(room.box.transpose());
    CAPTURE(room.walled[0]);
    CAPTURE(room.walled[1]);
    CAPTURE(room.walled[D - 1]);
    int most = 0;
    for (const bool centred : {false, true}) {
      CAPTURE(centred);
      const std::vector<double> largest = brute_distances(room, centred);
      const int held = static_cast<int>(largest.size()) - 1;
      most = std::max(most, held);
      for (int count = 1; count <= held + 1; ++count) {
        CAPTURE(count);
        const auto sites =
            centred ? face_centred_lattice(room, count) : primitive_lattice(room, count);
        REQUIRE(sites.empty() == (count > held));
        if (sites.empty()) continue;
        // The inverse, because a single site between walls has no neighbour.
        CHECK(1.0 / least_distance(room, sites) ==
              doctest::Approx(1.0 / largest[static_cast<std::size_t>(count)]).epsilon(1e-12));
      }
    }
    CHECK(lattice_capacity(room) == most);
  }
}

/// A row along each axis in turn, between walls along all others.
template <int D>
void check_touching() {
  constexpr int kLongest = D == 2 ? 400 : 100;
  for (int axis = 0; axis < D; ++axis) {
    Room<D> row{.box = Vec<D>::Ones()};
    row.walled.fill(true);
    row.box[axis] = 50.0;
    row.walled[axis] = false;
    CHECK(lattice_capacity(row) == 49);
    for (int n = 2; n < kLongest; ++n) {
      // The narrowest box with 0.1 n per particle for n particles of diameter 0.1, and slightly
      // wider boxes.
      for (const double width : {0.1 * n, 0.1 * n * (1.0 + 1e-15), 0.1 * n * (1.0 + 1e-13)}) {
        Room<D> room{.box = Vec<D>::Constant(0.15), .diameter = 0.1};
        room.box[axis] = width;
        const auto sites = primitive_lattice(room, lattice_capacity(room));
        CHECK(least_distance(room, sites) >= room.diameter);
      }
    }
  }
}

}  // namespace

TEST_CASE("Lattice: there are enough sites, inside the room and never closer than a diameter") {
  check_sites<2>({{20.0, 25.0}, {7.3, 7.3}, {1.2, 40.7}, {33.3, 1.9}, {11.0, 4.0}, {3.1, 2.7}});
  check_sites<3>({{2.9, 2.2, 1.7}, {1.2, 4.1, 1.1}, {1.6, 1.6, 3.3}, {2.1, 2.1, 2.1}});
}

TEST_CASE("Lattice: capacity and distances equal the best arrangement in any room") {
  check_against_brute_force<2>(
      {{5.3, 6.1}, {7.77, 3.21}, {1.5, 9.2}, {2.05, 6.6}, {4.4, 4.4}, {8.1, 1.05}, {6.93, 6.07}});
  check_against_brute_force<3>(
      {{2.3, 1.6, 3.1}, {1.05, 1.5, 4.2}, {2.9, 2.9, 2.9}, {3.3, 1.1, 2.05}, {1.2, 1.2, 1.2}});
  check_against_brute_force<2>(random_boxes<2>(40, 6.0, 41));
  check_against_brute_force<3>(random_boxes<3>(40, 3.0, 42));
}

TEST_CASE("Lattice: the perfect hexagonal packing is found where the box is commensurate with it") {
  for (const bool turned : {false, true}) {
    Room<2> room{.box = {10.0 * 1.0000001, 10.0 * std::sqrt(0.75) * 1.0000001}};
    if (turned) std::swap(room.box.x(), room.box.y());
    CHECK(lattice_capacity(room) == 100);
    const auto sites = face_centred_lattice(room, 100);
    REQUIRE(sites.size() == 100);
    CHECK(least_distance(room, sites) == doctest::Approx(1.0000001).epsilon(1e-12));
  }
}

TEST_CASE("Lattice: the fcc packing is found where the box is commensurate with it") {
  // Cubes with four spheres each; the densest packing fills pi/sqrt(18) = .7405.
  for (const Vec<3>& cubes : {Vec<3>(3, 3, 3), Vec<3>(2, 4, 3), Vec<3>(1, 1, 5), Vec<3>(4, 1, 2)}) {
    CAPTURE(cubes.transpose());
    const Room<3> room{.box = std::sqrt(2.0) * 1.0000001 * cubes};
    const int count = static_cast<int>(4.0 * cubes.prod());
    CHECK(packing_fraction(3, count / room.box.prod()) == doctest::Approx(0.7405).epsilon(1e-4));
    CHECK(lattice_capacity(room) == count);
    const auto sites = face_centred_lattice(room, count);
    REQUIRE(static_cast<int>(sites.size()) == count);
    CHECK(least_distance(room, sites) == doctest::Approx(1.0000001).epsilon(1e-12));
  }
}

TEST_CASE("Lattice: sites are spread as far apart as the lattice allows") {
  CHECK(least_distance({.box = {10.0, 10.0}}, primitive_lattice<2>({.box = {10.0, 10.0}}, 25)) ==
        doctest::Approx(2.0));
  const Room<2> walled{.box = {9.0, 5.0}, .walled = {true, true}};
  CHECK(least_distance(walled, primitive_lattice(walled, 15)) == doctest::Approx(2.0));
  // Four corners and the centre.
  const Room<2> square{.box = {5.0, 5.0}, .walled = {true, true}};
  CHECK(least_distance(square, face_centred_lattice(square, 5)) == doctest::Approx(std::sqrt(8.0)));

  const Room<3> block{.box = {9.0, 5.0, 6.0}, .walled = {true, true, false}};
  CHECK(least_distance(block, primitive_lattice(block, 45)) == doctest::Approx(2.0));
  // Eight corners and the middles of six faces.
  const Room<3> cube{.box = {5.0, 5.0, 5.0}, .walled = {true, true, true}};
  CHECK(least_distance(cube, face_centred_lattice(cube, 14)) == doctest::Approx(std::sqrt(8.0)));
}

TEST_CASE(
    "Lattice: particles that would touch exactly do not fit, for rounding would make some "
    "overlap") {
  check_touching<2>();
  check_touching<3>();
}

TEST_CASE("Lattice: rooms of any size have a capacity") {
  CHECK(lattice_capacity<2>({.box = {1e6, 1e6}}) == INT_MAX);
  CHECK(lattice_capacity<2>({.box = {1e300, 1e300}}) == INT_MAX);
  CHECK(lattice_capacity<2>({.box = {1e6, 1.5}, .walled = {true, true}}) == 1'154'700);
  CHECK(lattice_capacity<2>({.box = {1.5, 1e6}, .walled = {true, true}}) == 1'154'700);
  // Two staggered rows 0.75 apart, sites 2 sqrt(1 - 0.75^2) apart along each.
  CHECK(lattice_capacity<2>({.box = {1e9, 1.5}}) == doctest::Approx(2e9 / (2 * std::sqrt(0.4375))));
  CHECK(lattice_capacity<2>({.box = {1e12, 2.0}}) == INT_MAX);
  CHECK(lattice_capacity<2>({.box = {0.5, 9.0}, .walled = {true, true}}) == 0);

  CHECK(lattice_capacity<3>({.box = {1e6, 1e6, 1e6}}) == INT_MAX);
  CHECK(lattice_capacity<3>({.box = {1e300, 1e300, 1e300}}) == INT_MAX);
  CHECK(lattice_capacity<3>({.box = {1e6, 1.2, 1e6}}) == INT_MAX);
  // A zigzag in the plane of the two longer edges.
  CHECK(lattice_capacity<3>({.box = {1e6, 1.5, 1.2}, .walled = {true, true, true}}) == 1'154'700);
  CHECK(lattice_capacity<3>({.box = {1.2, 1e6, 1.5}, .walled = {true, true, true}}) == 1'154'700);
  CHECK(lattice_capacity<3>({.box = {1.5, 1.2, 1e6}, .walled = {true, true, true}}) == 1'154'700);
  // Pairs of sites in squares of 1.5, each turned from the next, sqrt(1 - 0.75^2) apart.
  CHECK(lattice_capacity<3>({.box = {1.5, 1.5, 1e8}}) == doctest::Approx(2e8 / std::sqrt(0.4375)));
  CHECK(lattice_capacity<3>({.box = {9.0, 0.5, 9.0}, .walled = {true, true, true}}) == 0);
}

TEST_CASE("Lattice: ten million sites are laid out") {
  CHECK(face_centred_lattice<2>({.box = {3500.0, 3500.0}}, 10'000'000).size() >= 10'000'000);
  CHECK(face_centred_lattice<3>({.box = {200.0, 200.0, 200.0}}, 10'000'000).size() >= 10'000'000);
}
