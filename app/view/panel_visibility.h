#pragma once

namespace clatter {

/// What of the window is open.
struct PanelVisibility {
  bool panels = true;
  bool plots = false;
  bool gallery = false;
  bool help = false;
  bool lesson = true;    ///< what there is to learn from the scene, and to try
  bool lecture = false;  ///< the projector's theme, large type, no panels
  bool hint = true;      ///< until the person has done something
};

}  // namespace clatter
