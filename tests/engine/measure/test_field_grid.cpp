#include <doctest/doctest.h>

#include <cmath>
#include <random>
#include <vector>

#include "engine/measure/field_grid.h"
#include "engine/measure/gaussian_kernel.h"
#include "tests/engine/measure/scenes.h"
#include "tests/engine/support/models.h"

using namespace clatter;
using namespace clatter::testing;

namespace {

using Cell = FieldGrid<2>::Cell;

FieldGrid<2> grid_in(const Scene& scene, const IntVec<2>& cells) {
  return {model_of<2>(scene, 1), cells};
}

/// A box of 5 x 4, walled along x.
Scene half_walled() {
  Scene scene = gas(5.0, 4.0, 1, 1.0);
  wall_in(scene, 0, Wall{});
  return scene;
}

/// Cells of 2 by 2, between walls at the left and right.
const FieldGrid<2> kGrid(with_walls(periodic_box(8.0, 6.0), 0, Wall{}), {4, 3});

std::vector<double> shares_of(const FieldGrid<2>& grid, const Vec2& from, const Vec2& along) {
  std::vector<double> shares(grid.size());
  grid.cut(from, along, [&](std::size_t cell, double share) {
    CHECK(share >= 0.0);
    shares[cell] += share;
  });
  return shares;
}

double weight_at(const GaussianKernel<2>& kernel, std::size_t cell, const Vec2& place) {
  double sum = 0.0;
  kernel.at(place, [&](std::size_t index, double weight) { sum += index == cell ? weight : 0.0; });
  return sum;
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

TEST_CASE("FieldGrid: lines are cut as dense points on them fall") {
  const FieldGrid<2> grid = grid_in(half_walled(), {7, 6});
  std::mt19937 random(71);
  std::uniform_real_distribution<double> place(-3.0, 9.0), length(-4.0, 4.0);
  constexpr int kPoints = 20000;
  for (int line = 0; line < 50; ++line) {
    CAPTURE(line);
    const Vec2 from(place(random), place(random));
    const Vec2 along(line % 5 ? length(random) : 0.0, line % 7 ? length(random) : 0.0);
    const std::vector<double> shares = shares_of(grid, from, along);
    std::vector<double> dense(grid.size());
    for (int k = 0; k < kPoints; ++k) {
      Vec2 r = from + along * ((k + 0.5) / kPoints);
      r.y() -= 4.0 * std::floor(r.y() / 4.0);
      const long i = std::clamp(static_cast<long>(std::floor(r.x() / (5.0 / 7.0))), 0L, 6L);
      const long j = std::min(static_cast<long>(r.y() / (4.0 / 6.0)), 5L);
      dense[static_cast<std::size_t>(i + 7 * j)] += 1.0 / kPoints;
    }
    double sum = 0.0;
    for (std::size_t cell = 0; cell < shares.size(); ++cell) {
      // Each piece of a line in a cell is off by up to one point.
      CHECK(std::fabs(shares[cell] - dense[cell]) < 4.0 / kPoints);
      sum += shares[cell];
    }
    CHECK(sum == doctest::Approx(1.0).epsilon(1e-14));
  }
}

TEST_CASE("FieldGrid: lines that start, end and run on borders") {
  const FieldGrid<2> grid = grid_in(half_walled(), {5, 4});
  const auto share = [&](const Vec2& from, const Vec2& along, int i, int j) {
    return shares_of(grid, from, along)[static_cast<std::size_t>(i + 5 * j)];
  };
  CHECK(share({1.0, 1.5}, {1.0, 0.0}, 1, 1) == 1.0);
  CHECK(share({2.0, 1.5}, {-1.0, 0.0}, 1, 1) == 1.0);
  CHECK(share({1.0, 1.0}, {0.0, 1.0}, 1, 1) == 1.0);
  CHECK(share({1.5, 3.5}, {0.0, 1.0}, 1, 0) == 0.5);  // through the periodic border
  CHECK(share({0.5, 0.0}, {0.0, -1.0}, 0, 3) == 1.0);
  CHECK(share({0.25, 1.5}, {-1.0, 0.0}, 0, 1) == 1.0);  // beyond the wall
  CHECK(share({4.5, 1.5}, {1.0, 0.0}, 4, 1) == 1.0);
  CHECK(share({2.0, 2.0}, {0.0, 0.0}, 2, 2) == 1.0);
  // Through corners, along the diagonal.
  CHECK(share({0.0, 0.0}, {4.0, 4.0}, 2, 2) == 0.25);
}

TEST_CASE("GaussianKernel: normalised in a periodic box, cut off at walls") {
  for (const bool walled : {false, true}) {
    Scene scene = gas(5.0, 4.0, 1, 1.0);
    if (walled) wall_in(scene, 0, Wall{});
    const FieldGrid<2> grid = grid_in(scene, {10, 8});
    for (const double width : {0.5, 1.0, 3.0}) {
      const GaussianKernel<2> kernel(grid, width);
      double sum = 0.0;
      kernel.at({1.0, 3.7}, [&](std::size_t, double weight) { sum += weight; });
      CAPTURE(width);
      // The density between two walls from sums over centres: midpoints of smooth pieces.
      const auto below = [&](double x) {
        return 0.5 * std::erfc((1.0 - x) / width / std::sqrt(2.0));
      };
      const double inside = walled ? below(5.0) - below(0.0) : 1.0;
      CHECK(sum == doctest::Approx(inside).epsilon(walled ? 0.02 : 1e-7));
    }
  }
}

TEST_CASE("GaussianKernel: the density of images by hand") {
  const FieldGrid<2> grid = grid_in(gas(5.0, 4.0, 1, 1.0), {5, 4});
  const GaussianKernel<2> kernel(grid, 0.8);
  const Vec2 place(4.6, 0.3), centre(0.5, 3.5);
  double expected = 0.0;
  for (int i = -5; i <= 5; ++i) {
    for (int j = -5; j <= 5; ++j) {
      const Vec2 away = centre - place + Vec2(5.0 * i, 4.0 * j);
      expected += std::exp(-away.squaredNorm() / 1.28) / (2.0 * std::numbers::pi * 0.64);
    }
  }
  CHECK(weight_at(kernel, 15, place) == doctest::Approx(expected).epsilon(1e-7));
}

TEST_CASE("GaussianKernel: a line is the mean of its points") {
  const FieldGrid<2> grid = grid_in(half_walled(), {5, 4});
  const GaussianKernel<2> kernel(grid, 0.7);
  const Vec2 from(4.2, 3.5), along(0.6, 0.8);
  std::vector<double> line(grid.size()), points(grid.size());
  kernel.along(from, along, [&](std::size_t cell, double weight) { line[cell] += weight; });
  constexpr int kPoints = 2000;
  for (int k = 0; k < kPoints; ++k) {
    kernel.at(from + along * ((k + 0.5) / kPoints),
              [&](std::size_t cell, double weight) { points[cell] += weight / kPoints; });
  }
  for (std::size_t cell = 0; cell < line.size(); ++cell) {
    CHECK(std::fabs(line[cell] - points[cell]) < 1e-7);
  }
}
