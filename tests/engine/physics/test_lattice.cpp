#include <doctest/doctest.h>

#include <algorithm>
#include <climits>
#include <cmath>

#include "tests/engine/support/rooms.h"

using namespace clatter;
using namespace clatter::testing;

namespace {

/// Rows of n sites and n or n - 1 in turn along `axis`, or of n each; `shift` moves every other row
/// by half a spacing.
std::vector<Vec2> rows_of(const Room<2>& room, int axis, int rows, int n, bool shift,
                          bool shorter) {
  std::vector<Vec2> sites;
  const int across = 1 - axis;
  const auto at = [&](int k, double i, double places) {
    if (!room.walled[k]) return i * room.box[k] / places;
    return places > 1.0 ? 0.5 * room.diameter + i * (room.box[k] - room.diameter) / (places - 1.0)
                        : 0.5 * room.box[k];
  };
  const double places = n + (shift && !shorter && room.walled[axis] ? 0.5 : 0.0);
  for (int row = 0; row < rows; ++row) {
    const bool odd = shift && row % 2 == 1;
    for (int i = 0; i < n - (odd && shorter ? 1 : 0); ++i) {
      Vec2 site;
      site[axis] = at(axis, i + (odd ? 0.5 : 0.0), places);
      site[across] = at(across, row, rows);
      sites.push_back(site);
    }
  }
  return sites;
}

/// The most particles over all these arrangements, by trying every one.
int brute_capacity(const Room<2>& room) {
  const int most = 2 * static_cast<int>(room.box.maxCoeff() / room.diameter) + 3;
  std::size_t best = 0;
  for (const int axis : {0, 1}) {
    for (int rows = 1; rows <= most; ++rows) {
      for (int n = 1; n <= most; ++n) {
        for (const bool shift : {false, true}) {
          for (const bool shorter : {false, true}) {
            if (shorter && (!shift || !room.walled[axis] || n == 1)) continue;
            if (shift && !room.walled[1 - axis] && rows % 2 == 1) continue;
            const auto sites = rows_of(room, axis, rows, n, shift, shorter);
            if (sites.size() <= best) continue;
            if (least_distance(room, sites, room.diameter) >= room.diameter) best = sites.size();
          }
        }
      }
    }
  }
  return static_cast<int>(best);
}

std::vector<Room<2>> rooms(std::initializer_list<Vec2> boxes) {
  std::vector<Room<2>> all;
  for (const Vec2& box : boxes) {
    for (const bool x : {false, true}) {
      for (const bool y : {false, true}) all.push_back({box, {x, y}, 1.0});
    }
  }
  return all;
}

}  // namespace

TEST_CASE("Lattice: there are enough sites, inside the room and never closer than a diameter") {
  const auto all =
      rooms({{20.0, 25.0}, {7.3, 7.3}, {1.2, 40.7}, {33.3, 1.9}, {11.0, 4.0}, {3.1, 2.7}});
  for (Room<2> room : all) {
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

TEST_CASE("Lattice: the capacity is that of the best arrangement, and one more is refused") {
  for (const Room<2>& room : rooms({{5.3, 6.1},
                                    {7.77, 3.21},
                                    {1.5, 9.2},
                                    {2.05, 6.6},
                                    {4.4, 4.4},
                                    {8.1, 1.05},
                                    {6.93, 6.07}})) {
    CAPTURE(room.box.transpose());
    CAPTURE(!room.walled[0]);
    CAPTURE(!room.walled[1]);
    const int capacity = lattice_capacity(room);
    CHECK(capacity == brute_capacity(room));
    CHECK(primitive_lattice(room, capacity + 1).empty());
    CHECK(face_centred_lattice(room, capacity + 1).empty());
  }
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

TEST_CASE("Lattice: sites are spread as far apart as the lattice allows") {
  CHECK(least_distance({.box = {10.0, 10.0}}, primitive_lattice<2>({.box = {10.0, 10.0}}, 25)) ==
        doctest::Approx(2.0));
  const Room<2> walled{.box = {9.0, 5.0}, .walled = {true, true}};
  CHECK(least_distance(walled, primitive_lattice(walled, 15)) == doctest::Approx(2.0));
  // Four corners and the centre.
  const Room<2> square{.box = {5.0, 5.0}, .walled = {true, true}};
  CHECK(least_distance(square, face_centred_lattice(square, 5)) == doctest::Approx(std::sqrt(8.0)));
}

TEST_CASE(
    "Lattice: particles that would touch exactly do not fit, for rounding would make some "
    "overlap") {
  const Room<2> row{.box = {50.0, 1.0}, .walled = {false, true}};
  CHECK(lattice_capacity(row) == 49);
  for (int n = 2; n < 400; ++n) {
    // The narrowest box that 0.1 n leaves for n particles of diameter 0.1, and one a little wider.
    for (const double width : {0.1 * n, 0.1 * n * (1.0 + 1e-15), 0.1 * n * (1.0 + 1e-13)}) {
      const Room<2> room{.box = {width, 0.15}, .diameter = 0.1};
      const auto sites = primitive_lattice(room, lattice_capacity(room));
      CHECK(least_distance(room, sites) >= room.diameter);
    }
  }
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
}

TEST_CASE("Lattice: ten million sites are laid out") {
  CHECK(face_centred_lattice<2>({.box = {3500.0, 3500.0}}, 10'000'000).size() >= 10'000'000);
}
