#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "engine/scene/scene_file.h"
#include "render/output/image.h"

namespace clatter {

/// The text of a scene as find_scene does. Also accepts a PNG picture of this program. Throws
/// UserError.
SceneText find_any_scene(const std::string& path_or_name);

/// Loads a scene as load_scene does. Also accepts a PNG picture of this program, which contains its
/// scene. Throws UserError.
Scene load_any_scene(const std::string& path_or_name, const std::vector<Override>& overrides = {},
                     StartFile start_file = StartFile::Read);

/// The texts inside a picture: title, program, seed and scene.
std::vector<PngText> picture_texts(const Scene& scene, std::uint64_t seed);

/// The seed inside a PNG picture of this program. Absent for any other file.
std::optional<std::uint64_t> seed_of_picture(const std::string& path);

}  // namespace clatter
