#pragma once

#include "app/view/controls.h"
#include "app/view/panel_visibility.h"
#include "app/view/session.h"

namespace clatter {

/// The bar at the top: scene, play and step buttons, speed, time, health, and the buttons that open
/// and close the parts of the window. In a narrow window it has only the scene, play, restart, and
/// time and health as far as there is room. Returns true if lecture mode was switched.
bool top_bar(Session& session, Controls& controls, PanelVisibility& shown);
/// One row with the controls that a narrow top bar lacks: steps and speed.
void step_row(Session& session, Controls& controls);
/// One row with play, restart, steps and speed, as far as they are shown.
void play_row(Session& session, Controls& controls);

}  // namespace clatter
