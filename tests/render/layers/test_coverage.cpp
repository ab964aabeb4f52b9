#include <doctest/doctest.h>

#include <cmath>
#include <random>

#include "render/layers/coverage.h"

namespace clatter {

namespace {

constexpr Size kCoverageSize{40, 30};

Eigen::Array4d total(const Coverage& coverage) {
  Eigen::Array4d sum = Eigen::Array4d::Zero();
  for (const Eigen::Array4f& pixel : coverage.pixels()) sum += pixel.cast<double>();
  return sum;
}

}  // namespace

TEST_CASE("Coverage: small disks keep their area and their light, wherever they are") {
  std::mt19937 random(5);
  std::uniform_real_distribution<double> x(-2.0, 42.0), y(-2.0, 32.0);
  std::uniform_int_distribution<int> channel(0, 255);
  Coverage coverage;
  for (const double radius : {0.01, 0.3, 0.5, 0.7, 1.1, 1.499}) {
    CAPTURE(radius);
    const double area = M_PI * radius * radius;
    coverage.restart(kCoverageSize, radius);
    Eigen::Array4d expected = Eigen::Array4d::Zero();
    for (int i = 0; i < 500; ++i) {
      const auto any = [&] { return static_cast<std::uint8_t>(channel(random)); };
      const Colour colour{any(), any(), any()};
      coverage.add({x(random), y(random)}, colour);
      expected += area * Eigen::Array4d(linear_light(colour.red), linear_light(colour.green),
                                        linear_light(colour.blue), 1.0);
    }
    coverage.sum();
    for (int k = 0; k < 4; ++k) {
      CHECK(total(coverage)[k] == doctest::Approx(expected[k]).epsilon(1e-5));
    }
  }
}

namespace {

// The area of a disk inside the pixel at (x, y), by 50 x 50 points.
double area_in(int x, int y, const Vec2& centre, double radius) {
  constexpr int kPoints = 50;
  int inside = 0;
  for (int j = 0; j < kPoints; ++j) {
    for (int i = 0; i < kPoints; ++i) {
      const Vec2 place(x + (i + 0.5) / kPoints, y + (j + 0.5) / kPoints);
      inside += (place - centre).norm() < radius;
    }
  }
  return static_cast<double>(inside) / (kPoints * kPoints);
}

}  // namespace

TEST_CASE("Coverage: the coverage of a pixel is its overlap with a small disk") {
  Coverage coverage;
  const int width = kCoverageSize.width + 2 * Coverage::kMargin;
  for (const double radius : {0.3, 1.2, 1.49}) {
    for (const Vec2& centre : {Vec2(7.0, 9.0), Vec2(7.5, 9.5), Vec2(20.31, 11.87)}) {
      coverage.restart(kCoverageSize, radius);
      coverage.add(centre, {255, 255, 255});
      coverage.sum();
      double worst = 0.0;
      for (int y = 0; y < kCoverageSize.height; ++y) {
        for (int x = 0; x < kCoverageSize.width; ++x) {
          const double area =
              coverage.pixels()[(y + Coverage::kMargin) * width + x + Coverage::kMargin][3];
          worst = std::max(worst, std::abs(area - area_in(x, y, centre, radius)));
        }
      }
      // Positions have a resolution of 1/16 pixel, so that an edge has an error of up to 0.045.
      CHECK(worst < 0.07);
    }
  }
}

TEST_CASE("Coverage: a picture without disks has no light, also after one with disks") {
  Coverage coverage;
  coverage.restart(kCoverageSize, 0.5);
  coverage.add({3.0, 3.0}, {255, 255, 255});
  coverage.sum();
  CHECK(total(coverage)[3] > 0.0);
  coverage.restart(kCoverageSize, 0.5);
  coverage.sum();
  CHECK(total(coverage).isZero());
}

TEST_CASE("Coverage: smaller disks of a picture have their own areas and places") {
  Coverage coverage;
  const int width = kCoverageSize.width + 2 * Coverage::kMargin;
  for (const double relative : {1.0, 0.9375, 0.7, 0.34, 0.05}) {
    CAPTURE(relative);
    const Vec2 centre(20.31, 11.87);
    coverage.restart(kCoverageSize, 1.49);
    coverage.add(centre, {255, 255, 255}, 1.0f, relative);
    coverage.sum();
    const double radius = 1.49 * relative;
    CHECK(total(coverage)[3] == doctest::Approx(M_PI * radius * radius).epsilon(1e-5));
    double worst = 0.0;
    for (int y = 0; y < kCoverageSize.height; ++y) {
      for (int x = 0; x < kCoverageSize.width; ++x) {
        const double area =
            coverage.pixels()[(y + Coverage::kMargin) * width + x + Coverage::kMargin][3];
        worst = std::max(worst, std::abs(area - area_in(x, y, centre, radius)));
      }
    }
    // Radii have a resolution of 1/32 of the largest.
    CHECK(worst < 0.1);
  }
}

}  // namespace clatter
