#include <doctest/doctest.h>
#include <mpfr.h>

#include <algorithm>
#include <bit>
#include <cmath>
#include <cstdint>
#include <limits>
#include <vector>

#include "engine/physics/elementary.h"
#include "engine/physics/random.h"

using namespace clatter;

namespace {

// The exact difference of a quarter and a smaller phase has 1074 bits at most.
constexpr mpfr_prec_t kPrecision = 1200;
// Precision of the reference values: the error of 200 bits is a negligible part of an ulp.
constexpr mpfr_prec_t kReferencePrecision = 200;

// A number of the MPFR library.
class Exact {
 public:
  explicit Exact(double x) : Exact() { mpfr_set_d(value_, x, MPFR_RNDN); }
  Exact() { mpfr_init2(value_, kPrecision); }
  Exact(const Exact&) = delete;
  Exact& operator=(const Exact&) = delete;
  ~Exact() { mpfr_clear(value_); }

  mpfr_ptr operator*() { return value_; }

  void shorten() { mpfr_prec_round(value_, kReferencePrecision, MPFR_RNDN); }

  // The error of a double in ulps, the spacing of doubles at the exact value.
  double error_of(double x) {
    // The ulp is 2^-53 of the next power of two, and at least the smallest double.
    const long exponent = mpfr_zero_p(value_) ? -1073 : mpfr_get_exp(value_);
    Exact error;
    mpfr_sub_d(*error, value_, x, MPFR_RNDN);
    mpfr_mul_2si(*error, *error, -std::max(exponent - 53, -1074L), MPFR_RNDN);
    return std::fabs(mpfr_get_d(*error, MPFR_RNDN));
  }

 private:
  mpfr_t value_;
};

void multiply_by_two_pi(Exact& x) {
  Exact pi;
  mpfr_const_pi(*pi, MPFR_RNDN);
  mpfr_mul(*x, *x, *pi, MPFR_RNDN);
  mpfr_mul_2ui(*x, *x, 1, MPFR_RNDN);
}

// sin(2 pi phase) = sin(2 pi r), where |r| <= 1/4; r is exact.
double sine_error(double phase, double got) {
  const double rest = std::remainder(phase, 1.0);
  Exact exact(rest);
  if (std::fabs(rest) > 0.25) {
    mpfr_d_sub(*exact, std::copysign(0.5, rest), *exact, MPFR_RNDN);
  }
  exact.shorten();
  multiply_by_two_pi(exact);
  mpfr_sin(*exact, *exact, MPFR_RNDN);
  return exact.error_of(got);
}

// cos(2 pi phase) = sin(2 pi (1/4 - |r|)), where |r| <= 1/2; r and the difference are exact.
double cosine_error(double phase, double got) {
  Exact exact(std::fabs(std::remainder(phase, 1.0)));
  mpfr_d_sub(*exact, 0.25, *exact, MPFR_RNDN);
  exact.shorten();
  multiply_by_two_pi(exact);
  mpfr_sin(*exact, *exact, MPFR_RNDN);
  return exact.error_of(got);
}

double acos_error(double x, double got) {
  Exact exact(x), circle(1.0);
  exact.shorten();
  mpfr_acos(*exact, *exact, MPFR_RNDN);
  multiply_by_two_pi(circle);
  mpfr_div(*exact, *exact, *circle, MPFR_RNDN);
  return exact.error_of(got);
}

double log_error(double x, double got) {
  Exact exact(x);
  exact.shorten();
  mpfr_log(*exact, *exact, MPFR_RNDN);
  return exact.error_of(got);
}

// A number, five doubles on either side of it, and others at growing distances.
std::vector<double> about(double x) {
  std::vector<double> numbers = {x};
  double above = x, below = x;
  for (int k = 0; k < 5; ++k) {
    numbers.push_back(above = std::nextafter(above, 1e300));
    numbers.push_back(below = std::nextafter(below, -1e300));
  }
  for (int k = -70; k < -2; ++k) {
    numbers.push_back(x + 1.7 * std::ldexp(1.0, k));
    numbers.push_back(x - 1.7 * std::ldexp(1.0, k));
  }
  return numbers;
}

// A number of any exponent, also subnormal.
double of_any_size(Random& random) {
  const auto bits = std::bit_cast<std::uint64_t>(1.0 + random.uniform()) << 12 >> 12;
  return std::bit_cast<double>(bits | random.below(2047) << 52);
}

struct Worst {
  double error = 0.0;
  double at = 0.0;

  void take(double at_x, double of_x) {
    if (of_x > error || std::isnan(of_x)) error = of_x, at = at_x;
  }
};

constexpr int kTries = 15000;

}  // namespace

TEST_CASE("Elementary functions: sine and cosine of turns have an error below 1 ulp") {
  Worst sine, cosine;
  const auto look_at = [&](double phase) {
    const SineCosine both = sin_cos_2pi(phase);
    sine.take(phase, sine_error(phase, both.sine));
    cosine.take(phase, cosine_error(phase, both.cosine));
    CHECK(sin_2pi(phase) == both.sine);
    CHECK(cos_2pi(phase) == both.cosine);
  };
  Random random(1, Stream::Kick, 0, 0);
  for (int k = 0; k < kTries; ++k) {
    look_at(random.uniform());
    look_at(16.0 * random.uniform() - 8.0);
    look_at(0.125 * random.uniform());
    const double any = of_any_size(random);
    look_at(k % 2 == 0 ? any : -any);
  }
  for (int eighth = -17; eighth <= 17; ++eighth) {
    for (const double phase : about(eighth / 8.0)) look_at(phase);
  }
  for (int k = -1074; k < 1024; ++k) {
    look_at(std::ldexp(1.0, k));
    look_at(-std::nextafter(std::ldexp(1.0, k), 0.0));
    look_at(std::nextafter(std::ldexp(1.0, k), 1e308));
  }
  look_at(std::numeric_limits<double>::max());
  INFO("sine at ", sine.at, " cosine at ", cosine.at);
  MESSAGE(sine.error << " ulp, " << cosine.error << " ulp");
  CHECK(sine.error <= 1.0);
  CHECK(cosine.error <= 1.0);
}

TEST_CASE("Elementary functions: sine and cosine of quarters of a turn are exact") {
  const double sines[] = {0.0, 1.0, 0.0, -1.0};
  for (const double turns : {-0x1p60, -1e6, -3.0, 0.0, 1.0, 0x1p46}) {
    for (int quarter = 0; quarter < 4; ++quarter) {
      const double phase = turns + 0.25 * quarter;
      if (phase - turns != 0.25 * quarter) continue;
      CHECK(sin_cos_2pi(phase).sine == sines[quarter]);
      CHECK(sin_cos_2pi(phase).cosine == sines[(quarter + 1) % 4]);
    }
  }
}

TEST_CASE("Elementary functions: the arc cosine in turns has an error below 1 ulp") {
  Worst worst;
  const auto look_at = [&](double x) {
    if (std::fabs(x) <= 1.0) worst.take(x, acos_error(x, acos_turns(x)));
  };
  Random random(2, Stream::Kick, 0, 0);
  for (int k = 0; k < kTries; ++k) {
    look_at(2.0 * random.uniform() - 1.0);
    const double any = of_any_size(random);
    look_at(k % 2 == 0 ? any : -any);
  }
  for (const double x : {-1.0, -0.5, 0.0, 0.5, 1.0, std::sqrt(0.5)}) {
    for (const double near_x : about(x)) look_at(near_x);
  }
  INFO("at ", worst.at);
  MESSAGE(worst.error << " ulp");
  CHECK(worst.error <= 1.0);
  CHECK(acos_turns(1.0) == 0.0);
  CHECK(acos_turns(0.0) == 0.25);
  CHECK(acos_turns(-1.0) == 0.5);
}

TEST_CASE("Elementary functions: the logarithm has an error below 1 ulp") {
  Worst worst;
  const auto look_at = [&](double x) {
    if (x > 0.0) worst.take(x, log_error(x, natural_log(x)));
  };
  Random random(3, Stream::Kick, 0, 0);
  for (int k = 0; k < kTries; ++k) {
    look_at(random.uniform());
    look_at(0.5 + 1.5 * random.uniform());
    look_at(of_any_size(random));
  }
  for (const double x : {0.0, 0.25, 0.5, std::sqrt(0.5), 1.0, std::sqrt(2.0), 2.0}) {
    for (const double near_x : about(x)) look_at(near_x);
  }
  for (int k = -1074; k < 1024; ++k) look_at(std::ldexp(1.0, k));
  // The smallest and the largest uniform variate.
  look_at(0x1p-53);
  look_at(1.0 - 0x1p-53);
  look_at(std::numeric_limits<double>::max());
  INFO("at ", worst.at);
  MESSAGE(worst.error << " ulp");
  CHECK(worst.error <= 1.0);
  CHECK(natural_log(1.0) == 0.0);
}
