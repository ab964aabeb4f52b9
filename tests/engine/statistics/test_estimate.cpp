#include <doctest/doctest.h>

#include <algorithm>
#include <cmath>
#include <vector>

#include "engine/physics/random.h"
#include "engine/statistics/estimate.h"

using namespace clatter;

namespace {

constexpr std::uint64_t kSeed = 20240501;

/// Normal variates of variance 1 with the correlation `rho` between neighbours.
std::vector<double> autoregressive(std::size_t count, double rho, std::uint32_t series) {
  Random random(kSeed, Stream::Velocity, series, 0);
  std::vector<double> values(count);
  double x = random.normal();
  for (double& value : values) {
    value = x;
    x = rho * x + std::sqrt(1.0 - rho * rho) * random.normal();
  }
  return values;
}

/// Errors of many series in units of the true one, sorted.
std::vector<double> relative_errors(int sample, std::size_t count, double rho) {
  // The variance of the mean is (1 + rho)/((1 - rho) n) up to O(1/n^2).
  const double truth = std::sqrt((1.0 + rho) / ((1.0 - rho) * static_cast<double>(count)));
  std::vector<double> errors;
  for (int k = 0; k < sample; ++k) {
    const auto series = autoregressive(count, rho, static_cast<std::uint32_t>(k));
    errors.push_back(blocked_error(series) / truth);
  }
  std::ranges::sort(errors);
  return errors;
}

double mean(const std::vector<double>& values) {
  double sum = 0.0;
  for (const double value : values) sum += value;
  return sum / static_cast<double>(values.size());
}

}  // namespace

TEST_CASE("Independent estimate: few values have an error, a single one has none") {
  const std::vector<double> values = {1.0, 2.0, 6.0};  // variance 7
  const Estimate estimate = independent_estimate(values);
  CHECK(estimate.mean == doctest::Approx(3.0));
  CHECK(estimate.standard_error == doctest::Approx(std::sqrt(7.0 / 3.0)));
  const std::vector<double> one = {2.0};
  CHECK(independent_estimate(one).mean == 2.0);
  CHECK(std::isnan(independent_estimate(one).standard_error));
}

TEST_CASE("Blocked error: white noise has the error sigma/sqrt(n)") {
  // 4096/256 = 16 blocks have about 24 independent ones, 1.5 for each: the uncertainty of the error
  // is 14 %, and 22 % after the extrapolation. The mean over 100 series has 2.2 %. The larger of
  // two estimates is too large by some percent.
  const auto errors = relative_errors(100, 4096, 0.0);
  CHECK(errors.front() > 0.4);
  CHECK(errors.back() < 1.0 + 5.0 * 0.22);
  CHECK(mean(errors) == doctest::Approx(1.05).epsilon(0.11));
}

TEST_CASE("Blocked error: it finds the error of a correlated series within 20 %") {
  // rho = 0.9: the mean of 65,536 values has the error of 65,536/19 independent values. The blocks
  // have 200 correlation times. The mean over 32 series has an uncertainty of 4 %.
  const auto errors = relative_errors(32, 65536, 0.9);
  CHECK(mean(errors) == doctest::Approx(1.05).epsilon(0.2));
  CHECK(errors.back() < 1.0 + 5.0 * 0.22);
}

TEST_CASE("Blocked error: correlations of half a block are extrapolated") {
  // 512 values with a correlation time of 15 in blocks of 32. Without the extrapolation the error
  // is too small by a factor of 0.74: e_b^2 is short of the share tau/b = 15/32. With 2 e_b^2 -
  // e_(b/2)^2 it is 0.93 or more, for the larger of both counts. The mean over 400 series has an
  // uncertainty of 1.3 %.
  const auto errors = relative_errors(400, 512, std::exp(-1.0 / 15.0));
  CHECK(mean(errors) == doctest::Approx(0.9).epsilon(0.1));
}

TEST_CASE(
    "Blocked error: negative correlations make the error small, as they make the mean exact") {
  // y_(k+1) - y_k + 0.1 z_k: the differences cancel in the mean but at both ends, so its error is
  // sqrt(2/n^2 + 0.01/n). White noise of this variance would have an error of 1.42/sqrt(n), 10
  // times as much.
  constexpr std::size_t kCount = 2048;
  double sum = 0.0;
  for (std::uint32_t k = 0; k < 50; ++k) {
    const auto y = autoregressive(kCount + 1, 0.0, 2 * k),
               z = autoregressive(kCount, 0.0, 2 * k + 1);
    std::vector<double> series(kCount);
    for (std::size_t i = 0; i < kCount; ++i) series[i] = y[i + 1] - y[i] + 0.1 * z[i];
    sum += blocked_error(series) / 50.0;
  }
  const double truth = std::sqrt(2.0 / (kCount * double{kCount}) + 0.01 / kCount);
  CHECK(sum > truth);
  CHECK(sum < 1.8 * truth);
  // x, -x, x, -x: the mean of all blocks is exact.
  std::vector<double> series;
  for (int k = 0; k < 64; ++k) series.push_back(k % 2 ? -1.0 : 1.0);
  CHECK(blocked_error(series) == 0.0);
}

TEST_CASE("Mean estimate: constants have no error, too short a series an unknown one") {
  CHECK(mean_estimate({}).mean == 0.0);
  CHECK(mean_estimate({}).standard_error == 0.0);

  const Estimate one = mean_estimate(std::vector{3.0});
  CHECK(one.mean == 3.0);
  CHECK(one.standard_error == 0.0);

  // Mean 3, squares 4 + 1 + 9 = 14.
  const Estimate three = mean_estimate(std::vector{1.0, 2.0, 6.0});
  CHECK(three.mean == 3.0);
  CHECK(three.standard_error == doctest::Approx(std::sqrt(14.0 / 6.0)));

  const Estimate constant = mean_estimate(std::vector(1000, 0.1));
  CHECK(constant.mean == doctest::Approx(0.1).epsilon(1e-13));
  CHECK(constant.standard_error < 1e-15);
}

TEST_CASE("Ratio estimate: a fixed ratio has no error however both vary") {
  const auto denominator = std::vector{1.0, 5.0, 2.0, 8.0};
  const auto numerator = std::vector{2.5, 12.5, 5.0, 20.0};
  const Estimate ratio = ratio_estimate(numerator, denominator);
  CHECK(ratio.mean == doctest::Approx(2.5).epsilon(1e-15));
  CHECK(ratio.standard_error < 1e-15);
}

TEST_CASE("Ratio estimate: independent errors add up as in the textbook") {
  // a = 2 + 0.1 x, b = 1 + 0.1 y: the error of a/b is sqrt(0.1^2 + (2*0.1)^2)/sqrt(n).
  constexpr std::size_t kCount = 4096;
  auto numerator = autoregressive(kCount, 0.0, 1001);
  auto denominator = autoregressive(kCount, 0.0, 1002);
  for (double& a : numerator) a = 2.0 + 0.1 * a;
  for (double& b : denominator) b = 1.0 + 0.1 * b;
  const Estimate ratio = ratio_estimate(numerator, denominator);
  const double error = std::sqrt(0.05 / kCount);
  CHECK(std::fabs(ratio.mean - 2.0) < 5.0 * error);
  CHECK(ratio.standard_error == doctest::Approx(error).epsilon(3.0 * 0.22));
}

TEST_CASE("Ratio estimate: nothing below the line gives nothing") {
  CHECK(ratio_estimate({}, {}).mean == 0.0);
  const Estimate ratio = ratio_estimate(std::vector{1.0, 2.0}, std::vector{0.0, 0.0});
  CHECK(ratio.mean == 0.0);
  CHECK(ratio.standard_error == 0.0);
}

TEST_CASE("Mean estimate: a stationary series has no drift, and one that rises has") {
  // 100 stationary series of 4096 values have drifts below 5 errors. The second half of one more
  // series is higher by 20 errors. Its drift is 20 within 22 %, the uncertainty of the errors.
  std::vector<double> drifts;
  for (std::uint32_t k = 0; k < 100; ++k) {
    drifts.push_back(mean_estimate(autoregressive(4096, 0.5, k)).drift);
  }
  CHECK(std::ranges::max(drifts) < 5.0);
  CHECK(std::ranges::min(drifts) > -5.0);
  CHECK(std::fabs(mean(drifts)) < 0.5);  // 5 standard errors

  auto series = autoregressive(4096, 0.0, 101);
  for (std::size_t k = 2048; k < 4096; ++k) series[k] += 20.0 * std::sqrt(2.0 / 2048.0);
  CHECK(mean_estimate(series).drift == doctest::Approx(20.0).epsilon(0.6));
  CHECK(mean_estimate(std::vector<double>(4096, 0.1)).drift == 0.0);
  CHECK(mean_estimate(autoregressive(511, 0.5, 0)).drift == 0.0);
}

TEST_CASE("Mean estimate: its error is known to rise where blocks are shorter than correlations") {
  // Blocks of 8 and 2 of 128 values with a correlation time of 100: nearly 8/2. Also blocks of 256
  // and 64 of 4096 independent values.
  double slow = 0.0, white = 0.0;
  for (std::uint32_t k = 0; k < 20; ++k) {
    slow += mean_estimate(autoregressive(128, 0.99, k)).rise / 20.0;
    white += mean_estimate(autoregressive(4096, 0.0, k)).rise / 20.0;
  }
  CHECK(slow > 3.0);
  CHECK(white < 1.5);
  const Estimate estimate{1.0, 0.1, 4.0, 0.0};
  CHECK(estimate.cautious_error() == doctest::Approx(0.2));
}
