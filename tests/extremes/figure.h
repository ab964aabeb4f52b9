#pragma once

#include <cstdio>
#include <string>

namespace clatter::testing {

/// A number for the table, with two digits.
inline std::string brief(double figure) {
  char text[32];
  std::snprintf(text, sizeof text, "%.2g", figure);
  return text;
}

}  // namespace clatter::testing
