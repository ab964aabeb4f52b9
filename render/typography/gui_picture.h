#pragma once

#include <functional>

#include "render/context/gl.h"
#include "render/output/image.h"
#include "render/palette.h"

struct ImDrawList;
struct ImFontAtlas;

namespace clatter {

/// The picture that a function draws by Dear ImGui, with the fonts that another function has added
/// to the atlas before. Throws RunError if OpenGL does not support the size.
Image gui_picture(const Gl& gl, Size size, Colour background,
                  const std::function<void(ImFontAtlas&)>& add_fonts,
                  const std::function<void(ImDrawList&)>& draw);

}  // namespace clatter
