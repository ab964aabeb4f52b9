#include <doctest/doctest.h>

#include <cmath>
#include <limits>

#include "render/colour_range.h"

namespace clatter {

TEST_CASE("Colour range: a robust extent ignores outliers, signs and NaNs") {
  std::vector<double> values(100, -1.0);
  values[7] = 1000.0;
  values[8] = std::nan("");
  CHECK(robust_extent(values) == 1.0);
  CHECK(robust_extent({}) == 0.0);
  CHECK(robust_extent({std::nan("")}) == 0.0);
}

TEST_CASE("Colour range: a robust extent is finite, whatever the values") {
  const double infinity = std::numeric_limits<double>::infinity();
  CHECK(robust_extent({infinity, 2.0, -infinity}) == 2.0);
  CHECK(robust_extent({infinity, -infinity}) == 0.0);
  SteadyExtent extent;
  CHECK(extent.follow(robust_extent({infinity})) == 1.0);
  for (const double value : {5e-324, 1e-300, 1e300}) {
    CAPTURE(value);
    const double end = SteadyExtent().follow(robust_extent({value}));
    CHECK(std::isfinite(end));
    CHECK(end >= value);
  }
}

TEST_CASE("Colour range: ranges end at round numbers") {
  CHECK(round_up(1.0) == doctest::Approx(1.0));
  CHECK(round_up(2.1) == doctest::Approx(3.0));
  CHECK(round_up(0.0083) == doctest::Approx(0.01));
  CHECK(round_up(130.0) == doctest::Approx(150.0));
}

TEST_CASE("Colour range: a steady extent moves only when it must") {
  SteadyExtent extent;
  CHECK(extent.follow(0.0) == 1.0);
  CHECK(extent.follow(1.9) == 2.0);
  CHECK(extent.follow(1.2) == 2.0);
  CHECK(extent.follow(2.05) == 2.0);
  CHECK(extent.follow(2.2) == 3.0);
  CHECK(extent.follow(1.6) == 3.0);
  CHECK(extent.follow(0.7) == doctest::Approx(0.8));
  CHECK(extent.follow(0.0) == doctest::Approx(0.8));
}

TEST_CASE("Colour range: a held extent stays as it was first seen") {
  SteadyExtent extent;
  CHECK(extent.follow(0.0, true) == 1.0);
  CHECK_FALSE(extent.held());  // no value yet
  CHECK(extent.follow(0.9) == 1.0);
  CHECK_FALSE(extent.held());
  CHECK(extent.follow(1.9, true) == 2.0);
  CHECK(extent.held());
  CHECK(extent.follow(50.0, true) == 2.0);
  CHECK(extent.follow(0.01, true) == 2.0);
  CHECK(extent.follow(50.0) == 50.0);
  CHECK_FALSE(extent.held());
}

TEST_CASE("Colour range: ticks are round and say no more digits than they need") {
  CHECK(round_ticks(0.0, 3.0, 4) == std::vector<double>{0, 1, 2, 3});
  CHECK(round_ticks(-2.0, 2.0, 5) == std::vector<double>{-2, -1, 0, 1, 2});
  // Steps of 5 would give the single tick 0.
  CHECK(round_ticks(-4.0, 4.0, 3) == std::vector<double>{-4, -2, 0, 2, 4});
  CHECK_FALSE(std::signbit(round_ticks(0.0, 3.0, 4).front()));
  // A range of two spacings of doubles.
  const std::vector<double> close = round_ticks(1e16, 1e16 + 4.0, 5);
  CHECK(close.size() > 1);
  CHECK(close.size() <= 12);
  CHECK(tick_text(0.4, 0.2) == "0.4");
  CHECK(tick_text(-2.0, 1.0) == "−2");
  CHECK(tick_text(3e-7, 1e-7) == "3×10⁻⁷");
  CHECK(tick_text(1.5e-16, 5e-17) == "1.5×10⁻¹⁶");
  CHECK(tick_text(0.0, 5e-17) == "0");
  CHECK(tick_text(0.0, 0.2) == "0.0");
}

TEST_CASE("Colour range: every range that a scene may have has two ticks or more") {
  const double roundings[] = {1.0, std::nextafter(1.0, 2.0)};
  const double least = ColourRange::kLeastWidth;
  const double ends[][2] = {
      {-1e300, 1e300},   {0.0, least}, {-1e-300, 1e300}, {1.3, 1.4}, {roundings[0], roundings[1]},
      {-7e299, -6.9e299}};
  for (const auto& [low, high] : ends) {
    for (const int count : {1, 2, 3, 5}) {
      CAPTURE(low);
      const std::vector<double> ticks = round_ticks(low, high, count);
      REQUIRE(ticks.size() > 1);
      CHECK(ticks.size() <= 2 * (5 + 8) + 1);
      const double slack = 1e-9 * (high - low);
      for (std::size_t i = 0; i < ticks.size(); ++i) {
        CHECK(ticks[i] >= low - slack);
        CHECK(ticks[i] <= high + slack);
        if (i > 0) CHECK(ticks[i] > ticks[i - 1]);
        CHECK_FALSE(tick_text(ticks[i], ticks[1] - ticks[0]).empty());
      }
    }
  }
}

TEST_CASE("Colour range: round numbers stay within the limits of ranges") {
  CHECK(round_up(5e-324) == doctest::Approx(ColourRange::kLeastWidth));
  CHECK(round_up(1.7e308) == doctest::Approx(ColourRange::kLargestEnd));
}

}  // namespace clatter
