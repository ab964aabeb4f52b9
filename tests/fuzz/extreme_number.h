#pragma once

#include <array>
#include <cmath>
#include <random>
#include <string>

namespace clatter {

/// A number as a text: mostly an end of double precision, a limit of a key or a neighbour of one,
/// else of any magnitude between 1e-20 and 1e20.
inline std::string extreme_number(std::minstd_rand& random) {
  constexpr std::array kNumbers = {"0",
                                   "-0.0",
                                   "1",
                                   "-1",
                                   "2",
                                   "3",
                                   "5e-324",
                                   "2.3e-308",
                                   "1e-300",
                                   "1e-30",
                                   "1e-15",
                                   "1e-9",
                                   "1e-6",
                                   "1e-3",
                                   "0.5",
                                   "0.999999999999999",
                                   "1.0000000001",
                                   "10",
                                   "16",
                                   "1000",
                                   "1e3",
                                   "2000",
                                   "1e6",
                                   "1e9",
                                   "1e12",
                                   "1e15",
                                   "1e30",
                                   "1e100",
                                   "1e300",
                                   "1.7e308",
                                   "-1e308",
                                   "inf",
                                   "nan",
                                   "2147483647",
                                   "2147483648",
                                   "9223372036854775807"};
  if (random() % 4) return kNumbers[random() % kNumbers.size()];
  return std::to_string(std::pow(10.0, static_cast<double>(random() % 4000) / 100.0 - 20.0));
}

/// A list of 0, 1, 2, 3 or 100 such numbers.
inline std::string extreme_list(std::minstd_rand& random) {
  constexpr std::array kLengths = {0, 1, 2, 2, 2, 3, 100};
  std::string list;
  for (int k = kLengths[random() % kLengths.size()]; k > 0; --k) {
    list += extreme_number(random) + (k > 1 ? ", " : "");
  }
  return "[" + list + "]";
}

}  // namespace clatter
