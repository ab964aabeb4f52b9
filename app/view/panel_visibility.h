#pragma once

namespace clatter {

/// The open parts of the window.
struct PanelVisibility {
  bool panels = true;
  bool plots = false;
  bool gallery = false;
  bool help = false;
  bool lesson = true;    ///< strip with the goal of the scene
  bool lecture = false;  ///< lecture mode: projector theme, large text, no panels at first
  bool hint = true;      ///< line with hints, until the first input

  /// Opens or closes the gallery. Gallery and help are never open together.
  void toggle_gallery() {
    gallery = !gallery;
    help = false;
  }
  /// Opens or closes the list of keys.
  void toggle_help() {
    help = !help;
    gallery = false;
  }
  /// Shows the panels, or hides them and the plots.
  void toggle_panels() {
    panels = !panels;
    plots = plots && panels;
  }
};

}  // namespace clatter
