#pragma once

#include <doctest/doctest.h>

#include <cstdio>
#include <nlohmann/json.hpp>
#include <regex>
#include <sstream>
#include <string>
#include <utility>
#include <vector>

namespace clatter {

/// Checks that the last printed columns have the numbers of the JSON rows under `keys`, with these
/// formats of printf. A dash or a blank stands for null or for an absent key.
inline void check_columns(const std::string& out, const nlohmann::json& rows,
                          const std::string& heading,
                          const std::vector<std::pair<std::string, const char*>>& keys) {
  std::istringstream lines(out);
  std::string line;
  REQUIRE(std::getline(lines, line));
  CHECK(std::regex_replace(line, std::regex("^ +| +(?= )"), "") == heading);
  for (const nlohmann::json& row : rows) {
    REQUIRE(std::getline(lines, line));
    CAPTURE(line);
    CAPTURE(row.dump());
    std::string numbers;
    for (const auto& [key, format] : keys) {
      if (!row.contains(key)) continue;
      char text[64];
      if (row.at(key).is_null()) {
        std::snprintf(text, sizeof text, " -");
      } else {
        std::snprintf(text, sizeof text, format, row.at(key).get<double>());
      }
      numbers += text;
    }
    CHECK(std::regex_replace(line, std::regex(" +"), " ").ends_with(numbers));
  }
}

}  // namespace clatter
