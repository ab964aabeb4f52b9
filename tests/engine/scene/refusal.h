#pragma once

#include <string>
#include <vector>

#include "engine/scene/scene_file.h"
#include "tests/support/messages.h"

namespace clatter::testing {

/// The smallest valid scene.
inline const std::string kParticles = "[particles]\ncount = 10\n";
/// The smallest valid scene of spheres.
inline const std::string kSpheres = "[box]\nsize = [20, 20, 20]\n" + kParticles;

/// The error message for the text of a scene; empty if it is valid.
inline std::string refusal(const std::string& text, const std::vector<Override>& overrides = {}) {
  return refusal_of([&] { parse_scene(text, "s.toml", overrides); });
}

/// The error message for a file or a name; empty if it is valid.
inline std::string load_refusal(const std::string& name,
                                const std::vector<Override>& overrides = {}) {
  return refusal_of([&] { load_scene(name, overrides); });
}

}  // namespace clatter::testing
