#pragma once

#include <array>
#include <optional>

#include "app/view/controls.h"
#include "app/view/messages.h"
#include "app/view/script_log.h"
#include "app/view/session.h"

namespace clatter {

/// The strip under the picture with the time of the run: the present time, the head, changes of
/// laws and stops. A press or a drag of the mouse goes to a time, and one with Shift repeats a
/// stretch of time. A thin line below shows the other future; a click on it exchanges the futures.
class Timeline {
 public:
  /// Draws the strip along the lower edge of an area. Returns the height of the strip. Requires a
  /// frame.
  float draw(Session& session, Controls& controls, ScriptLog& log, const Area& area);

 private:
  void track(Session& session, ScriptLog& log, float width);
  void use_mouse(Session& session, double time);
  void mark_loop(Session& session, const std::array<double, 2>& loop);

  std::optional<double> loop_from_;  // start of the stretch that the mouse marks
  bool held_ = false;                // the mouse drags the present time
  bool played_ = false;              // the gas played before the drag
  bool backwards_ = false;           // and it played backwards
  double sent_ = 0.0;                // time of the last jump of the drag
};

}  // namespace clatter
