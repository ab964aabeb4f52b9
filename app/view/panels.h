#pragma once

#include "app/view/controls.h"
#include "app/view/session.h"

namespace clatter {

// The groups of the left panel. Each draws into the current ImGui window.

/// Number of disks and their collision laws.
void gas_panel(Session& session, Controls& controls);
/// Box, walls, gravity and bulk drive.
void box_panel(Session& session, Controls& controls);
/// Colours, heatmap, arrows and other layers of the picture.
void view_panel(Session& session, Controls& controls);
/// Settings that trade accuracy for speed, with their cost.
void accuracy_panel(Session& session, Controls& controls);
/// End of the colour range of the disks: a round number at or above twice the thermal speed.
double disk_colour_end(const Snapshot& snapshot);
/// Action of the record panel.
enum class Recording { None, Screenshot, SaveScene, CopyCommand, Film, StopFilm };
/// Buttons for pictures, scene files and films. `filmed` is the completed fraction of the current
/// film, 0..1; absent: no film. Returns the chosen action.
Recording record_panel(Controls& controls, std::optional<double> filmed);

}  // namespace clatter
