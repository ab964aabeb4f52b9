#include "render/chart_axis.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>

#include "render/colour_range.h"
#include "render/typeset_number.h"

namespace clatter {

namespace {

constexpr double kSlack = 1e-9;  // for rounding errors of shares and logarithms

std::vector<double> multiples(double step, double low, double high) {
  std::vector<double> values;
  const double first = std::ceil(low / step - kSlack);
  const double count = std::floor(high / step + kSlack) - first;
  for (int i = 0; i <= count; ++i) values.push_back((first + i) * step);
  return values;
}

// Adds minor ticks at values that have no tick yet.
void add_minor(std::vector<ChartTick>& ticks, const std::vector<double>& values, double least_gap) {
  const std::vector<ChartTick> numbered = ticks;
  for (const double value : values) {
    const bool taken = std::ranges::any_of(
        numbered, [&](const ChartTick& tick) { return std::abs(tick.value - value) < least_gap; });
    if (!taken) ticks.push_back({value, ""});
  }
}

std::vector<ChartTick> linear_ticks(double low, double high, int most) {
  std::vector<ChartTick> ticks;
  const std::vector<double> values = round_ticks(low, high, most);
  const double step = values[1] - values[0];
  for (const double value : values) ticks.push_back({value, tick_text(value, step)});
  // Minor ticks divide steps of 1 and 5 into five parts, and steps of 2 into four.
  const double mantissa = step / std::pow(10.0, std::floor(std::log10(step) + kSlack));
  const double part = step / (std::abs(mantissa - 2.0) < kSlack ? 4.0 : 5.0);
  add_minor(ticks, multiples(part, low, high), 0.1 * part);
  return ticks;
}

// An integer times a power of ten.
struct RoundNumber {
  int multiple;
  int exponent;

  double value() const { return multiple * std::pow(10.0, exponent); }
  std::string superscript() const {
    return (multiple == 1 ? "" : std::to_string(multiple) + "×") + power_text(exponent);
  }
};

// The numbers with these multiples between the ends of a logarithmic scale.
template <std::size_t N>
std::vector<RoundNumber> round_numbers(const ChartScale& scale,
                                       const std::array<int, N>& multiples) {
  std::vector<RoundNumber> numbers;
  for (int exponent = static_cast<int>(std::floor(scale.low)); exponent <= scale.high + kSlack;
       ++exponent) {
    for (const int multiple : multiples) {
      const double at = exponent + std::log10(multiple);
      if (at < scale.low - kSlack || at > scale.high + kSlack) continue;
      numbers.push_back({multiple, exponent});
    }
  }
  return numbers;
}

// Plain numbers if all are short, otherwise with superscripts.
std::vector<ChartTick> numbered(const std::vector<RoundNumber>& numbers) {
  const bool plain = std::ranges::all_of(numbers, [](const RoundNumber& number) {
    return number.exponent >= -3 && number.exponent <= 3;
  });
  std::vector<ChartTick> ticks;
  for (const RoundNumber& number : numbers) {
    ticks.push_back(
        {number.value(), plain ? fmt::format("{:g}", number.value()) : number.superscript()});
  }
  return ticks;
}

void add_minor(std::vector<ChartTick>& ticks, const std::vector<RoundNumber>& numbers) {
  std::vector<double> values;
  for (const RoundNumber& number : numbers) values.push_back(number.value());
  if (!values.empty()) add_minor(ticks, values, 0.1 * values.front());
}

std::vector<ChartTick> logarithmic_ticks(const ChartScale& scale, int most) {
  constexpr std::array<int, 8> kMultiples = {2, 3, 4, 5, 6, 7, 8, 9};
  constexpr std::size_t kDecadesWithMultiples = 12;
  const auto powers = round_numbers(scale, std::array{1});
  if (powers.size() < 2) {
    const auto numbers = round_numbers(scale, std::array{1, 2, 5});
    std::vector<ChartTick> ticks =
        numbers.size() < 2
            ? linear_ticks(std::pow(10.0, scale.low), std::pow(10.0, scale.high), most)
            : numbered(numbers);
    if (numbers.size() > 1) add_minor(ticks, round_numbers(scale, kMultiples));
    return ticks;
  }
  const std::size_t stride = (powers.size() + most - 1) / most;
  std::vector<RoundNumber> labelled;
  for (std::size_t i = 0; i < powers.size(); i += stride) labelled.push_back(powers[i]);
  std::vector<ChartTick> ticks = numbered(labelled);
  if (stride > 1) {
    add_minor(ticks, powers);
  } else if (powers.size() <= kDecadesWithMultiples) {
    add_minor(ticks, round_numbers(scale, kMultiples));
  }
  return ticks;
}

}  // namespace

void ChartExtent::include(double coordinate) {
  low = std::min(low, coordinate);
  high = std::max(high, coordinate);
}

bool ChartScale::shows(double value) const {
  // The span of an axis must be finite, too, and its ends must not be subnormal.
  constexpr double kLargest = 1e300;
  return std::abs(value) <= kLargest && (!logarithmic || value >= 1.0 / kLargest);
}

double ChartScale::coordinate(double value) const {
  return logarithmic ? std::log10(value) : value;
}

ChartScale chart_scale(ChartExtent points, ChartExtent lines, bool logarithmic) {
  if (points.empty()) points = lines;
  if (points.empty()) return {0.0, 1.0, logarithmic};
  auto [low, high] = points;
  const double size = std::max(std::abs(low), std::abs(high));
  const double least = logarithmic ? 1e-6 : std::max(1e-9 * size, 1e-300);
  if (high - low < least) {
    const double room = logarithmic || size < least ? 0.5 : 0.5 * size;
    low -= room;
    high += room;
  }
  const double span = high - low;
  if (!lines.empty()) {
    low = std::min(low, std::max(lines.low, low - span));
    high = std::max(high, std::min(lines.high, high + span));
  }
  constexpr double kRoom = 0.06;
  const double room = kRoom * (high - low);
  if (!logarithmic) return {low - room, high + room};
  constexpr double kMostDecades = std::numeric_limits<double>::max_exponent10 - 1;
  return {std::max(low - room, -kMostDecades), std::min(high + room, kMostDecades), true};
}

std::vector<ChartTick> chart_ticks(const ChartScale& scale, int most) {
  return scale.logarithmic ? logarithmic_ticks(scale, most)
                           : linear_ticks(scale.low, scale.high, most);
}

}  // namespace clatter
