#pragma once

#include <stdexcept>
#include <string>

namespace clatter {

/// Where in a person's input a mistake stands; line and column count from 1, 0 means unknown.
struct Place {
  std::string file;  ///< path, gallery name or "--set key"; empty where none applies
  int line = 0;
  int column = 0;
};

/// A person's mistake in a scene, a flag or a file: `what()` is "file:line:column: what, what to
/// do". The program prints it and exits with 2.
class UserError : public std::runtime_error {
 public:
  /// `problem` says what is wrong there and `advice` what to do; an empty advice is left out.
  UserError(const Place& place, const std::string& problem, const std::string& advice);

  /// What is wrong, without the place.
  const std::string& problem() const { return problem_; }
  /// What to do; empty: nothing to say.
  const std::string& advice() const { return advice_; }

 private:
  std::string problem_;
  std::string advice_;
};

/// What a person asked for cannot go on although nothing is wrong with the input (a full disk, a
/// missing encoder, a failed check); the program prints it and exits with 1.
class RunError : public std::runtime_error {
  using std::runtime_error::runtime_error;
};

/// A physical stop (overlap, collapse, no more room for motion): where, when, which particles, what
/// would help; the program prints it and exits with 3.
class PhysicalStop : public std::runtime_error {
 public:
  /// `what` says why, where and when; `remedy` is as remedy() gives it.
  explicit PhysicalStop(const std::string& what, const std::string& remedy = "")
      : std::runtime_error(what), remedy_(remedy) {}

  /// The key=value with which the run would carry on from where it stopped; empty where none is
  /// known.
  const std::string& remedy() const { return remedy_; }

 private:
  std::string remedy_;
};

}  // namespace clatter
