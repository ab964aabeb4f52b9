#pragma once

#include "app/view/controls.h"
#include "app/view/panel_visibility.h"
#include "app/view/session.h"

namespace clatter {

/// The slim bar above all: scene, play and steps, speed, time, health, and what is to be open.
void top_bar(Session& session, Controls& controls, PanelVisibility& shown);

}  // namespace clatter
