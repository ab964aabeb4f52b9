#pragma once

#include <charconv>
#include <optional>
#include <string_view>

namespace clatter {

/// The whole number that a text is; absent where it is anything else, or does not fit.
template <class T>
std::optional<T> whole_number(std::string_view text) {
  T number{};
  const char* end = text.data() + text.size();
  const auto [stopped, error] = std::from_chars(text.data(), end, number);
  if (error != std::errc() || stopped != end) return std::nullopt;
  return number;
}

}  // namespace clatter
