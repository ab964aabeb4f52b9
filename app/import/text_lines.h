#pragma once

#include <cstddef>
#include <filesystem>
#include <istream>
#include <memory>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

namespace clatter {

/// The words of a line. They point into its text, up to the next line.
using LineWords = std::vector<std::string_view>;

/// The words between blanks of a text.
LineWords words_of(std::string_view text);

/// The lines of a text file of particles, which gzip may have compressed. Its errors are UserErrors
/// with file and line.
class TextLines {
 public:
  /// How exponents of numbers begin.
  enum class Exponents {
    E,       ///< with e or E
    Fortran  ///< also with d or D
  };

  /// Opens a file. Throws if it cannot be read.
  explicit TextLines(const std::filesystem::path& path, Exponents exponents = Exponents::E);

  /// Moves to the next line; false at the end.
  bool next();
  /// Moves to the next line of a frame. Throws at the end.
  void require_next();
  /// Number of the line, from 1.
  int number() const { return number_; }
  /// The line, without its end.
  const std::string& text() const { return line_; }
  /// The words of the line.
  LineWords words() const { return words_of(line_); }

  /// The number in a word, which may be infinite or NaN; absent: the word is anything else.
  std::optional<double> number_in(std::string_view word) const;
  /// The finite number in a word. Throws for other words.
  double real(std::string_view word) const;
  /// The number of particles in a word. Throws for other words.
  std::size_t count(std::string_view word) const;
  /// Throws the error of this line.
  [[noreturn]] void refuse(const std::string& problem, const std::string& advice) const;
  /// Throws the error of an earlier line.
  [[noreturn]] void refuse_at(int line, const std::string& problem,
                              const std::string& advice) const;
  /// Throws the error of a file that ends within a frame.
  [[noreturn]] void refuse_end() const;

 private:
  std::filesystem::path path_;
  Exponents exponents_;
  std::unique_ptr<std::istream> text_;
  std::string line_;
  int number_ = 0;
};

}  // namespace clatter
