#pragma once

#include "app/view/controls.h"
#include "app/view/messages.h"

namespace clatter {

/// Draws what there is to learn from a scene, and to try, along the lower edge of an area, with a
/// button that closes it. Returns the height that it takes; 0 where the scene says nothing of it.
float lesson_strip(const Scene& scene, const Area& area, Controls& controls, bool& open);

}  // namespace clatter
