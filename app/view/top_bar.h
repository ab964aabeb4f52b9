#pragma once

#include "app/view/controls.h"
#include "app/view/session.h"
#include "app/view/window_parts.h"

namespace clatter {

/// Symbols of buttons that control the time.
enum class Icon { Play, Pause, Frame, Collision, Reset, CollisionBack, Back, Head };

/// Button with a symbol, and the line continues after it. Returns true if it was pressed.
bool icon_button(Controls& controls, const char* key, Icon icon, const char* help);

/// A button of the bar at the top whose action is left to the caller.
enum class BarButton { None, Sound, Lecture };

/// The bar at the top: scene, play and step buttons, speed, time, health, and the buttons that open
/// and close the parts of the window. In a narrow window it has only the scene, play, restart, and
/// time and health as far as there is room. Returns the pressed button.
BarButton top_bar(Session& session, Controls& controls, PanelVisibility& shown, bool has_sound);
/// The button of the sound, `width` pixels wide; 0: as its text. Returns whether it was pressed.
bool sound_button(const Session& session, Controls& controls, float width);
/// One row with the controls that a narrow top bar lacks: steps and speed.
void step_row(Session& session, Controls& controls);
/// One row with play, restart, steps and speed, as far as they are shown.
void play_row(Session& session, Controls& controls);

}  // namespace clatter
