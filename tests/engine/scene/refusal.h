#pragma once

#include <string>
#include <vector>

#include "engine/scene/scene_file.h"
#include "tests/support/messages.h"

namespace clatter::testing {

/// The smallest scene.
inline const std::string kParticles = "[particles]\ncount = 10\n";
/// The smallest of spheres.
inline const std::string kSpheres = "[box]\nsize = [20, 20, 20]\n" + kParticles;

/// The message with which a scene's text is refused; empty where it is not.
inline std::string refusal(const std::string& text, const std::vector<Override>& overrides = {}) {
  return refusal_of([&] { parse_scene(text, "s.toml", overrides); });
}

/// The message with which a file, or a name, is refused; empty where it is not.
inline std::string load_refusal(const std::string& name,
                                const std::vector<Override>& overrides = {}) {
  return refusal_of([&] { load_scene(name, overrides); });
}

}  // namespace clatter::testing
