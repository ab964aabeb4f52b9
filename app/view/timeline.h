#pragma once

#include <algorithm>
#include <array>
#include <cstddef>
#include <optional>

#include "app/view/controls.h"
#include "app/view/messages.h"
#include "app/view/script_log.h"
#include "app/view/session.h"

namespace clatter {

/// The strip under the picture with the time of the run: the present time, the head, changes of
/// laws and stops. A press or a drag of the mouse goes to a time, and one with Shift repeats a
/// stretch of time. The mark of a change can be dragged. A thin line below shows the other future;
/// a click on it exchanges the futures.
class Timeline {
 public:
  /// Draws the strip along the lower edge of an area. Returns the height of the strip. Requires a
  /// frame.
  float draw(Session& session, Controls& controls, ScriptLog& log, const Area& area);

 private:
  // A press of the left button on the strip.
  struct Press {
    float place = 0.0f;                    // of the mouse, window units
    double time = 0.0;                     // there
    std::optional<std::size_t> mark = {};  // index of the change whose mark is dragged
    bool repeats = false;                  // marks a stretch to repeat
    bool played = false;                   // the gas played before
    bool backwards = false;                // and it played backwards
    std::optional<double> jumped_to = {};  // the last jump of the drag

    bool moved(float to) const { return to < place - 3.0f || to > place + 3.0f; }
    std::array<double, 2> stretch(double to) const {
      return {std::min(time, to), std::max(time, to)};
    }
  };

  void track(Session& session, ScriptLog& log, float width);
  void drag(Session& session, double time, double mark_time, float place);

  std::optional<Press> press_;  // while the button is down
};

}  // namespace clatter
