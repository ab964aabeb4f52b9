#pragma once

#include "app/view/controls.h"
#include "app/view/panel_visibility.h"
#include "app/view/session.h"

namespace clatter {

/// The bar at the top: scene, play and step buttons, speed, time, health, and the buttons that open
/// and close the parts of the window.
void top_bar(Session& session, Controls& controls, PanelVisibility& shown);

}  // namespace clatter
