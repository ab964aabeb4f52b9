#pragma once

#include <cstdint>
#include <optional>
#include <vector>

#include "app/view/session.h"

namespace clatter {

/// Moves the piston, the right wall, after the mouse. While the gas plays, the run records strokes
/// of a tenth of a second of playing, each at most as fast as the thermal speed. A drag is one undo
/// entry.
class PistonHand {
 public:
  /// Handles a frame. `wanted` is the position of the mouse on the x axis; absent: no drag.
  void use(Session& session, std::optional<double> wanted);

 private:
  struct Drag {
    std::uint64_t run;         // of the frame
    std::vector<Change> acts;  // strokes so far
  };

  void push(Session& session, double wanted);
  void release(Session& session);

  std::optional<Drag> drag_;
};

}  // namespace clatter
