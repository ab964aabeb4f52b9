#pragma once

#include <cstdint>
#include <string>
#include <string_view>

#include "engine/scene/scene.h"

namespace clatter {

/// The most particles of a scene from a link: a page opens more too slowly.
inline constexpr int kMostInLink = 100'000;

/// A scene and its seed.
struct LinkedScene {
  Scene scene;
  std::uint64_t seed = 1;
};

/// Reads the fragment of a link, without '#'. It is the name of a gallery scene, or scene=TEXT with
/// a whole scene from link_of(). Settings may follow, each as &KEY=VALUE, and &seed=NUMBER. A value
/// is TOML; quotes of words may be left out. An empty fragment is the scene "vibrated". Throws
/// UserError.
LinkedScene read_link(std::string_view fragment);

/// The fragment of a link that opens this scene. Throws UserError if the scene has a start state.
std::string link_of(const Scene& scene, std::uint64_t seed);

}  // namespace clatter
