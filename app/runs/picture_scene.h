#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "engine/scene/scene_file.h"
#include "render/output/image.h"

namespace clatter {

/// Like load_scene, also of the scene inside a PNG picture that this program made. Throws
/// UserError.
Scene load_any_scene(const std::string& path_or_name, const std::vector<Override>& overrides = {},
                     StartFile start_file = StartFile::Read);

/// What a picture keeps of the run that it shows: title, program, seed and scene.
std::vector<PngText> picture_texts(const Scene& scene, std::uint64_t seed);

/// The seed inside a PNG picture that this program made; absent: the file is none.
std::optional<std::uint64_t> seed_of_picture(const std::string& path);

}  // namespace clatter
