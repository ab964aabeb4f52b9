#include <doctest/doctest.h>

#include <algorithm>
#include <cmath>
#include <optional>
#include <set>
#include <tuple>
#include <vector>

#include "engine/dynamics/cell_grid.h"
#include "engine/physics/random.h"
#include "tests/engine/support/gas.h"

using namespace clatter;
using namespace clatter::testing;

namespace {

using Image = std::tuple<std::uint32_t, int, int>;  // particle, box lengths along x and y

std::multiset<Image> near(const CellGrid<2>& grid, const IntVec<2>& cell) {
  std::multiset<Image> images;
  grid.visit(cell, [&](std::uint32_t particle, const Vec2& wrap) {
    images.insert({particle, static_cast<int>(wrap.x()), static_cast<int>(wrap.y())});
  });
  return images;
}

// Whether each list with a particle across a periodic border is marked.
bool wraps_are_told(const CellGrid<2>& grid, const IntVec<2>& cell) {
  for (NearListView list(grid.near(cell));; list = grid.continuations().next(list)) {
    for (int k = 0; k < list.count; ++k) {
      const Neighbour neighbour = list.neighbours[k];
      if (neighbour != particle_of<2>(neighbour) && !list.wraps) return false;
    }
    if (list.next == NearListView::kNone) return true;
  }
}

// A box of random size, down to less than two diameters, with walled or periodic pairs of sides.
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

// A position in the box. One in four is at a corner of a cell or of the box.
Vec2 random_place(const Model<2>& model, const CellGrid<2>& grid, Random& random) {
  Vec2 r;
  for (int axis = 0; axis < 2; ++axis) {
    r[axis] = model.box[axis] * random.uniform();
    if (random.below(4) == 0) {
      const int count = grid.counts()[axis];
      r[axis] = model.box[axis] / count * static_cast<double>(random.below(count + 1));
    }
    if (!model.periodic(axis)) {
      r[axis] = std::clamp(r[axis], model.wall_plane(axis, 0), model.wall_plane(axis, 1));
    }
  }
  return r;
}

// A particle in a grid: its cell, and its position in the frame of this cell.
struct Guest {
  IntVec<2> cell;
  Vec2 r;
};

bool belongs(const CellGrid<2>& grid, const Guest& guest) {
  bool within = true;
  for (int axis = 0; axis < 2; ++axis) {
    within = within && guest.r[axis] >= grid.border(axis, guest.cell[axis], false) &&
             guest.r[axis] <= grid.border(axis, guest.cell[axis], true);
  }
  return within;
}

// The particle after a step to a neighbouring cell; nothing if there is a wall.
std::optional<Guest> stepped(const Model<2>& model, const CellGrid<2>& grid, Guest guest, int axis,
                             int step) {
  const int next = guest.cell[axis] + step;
  const bool round = next < 0 || next == grid.counts()[axis];
  if (round && !model.periodic(axis)) return {};
  guest.cell = grid.neighbour(guest.cell, axis, step);
  if (round) guest.r[axis] -= step * model.box[axis];
  return guest;
}

// Moves a particle over at most `most` cell borders, as far as `may(there)` allows. Returns the
// number of crossed borders.
template <typename May>
int wander(const Model<2>& model, CellGrid<2>& grid, std::uint32_t particle, Guest& guest, int most,
           Random& random, const May& may, int reach = 1) {
  int crossed = 0;
  for (int k = 0; k < most; ++k) {
    const int axis = static_cast<int>(random.below(2)), step = random.below(2) ? 1 : -1;
    const auto next = stepped(model, grid, guest, axis, step);
    if (!next || !may(*next)) continue;
    grid.move(particle, guest.cell, axis, step, reach);
    guest = *next;
    ++crossed;
  }
  return crossed;
}

}  // namespace

TEST_CASE("CellGrid: a list holds the particles about its cell, however many") {
  CellGrid<2> grid(periodic_box(10.0, 10.0), 50.0);
  REQUIRE(grid.counts() == IntVec<2>(7, 7));
  Random random(61, Stream::Placement, 0, 0);
  std::multiset<Image> inside;
  const IntVec<2> cell = {1, 2}, beside = {2, 3}, off = {4, 2};
  std::uint32_t next = 0;
  for (int i = 0; i < 5000; ++i) {
    // Fills to some 250 particles, 18 lists, and empties again.
    const bool fill = (i / 250) % 2 == 0;
    if (fill || inside.empty()) {
      grid.insert(next, cell);
      grid.insert(next + 100000, off);
      inside.insert({next++, 0, 0});
    } else {
      const auto leaver = std::next(inside.begin(), static_cast<int>(random.below(inside.size())));
      grid.remove(std::get<0>(*leaver), cell);
      grid.remove(std::get<0>(*leaver) + 100000, off);
      inside.erase(leaver);
    }
    REQUIRE(near(grid, cell) == inside);
    REQUIRE(near(grid, beside) == inside);
    REQUIRE(near(grid, off).size() == inside.size());
    REQUIRE(grid.continuations().count(grid.near(cell)) == inside.size());
  }
}

TEST_CASE("CellGrid: a list marks particles across a periodic border") {
  CellGrid<2> grid(periodic_box(10.0, 10.0), 50.0);
  const IntVec<2> first = {0, 2}, last = {6, 2};
  // Particles beyond the border reuse the places of others.
  for (std::uint32_t particle = 0; particle < 20; ++particle) grid.insert(particle, first);
  for (std::uint32_t particle = 20; particle < 40; ++particle) grid.insert(particle, last);
  for (std::uint32_t particle = 0; particle < 20; ++particle) {
    grid.remove(particle, first);
    REQUIRE(wraps_are_told(grid, first));
  }
  CHECK(near(grid, first).count({39, -1, 0}) == 1);
}

TEST_CASE("CellGrid: a particle that moves is listed as if inserted there") {
  Random random(62, Stream::Placement, 1, 0);
  for (int i = 0; i < 300; ++i) {
    const Model<2> model = random_box(random);
    const std::uint32_t count = 1 + static_cast<std::uint32_t>(random.below(40));
    CellGrid<2> moved(model, count), put(model, count);
    std::vector<Guest> guests;
    for (std::uint32_t k = 0; k < count; ++k) {
      const Vec2 r = random_place(model, moved, random);
      guests.push_back({moved.cell_at(r), r});
      moved.insert(k, guests[k].cell);
      wander(model, moved, k, guests[k], 6, random, [](const Guest&) { return true; });
      put.insert(k, guests[k].cell);
    }
    for (int x = 0; x < moved.counts().x(); ++x) {
      for (int y = 0; y < moved.counts().y(); ++y) {
        REQUIRE(near(moved, {x, y}) == near(put, {x, y}));
        REQUIRE(wraps_are_told(moved, {x, y}));
      }
    }
  }
}

TEST_CASE("CellGrid: every position is in a cell, within its borders") {
  Random random(62, Stream::Placement, 0, 0);
  for (int i = 0; i < 1000; ++i) {
    const Model<2> model = random_box(random);
    const CellGrid<2> grid(model, static_cast<double>(random.below(60)));
    for (int axis = 0; axis < 2; ++axis) {
      const int last = grid.counts()[axis] - 1;
      REQUIRE(grid.border(axis, 0, false) <= 0.0);
      REQUIRE(grid.border(axis, last, true) >= model.box[axis]);
      REQUIRE(std::isfinite(grid.border(axis, 0, false)) == model.periodic(axis));
      REQUIRE(std::isfinite(grid.border(axis, last, true)) == model.periodic(axis));
    }
    for (int k = 0; k < 50; ++k) {
      const Vec2 r = random_place(model, grid, random);
      const IntVec<2> cell = grid.cell_at(r);
      for (int axis = 0; axis < 2; ++axis) {
        REQUIRE(cell[axis] >= 0);
        REQUIRE(cell[axis] < grid.counts()[axis]);
        // On a border, rounding decides the cell.
        REQUIRE(r[axis] >= grid.border(axis, cell[axis], false) - 1e-14);
        REQUIRE(r[axis] <= grid.border(axis, cell[axis], true) + 1e-14);
      }
    }
  }
}

TEST_CASE("CellGrid: every image within one diameter is found exactly once") {
  Random random(63, Stream::Placement, 0, 0);
  int overhanging = 0;
  for (int i = 0; i < 10000; ++i) {
    const Model<2> model = random_box(random);
    const std::uint32_t count = 2 + static_cast<std::uint32_t>(random.below(40));
    CellGrid<2> grid(model, count);
    std::vector<Guest> guests;
    for (std::uint32_t k = 0; k < count; ++k) {
      const Vec2 r = random_place(model, grid, random);
      guests.push_back({grid.cell_at(r), r});
      grid.insert(k, guests[k].cell);
      // Any cell that contains the particle within its borders is allowed.
      overhanging += wander(model, grid, k, guests[k], 4, random,
                            [&](const Guest& there) { return belongs(grid, there); });
    }
    for (std::uint32_t k = 0; k < count; ++k) {
      for (int axis = 0; axis < 2; ++axis) {
        if (model.periodic(axis)) continue;
        const double r = guests[k].r[axis];
        REQUIRE(r >= grid.distance_from_end(guests[k].cell, axis, false) - 1e-14);
        REQUIRE(model.box[axis] - r >= grid.distance_from_end(guests[k].cell, axis, true) - 1e-14);
      }
      const std::multiset<Image> visited = near(grid, guests[k].cell);
      REQUIRE(std::set<Image>(visited.begin(), visited.end()).size() == visited.size());
      for (std::uint32_t j = 0; j < count; ++j) {
        for (int kx = -2; kx <= 2; ++kx) {
          for (int ky = -2; ky <= 2; ++ky) {
            if ((kx && !model.periodic(0)) || (ky && !model.periodic(1))) continue;
            const Vec2 x = guests[k].r - guests[j].r - Vec2(kx * model.box.x(), ky * model.box.y());
            if (x.norm() > 1.0) continue;
            INFO("box " << model.box.transpose() << " image " << kx << " " << ky);
            REQUIRE(visited.count({j, kx, ky}) == 1);
          }
        }
      }
    }
  }
  CHECK(overhanging > 10000);
}

// The images that a particle of any reach finds.
static std::set<Image> found(const CellGrid<2>& grid, const IntVec<2>& cell, int reach) {
  if (reach == 1) {
    const std::multiset<Image> images = near(grid, cell);
    return {images.begin(), images.end()};
  }
  std::set<Image> images;
  grid.visit_wide(cell, reach, [&](const CellGrid<2>::List& list, const IntVec<2>& of_cell) {
    grid.continuations().visit(list, [&](std::uint32_t particle, const Vec2& wrap) {
      const IntVec<2> sum = wrap.cast<int>() + of_cell;
      images.insert({particle, sum.x(), sum.y()});
    });
  });
  return images;
}

TEST_CASE("CellGrid: every image within contact is found among particles of any sizes") {
  Random random(64, Stream::Placement, 0, 0);
  int wide = 0, overhanging = 0;
  for (int i = 0; i < 4000; ++i) {
    Model<2> model = random_box(random);
    if (random.below(2)) model.box *= 3.0;
    const std::uint32_t count = 2 + static_cast<std::uint32_t>(random.below(60));
    const double ratio = 1.0 + 15.0 * random.uniform();
    std::vector<double> diameters(count, 1.0);
    for (double& diameter : diameters) {
      const double between = random.uniform();
      diameter = std::pow(ratio, random.below(3) ? -1.0 : -between);
    }
    diameters.front() = 1.0;
    const double base = diameters[random.below(count)];
    CellGrid<2> grid(whole_box<2>(model), {base, 1.0}, 4.0 * count * random.uniform());
    std::vector<Guest> guests;
    for (std::uint32_t k = 0; k < count; ++k) {
      const Vec2 r = random_place(model, grid, random);
      const int reach = grid.reach_of(diameters[k]);
      guests.push_back({grid.cell_at(r), r});
      grid.insert(k, guests[k].cell, reach);
      wide += reach > 1;
      overhanging += wander(
          model, grid, k, guests[k], 4, random,
          [&](const Guest& there) { return belongs(grid, there); }, reach);
    }
    for (std::uint32_t k = 0; k < count; ++k) {
      const std::set<Image> images = found(grid, guests[k].cell, grid.reach_of(diameters[k]));
      for (std::uint32_t j = 0; j < count; ++j) {
        if (j == k) continue;
        for (int kx = -2; kx <= 2; ++kx) {
          for (int ky = -2; ky <= 2; ++ky) {
            if ((kx && !model.periodic(0)) || (ky && !model.periodic(1))) continue;
            const Vec2 x = guests[k].r - guests[j].r - Vec2(kx * model.box.x(), ky * model.box.y());
            if (x.norm() > 0.5 * (diameters[k] + diameters[j])) continue;
            INFO("box " << model.box.transpose() << " image " << kx << " " << ky);
            REQUIRE(images.count({j, kx, ky}) == 1);
          }
        }
      }
    }
  }
  CHECK(wide > 20000);
  CHECK(overhanging > 10000);
}

TEST_CASE("CellGrid: filled lists hold the same particles as lists of inserted particles") {
  Random random(41, Stream::Kick, 0, 0);
  for (int round = 0; round < 600; ++round) {
    const Model<2> model = random_box(random);
    // Up to two particles per cell on average: rows and lists of all lengths occur.
    CellGrid<2> filled(model, 1.0 + 80.0 * random.uniform()), inserted = filled;
    std::vector<IntVec<2>> cells;
    const int count = static_cast<int>(random.below(2 * filled.counts().prod() + 1));
    for (int i = 0; i < count; ++i) {
      cells.push_back(filled.cell_at(random_place(model, filled, random)));
    }
    std::vector<std::uint32_t> order;
    filled.fill(cells, order);
    REQUIRE(order.size() == cells.size());
    for (std::uint32_t k = 0; k < order.size(); ++k) inserted.insert(k, cells[order[k]]);
    for (const IntVec<2>& cell : cells) {
      CHECK(near(filled, cell) == near(inserted, cell));
      CHECK(wraps_are_told(filled, cell));
    }
  }
}
