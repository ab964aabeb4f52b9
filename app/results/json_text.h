#pragma once

#include <nlohmann/json_fwd.hpp>
#include <string>

namespace clatter {

/// The text of a JSON value, indented by one space per level. Lists of plain values, such as series
/// and profiles, are on one line each.
std::string json_text(const nlohmann::ordered_json& json);

}  // namespace clatter
