#pragma once

#include <cstddef>
#include <string>
#include <string_view>
#include <vector>

#include "engine/embedded_file.h"
#include "engine/scene/scene.h"

namespace clatter {

/// Whether the file of a start state is read. A run that goes on has its particles already: without
/// the file the scene has no start state and, unless a key gives their number, no particles.
enum class StartFile { Read, Skip };

/// Reads the scene at a path, or the gallery scene of that name, applies the overrides, and
/// validates the whole. Throws UserError with file, line, column, what is wrong and what to do.
Scene load_scene(const std::string& path_or_name, const std::vector<Override>& overrides = {},
                 StartFile start_file = StartFile::Read);

/// Most bytes that the text of a scene may have.
inline constexpr std::size_t kLargestScene = 1'000'000;

/// Like load_scene, of a scene in the gallery.
Scene load_gallery_scene(const EmbeddedFile& scene, const std::vector<Override>& overrides = {});

/// Like load_scene, from text; `file` is the name that errors carry, beside which the files lie
/// that the scene names.
Scene parse_scene(std::string_view text, const std::string& file,
                  const std::vector<Override>& overrides = {},
                  StartFile start_file = StartFile::Read);

/// The scene with keys set anew, and the same start state. Throws UserError where that makes no
/// scene.
Scene with_settings(const Scene& scene, const std::vector<Override>& settings);

/// The scene as a file that parses back to the same scene, every default written out.
std::string scene_to_toml(const Scene& scene);

/// The scene as a JSON object with the keys of the scene file, every default written out.
std::string scene_to_json(const Scene& scene);

}  // namespace clatter
