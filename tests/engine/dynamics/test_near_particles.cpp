#include <doctest/doctest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <vector>

#include "engine/dynamics/near_particles.h"
#include "engine/physics/random.h"
#include "tests/support/dimensions.h"

namespace clatter {

namespace {

template <int D>
Vec<D> random_point(const Vec<D>& low, const Vec<D>& extent, Random& random) {
  Vec<D> point;
  for (int axis = 0; axis < D; ++axis) point[axis] = low[axis] + extent[axis] * random.uniform();
  return point;
}

// The distances below the range from a point to particles and their images, sorted. All images in
// the box and next to it are compared.
template <int D>
std::vector<double> distances_by_hand(const Domain<D>& domain, const std::vector<Vec<D>>& particles,
                                      const Vec<D>& point, double range) {
  std::vector<double> distances;
  for (const Vec<D>& particle : particles) {
    for (int code = 0; code < (D == 2 ? 9 : 27); ++code) {
      Vec<D> way = particle - point;
      bool exists = true;
      for (int axis = 0, rest = code; axis < D; ++axis, rest /= 3) {
        const int image = rest % 3 - 1;
        exists = exists && (image == 0 || domain.periodic[static_cast<std::size_t>(axis)]);
        way[axis] += image * domain.box[axis];
      }
      if (exists && way.norm() < range) distances.push_back(way.norm());
    }
  }
  std::ranges::sort(distances);
  return distances;
}

}  // namespace

TEST_CASE_TEMPLATE("Near particles: all within the range are found once, by walls and images",
                   Dimension, testing::Plane, testing::Space) {
  constexpr int D = Dimension::value;
  Random random(7, Stream::Placement, 0, 0);
  // Boxes of one, two, and more cells along an axis.
  for (const double first : {1.3, 2.5, 9.0}) {
    for (const bool periodic : {true, false}) {
      CAPTURE(first);
      CAPTURE(periodic);
      Domain<D> domain;
      domain.box = Vec<D>::Constant(6.0);
      domain.box[0] = first;
      domain.periodic.fill(periodic);
      domain.periodic[1] = !periodic;
      NearParticles<D> near(domain, 1.25);
      for (int k = 0; k < 200; ++k) near.add(random_point<D>(Vec<D>::Zero(), domain.box, random));
      for (int k = 0; k < 100; ++k) {
        const Vec<D> point = random_point<D>(Vec<D>::Zero(), domain.box, random);
        const std::vector<double> expected =
            distances_by_hand<D>(domain, near.positions(), point, 1.25);
        std::vector<double> found;
        near.visit(point, [&](std::uint32_t, const Vec<D>& way) {
          if (way.norm() < 1.25) found.push_back(way.norm());
        });
        std::ranges::sort(found);
        REQUIRE(found.size() == expected.size());
        for (std::size_t i = 0; i < found.size(); ++i) {
          CHECK(found[i] == doctest::Approx(expected[i]).epsilon(1e-12));
        }
        const double nearest = expected.empty() ? 2.0 : expected.front();
        CHECK(near.any_within(point, 0.6) == (nearest < 0.6));
      }
    }
  }
}

// Cells that follow the mean density would have all particles of the cluster in one.
TEST_CASE("Near particles: a search in a dense cluster of a large box visits few particles") {
  constexpr double kSide = 50.0;
  Domain<2> domain{.box = Vec2::Constant(1e6), .periodic = {true, true}};
  NearParticles<2> near(domain, 1.0);
  Random random(8, Stream::Placement, 0, 0);
  for (int k = 0; k < 2500; ++k)
    near.add(random_point<2>(Vec2::Constant(4e5), Vec2::Constant(kSide), random));
  int visits = 0;
  for (const Vec2& point : near.positions()) {
    near.visit(point, [&](std::uint32_t, const Vec2&) { ++visits; });
  }
  // Nine cells of 1.01^2 have nine particles and the searched one on average.
  CHECK(visits < 2500 * 12);
}

}  // namespace clatter
