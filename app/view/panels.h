#pragma once

#include "app/view/controls.h"
#include "app/view/session.h"

namespace clatter {

// The groups of the left panel. Each draws into the ImGui window that is open.

/// The disks: how many, and what their collisions do.
void gas_panel(Session& session, Controls& controls);
/// The box, its sides, gravity, the bulk drive.
void box_panel(Session& session, Controls& controls);
/// What is drawn.
void view_panel(Session& session, Controls& controls);
/// The dials between speed and accuracy, with what they cost.
void accuracy_panel(Session& session, Controls& controls);
/// A round end for a range of the disks' colours: twice the thermal speed.
double disk_colour_end(const Snapshot& snapshot);
/// What a person asked the record panel for.
enum class Recording { None, Screenshot, SaveScene, CopyCommand, Film, StopFilm };
/// Pictures and files of what is on screen; how much of a film is done, where one is made.
Recording record_panel(Controls& controls, std::optional<double> filmed);

}  // namespace clatter
