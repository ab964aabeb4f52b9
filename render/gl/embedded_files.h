#pragma once

#include <span>

#include "engine/embedded_file.h"

namespace clatter {

/// The files of shaders/.
std::span<const EmbeddedFile> embedded_shaders();

/// The fonts for text: DejaVuSans.ttf.
std::span<const EmbeddedFile> embedded_fonts();

}  // namespace clatter
