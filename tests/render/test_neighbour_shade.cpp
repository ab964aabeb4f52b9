#include <doctest/doctest.h>

#include <cmath>
#include <cstdint>
#include <numeric>
#include <vector>

#include "render/neighbour_shade.h"

namespace clatter {

namespace {

/// The covered share of the sky as the shader computes it.
double covered(const NeighbourShade& shade, const Eigen::Vector3f& n) {
  const double across =
      shade.squares.dot(n.cwiseProduct(n)) +
      2.0 * shade.products.dot(Eigen::Vector3f(n.x() * n.y(), n.x() * n.z(), n.y() * n.z()));
  return 3.0 / 32.0 * shade.weight + 0.5 * shade.direction.dot(n) + 15.0 / 32.0 * across;
}

std::vector<NeighbourShade> all_shades(const std::vector<Vec<3>>& centres) {
  std::vector<std::uint32_t> all(centres.size());
  std::iota(all.begin(), all.end(), 0u);
  return neighbour_shades(centres, std::vector{0.5}, all);
}

}  // namespace

TEST_CASE("Neighbour shade: one that touches covers w max(0, cos) within 0.1 w") {
  // The expansion to second order of max(0, cos) differs from it by 3/32 at most. At a distance of
  // one diameter w = 1/2.
  const Vec<3> u = Vec<3>(1.0, -2.0, 2.0) / 3.0;
  const NeighbourShade shade = all_shades({{5.0, 5.0, 5.0}, Vec<3>(5.0, 5.0, 5.0) + u})[0];
  for (const Vec<3>& n :
       {u, Vec<3>(-u), Vec<3>(0.0, 0.7071068, 0.7071068), Vec<3>(1.0, 0.0, 0.0)}) {
    CHECK(std::fabs(covered(shade, n.cast<float>()) - 0.5 * std::max(0.0, n.dot(u))) < 0.05);
  }
}

TEST_CASE("Neighbour shade: all neighbours within 1.75 diameters count, and no others") {
  // Random places in a box, compared with all pairs. Seeds of a linear congruential generator.
  std::vector<Vec<3>> centres;
  std::uint32_t state = 20240611;
  const auto random = [&] { return (state = 1664525u * state + 1013904223u) / 4294967296.0; };
  for (int k = 0; k < 300; ++k)
    centres.emplace_back(8.0 * random(), 3.0 * random(), 5.0 * random());
  const std::vector<NeighbourShade> shades = all_shades(centres);
  for (std::size_t i = 0; i < centres.size(); ++i) {
    double weight = 0.0;
    Vec<3> direction = Vec<3>::Zero();
    for (std::size_t j = 0; j < centres.size(); ++j) {
      const Vec<3> offset = centres[j] - centres[i];
      const double distance = offset.norm();
      if (i == j || distance >= 1.75) continue;
      const double w = 0.5 / (distance * distance) * std::min(1.0, 4.0 * (1.0 - distance / 1.75));
      weight += w;
      direction += w / distance * offset;
    }
    CHECK(shades[i].weight == doctest::Approx(weight).epsilon(1e-5));
    CHECK((shades[i].direction.cast<double>() - direction).norm() < 1e-4 * (1.0 + weight));
    CHECK(shades[i].squares.sum() == doctest::Approx(weight).epsilon(1e-5));
  }
}

TEST_CASE("Neighbour shade: unequal spheres count by their own radius, up to the same gap") {
  // Random places and radii of four sizes, compared with all pairs.
  std::vector<Vec<3>> centres;
  std::vector<double> radii;
  std::uint32_t state = 20240716;
  const auto random = [&] { return (state = 1664525u * state + 1013904223u) / 4294967296.0; };
  for (int k = 0; k < 300; ++k) {
    centres.emplace_back(8.0 * random(), 3.0 * random(), 5.0 * random());
    radii.push_back(std::vector{0.1, 0.12, 0.7, 2.0}[static_cast<std::size_t>(k % 17) % 4]);
  }
  std::vector<std::uint32_t> all(centres.size());
  std::iota(all.begin(), all.end(), 0u);
  const std::vector<NeighbourShade> shades = neighbour_shades(centres, radii, all);
  for (std::size_t i = 0; i < centres.size(); ++i) {
    double weight = 0.0;
    Vec<3> direction = Vec<3>::Zero();
    for (std::size_t j = 0; j < centres.size(); ++j) {
      const Vec<3> offset = centres[j] - centres[i];
      const double distance = offset.norm(), gap = distance - radii[i] - radii[j];
      // Of equal spheres at a distance of 1.75 diameters the gap is 1.5 radii.
      if (i == j || gap >= 1.5 * radii[j]) continue;
      const double fade = std::min(1.0, 4.0 * (1.0 - (gap / radii[j] + 2.0) / 3.5));
      const double factor = 1.0 + std::min(1.0, radii[i] / radii[j]);
      const double w = fade * factor * std::pow(radii[j] / distance, 2);
      weight += w;
      direction += w / distance * offset;
    }
    CHECK(shades[i].weight == doctest::Approx(weight).epsilon(1e-5));
    CHECK((shades[i].direction.cast<double>() - direction).norm() < 1e-4 * (1.0 + weight));
  }
}

TEST_CASE(
    "Neighbour shade: a large one that touches covers the sky, a small one hardly any of it") {
  const std::vector<Vec<3>> centres = {{0.0, 0.0, 0.0}, {5.5, 0.0, 0.0}};
  const std::vector<double> radii = {0.5, 5.0};
  const std::vector<NeighbourShade> shades =
      neighbour_shades(centres, radii, std::vector<std::uint32_t>{0, 1});
  CHECK(shades[0].weight == doctest::Approx(1.1 * 25.0 / (5.5 * 5.5)));
  CHECK(shades[1].weight == doctest::Approx(2.0 * 0.25 / (5.5 * 5.5)));
}

}  // namespace clatter
