#pragma once

#include <concepts>
#include <functional>
#include <utility>

namespace clatter {

/// Thrown by long work that has found a request to stop. It is no error and has no message.
struct Interrupted {};

/// Number of short steps of work, of about a microsecond each, between two questions whether to
/// stop. The answer may need a clock, which takes longer than such a step in browsers.
inline constexpr unsigned kStepsPerQuestion = 16;

/// Whether long work must stop. Work asks often and on several threads, so the answer must be fast
/// and thread-safe.
class StopRequest {
 public:
  /// Never stops.
  StopRequest() = default;
  /// Stops once `asked` returns true.
  template <std::predicate Asked>
  StopRequest(Asked asked) : asked_(std::move(asked)) {}

  /// Whether the work must stop.
  bool made() const { return asked_ && asked_(); }
  /// Throws Interrupted if the work must stop.
  void check() const {
    if (made()) throw Interrupted();
  }

 private:
  std::function<bool()> asked_;
};

}  // namespace clatter
