#include "engine/physics/elementary.h"

#include <bit>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <numbers>

namespace clatter {

namespace {

// The coefficients are minimax fits by Remez's algorithm, in decimal arithmetic of 70 digits. They
// were rounded to double in order, the lowest power first. After each rounding the higher powers
// were fitted again.

// c[0] + c[1] x + c[2] x^2 + ... Even and odd powers are summed separately: two short chains of
// operations take less time than a long one.
template <std::size_t N>
double polynomial(const double (&c)[N], double x) {
  static_assert(N >= 4);
  const double square = x * x;
  double even = c[(N - 1) / 2 * 2];
  for (std::size_t k = (N - 1) / 2 * 2; k > 0; k -= 2) even = c[k - 2] + square * even;
  double odd = c[N / 2 * 2 - 1];
  for (std::size_t k = N / 2 * 2 - 1; k > 1; k -= 2) odd = c[k - 2] + square * odd;
  return even + x * odd;
}

// The leading 26 bits of x; the product of two such numbers is exact.
double leading_bits(double x) {
  return std::bit_cast<double>(std::bit_cast<std::uint64_t>(x) & ~((std::uint64_t{1} << 27) - 1));
}

// A number given as the sum of two doubles.
struct Sum {
  double high;
  double low;
};

// (x + x_low) * constant, where x_low is at most half an ulp of x. `constant.high` has 26 bits, and
// `whole` is the constant as one double. The error is about 2^-75 of the product.
Sum product(double x, double x_low, const Sum& constant, double whole) {
  const double lead = leading_bits(x);
  return {lead * constant.high, lead * constant.low + ((x - lead) + x_low) * whole};
}

// a + b as its rounded value and the error of that, which is exact. Requires |a| >= |b| or a = 0.
Sum add(double a, double b) {
  const double sum = a + b;
  return {sum, (a - sum) + b};
}

constexpr double kTwoPi = 2.0 * std::numbers::pi;
constexpr Sum kTwoPiParts = {0x1.921fb5p+2, 0x1.110b4611a6263p-24};
constexpr double kPerTwoPi = 0.5 * std::numbers::inv_pi;
constexpr Sum kPerTwoPiParts = {0x1.45f3068p-3, 0x1.727220a94fe14p-29};
// `high` has 42 bits, so that its product with an exponent is exact.
constexpr Sum kLog2 = {0x1.62e42fefa38p-1, 0x1.ef35793c7673p-45};

// (sin(2 pi r) - 2 pi r) / r^3 as a function of r^2, for |r| <= 1/8.
constexpr double kSine[] = {-0x1.4abbce625be47p+5, 0x1.466bc67758dfap+6,  -0x1.32d2cce33a564p+6,
                            0x1.50783021c7e0ep+5,  -0x1.e300abb27c9e0p+3, 0x1.e40582304e25ap+1};
// (cos(2 pi r) - 1 + (2 pi r)^2 / 2) / r^4 as a function of r^2, for |r| <= 1/8.
constexpr double kCosine[] = {0x1.03c1f081b5abcp+6,  -0x1.55d3c7e3ca612p+6, 0x1.e1f506850b318p+5,
                              -0x1.a6d1ed9ffb284p+4, 0x1.f9cd087838c7cp+2,  -0x1.b29a1882e67b6p+0};
// (asin(x) - x) / (2 pi x^3) as a function of x^2, for |x| <= 1/2.
constexpr double kArcSine[] = {0x1.b2995e7b7b3b7p-6, 0x1.8723a1d5d570ap-7,  0x1.d1a452ba25f40p-8,
                               0x1.3ce534666384dp-8, 0x1.d2b113d97258fp-9,  0x1.6a234fb3147c8p-9,
                               0x1.21a4bada7577bp-9, 0x1.fbe274f528e40p-10, 0x1.0fa7b5a2a4c19p-10,
                               0x1.984f6bc5d2612p-9, -0x1.53e1dbfeab671p-9, 0x1.4d5606daffdc2p-8};
// (2 artanh(s) - 2 s) / s^3 as a function of s^2, for |s| <= (sqrt 2 - 1)/(sqrt 2 + 1).
constexpr double kLog[] = {0x1.5555555555592p-1, 0x1.999999997ff06p-2, 0x1.24924941e3165p-2,
                           0x1.c71c5212752f1p-3, 0x1.74663d61eeaf7p-3, 0x1.39a1db628a366p-3,
                           0x1.2f04503511a13p-3};

}  // namespace

SineCosine sin_cos_2pi(double phase) {
  // phase = quarters / 4 + r with |r| <= 1/8, exactly.
  if (!(std::fabs(phase) < 0x1p48)) phase -= std::floor(phase);
  constexpr double kShift = 0x1.8p52;  // Doubles near it are whole numbers.
  const double shifted = 4.0 * phase + kShift;
  const std::uint64_t quarters = std::bit_cast<std::uint64_t>(shifted);
  const double r = phase - 0.25 * (shifted - kShift);

  // theta.high + theta.low = 2 pi r.
  const Sum parts = product(r, 0.0, kTwoPiParts, kTwoPi);
  const Sum theta = add(parts.high, parts.low);
  const double square = r * r;
  const double half = 0.5 * theta.high * theta.high;
  const Sum parabola = add(1.0, -half);
  const double cosine =
      parabola.high +
      (parabola.low + (square * square * polynomial(kCosine, square) - theta.high * theta.low));
  // The parts of a very small product would be subnormal. The sine then is 2 pi r.
  const bool tiny = std::fabs(r) < 0x1p-900;
  const double sine =
      tiny ? kTwoPi * r
           : theta.high + (r * square * polynomial(kSine, square) + theta.low * parabola.high);

  // Odd quarters exchange the two. The code is branch-free, because branches would be
  // unpredictable.
  const std::uint64_t exchange =
      (std::bit_cast<std::uint64_t>(sine) ^ std::bit_cast<std::uint64_t>(cosine)) & -(quarters & 1);
  const std::uint64_t sine_sign = (quarters & 2) << 62;
  const std::uint64_t cosine_sign = ((quarters + 1) & 2) << 62;
  return {std::bit_cast<double>((std::bit_cast<std::uint64_t>(sine) ^ exchange) ^ sine_sign),
          std::bit_cast<double>((std::bit_cast<std::uint64_t>(cosine) ^ exchange) ^ cosine_sign)};
}

double acos_turns(double x) {
  if (std::fabs(x) <= 0.5) {
    // 1/4 - asin(x) / (2 pi)
    const Sum linear = product(x, 0.0, kPerTwoPiParts, kPerTwoPi);
    const Sum rest = add(0.25, -linear.high);
    return rest.high + (rest.low - (linear.low + x * x * x * polynomial(kArcSine, x * x)));
  }
  // acos(|x|) = 2 asin(s) with s^2 = (1 - |x|) / 2, which is exact.
  const double square = 0.5 * (1.0 - std::fabs(x));
  if (square == 0.0) return x > 0.0 ? 0.0 : 0.5;
  const double s = std::sqrt(square);
  const double lead = leading_bits(s);
  const double s_low = (square - lead * lead) / (s + lead) - (s - lead);
  const Sum linear = product(2.0 * s, 2.0 * s_low, kPerTwoPiParts, kPerTwoPi);
  const double correction = linear.low + 2.0 * s * square * polynomial(kArcSine, square);
  if (x > 0.0) return linear.high + correction;
  const Sum rest = add(0.5, -linear.high);
  return rest.high + (rest.low - correction);
}

double natural_log(double x) {
  // x = 2^exponent (1 + f), with 1 + f between the square roots of 1/2 and 2.
  constexpr std::uint64_t kRootOfHalf = std::bit_cast<std::uint64_t>(0.5 * std::numbers::sqrt2);
  const bool subnormal = x < 0x1p-1022;
  const std::uint64_t bits = std::bit_cast<std::uint64_t>(subnormal ? x * 0x1p54 : x);
  const std::int64_t power = static_cast<std::int64_t>(bits - kRootOfHalf) >> 52;
  const double f = std::bit_cast<double>(bits - (static_cast<std::uint64_t>(power) << 52)) - 1.0;
  const double exponent = static_cast<double>(power - (subnormal ? 54 : 0));

  // log(1 + f) = 2 artanh(s) = f - f^2/2 + s (f^2/2 + (2 artanh(s) - 2 s) / s), s = f / (2 + f):
  // f is exact, so that only the small terms are rounded before the last sum.
  const double s = f / (2.0 + f);
  const double square = s * s;
  const double half = 0.5 * f * f;
  const double small = half - s * (half + square * polynomial(kLog, square));
  const Sum large = add(exponent * kLog2.high, f);
  return large.high + (large.low + (exponent * kLog2.low - small));
}

// P(0 < Z < z) of a standard normal variable for 0 <= z <= 3, by its power series.
static double normal_share(double z) {
  const double half = 0.5 * z * z;
  double term = z, sum = z;  // (-1)^k z (z^2/2)^k / k!, and its sum over 2k + 1
  for (int k = 1; std::fabs(term) > 1e-18; ++k) {
    term *= -half / k;
    sum += term / (2 * k + 1);
  }
  return sum * std::numbers::inv_sqrtpi / std::numbers::sqrt2;
}

double cut_normal_quantile(double probability) {
  static const double kShare = normal_share(3.0);
  const double share = 2.0 * std::fabs(probability - 0.5) * kShare;
  // The share is concave, so Newton's method increases towards the solution.
  double z = 0.0;
  for (double before = -1.0; z > before && z < 3.0;) {
    before = z;
    const double density =
        exponential(-0.5 * z * z) * std::numbers::inv_sqrtpi / std::numbers::sqrt2;
    z += (share - normal_share(z)) / density;
  }
  z = std::fmin(z, 3.0);
  return probability < 0.5 ? -z : z;
}

double exponential(double x) {
  constexpr int kHalvings = 10;
  const double r = x / (1 << kHalvings);
  double power = 0.0;  // exp(r) - 1, by its power series
  for (int k = 9; k > 0; --k) power = (1.0 + power) * r / k;
  for (int k = 0; k < kHalvings; ++k) power *= 2.0 + power;
  return 1.0 + power;
}

}  // namespace clatter
