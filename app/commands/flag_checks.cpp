#include "app/commands/flag_checks.h"

#include <charconv>
#include <cmath>
#include <cstdint>
#include <cstdio>
#include <cstdlib>
#include <string>

#include "engine/error.h"

namespace clatter {

// The whole of a text as a finite number; NaN where it is none.
static double number_in(const std::string& text) {
  char* end = nullptr;
  const double number = std::strtod(text.c_str(), &end);
  return !text.empty() && *end == '\0' && std::isfinite(number) ? number : NAN;
}

template <class Allows>
static CLI::Validator number_check(Allows allows, const std::string& wanted) {
  return CLI::Validator(
      [=](const std::string& text) {
        return allows(number_in(text)) ? "" : "'" + text + "' is wrong; give " + wanted;
      },
      "");
}

CLI::Validator positive_number() {
  return number_check([](double x) { return x > 0.0; }, "a number greater than 0");
}

CLI::Validator non_negative_number() {
  return number_check([](double x) { return x >= 0.0; }, "a number of at least 0");
}

CLI::Validator number_between(double low, double high) {
  char wanted[80];
  std::snprintf(wanted, sizeof wanted, "a number between %g and %g", low, high);
  return number_check([=](double x) { return x >= low && x <= high; }, wanted);
}

CLI::Validator share() {
  return CLI::Validator(
      [](std::string& text) -> std::string {
        const bool percent = text.ends_with('%');
        const double number = number_in(percent ? text.substr(0, text.size() - 1) : text);
        const double value = percent ? 0.01 * number : number;
        if (!(value > 0.0 && value < 1.0)) {
          return "'" + text + "' is wrong; give a share such as 1% or 0.01";
        }
        char digits[32];
        std::snprintf(digits, sizeof digits, "%.17g", value);
        text = digits;
        return "";
      },
      "");
}

CLI::Validator seed_number() {
  return CLI::Validator(
      [](const std::string& text) -> std::string {
        std::uint64_t seed = 0;
        const char* end = text.data() + text.size();
        const auto [stopped, error] = std::from_chars(text.data(), end, seed);
        if (error == std::errc() && stopped == end) return "";
        return "'" + text + "' is wrong; give a whole number between 0 and 18446744073709551615";
      },
      "");
}

Size parse_size(const std::string& text, Size least) {
  constexpr int kMax = 16384;
  Size size;
  char after;
  if (std::sscanf(text.c_str(), "%dx%d%c", &size.width, &size.height, &after) == 2 &&
      size.width >= least.width && size.height >= least.height && size.width <= kMax &&
      size.height <= kMax) {
    return size;
  }
  const auto text_of = [](int width, int height) {
    return std::to_string(width) + "x" + std::to_string(height);
  };
  throw UserError({"--size", 0, 0}, "'" + text + "' is no size that there can be",
                  "write WIDTHxHEIGHT, from " + text_of(least.width, least.height) + " to " +
                      text_of(kMax, kMax) + ", for instance 1280x720");
}

}  // namespace clatter
