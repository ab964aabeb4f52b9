#pragma once

#include <imgui.h>

#include <optional>

#include "app/view/session.h"

namespace clatter {

/// A rectangle of the window, in window units.
struct Area {
  ImVec2 low, high;  ///< upper left and lower right corner
};

/// Draws one line with hints at the lower edge of the area, for a scene of this dimension.
void hint_line(int dimension, const Area& area);
/// Draws the message of the session for 10 seconds. Returns true while it is shown.
bool session_message(const Session& session, const Area& area);
/// Draws the state of a particle beside its position `place` in the area.
void particle_label(const Frame& frame, std::size_t particle, bool follows, ImVec2 place,
                    const Area& area);
/// Draws the list of keys and mouse actions for a scene of this dimension, in the middle of a
/// window of `width` x `height`.
void help_window(int dimension, float width, float height);

}  // namespace clatter
