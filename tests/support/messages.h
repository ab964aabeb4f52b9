#pragma once

#include <string>

#include "engine/error.h"

namespace clatter::testing {

/// Whether a text contains a part.
inline bool says(const std::string& text, const std::string& part) {
  return text.find(part) != std::string::npos;
}

/// The message of the UserError that `action()` throws; empty without an error.
template <class Action>
std::string refusal_of(const Action& action) {
  try {
    action();
  } catch (const UserError& error) {
    return error.what();
  }
  return "";
}

}  // namespace clatter::testing
