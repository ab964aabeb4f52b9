#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "engine/scene/scene.h"

namespace clatter {

/// A scene of a playlist.
struct PlaylistItem {
  Scene scene;
  std::optional<std::uint64_t> seed;  ///< absent: that of the window
};

/// Reads a playlist: `schema = 1` and `scenes`, a list of names or of tables with `scene`, `set`
/// and `seed`. Names are those of the gallery or paths, relative to the folder of `file`. Throws
/// UserError with file, line, column, problem and fix.
std::vector<PlaylistItem> read_playlist(std::string_view text, const std::string& file);

/// As read_playlist, from a file.
std::vector<PlaylistItem> load_playlist(const std::string& file);

}  // namespace clatter
