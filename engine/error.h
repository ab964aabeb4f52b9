#pragma once

#include <stdexcept>
#include <string>

namespace clatter {

/// Place of an error in the user's input. Line and column count from 1; 0 means unknown.
struct Place {
  std::string file;  ///< path, gallery name or "--set key"; empty: none
  int line = 0;
  int column = 0;
};

/// An error of the user in a scene, a flag or a file: `what()` is "file:line:column: problem;
/// advice". The program prints it and exits with 2.
class UserError : public std::runtime_error {
 public:
  /// `problem` describes the error and `advice` the fix; an empty advice is omitted.
  UserError(const Place& place, const std::string& problem, const std::string& advice);

  /// The place.
  const Place& place() const { return place_; }
  /// The problem, without the place.
  const std::string& problem() const { return problem_; }
  /// The fix; empty: none.
  const std::string& advice() const { return advice_; }

 private:
  Place place_;
  std::string problem_;
  std::string advice_;
};

/// A task cannot continue although the input is correct: a full disk, a missing encoder, a failed
/// check. The program prints it and exits with 1.
class RunError : public std::runtime_error {
  using std::runtime_error::runtime_error;
};

/// A physical reason ends the run: overlap, inelastic collapse, divergence. The message has place,
/// time, particles and a remedy. The program prints it and exits with 3.
class PhysicalStop : public std::runtime_error {
 public:
  /// `what` is the message with cause, place and time; for `remedy` see remedy().
  explicit PhysicalStop(const std::string& what, const std::string& remedy = "")
      : std::runtime_error(what), remedy_(remedy) {}

  /// The setting (key=value) with which the run can continue; empty if it is unknown.
  const std::string& remedy() const { return remedy_; }

 private:
  std::string remedy_;
};

}  // namespace clatter
