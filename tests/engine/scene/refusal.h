#pragma once

#include <string>
#include <vector>

#include "engine/error.h"
#include "engine/scene/scene_file.h"

namespace clatter::testing {

/// The smallest scene.
inline const std::string kParticles = "[particles]\ncount = 10\n";

/// The message with which a scene is refused; empty where it is not.
inline std::string refusal(const std::string& text, const std::vector<Override>& overrides = {}) {
  try {
    parse_scene(text, "s.toml", overrides);
  } catch (const UserError& error) {
    return error.what();
  }
  return "";
}

/// Whether a text has a part.
inline bool has(const std::string& text, const std::string& part) {
  return text.find(part) != std::string::npos;
}

}  // namespace clatter::testing
