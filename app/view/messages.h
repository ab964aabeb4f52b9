#pragma once

#include <imgui.h>

#include <optional>

#include "app/view/session.h"

namespace clatter {

/// The part of the window that shows the gas, in units of the window.
struct Area {
  ImVec2 low, high;
};

/// One line at the area's lower edge, until the person has done something.
void hint_line(const Area& area);
/// What the session has to tell, for some seconds; whether there is something.
bool session_message(const Session& session, const Area& area);
/// The state of a disk, beside its place in the area.
void disk_label(const Frame& frame, std::size_t disk, bool follows, ImVec2 place, const Area& area);
/// All keys and what the mouse does, in the middle of a window of that extent.
void help_window(float width, float height);

}  // namespace clatter
