#include "render/colour_range.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <functional>

#include "render/typeset_number.h"

namespace clatter {

double robust_extent(std::vector<double> values) {
  std::erase_if(values, [](double value) { return !std::isfinite(value); });
  if (values.empty()) return 0.0;
  const auto place = values.begin() + std::lround(0.98 * static_cast<double>(values.size() - 1));
  std::nth_element(values.begin(), place, values.end(),
                   [](double a, double b) { return std::abs(a) < std::abs(b); });
  return std::abs(*place);
}

double round_up(double value) {
  value = std::clamp(value, ColourRange::kLeastWidth, ColourRange::kLargestEnd);
  const double power = std::pow(10.0, std::floor(std::log10(value)));
  for (double step : {1.0, 1.5, 2.0, 3.0, 4.0, 5.0, 6.0, 8.0}) {
    // The tolerance keeps a round value from the next step despite rounding errors.
    if (value <= step * power * (1.0 + 1e-9)) return step * power;
  }
  return 10.0 * power;
}

double round_down(double value) {
  const double power = std::pow(10.0, std::floor(std::log10(value)));
  for (double step : {5.0, 2.0}) {
    if (step * power <= value) return step * power;
  }
  return power;
}

double steady_end(double end, double extent) {
  const bool fits = 0.5 * end <= extent && extent <= 1.05 * end;
  return extent > 0.0 && !fits ? round_up(extent) : end;
}

double SteadyExtent::follow(double extent, bool hold) {
  const bool kept = hold && held_;
  if (!kept) current_ = steady_end(current_, extent);
  held_ = hold && (held_ || extent > 0.0);
  return current_ > 0.0 ? current_ : 1.0;
}

// Multiples of `step` in [low, high], at most `most` + 1.
static std::vector<double> multiples_of(double step, double low, double high, int most) {
  std::vector<double> ticks;
  const double slack = 1e-9 * (high - low);
  // Counts from the first tick: far from zero in a narrow range, first + 1 may round to first.
  const double first = std::ceil((low - slack) / step);
  for (int i = 0; (first + i) * step <= high + slack && i <= most; ++i) {
    ticks.push_back((first + i) * step + 0.0);  // + 0 turns -0 into 0
  }
  return ticks;
}

std::vector<double> round_ticks(double low, double high, int count) {
  // Tries finer steps until the range has two distinct ticks.
  constexpr int kFiner = 8;
  for (int parts = count; parts <= count + kFiner; ++parts) {
    const double rough = (high - low) / parts;
    const double power = std::pow(10.0, std::floor(std::log10(rough)));
    double step = 10.0 * power;
    for (double candidate : {5.0, 2.0, 1.0}) {
      if (rough <= candidate * power * (1.0 + 1e-9)) step = candidate * power;
    }
    const std::vector<double> ticks = multiples_of(step, low, high, 2 * parts);
    const auto no_rise = std::ranges::adjacent_find(ticks, std::greater_equal());
    if (ticks.size() > 1 && no_rise == ticks.end()) return ticks;
  }
  return {low, high};
}

// The power of ten of the first digit. The tolerance is for inexact powers of ten.
static double order_of(double value) {
  return std::floor(std::log10(value) + 1e-9);
}

std::string tick_text(double value, double step) {
  const double magnitude = std::abs(value);
  const double place = order_of(step);  // power of ten of the last digit
  const bool plain = std::abs(place) <= 4.0;
  if (magnitude == 0.0 && !plain) return "0";
  const int digits = static_cast<int>(std::max(0.0, plain ? -place : order_of(magnitude) - place));
  const std::string text = plain ? fmt::format("{:.{}f}", magnitude, digits)
                                 : typeset_number(fmt::format("{:.{}e}", magnitude, digits));
  return value < 0.0 ? "−" + text : text;
}

}  // namespace clatter
