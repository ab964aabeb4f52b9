#pragma once

#include <CLI/CLI.hpp>

#include "render/camera.h"

namespace clatter {

/// Checks of the values of flags, whose messages say what to give. NaN and infinity never pass.
CLI::Validator positive_number();
CLI::Validator non_negative_number();
CLI::Validator number_between(double low, double high);
CLI::Validator whole_number_between(int low, int high);
/// Any text but an empty one.
CLI::Validator named_file();
/// Turns a share such as 1% or 0.01, more than 0 and less than 1, into its number.
CLI::Validator share();
/// Whole, and one of 64 bits: CLI11 itself takes -1 for the largest.
CLI::Validator seed_number();

/// The value WIDTHxHEIGHT of --size, in pixels. Throws UserError where it is none, or an extent is
/// not from the least to the largest one that an image has.
Size parse_size(const std::string& text, Size least);

/// A flag whose value is one of a few words, each of which stands for a value.
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
    return "'" + text + "' is none of " + wanted;
  };
  return CLI::Validator(convert, "");
}

}  // namespace clatter
