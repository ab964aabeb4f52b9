#include <doctest/doctest.h>

#include <array>
#include <cmath>
#include <numbers>
#include <set>
#include <vector>

#include "engine/physics/random.h"
#include "tests/support/statistics.h"

using namespace clatter;
using namespace clatter::testing;

// Random123 1.14.0, tests/kat_vectors, lines "philox4x32 10" (Salmon et al. 2011).
TEST_CASE("Philox: it gives the known answers of Random123") {
  using Words = std::array<std::uint32_t, 4>;
  CHECK(philox({0, 0, 0, 0}, {0, 0}) == Words{0x6627e8d5, 0xe169c58d, 0xbc57ac4c, 0x9b00dbd8});
  const std::uint32_t f = 0xffffffff;
  CHECK(philox({f, f, f, f}, {f, f}) == Words{0x408f276d, 0x41c83b0e, 0xa20bc7c6, 0x6d5451fd});
  CHECK(philox({0x243f6a88, 0x85a308d3, 0x13198a2e, 0x03707344}, {0xa4093822, 0x299f31d0}) ==
        Words{0xd16cfe09, 0x94fdcceb, 0x5001e420, 0x24126ea1});
}

TEST_CASE("Random: uniform numbers fill (0,1) evenly") {
  constexpr int kSamples = 1000000, kBins = 100;
  Random random(1, Stream::Velocity, 0, 0);
  std::vector<double> observed(kBins), expected(kBins, kSamples / double{kBins});
  double sum = 0.0, squares = 0.0;
  for (int i = 0; i < kSamples; ++i) {
    const double u = random.uniform();
    REQUIRE(u > 0.0);
    REQUIRE(u < 1.0);
    ++observed[static_cast<int>(kBins * u)];
    sum += u;
    squares += u * u;
  }
  CHECK(counts_p(observed, expected) > kMinProbability);
  CHECK(std::fabs(standard_errors_off(sum, kSamples, 0.5, 1.0 / 12.0)) < 5.0);
  CHECK(std::fabs(standard_errors_off(squares, kSamples, 1.0 / 3.0, 4.0 / 45.0)) < 5.0);
}

TEST_CASE("Random: normal numbers are normal") {
  constexpr int kSamples = 1000000, kBins = 80;
  Random random(2, Stream::Velocity, 7, 3);
  // Even bins over [-4, 4). The outer bins include all values beyond.
  std::vector<double> observed(kBins), expected(kBins);
  const auto below = [](double z) { return 0.5 * std::erfc(-z / std::numbers::sqrt2); };
  for (int i = 0; i < kBins; ++i) {
    const double from = i == 0 ? 0.0 : below(-4.0 + i * 0.1);
    const double to = i == kBins - 1 ? 1.0 : below(-4.0 + (i + 1) * 0.1);
    expected[i] = kSamples * (to - from);
  }
  std::array<double, 5> moments{};
  for (int i = 0; i < kSamples; ++i) {
    const double z = random.normal();
    ++observed[std::min(kBins - 1, std::max(0, static_cast<int>(std::floor((z + 4.0) * 10.0))))];
    for (int k = 1; k <= 4; ++k) moments[k] += std::pow(z, k);
  }
  CHECK(counts_p(observed, expected) > kMinProbability);
  // Mean and variance of z^k of a standard normal z: 0, 1; 1, 2; 0, 15; 3, 96.
  CHECK(std::fabs(standard_errors_off(moments[1], kSamples, 0.0, 1.0)) < 5.0);
  CHECK(std::fabs(standard_errors_off(moments[2], kSamples, 1.0, 2.0)) < 5.0);
  CHECK(std::fabs(standard_errors_off(moments[3], kSamples, 0.0, 15.0)) < 5.0);
  CHECK(std::fabs(standard_errors_off(moments[4], kSamples, 3.0, 96.0)) < 5.0);
}

TEST_CASE("Random: whole numbers below a limit are unbiased") {
  Random random(3, Stream::Placement, 0, 0);
  SUBCASE("small n") {
    constexpr int kSamples = 700000;
    std::vector<double> observed(7), expected(7, kSamples / 7.0);
    for (int i = 0; i < kSamples; ++i) ++observed[random.below(7)];
    CHECK(counts_p(observed, expected) > kMinProbability);
  }
  SUBCASE("n of the generator's own size: a plain remainder would favour the lowest third") {
    constexpr int kSamples = 90000;
    constexpr std::uint64_t kThird = 1ull << 62;
    std::vector<double> observed(3), expected(3, kSamples / 3.0);
    for (int i = 0; i < kSamples; ++i) ++observed[random.below(3 * kThird) / kThird];
    CHECK(counts_p(observed, expected) > kMinProbability);
  }
  SUBCASE("n = 1") {
    CHECK(random.below(1) == 0);
  }
}

TEST_CASE("Random: streams, owners, items and seeds share no numbers") {
  std::set<double> first;
  int drawn = 0;
  for (const auto stream : {Stream::Placement, Stream::Velocity, Stream::ThermalWall}) {
    for (const std::uint64_t seed : {1ull, 2ull, 1ull << 32}) {
      for (std::uint32_t owner = 0; owner < 20; ++owner) {
        for (std::uint32_t item = 0; item < 20; ++item) {
          Random random(seed, stream, owner, item);
          for (int k = 0; k < 6; ++k, ++drawn) first.insert(random.uniform());
        }
      }
    }
  }
  CHECK(static_cast<int>(first.size()) == drawn);
}

TEST_CASE("Random: the first numbers of neighbouring owners are independent") {
  constexpr int kOwners = 200000, kSide = 16;
  std::vector<double> observed(kSide * kSide),
      expected(kSide * kSide, kOwners / double{kSide * kSide});
  for (std::uint32_t owner = 0; owner < kOwners; ++owner) {
    const int a = static_cast<int>(kSide * Random(5, Stream::Velocity, owner, 0).uniform());
    const int b = static_cast<int>(kSide * Random(5, Stream::Velocity, owner + 1, 0).uniform());
    ++observed[a * kSide + b];
  }
  CHECK(counts_p(observed, expected) > kMinProbability);
}
