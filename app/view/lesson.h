#pragma once

#include "app/view/controls.h"
#include "app/view/messages.h"

namespace clatter {

/// Draws the goal of a scene and its suggestions along the lower edge of an area, with a button
/// that closes the strip. Returns the height of the strip; 0 if the scene has neither text.
float lesson_strip(const Scene& scene, const Area& area, Controls& controls, bool& open);

}  // namespace clatter
