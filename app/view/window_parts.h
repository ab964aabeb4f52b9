#pragma once

namespace clatter {

/// A sheet of a narrow window: a group of controls.
enum class Sheet { None, Run, Gas, View, Record, Plots, Lesson };

/// The open parts of the window.
struct PanelVisibility {
  bool panels = true;
  bool plots = false;
  bool gallery = false;
  bool help = false;
  bool lesson = true;    ///< strip with the goal of the scene
  bool lecture = false;  ///< lecture mode: projector theme, large text, no panels at first
  bool hint = true;      ///< line with hints, until the first input
  bool narrow = false;   ///< the window has room for one sheet instead of panels, plots and strip
  Sheet sheet = Sheet::None;  ///< the open sheet of a narrow window

  /// Whether the plots are shown.
  bool shows_plots() const { return narrow ? panels && sheet == Sheet::Plots : plots; }
  /// Opens or closes a part of the window that is a sheet in narrow windows: plots, strip, or a
  /// sheet of a narrow window.
  void toggle(Sheet part) {
    if (narrow) {
      sheet = sheet == part ? Sheet::None : part;
    } else if (part == Sheet::Plots) {
      plots = !plots;
    } else if (part == Sheet::Lesson) {
      lesson = !lesson;
    }
  }
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

class Controls;
class Host;
class MouseTools;
class ScriptLog;
class Session;
class TextScale;
class Viewport;

/// The parts of the window on which its panels act.
struct WindowParts {
  Host& host;
  ScriptLog& log;
  Session& session;
  Controls& controls;
  Viewport& viewport;
  MouseTools& mouse_tools;
  TextScale& text_scale;
  PanelVisibility& panels;
};

}  // namespace clatter
