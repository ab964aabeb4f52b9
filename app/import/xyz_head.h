#pragma once

#include <array>
#include <map>
#include <string>
#include <vector>

#include "app/import/text_lines.h"

namespace clatter {

/// The keys and values of the second line of a frame of extended XYZ, see
/// https://github.com/libAtoms/extxyz. Its errors have the line. Keys have any case.
class XyzHead {
 public:
  /// Reads the present line.
  explicit XyzHead(const TextLines& lines);

  /// Whether the line has a key, in lower case.
  bool has(const std::string& key) const { return values_.contains(key); }
  /// The value of a key; empty: absent.
  std::string text(const std::string& key) const;
  /// The words of a value: an array in quotes, brackets or braces.
  std::vector<std::string> words(const std::string& key) const;
  /// `count` numbers of a key.
  std::vector<double> numbers(const std::string& key, std::size_t count) const;
  /// Three truth values of a key.
  std::array<bool, 3> truths(const std::string& key) const;

 private:
  std::string taken_key();
  std::string taken_value();
  std::string taken_text(char end);
  std::string taken_array();
  void skip_blanks();

  const TextLines& lines_;
  std::string_view rest_;
  std::map<std::string, std::string> values_;  // by key in lower case
};

}  // namespace clatter
