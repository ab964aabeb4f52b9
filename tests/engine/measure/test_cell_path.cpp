#include <doctest/doctest.h>

#include <vector>

#include "engine/measure/cell_path.h"
#include "tests/engine/support/gas.h"

using namespace clatter;
using namespace clatter::testing;

namespace {

// Walls at the left and right of a box of 8 by 6, cells of 2 by 2.
const Model<2> kChannel = with_walls(periodic_box(8.0, 6.0), 0, Wall{});
const CellPath<2> kPath(kChannel, {4, 3});

struct Step {
  double at;
  int axis;
  int step;
};

void check_steps(const std::vector<FaceCrossing>& crossings, const std::vector<Step>& expected) {
  REQUIRE(crossings.size() == expected.size());
  for (std::size_t k = 0; k < expected.size(); ++k) {
    CHECK(crossings[k].at == doctest::Approx(expected[k].at));
    CHECK(crossings[k].axis == expected[k].axis);
    CHECK(crossings[k].step == expected[k].step);
  }
}

}  // namespace

TEST_CASE("CellPath: cells by place and by index") {
  CHECK(kPath.cell_at({0.1, 0.1}) == IntVec<2>(0, 0));
  CHECK(kPath.cell_at({7.9, 5.9}) == IntVec<2>(3, 2));
  CHECK(kPath.cell_at({-1.0, -1.0}) == IntVec<2>(0, 2));  // beyond the wall; round the box
  CHECK(kPath.cell_at({11.0, 15.0}) == IntVec<2>(3, 1));
  CHECK(kPath.index({3, 2}) == 11);
  for (std::size_t index = 0; index < 12; ++index) CHECK(kPath.index(kPath.cell(index)) == index);
  CHECK(kPath.beyond({1, 0}, 1, -1) == IntVec<2>(1, 2));
  CHECK(kPath.beyond({1, 2}, 1, 1) == IntVec<2>(1, 0));
}

TEST_CASE("CellPath: a cell holds what lies in it at any image, to within rounding") {
  CHECK(kPath.is_current({1, 1}, {2.0 - 1e-12, 4.0 + 1e-12}));
  CHECK(kPath.is_current({1, 1}, {3.0, 3.0 - 60.0}));
  CHECK_FALSE(kPath.is_current({1, 1}, {1.99, 3.0}));
  CHECK_FALSE(kPath.is_current({1, 1}, {3.0, 4.01}));
  CHECK(kPath.is_current({0, 1}, {-3.0, 3.0}));
  CHECK_FALSE(kPath.is_current({3, 1}, {-3.0, 3.0}));
}

TEST_CASE("CellPath: the next face of a flight") {
  const auto check = [](const CellPath<2>& path, const Flight<2>& flight, const IntVec<2>& cell,
                        double time, const Step& expected) {
    check_steps({path.next_crossing(flight, cell, time)}, {expected});
  };
  check(kPath, {{3.0, 3.0}, {1.0, 0.4}}, {1, 1}, 0.0, {1.0, 0, 1});
  check(kPath, {{3.0, 3.0 + 60.0}, {-0.5, 0.8}}, {1, 1}, 0.25, {1.25, 1, 1});
  check(kPath, {{5.0, 3.0}, {1.0, 0.0}}, {2, 1}, 0.0, {1.0, 0, 1});
  // On a face, or beyond by rounding: at once outwards, the far face inwards.
  check(kPath, {{4.0 + 1e-15, 3.0}, {1.0, 0.0}}, {1, 1}, 0.0, {0.0, 0, 1});
  check(kPath, {{4.0 + 1e-15, 3.0}, {-1.0, 0.0}}, {1, 1}, 0.0, {2.0, 0, -1});
  // Walls and the ends of the box are no faces.
  CHECK(kPath.next_crossing({{7.0, 3.0}, {1.0, 0.0}}, {3, 1}, 0.0).at == kNever);
  CHECK(kPath.next_crossing({{1.0, 3.0}, {-1.0, 0.0}}, {0, 1}, 0.0).at == kNever);
  const CellPath<2> single(kChannel, {1, 1});
  CHECK(single.next_crossing({{7.0, 3.0}, {1.0, 1.0}}, {0, 0}, 0.0).at == kNever);
  // A parabola that turns before the face ahead.
  const Model<2> falling = [] {
    Model<2> model = kChannel;
    model.gravity = {0.0, -1.0};
    return model;
  }();
  const CellPath<2> under_gravity(falling, {4, 3});
  check(under_gravity, {{3.0, 2.0}, {0.0, 1.0}}, {1, 1}, 0.0, {2.0, 1, -1});
  check(under_gravity, {{3.0, 2.5}, {0.0, 2.0}}, {1, 1}, 0.0, {1.0, 1, 1});
}

TEST_CASE("CellPath: the faces along a branch, in order") {
  check_steps(kPath.along({1.0, 1.0}, {0.5, 0.5}, {0, 0}, {0, 0}), {});
  check_steps(kPath.along({1.0, 1.0}, {4.0, 2.0}, {0, 0}, {2, 1}),
              {{0.25, 0, 1}, {0.5, 1, 1}, {0.75, 0, 1}});
  check_steps(kPath.along({5.0, 1.0}, {-2.0, -4.0}, {2, 0}, {1, 1}),
              {{0.25, 1, -1}, {0.5, 0, -1}, {0.75, 1, -1}});
  check_steps(kPath.along({5.0, 1.0 - 12.0}, {0.0, 4.0}, {2, 0}, {2, 2}),
              {{0.25, 1, 1}, {0.75, 1, 1}});
}

TEST_CASE("CellPath: a branch ends in the cell that it is told, on faces too") {
  check_steps(kPath.along({1.0, 1.0}, {1.0, 0.0}, {0, 0}, {0, 0}), {});
  check_steps(kPath.along({1.0, 1.0}, {1.0, 0.0}, {0, 0}, {1, 0}), {{1.0, 0, 1}});
  check_steps(kPath.along({2.0, 1.0}, {1.0, 0.0}, {0, 0}, {1, 0}), {{0.0, 0, 1}});
  check_steps(kPath.along({2.0, 1.0}, {0.0, 1.0}, {0, 0}, {1, 1}), {{0.0, 0, 1}, {1.0, 1, 1}});
  check_steps(kPath.along({1.0, 0.0}, {0.0, 1.0}, {0, 2}, {0, 0}), {{0.0, 1, 1}});
}
