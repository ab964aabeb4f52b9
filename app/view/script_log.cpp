#include "app/view/script_log.h"

#include <array>
#include <cerrno>
#include <cstring>
#include <nlohmann/json.hpp>

#include "engine/error.h"

namespace clatter {

ScriptLog::ScriptLog(const std::string& file) : name_(file) {
  if (file.empty()) return;
  file_.reset(std::fopen(file.c_str(), "w"));
  if (!file_) fail();
}

void ScriptLog::fail() const {
  throw RunError("cannot write " + name_ + ": " + std::strerror(errno));
}

void ScriptLog::event(const char* name, nlohmann::json members) {
  if (!file_) return;
  const std::chrono::duration<double> since = std::chrono::steady_clock::now() - began_;
  members["event"] = name;
  members["at"] = since.count();
  const std::string line = members.dump() + '\n';
  if (std::fputs(line.c_str(), file_.get()) < 0 || std::fflush(file_.get()) != 0) fail();
}

void ScriptLog::widget(const std::string& name, float x, float y, float width, float height) {
  if (!file_) return;
  const std::array<float, 4> place = {x, y, width, height};
  const auto [known, is_new] = widgets_.try_emplace(name, place);
  if (!is_new && known->second == place) return;
  known->second = place;
  event("widget", {{"name", name}, {"place", place}});
}

}  // namespace clatter
