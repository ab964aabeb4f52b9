#include "engine/scene/key_values.h"

#include <cmath>

#include "engine/text.h"

namespace clatter {

// The limits in words: "numbers between 0 and 1", "a number greater than 0".
static std::string within(const std::string& what, Limits limits) {
  if (limits.lowest == limits.highest) return number_text(limits.lowest);
  if (limits.above) {
    const bool bounded = limits.highest < Limits{}.highest;
    return what + " greater than " + number_text(limits.lowest) +
           (bounded ? " and at most " + number_text(limits.highest) : "");
  }
  if (limits.highest < Limits().highest) {
    return what + " between " + number_text(limits.lowest) + " and " + number_text(limits.highest);
  }
  if (std::isinf(limits.highest)) {
    return what + " of at least " + number_text(limits.lowest) + ", or inf";
  }
  return limits.lowest > Limits().lowest ? what + " of at least " + number_text(limits.lowest)
                                         : what;
}

// The number of values and their axes in words.
static std::string count_and_axes(const std::string& numbers, Limits limits, std::size_t size) {
  return (size == 2 ? "two " : "three ") + numbers + within("", limits) +
         (size == 2 ? ", along x and y" : ", along x, y and z");
}

std::string allowed_values(double, Limits limits) {
  return within("a number", limits);
}

std::string allowed_values(int, Limits limits) {
  return within("a whole number", limits);
}

std::string allowed_values(bool, Limits) {
  return "true or false";
}

std::string allowed_values(const std::string&, Limits) {
  return "a text between quotes";
}

std::string allowed_values(const std::vector<std::string>&, Limits limits) {
  const bool exact = limits.lowest == limits.highest;
  return std::string("a list of ") + (exact ? "" : "at most ") + number_text(limits.highest) +
         " texts between quotes";
}

std::string allowed_values(const Vec2&, Limits limits) {
  return count_and_axes("numbers", limits, 2);
}

std::string allowed_values(const std::vector<Vec2>&, Limits limits) {
  return "a list of points, each two numbers" + within("", limits);
}

std::string allowed_values(const VecX& numbers, Limits limits) {
  if (numbers.size() == 0) {
    return count_and_axes("numbers", limits, 2) + ", of spheres " +
           count_and_axes("numbers", limits, 3);
  }
  return count_and_axes("numbers", limits, static_cast<std::size_t>(numbers.size()));
}

std::string allowed_values(const std::vector<int>& numbers, Limits limits) {
  return count_and_axes("whole numbers", limits, numbers.size());
}

std::string allowed_values(const std::vector<double>& numbers, Limits limits) {
  return "a list of " + counted(numbers.size(), "number") + within("", limits);
}

std::string allowed_values(const ColourRange&, Limits limits) {
  return "\"auto\", \"locked\" or two numbers [low, high] with low < high, neither beyond " +
         number_text(limits.highest) + " nor closer than " + number_text(ColourRange::kLeastWidth);
}

std::string allowed_values(const Rgb&, Limits) {
  return "a colour as \"#rrggbb\", for instance \"#ffffff\"";
}

}  // namespace clatter
