#pragma once

#include "app/view/controls.h"

namespace clatter {

/// Symbols of buttons that control the time.
enum class Icon { Play, Pause, Frame, Collision, Reset, CollisionBack, Back, Head };

/// Button with a symbol, and the line continues after it. Returns true if it was pressed.
bool icon_button(Controls& controls, const char* key, Icon icon, const char* help);

}  // namespace clatter
