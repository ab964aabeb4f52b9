#pragma once

#include <cstddef>
#include <string>
#include <string_view>
#include <vector>

#include "engine/embedded_file.h"
#include "engine/scene/scene.h"

namespace clatter {

/// Whether the file of a start state is read. A resumed run already has its particles. Without the
/// file the scene has no start state and, unless a key gives their number, no particles.
enum class StartFile { Read, Skip };

/// Location of the files that a scene names: the folder of the scene, or the gallery.
enum class Origin { Folder, Gallery };

/// A scene before it is parsed.
struct SceneText {
  std::string text;  ///< TOML
  std::string file;  ///< name for errors; with Origin::Folder its folder has the scene's files
  Origin origin = Origin::Folder;
};

/// Reads the scene at a path, or the gallery scene of that name, applies the overrides, and
/// validates the scene. Throws UserError with file, line, column, problem and fix.
Scene load_scene(const std::string& path_or_name, const std::vector<Override>& overrides = {},
                 StartFile start_file = StartFile::Read);

/// The text of the scene at a path, or of the gallery scene of that name. Throws UserError.
SceneText find_scene(const std::string& path_or_name);

/// Maximum size of the text of a scene, in bytes.
inline constexpr std::size_t kLargestScene = 1'000'000;

/// As load_scene, for a scene of the gallery.
Scene load_gallery_scene(const EmbeddedFile& scene, const std::vector<Override>& overrides = {});

/// As load_scene, from a text.
Scene parse_scene(const SceneText& source, const std::vector<Override>& overrides = {},
                  StartFile start_file = StartFile::Read);

/// As load_scene, from text. `file` is the name for errors; files that the scene names are relative
/// to its folder.
Scene parse_scene(std::string_view text, const std::string& file,
                  const std::vector<Override>& overrides = {},
                  StartFile start_file = StartFile::Read);

/// The scene with new values of some keys, and the same start state. Throws UserError if the result
/// is invalid. If no particle spins, the scene keeps the values, colours and fields of spins for
/// later.
Scene with_settings(const Scene& scene, const std::vector<Override>& settings);

/// The settings that give a scene the obstacles and partitions of this one.
std::vector<Override> fixture_settings(const Scene& scene);

/// The scene as a file that parses back to the same scene, every default written out.
std::string scene_to_toml(const Scene& scene);

/// The scene as a JSON object with the keys of the scene file, every default written out.
std::string scene_to_json(const Scene& scene);

}  // namespace clatter
