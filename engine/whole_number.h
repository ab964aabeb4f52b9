#pragma once

#include <charconv>
#include <cmath>
#include <optional>
#include <string_view>

namespace clatter {

/// The integer in a text; absent if the text is anything else, or the number does not fit T.
template <class T>
std::optional<T> whole_number(std::string_view text) {
  T number{};
  const char* end = text.data() + text.size();
  const auto [stopped, error] = std::from_chars(text.data(), end, number);
  if (error != std::errc() || stopped != end) return std::nullopt;
  return number;
}

/// The number in a text; absent if the text is anything else.
inline std::optional<double> real_number(std::string_view text) {
  return whole_number<double>(text);
}

/// The number in a text, which may have either sign; absent if the text is anything else.
template <class T>
std::optional<T> signed_number(std::string_view text) {
  if (text.starts_with('+') && !text.starts_with("+-")) text.remove_prefix(1);
  return whole_number<T>(text);
}

/// The finite number in a text, which may have a sign; absent if the text is anything else.
inline std::optional<double> finite_number(std::string_view text) {
  const std::optional<double> number = signed_number<double>(text);
  return number && std::isfinite(*number) ? number : std::nullopt;
}

}  // namespace clatter
