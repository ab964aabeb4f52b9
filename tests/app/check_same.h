#pragma once

#include <doctest/doctest.h>

#include <cmath>
#include <nlohmann/json.hpp>
#include <string>

namespace clatter::testing {

/// Checks that two documents have the same keys, and numbers that are equal within rounding errors.
inline void check_same(const nlohmann::json& actual, const nlohmann::json& expected,
                       const std::string& place = "") {
  CAPTURE(place);
  if (expected.is_object()) {
    REQUIRE(actual.is_object());
    for (const auto& [key, value] : actual.items()) {
      CAPTURE(key);
      CHECK(expected.contains(key));
    }
    for (const auto& [key, value] : expected.items()) {
      CAPTURE(key);
      REQUIRE(actual.contains(key));
      check_same(actual[key], value, place + '/' + key);
    }
  } else if (expected.is_array()) {
    REQUIRE(actual.size() == expected.size());
    for (std::size_t k = 0; k < expected.size(); ++k) {
      check_same(actual[k], expected[k], place + '/' + std::to_string(k));
    }
  } else if (expected.is_number_float() && actual.is_number()) {
    const double value = expected;
    CHECK(std::fabs(actual.get<double>() - value) <= 1e-9 + 1e-5 * std::fabs(value));
  } else {
    CHECK(actual == expected);
  }
}

}  // namespace clatter::testing
