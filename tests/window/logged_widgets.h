#pragma once

#include <doctest/doctest.h>

#include <algorithm>
#include <array>
#include <filesystem>
#include <nlohmann/json.hpp>
#include <optional>
#include <sstream>
#include <string>
#include <vector>

#include "tests/support/temporary_folder.h"

namespace clatter {

/// The events in a script log, oldest first.
inline std::vector<nlohmann::json> events_in(const std::filesystem::path& log) {
  std::vector<nlohmann::json> events;
  std::istringstream lines(testing::bytes_of(log));
  for (std::string line; std::getline(lines, line);) {
    events.push_back(nlohmann::json::parse(line));
  }
  return events;
}

/// The events in a script log that place a widget, oldest first.
inline std::vector<nlohmann::json> widgets_in(const std::filesystem::path& log) {
  std::vector<nlohmann::json> widgets = events_in(log);
  std::erase_if(widgets, [](const auto& event) { return event.at("event") != "widget"; });
  return widgets;
}

/// The newest event of a name in a script log. Fails the test if there is none.
inline nlohmann::json newest_event(const std::filesystem::path& log, const std::string& name) {
  nlohmann::json newest;
  for (const nlohmann::json& event : events_in(log)) {
    if (event.at("event") == name) newest = event;
  }
  CAPTURE(name);
  REQUIRE(!newest.is_null());
  return newest;
}

/// Whether the newest status in a script log answers all commands, and the gas is halted.
inline bool at_rest(const std::filesystem::path& log) {
  nlohmann::json sent = 0, status;
  for (const nlohmann::json& event : events_in(log)) {
    // Answers have the number of their command too.
    if (event.contains("command")) sent = std::max(sent, event["command"]);
    if (event["event"] == "status") status = event;
  }
  return status["handled"] == sent && status["plays"] == false;
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
