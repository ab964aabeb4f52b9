#pragma once

#include <array>
#include <vector>

#include "app/view/messages.h"
#include "app/view/window_map.h"

namespace clatter {

/// Resizes the box by dragging its walls with the mouse, the right wall with Shift. A wall moves by
/// as much as the mouse, and a click changes nothing. Without Shift the right wall is a piston.
class WallGrip {
 public:
  /// A new box for the gas.
  struct Resized {
    VecX box;    ///< new size
    VecX shift;  ///< shift of the particles, which keeps them at their places on the viewport
  };

  /// Area where a wall can be grabbed: a strip along an edge of the box up to the piston, just
  /// outside of it, where there are no particles to pick.
  struct Handle {
    Side side;
    std::array<ImVec2, 2> edge;  ///< ends of the edge, window units
    ImVec2 outward;              ///< width of the strip, from the edge
    ImVec2 unit;                 ///< motion of the wall on the viewport per diameter along its axis

    /// The smallest area around the strip.
    Area bounds() const;
  };

  /// Handles the mouse. Returns the new box when a moved wall is released. `over`: the mouse is
  /// over the viewport.
  std::optional<Resized> use(const WindowMap& map, const Frame& frame, bool over);
  /// Position on the x axis to which the mouse drags the piston; absent: it does not.
  std::optional<double> piston() const;
  /// Tooltip of the right wall under the mouse; nullptr: none.
  const char* help() const;
  /// True if a wall is under the mouse or being dragged.
  bool active() const { return grip_.has_value(); }
  /// Marks that wall, at its new position while it is dragged.
  void mark(ImDrawList& list, const WindowMap& map, const Frame& frame) const;

  /// The handles of all walls that can be grabbed. Disks have one at each side. Spheres have them
  /// at the edges of the outline of the box. Such an edge belongs to two sides, and grips the wall
  /// that moves outwards there.
  static std::vector<Handle> handles(const WindowMap& map, const Frame& frame);

 private:
  std::optional<Handle> grip_;  // wall under the mouse or being dragged
  bool held_ = false;
  bool moved_ = false;   // the held wall follows the mouse
  ImVec2 pressed_;       // position of the mouse at the press
  bool pushes_ = false;  // the held wall is the piston
  double start_ = 0.0;   // length of the box perpendicular to that wall, at the press
  double length_ = 0.0;  // the same where the mouse is
};

}  // namespace clatter
