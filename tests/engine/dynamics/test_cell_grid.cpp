#include <doctest/doctest.h>

#include <algorithm>
#include <limits>
#include <set>
#include <tuple>
#include <vector>

#include "engine/dynamics/cell_grid.h"
#include "engine/physics/random.h"
#include "tests/engine/support/gas.h"

using namespace clatter;
using namespace clatter::testing;

namespace {

std::vector<std::uint32_t> contents(const CellGrid<2>& grid, const IntVec<2>& cell) {
  std::vector<std::uint32_t> disks;
  CellGrid<2>::Stencil itself;
  itself.from.setZero();
  itself.to.setZero();
  grid.visit(cell, itself, [&](const auto& line, const Vec2*) {
    disks.insert(disks.end(), line.disks.begin(), line.disks.begin() + line.count);
  });
  std::sort(disks.begin(), disks.end());
  return disks;
}

// A box from wide to narrower than two diameters, with either pair of sides walled or periodic.
Model<2> random_box(Random& random) {
  constexpr double kEdges[] = {1.001, 1.2, 2.0, 2.05, 2.1, 2.2, 3.15, 3.2, 4.0, 7.3};
  Model<2> model;
  for (int axis = 0; axis < 2; ++axis) {
    model.box[axis] = random.below(3) == 0 ? 1.0 + 11.0 * random.uniform()
                                           : kEdges[random.below(std::size(kEdges))];
    if (random.below(2)) model = with_walls(model, axis, Wall{});
  }
  return model;
}

// A place in the box; one in four lies on a corner of a cell or of the box.
Vec2 random_place(const Model<2>& model, const CellGrid<2>& grid, Random& random) {
  Vec2 r;
  for (int axis = 0; axis < 2; ++axis) {
    r[axis] = model.box[axis] * random.uniform();
    if (random.below(4) == 0) {
      const double border =
          grid.border(axis, static_cast<int>(random.below(grid.counts()[axis] + 1)));
      r[axis] = std::clamp(border, 0.0, model.box[axis]);
    }
    if (!model.periodic(axis)) {
      r[axis] = std::clamp(r[axis], model.wall_plane(axis, 0), model.wall_plane(axis, 1));
    }
  }
  return r;
}

using Image = std::tuple<std::size_t, int, int>;  // disk, box lengths along x and y

}  // namespace

TEST_CASE("cell grid: a cell holds what was put into it and not taken out, chained or not") {
  CellGrid<2> grid(periodic_box(10.0, 10.0), 50);
  Random random(61, Stream::Placement, 0, 0);
  std::vector<std::uint32_t> inside;
  const IntVec<2> cell = {1, 2}, other = {2, 2};
  std::uint32_t next = 0;
  for (int i = 0; i < 5000; ++i) {
    // Fills to some 250 disks, 36 lines, and empties again.
    const bool fill = (i / 250) % 2 == 0;
    if (fill || inside.empty()) {
      grid.insert(next, cell);
      grid.insert(next + 100000, other);
      inside.push_back(next++);
    } else {
      const std::size_t at = random.below(inside.size());
      grid.remove(inside[at], cell);
      grid.remove(inside[at] + 100000, other);
      inside.erase(inside.begin() + static_cast<std::ptrdiff_t>(at));
    }
    REQUIRE(contents(grid, cell) == inside);
    REQUIRE(contents(grid, other).size() == inside.size());
  }
}

TEST_CASE("cell grid: crowding is how many disks share the cell of a disk") {
  CellGrid<2> grid(periodic_box(10.0, 10.0), 50);
  CHECK(grid.crowding() == 0.0);
  std::uint32_t next = 0;
  for (const auto& [cell, count] :
       {std::pair{IntVec<2>(1, 1), 1}, {IntVec<2>(2, 1), 3}, {IntVec<2>(0, 4), 20}}) {
    for (int i = 0; i < count; ++i) grid.insert(next++, cell);
  }
  CHECK(grid.crowding() == (1.0 + 9.0 + 400.0) / 24.0);
}

TEST_CASE("cell grid: every position lies in a cell, and between its borders") {
  Random random(62, Stream::Placement, 0, 0);
  for (int i = 0; i < 1000; ++i) {
    const Model<2> model = random_box(random);
    const CellGrid<2> grid(model, random.below(60));
    for (int axis = 0; axis < 2; ++axis) {
      const double beyond = model.periodic(axis) ? 0.0 : std::numeric_limits<double>::infinity();
      REQUIRE(grid.border(axis, 0) == -beyond);
      REQUIRE(grid.border(axis, grid.counts()[axis]) == model.box[axis] + beyond);
    }
    for (int k = 0; k < 50; ++k) {
      const Vec2 r = random_place(model, grid, random);
      const IntVec<2> cell = grid.cell_at(r);
      for (int axis = 0; axis < 2; ++axis) {
        REQUIRE(cell[axis] >= 0);
        REQUIRE(cell[axis] < grid.counts()[axis]);
        // On a border rounding may name the cell on either side.
        REQUIRE(r[axis] >= grid.border(axis, cell[axis]) - 1e-14);
        REQUIRE(r[axis] <= grid.border(axis, cell[axis] + 1) + 1e-14);
      }
    }
  }
}

TEST_CASE("cell grid: no image of a disk within one diameter is missed, and none comes twice") {
  Random random(63, Stream::Placement, 0, 0);
  for (int i = 0; i < 10000; ++i) {
    const Model<2> model = random_box(random);
    const std::size_t count = 2 + random.below(40);
    CellGrid<2> grid(model, count);
    std::vector<Vec2> r;
    for (std::size_t k = 0; k < count; ++k) {
      r.push_back(random_place(model, grid, random));
      grid.insert(static_cast<std::uint32_t>(k), grid.cell_at(r[k]));
    }
    for (std::size_t k = 0; k < count; ++k) {
      std::set<Image> visited;
      std::size_t visits = 0;
      grid.visit(grid.cell_at(r[k]), {}, [&](const auto& line, const Vec2* wrap) {
        const IntVec<2> image = wrap ? IntVec<2>(wrap->cast<int>()) : IntVec<2>(0, 0);
        for (std::uint32_t n = 0; n < line.count; ++n, ++visits) {
          visited.insert({line.disks[n], image.x(), image.y()});
        }
      });
      REQUIRE(visited.size() == visits);
      for (std::size_t j = 0; j < count; ++j) {
        for (int kx = -2; kx <= 2; ++kx) {
          for (int ky = -2; ky <= 2; ++ky) {
            if ((kx && !model.periodic(0)) || (ky && !model.periodic(1))) continue;
            const Vec2 x = r[k] - r[j] - Vec2(kx * model.box.x(), ky * model.box.y());
            if (x.norm() > 1.0) continue;
            INFO("box " << model.box.transpose() << " image " << kx << " " << ky);
            REQUIRE(visited.count({j, kx, ky}) == 1);
          }
        }
      }
    }
  }
}
