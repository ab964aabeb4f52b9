#include <doctest/doctest.h>

#include <algorithm>
#include <cmath>

#include "render/plane_map.h"

namespace clatter {

namespace {

// A map with one value at a cell, and another everywhere else.
PlaneMap spike(int x, int y, double value, double rest, bool periodic) {
  PlaneMap map{7, 6, {periodic, periodic}, std::vector<double>(42, rest)};
  map.values[static_cast<std::size_t>(7 * y + x)] = value;
  return map;
}

double at(const std::vector<double>& cells, int x, int y) {
  return cells[static_cast<std::size_t>(7 * y + x)];
}

}  // namespace

TEST_CASE("Plane map: a spike is spread with binomial weights") {
  const SmoothMap map = smoothed(spike(3, 2, 256.0, 0.0, true));
  CHECK(at(map.values, 3, 2) == 36.0);
  CHECK(at(map.values, 4, 2) == 24.0);
  CHECK(at(map.values, 3, 4) == 6.0);
  CHECK(at(map.values, 1, 0) == 1.0);
  CHECK(at(map.values, 0, 2) == 0.0);
  CHECK(std::ranges::count(map.shares, 1.0) == 42);
}

TEST_CASE("Plane map: periodic cells continue beyond the last, others are mirrored") {
  const SmoothMap periodic = smoothed(spike(0, 0, 256.0, 0.0, true));
  CHECK(at(periodic.values, 6, 0) == 24.0);
  CHECK(at(periodic.values, 0, 5) == 24.0);
  const SmoothMap mirrored = smoothed(spike(0, 0, 256.0, 0.0, false));
  // The mirrored spike beside it adds 4/16 to 6/16: (10/16)^2.
  CHECK(at(mirrored.values, 0, 0) == 100.0);
  CHECK(at(mirrored.values, 6, 0) == 0.0);
}

TEST_CASE("Plane map: cells without a value do not count") {
  const double none = std::nan("");
  const SmoothMap hole = smoothed(spike(3, 2, none, 5.0, true));
  CHECK(at(hole.values, 3, 2) == doctest::Approx(5.0));
  CHECK(at(hole.shares, 3, 2) == 1.0 - 36.0 / 256.0);
  const SmoothMap lone = smoothed(spike(3, 2, 5.0, none, true));
  CHECK(at(lone.values, 4, 2) == doctest::Approx(5.0));
  CHECK(at(lone.shares, 4, 2) == 24.0 / 256.0);
  CHECK(std::isnan(at(lone.values, 0, 2)));
  CHECK(at(lone.shares, 0, 2) == 0.0);
}

TEST_CASE("Plane map: one row or one cell stays as it is across") {
  CHECK(smoothed({1, 1, {true, false}, {3.0}}).values == std::vector{3.0});
  const SmoothMap row = smoothed({5, 1, {false, false}, {0.0, 0.0, 16.0, 0.0, 0.0}});
  CHECK(row.values == std::vector{1.0, 4.0, 6.0, 4.0, 1.0});
}

}  // namespace clatter
