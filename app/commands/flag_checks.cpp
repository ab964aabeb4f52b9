#include "app/commands/flag_checks.h"

#include <fmt/format.h>

#include <cmath>
#include <cstdint>
#include <cstdlib>
#include <optional>
#include <string>

#include "app/film/film_limits.h"
#include "app/measure/accuracy_goal.h"
#include "engine/error.h"
#include "engine/whole_number.h"

namespace clatter {

// The finite number that the whole text represents; otherwise NaN.
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
      wanted);
}

CLI::Validator named_file() {
  return CLI::Validator(
      [](const std::string& name) {
        return name.empty() ? "the name is empty; name a file or folder" : "";
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
  return number_check([=](double x) { return x >= low && x <= high; },
                      fmt::format("a number between {:g} and {:g}", low, high));
}

CLI::Validator share() {
  return CLI::Validator(
      [](std::string& text) -> std::string {
        const std::optional<double> share = share_in(text);
        if (!share) return "'" + text + "' is wrong; give a share such as 1% or 0.01";
        text = fmt::format("{:.17g}", *share);
        return "";
      },
      "a share such as 1% or 0.01");
}

CLI::Validator whole_number_between(int low, int high) {
  const std::string wanted = fmt::format("a whole number between {} and {}", low, high);
  return CLI::Validator(
      [=](const std::string& text) -> std::string {
        const auto number = whole_number<int>(text);
        if (number && *number >= low && *number <= high) return "";
        return "'" + text + "' is wrong; give " + wanted;
      },
      wanted);
}

CLI::Validator seed_number() {
  return CLI::Validator(
      [](const std::string& text) -> std::string {
        if (whole_number<std::uint64_t>(text)) return "";
        return "'" + text + "' is wrong; give a whole number between 0 and 18446744073709551615";
      },
      "");
}

Size parse_size(const std::string& text, Size least) {
  const std::size_t cross = text.find('x');
  if (cross != std::string::npos) {
    const auto width = whole_number<int>(std::string_view(text).substr(0, cross));
    const auto height = whole_number<int>(std::string_view(text).substr(cross + 1));
    if (width && height && *width >= least.width && *height >= least.height &&
        *width <= kLongestSide && *height <= kLongestSide) {
      return {*width, *height};
    }
  }
  throw UserError({"--size", 0, 0}, "'" + text + "' is not a valid size",
                  "write WIDTHxHEIGHT, from " + size_text(least) + " to " +
                      size_text({kLongestSide, kLongestSide}) + ", for example 1280x720");
}

}  // namespace clatter
