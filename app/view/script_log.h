#pragma once

#include <array>
#include <chrono>
#include <cstdio>
#include <map>
#include <memory>
#include <nlohmann/json_fwd.hpp>
#include <string>

namespace clatter {

/// Tells what the window does, a JSON object per line, for scripts that drive it. Without a file it
/// tells nothing.
class ScriptLog {
 public:
  /// Throws RunError where the file cannot be written; empty: none.
  explicit ScriptLog(const std::string& file);

  /// Writes an event with its members, and the seconds since the start.
  void event(const char* name, nlohmann::json members);
  /// Tells where a widget is, in pixels of the window, whenever that changes.
  void widget(const std::string& name, float x, float y, float width, float height);
  /// Whether there is a file.
  bool on() const { return file_ != nullptr; }

 private:
  struct Close {
    void operator()(std::FILE* file) const { std::fclose(file); }
  };

  std::unique_ptr<std::FILE, Close> file_;
  std::chrono::steady_clock::time_point began_ = std::chrono::steady_clock::now();
  std::map<std::string, std::array<float, 4>> widgets_;
};

}  // namespace clatter
