#include <doctest/doctest.h>

#include <cmath>

#include "render/chart_axis.h"

namespace clatter {

namespace {

ChartScale logarithmic(double low, double high) {
  return {std::log10(low), std::log10(high), true};
}

// The numbers at the ticks, in their order.
std::string numbers(const ChartScale& scale, int most) {
  std::string text;
  for (const ChartTick& tick : chart_ticks(scale, most)) {
    if (!tick.text.empty()) text += (text.empty() ? "" : " ") + tick.text;
  }
  return text;
}

// The values of the minor ticks in units of `unit`.
std::vector<double> minor(const ChartScale& scale, int most, double unit) {
  std::vector<double> values;
  for (const ChartTick& tick : chart_ticks(scale, most)) {
    if (tick.text.empty()) values.push_back(std::round(1e6 * tick.value / unit) / 1e6);
  }
  return values;
}

ChartExtent extent(double low, double high) {
  return {low, high};
}

}  // namespace

TEST_CASE("Chart axis: a linear axis has ticks at 1, 2 or 5 times a power of ten") {
  CHECK(numbers({0.0, 1.0}, 5) == "0.0 0.2 0.4 0.6 0.8 1.0");
  CHECK(numbers({-1.1, 2.1}, 7) == "−1.0 −0.5 0.0 0.5 1.0 1.5 2.0");
  CHECK(numbers({995.0, 1032.0}, 4) == "1000 1010 1020 1030");
  CHECK(numbers({-2.1e-6, 2.1e-6}, 5) == "−2×10⁻⁶ −1×10⁻⁶ 0 1×10⁻⁶ 2×10⁻⁶");
  CHECK(minor({0.0, 1.1}, 2, 0.2) == std::vector<double>{1, 2, 3, 4});
  CHECK(minor({0.0, 0.45}, 2, 0.05) == std::vector<double>{1, 2, 3, 5, 6, 7, 9});
  CHECK(minor({0.0, 2.1}, 2, 0.5) == std::vector<double>{1, 2, 3});
}

TEST_CASE("Chart axis: a logarithmic axis has ticks at powers of ten and at their multiples") {
  CHECK(numbers(logarithmic(0.0008, 12.0), 7) == "0.001 0.01 0.1 1 10");
  CHECK(numbers(logarithmic(1e-5, 0.1), 7) == "10⁻⁵ 10⁻⁴ 10⁻³ 10⁻² 10⁻¹");
  CHECK(numbers(logarithmic(0.5, 3e4), 7) == "10⁰ 10¹ 10² 10³ 10⁴");
  CHECK(minor(logarithmic(0.7, 13.0), 7, 0.1) ==
        std::vector<double>{7, 8, 9, 20, 30, 40, 50, 60, 70, 80, 90});
}

TEST_CASE("Chart axis: a short logarithmic axis also has ticks at 2 and 5, or at round values") {
  CHECK(numbers(logarithmic(1.5, 8.0), 7) == "2 5");
  CHECK(minor(logarithmic(1.5, 8.5), 7, 1.0) == std::vector<double>{3, 4, 6, 7, 8});
  CHECK(numbers(logarithmic(0.12, 9.0), 7) == "0.2 0.5 1 2 5");
  CHECK(numbers(logarithmic(1.5e-4, 1.1e-3), 7) == "2×10⁻⁴ 5×10⁻⁴ 10⁻³");
  CHECK(numbers(logarithmic(1.75, 2.25), 4) == "1.8 2.0 2.2");
  CHECK(numbers(logarithmic(3.05, 3.35), 4) == "3.1 3.2 3.3");
}

TEST_CASE("Chart axis: an axis of many decades has numbers at some powers of ten only") {
  const ChartScale scale{-20.2, 20.2, true};
  CHECK(numbers(scale, 5) == "10⁻²⁰ 10⁻¹¹ 10⁻² 10⁷ 10¹⁶");
  CHECK(chart_ticks(scale, 5).size() == 41);
}

TEST_CASE("Chart axis: an axis contains the points, and lines up to the span of the points") {
  const ChartScale scale = chart_scale(extent(2.0, 4.0), extent(-1e6, 5.0), false);
  CHECK(scale.share(0.0) > 0.0);
  CHECK(scale.share(0.0) < 0.1);
  CHECK(scale.share(5.0) < 1.0);
  CHECK(scale.share(5.0) > 0.9);
  const ChartScale points = chart_scale(extent(2.0, 4.0), {}, false);
  CHECK(points.share(2.0) > 0.0);
  CHECK(points.share(2.0) < 0.1);
  CHECK(points.share(3.0) == doctest::Approx(0.5));
  const ChartScale lines = chart_scale({}, extent(-1.0, 3.0), true);
  CHECK(lines.share(10.0) == doctest::Approx(0.5));
}

TEST_CASE("Chart axis: an axis of one value, of none and of extreme values has a finite span") {
  for (const bool logarithmic : {false, true}) {
    for (const ChartExtent& points :
         {extent(5.0, 5.0), extent(0.0, 0.0), extent(-300.0, 300.0), extent(1.0, 1.0 + 1e-15),
          extent(1e-310, 1e-310), ChartExtent{}}) {
      const ChartScale scale = chart_scale(points, {}, logarithmic);
      CHECK(scale.high - scale.low > 1e-12 * std::abs(scale.high));
      for (const ChartTick& tick : chart_ticks(scale, 5)) {
        CHECK(scale.share(tick.value) > -1e-6);
        CHECK(scale.share(tick.value) < 1.0 + 1e-6);
      }
    }
  }
  CHECK(std::isfinite(chart_scale(extent(-1e300, 1e300), extent(-1e300, 1e300), false).share(0.0)));
}

TEST_CASE("Chart axis: an axis shows finite values, and a logarithmic one positive ones") {
  const ChartScale linear{0.0, 1.0, false}, decades{0.0, 1.0, true};
  const double none = std::numeric_limits<double>::quiet_NaN();
  const double endless = std::numeric_limits<double>::infinity();
  CHECK(linear.shows(-1.0));
  CHECK(decades.shows(1.1e-300));
  for (const double value : {none, endless, -endless}) CHECK_FALSE(linear.shows(value));
  for (const double value : {none, endless, 0.0, -1.0}) CHECK_FALSE(decades.shows(value));
}

}  // namespace clatter
