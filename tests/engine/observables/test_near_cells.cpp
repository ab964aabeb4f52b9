#include <doctest/doctest.h>

#include <algorithm>
#include <tuple>
#include <vector>

#include "engine/observables/near_cells.h"
#include "engine/physics/random.h"
#include "tests/engine/observables/observed.h"
#include "tests/engine/support/models.h"

using namespace clatter;
using namespace clatter::testing;

namespace {

template <int D>
std::vector<Vec<D>> random_positions(const Model<D>& model, std::uint32_t count) {
  std::vector<Vec<D>> positions;
  for (std::uint32_t i = 0; i < count; ++i) {
    Random random(1, Stream::Placement, i, 0);
    Vec<D> position;
    for (int axis = 0; axis < D; ++axis) position[axis] = random.uniform() * model.box[axis];
    positions.push_back(position);
  }
  return positions;
}

}  // namespace

// Boxes with many cells along some axes and few along others, with periodic axes and walls.
TEST_CASE_TEMPLATE("Near cells: each pair within the range is visited once", Dimension, Plane,
                   Space) {
  constexpr int D = Dimension::value;
  for (const double width : {3.1, 9.0, 400.0}) {
    for (const bool walls : {false, true}) {
      CAPTURE(width);
      CAPTURE(walls);
      VecX box = VecX::Constant(D, 7.0);
      box[0] = width;
      Scene scene = gas(box, 8, 1.0);
      if (walls) wall_in(scene, 1, {.kind = WallKind::Static});
      const Model<D> model = model_of<D>(scene, 1);
      const std::vector<Vec<D>> positions = random_positions<D>(model, 90);
      NearCells<D> cells(model, positions.size(), 2.3);
      const double range = std::min(2.3, 0.5 * width);
      CHECK(cells.range() == range);
      cells.sort(positions, model.domain());
      CHECK(cells.cells() <= 4 * positions.size() + 1);

      using Pair = std::tuple<std::uint32_t, std::uint32_t>;
      std::vector<Pair> expected, visited;
      for (std::uint32_t i = 0; i < positions.size(); ++i) {
        for (std::uint32_t j = 0; j < i; ++j) {
          const Vec<D> apart = nearest_image<D>(model, positions[i] - positions[j]);
          if (apart.norm() <= range) expected.emplace_back(j, i);
        }
      }
      cells.each_pair([&](std::uint32_t first, std::uint32_t second, const Vec<D>& separation) {
        visited.emplace_back(std::minmax(first, second));
        Vec<D> apart = positions[first] - positions[second] - separation;
        for (int axis = 0; axis < D; ++axis) {
          const double periods = apart[axis] / model.box[axis];
          CHECK(periods == doctest::Approx(std::round(periods)));
        }
      });
      std::ranges::sort(expected);
      std::ranges::sort(visited);
      CHECK(expected.size() > 5);
      CHECK(visited == expected);
    }
  }
}

// A sheared box at many offsets, against all images of all pairs.
TEST_CASE_TEMPLATE("Near cells: each pair through images that slide is visited once", Dimension,
                   Plane, Space) {
  constexpr int D = Dimension::value;
  for (const double width : {3.1, 9.0, 400.0}) {
    for (const double offset : {0.0, 0.3, -1.4, 3.0, 4.6, 1234.5}) {
      CAPTURE(width);
      CAPTURE(offset);
      VecX box = VecX::Constant(D, 7.0);
      box[0] = width;
      const Model<D> model = sheared(periodic_box<D>(box), 1.0);
      Domain<D> domain = model.domain();
      domain.offset = offset;
      const std::vector<Vec<D>> positions = random_positions<D>(model, 90);
      const double range = std::min(2.3, 0.5 * width);
      NearCells<D> cells(model, positions.size(), range);
      cells.sort(positions, domain);

      using Pair = std::tuple<std::uint32_t, std::uint32_t, double>;
      std::vector<Pair> expected, visited;
      const auto note = [&](std::vector<Pair>& pairs, std::uint32_t first, std::uint32_t second,
                            double distance) {
        const auto [low, high] = std::minmax(first, second);
        pairs.emplace_back(low, high, std::round(1e9 * distance));
      };
      for (std::uint32_t i = 0; i < positions.size(); ++i) {
        for (std::uint32_t j = 0; j < i; ++j) {
          for (const double up : {-1.0, 0.0, 1.0}) {
            Vec<D> apart = positions[i] - positions[j];
            apart[0] -= up * offset;
            apart[1] -= up * 7.0;
            apart[0] -= width * std::round(apart[0] / width);
            if (D == 3) apart[D - 1] -= 7.0 * std::round(apart[D - 1] / 7.0);
            if (apart.norm() <= range) note(expected, i, j, apart.norm());
          }
        }
      }
      cells.each_pair([&](std::uint32_t first, std::uint32_t second, const Vec<D>& apart) {
        note(visited, first, second, apart.norm());
      });
      std::ranges::sort(expected);
      std::ranges::sort(visited);
      CHECK(expected.size() > 5);
      CHECK(visited == expected);
    }
  }
}
