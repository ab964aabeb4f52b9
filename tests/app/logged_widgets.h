#pragma once

#include <array>
#include <filesystem>
#include <nlohmann/json.hpp>
#include <optional>
#include <sstream>
#include <string>
#include <vector>

#include "tests/support/temporary_folder.h"

namespace clatter {

/// The events in a script log that place a widget, oldest first.
inline std::vector<nlohmann::json> widgets_in(const std::filesystem::path& log) {
  std::vector<nlohmann::json> widgets;
  std::istringstream lines(testing::bytes_of(log));
  for (std::string line; std::getline(lines, line);) {
    auto event = nlohmann::json::parse(line);
    if (event.at("event") == "widget") widgets.push_back(std::move(event));
  }
  return widgets;
}

/// The newest rectangle of a widget in a script log: left, top, width, height. Absent: none.
inline std::optional<std::array<float, 4>> place_in(const std::filesystem::path& log,
                                                    const std::string& widget) {
  std::optional<std::array<float, 4>> place;
  for (const nlohmann::json& event : widgets_in(log)) {
    if (event.at("name") == widget) place = event.at("place");
  }
  return place;
}

}  // namespace clatter
