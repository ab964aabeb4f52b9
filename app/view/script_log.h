#pragma once

#include <array>
#include <chrono>
#include <map>
#include <nlohmann/json_fwd.hpp>
#include <string>

#include "engine/system/read_file.h"

namespace clatter {

/// Log of the window's events, one JSON object per line, for scripts that drive the window. Without
/// a file it writes nothing.
class ScriptLog {
 public:
  /// Opens `file`; empty: no log. Throws RunError if the file cannot be written.
  explicit ScriptLog(const std::string& file);

  /// Writes an event with its members, and the time since the start in seconds. Throws RunError.
  void event(const char* name, nlohmann::json members);
  /// Writes the rectangle of a widget, in window units, if it has changed. Throws RunError.
  void widget(const std::string& name, float x, float y, float width, float height);
  /// True if there is a file.
  bool on() const { return file_ != nullptr; }

 private:
  [[noreturn]] void fail() const;

  std::string name_;
  CStream file_;
  std::chrono::steady_clock::time_point began_ = std::chrono::steady_clock::now();
  std::map<std::string, std::array<float, 4>> widgets_;
};

}  // namespace clatter
