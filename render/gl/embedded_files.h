#pragma once

#include <span>

#include "engine/embedded_file.h"

namespace clatter {

/// The shaders of shaders/.
std::span<const EmbeddedFile> embedded_shaders();

/// The fonts that text is drawn with: DejaVuSans.ttf.
std::span<const EmbeddedFile> embedded_fonts();

}  // namespace clatter
