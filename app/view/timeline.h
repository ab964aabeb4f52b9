#pragma once

#include "app/view/controls.h"
#include "app/view/messages.h"
#include "app/view/script_log.h"
#include "app/view/session.h"

namespace clatter {

/// The strip under the picture with the time of the run: the present time, the head, changes of
/// laws and stops. A press or a drag of the mouse goes to a time. A thin line below shows the other
/// future; a click on it exchanges the futures.
class Timeline {
 public:
  /// Draws the strip along the lower edge of an area. Returns the height of the strip. Requires a
  /// frame.
  float draw(Session& session, Controls& controls, ScriptLog& log, const Area& area);

 private:
  void track(Session& session, ScriptLog& log, float width);
  void use_mouse(Session& session, double time);

  bool held_ = false;       // the mouse drags the present time
  bool played_ = false;     // the gas played before the drag
  bool backwards_ = false;  // and it played backwards
  double sent_ = 0.0;       // time of the last jump of the drag
};

}  // namespace clatter
