#pragma once

#include <CLI/CLI.hpp>

#include "render/camera.h"

namespace clatter {

/// Checks of flag values. Their messages name the allowed values. NaN and infinity are errors.
CLI::Validator positive_number();
CLI::Validator non_negative_number();
CLI::Validator number_between(double low, double high);
CLI::Validator whole_number_between(int low, int high);
/// Any non-empty text.
CLI::Validator named_file();
/// Converts a share such as 1% or 0.01 to a number between 0 and 1, both excluded.
CLI::Validator share();
/// A whole number of 64 bits. CLI11 itself would read -1 as the largest number.
CLI::Validator seed_number();

/// Parses the value WIDTHxHEIGHT of --size, in pixels. Throws UserError if the form is wrong.
/// Throws it also if a side is less than `least` or more than the largest picture size.
Size parse_size(const std::string& text, Size least);

/// A flag with a fixed set of words as values.
template <class E>
CLI::Validator one_of(std::vector<std::pair<std::string, E>> words) {
  std::string wanted;
  for (const auto& [word, value] : words) wanted += (wanted.empty() ? "" : ", ") + word;
  const auto convert = [words, wanted](std::string& text) -> std::string {
    for (const auto& [word, value] : words) {
      if (text != word) continue;
      text = std::to_string(static_cast<int>(value));
      return "";
    }
    return "'" + text + "' is unknown; give one of " + wanted;
  };
  return CLI::Validator(convert, "");
}

}  // namespace clatter
