#include <doctest/doctest.h>

#include <vector>

#include "engine/measure/field_grid.h"
#include "tests/engine/support/gas.h"

using namespace clatter;
using namespace clatter::testing;

namespace {

using Cell = FieldGrid<2>::Cell;

// Walls at the left and right of a box of 8 by 6, cells of 2 by 2.
const Model<2> kChannel = with_walls(periodic_box(8.0, 6.0), 0, Wall{});
const FieldGrid<2> kGrid(kChannel, {4, 3});

struct Step {
  double at;  ///< time, or share of a line
  int axis;
  int step;
};

void check_steps(const std::vector<Step>& steps, const std::vector<Step>& expected) {
  REQUIRE(steps.size() == expected.size());
  for (std::size_t k = 0; k < expected.size(); ++k) {
    CHECK(steps[k].at == doctest::Approx(expected[k].at));
    CHECK(steps[k].axis == expected[k].axis);
    CHECK(steps[k].step == expected[k].step);
  }
}

/// The borders that a flight crosses. Checks that the pieces in between are contiguous.
std::vector<Step> crossed(const Flight<2>& flight, Cell cell, double begin, double end,
                          const Vec2& gravity = Vec2::Zero()) {
  std::vector<Step> steps;
  double reached = begin;
  Cell in = cell;
  kGrid.walk(
      flight, gravity, cell, begin, end,
      [&](const Cell& piece, double from, double until) {
        CHECK(piece == in);
        CHECK(from == reached);
        reached = until;
      },
      [&](const Cell& left, double time, int axis, int step) {
        CHECK(left == in);
        CHECK(time == reached);
        in[axis] += step;
        steps.push_back({time, axis, step});
      });
  CHECK(reached == end);
  CHECK(cell == in);
  return steps;
}

/// The borders that a line crosses.
std::vector<Step> crossed(const Vec2& from, const Vec2& along, const Cell& first,
                          const Cell& last) {
  std::vector<Step> steps;
  double share = 0.0;
  kGrid.walk(
      from, along, first, last, [&](const Cell&, double length) { share += length; },
      [&](const Cell&, int axis, int step) {
        steps.push_back({share, axis, step});
      });
  CHECK(share == doctest::Approx(1.0));
  return steps;
}

}  // namespace

TEST_CASE("FieldGrid: cells by place and by index") {
  CHECK(kGrid.cell_at({0.1, 0.1}) == Cell{0, 0});
  CHECK(kGrid.cell_at({7.9, 5.9}) == Cell{3, 2});
  CHECK(kGrid.index_of(kGrid.cell_at({-1.0, -1.0})) == kGrid.index_of({0, 2}));
  CHECK(kGrid.index_of(kGrid.cell_at({11.0, 15.0})) == kGrid.index_of({3, 1}));
  CHECK(kGrid.index_of({3, 2}) == 11);
  for (std::size_t index = 0; index < 12; ++index) {
    CHECK(kGrid.index_of(kGrid.cell_of(index)) == index);
  }
}

TEST_CASE("FieldGrid: a cell has an image for each position, and one image between walls") {
  CHECK(kGrid.image_at({1, 1}, {3.0, 3.0 - 60.0}) == Cell{1, -29});
  CHECK(kGrid.image_at({1, -29}, {3.0, 3.0 + 6.0}) == Cell{1, 4});
  CHECK(kGrid.image_at({1, 1}, {30.0, 3.0}) == Cell{1, 1});
  // On a border too, the image is the near one.
  CHECK(kGrid.image_at({1, 2}, {3.0, 0.0}) == Cell{1, -1});
  CHECK(kGrid.image_at({1, 0}, {3.0, 6.0}) == Cell{1, 3});
}

TEST_CASE("FieldGrid: a cell contains its positions up to rounding") {
  CHECK(kGrid.contains({1, 1}, {2.0 - 1e-12, 4.0 + 1e-12}));
  CHECK(kGrid.contains({1, -29}, {3.0, 3.0 - 60.0}));
  CHECK_FALSE(kGrid.contains({1, 1}, {3.0, 3.0 - 60.0}));
  CHECK_FALSE(kGrid.contains({1, 1}, {1.99, 3.0}));
  CHECK_FALSE(kGrid.contains({1, 1}, {3.0, 4.01}));
  CHECK(kGrid.contains({-2, 1}, {-3.0, 3.0}));
}

TEST_CASE("FieldGrid: the borders on a flight, in order") {
  check_steps(crossed({{3.0, 3.0}, {1.0, 0.4}}, {1, 1}, 0.0, 3.5),
              {{1.0, 0, 1}, {2.5, 1, 1}, {3.0, 0, 1}});
  check_steps(crossed({{3.0, 63.0}, {-0.5, 0.8}}, {1, 31}, 0.25, 2.1),
              {{1.25, 1, 1}, {2.0, 0, -1}});
  // On a border, or beyond it by rounding: the outward crossing is immediate, the other border is
  // far.
  check_steps(crossed({{4.0 + 1e-15, 3.0}, {1.0, 0.0}}, {1, 1}, 0.0, 1.0), {{0.0, 0, 1}});
  check_steps(crossed({{4.0 + 1e-15, 3.0}, {-1.0, 0.0}}, {1, 1}, 0.0, 2.5), {{2.0, 0, -1}});
  // A border at the very end belongs to the next piece.
  check_steps(crossed({{3.0, 3.0}, {1.0, 0.0}}, {1, 1}, 0.0, 1.0), {});
  // Parabolas turn before the border ahead, or behind it.
  const Vec2 down(0.0, -1.0);
  check_steps(crossed({{3.0, 2.0}, {0.0, 1.0}}, {1, 1}, 0.0, 2.5, down), {{2.0, 1, -1}});
  check_steps(crossed({{3.0, 2.5}, {0.0, 2.0}}, {1, 1}, 0.0, 3.5, down),
              {{1.0, 1, 1}, {3.0, 1, -1}});
}

TEST_CASE("FieldGrid: the borders on a line, in order") {
  check_steps(crossed({1.0, 1.0}, {0.5, 0.5}, {0, 0}, {0, 0}), {});
  check_steps(crossed({1.0, 1.0}, {4.0, 2.0}, {0, 0}, {2, 1}),
              {{0.25, 0, 1}, {0.5, 1, 1}, {0.75, 0, 1}});
  check_steps(crossed({5.0, 1.0}, {-2.0, -4.0}, {2, 0}, {1, -2}),
              {{0.25, 1, -1}, {0.5, 0, -1}, {0.75, 1, -1}});
}

TEST_CASE("FieldGrid: a line ends in the cell that is given, on borders too") {
  check_steps(crossed({1.0, 1.0}, {1.0, 0.0}, {0, 0}, {0, 0}), {});
  check_steps(crossed({1.0, 1.0}, {1.0, 0.0}, {0, 0}, {1, 0}), {{1.0, 0, 1}});
  check_steps(crossed({2.0, 1.0}, {1.0, 0.0}, {0, 0}, {1, 0}), {{0.0, 0, 1}});
  check_steps(crossed({2.0, 1.0}, {0.0, 1.0}, {0, 0}, {1, 1}), {{0.0, 0, 1}, {1.0, 1, 1}});
  check_steps(crossed({1.0, 0.0}, {0.0, 1.0}, {0, -1}, {0, 0}), {{0.0, 1, 1}});
}
