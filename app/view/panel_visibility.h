#pragma once

namespace clatter {

/// The open parts of the window.
struct PanelVisibility {
  bool panels = true;
  bool plots = false;
  bool gallery = false;
  bool help = false;
  bool lesson = true;    ///< strip with the goal of the scene
  bool lecture = false;  ///< lecture mode: projector theme, large text, no panels
  bool hint = true;      ///< line with hints, until the first input
};

}  // namespace clatter
