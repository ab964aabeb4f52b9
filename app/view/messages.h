#pragma once

#include <imgui.h>

#include <cstdint>
#include <string>

#include "app/view/controls.h"
#include "app/view/session.h"

namespace clatter {

/// A rectangle of the window, in window units.
struct Area {
  ImVec2 low, high;  ///< upper left and lower right corner
};

/// Whether a place is in an area.
inline bool contains(const Area& area, ImVec2 place) {
  return place.x >= area.low.x && place.y >= area.low.y && place.x < area.high.x &&
         place.y < area.high.y;
}

/// Draws a line with hints at the lower edge of the area.
void hint_line(const std::string& text, const Area& area);
/// Draws the progress of the scene that is being opened, or of its way to the time at which it was
/// saved, in the middle of the area. A button ends it.
void opening_note(Session& session, Controls& controls, const Area& area);
/// Shows each message of the session for some seconds, longer texts for longer. The message stays
/// while the mouse is over it.
class MessageNote {
 public:
  /// Draws the message, if any, at the lower edge of the area. Call it in every frame.
  void draw(const Session& session, const Area& area);
  /// True while a message is shown: the window then redraws without input.
  bool shown() const { return left_ > 0.0f; }

 private:
  std::uint64_t number_ = 0;  // Session::messages() of the message
  float left_ = 0.0f;         // seconds until it is gone
};
/// Draws the state of a particle beside its position `place` in the area.
void particle_label(const Frame& frame, std::size_t particle, bool follows, ImVec2 place,
                    const Area& area);
/// Draws the list of keys and mouse actions for a scene of this dimension, in the middle of a
/// window of `width` x `height`.
void help_window(int dimension, float width, float height);

/// Draws the goal of a scene and its suggestions along the lower edge of an area, with a button
/// that closes the strip. Returns the height of the strip; 0 if the scene has neither text.
float lesson_strip(const Scene& scene, const Area& area, Controls& controls, bool& open);

}  // namespace clatter
