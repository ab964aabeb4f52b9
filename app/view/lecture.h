#pragma once

#include <array>
#include <cstdint>
#include <limits>
#include <optional>
#include <utility>

#include "app/view/lecture_sliders.h"
#include "app/view/lecture_tools.h"
#include "app/view/messages.h"
#include "app/view/mouse_tools.h"
#include "app/view/session.h"
#include "app/view/window_parts.h"
#include "render/charts/live_plot.h"

namespace clatter {

class SceneOpener;
class Timeline;

/// Lecture mode: the gas with some sliders, a large plot and the tools of a lecturer.
class LectureMode {
 public:
  LectureMode(const WindowParts& parts, PlotsPanel& plots, SceneOpener& opener);

  /// Enters or leaves lecture mode.
  void toggle();
  /// Draws the panels of lecture mode, and takes their places from the area of the gas.
  void draw(Area& area, Timeline& timeline);
  /// Takes a key. Returns whether it is one of lecture mode.
  bool use_key(char key);
  /// Closes the settings. Returns whether they were open.
  bool close_settings() { return std::exchange(settings_, false); }
  /// Shows or hides the large plot.
  void toggle_plot() { plot_ = !plot_; }
  /// Whether the large plot is a profile.
  bool shows_profile() const;
  /// The theme on screen. Lecture mode has one of its own.
  Theme theme() const { return panels_.lecture ? theme_ : session_.view().theme; }
  /// The view on screen.
  View shown_view() const;
  /// Whether the picture changes without input.
  bool changes() const;

  /// Chooses a mouse tool, or ends the same one. A tool puts the pen away.
  void toggle_tool(Tool tool);
  /// Puts the pen away.
  void lift_pen();
  /// Whether the mouse belongs to the pen.
  bool draws() const { return panels_.lecture && pen_; }
  /// Draws with the pen, over the gas or the large plot, and follows the pointer. With Shift the
  /// pen lays a slope triangle on the plot. `over`: the mouse is over the gas.
  void use_pen(bool over);
  /// Draws the lines of the pen, and the ring and trail of the pointer.
  void paint_ink(ImDrawList& list, bool over) const;

 private:
  float caption_strip(const Area& area);
  void column(Area& area);
  float bar();
  bool bar_has_tools() const;
  void stopwatch_button();
  void press_stopwatch();
  void toggle_pen();
  void wipe();
  void draw_slope(bool held);
  void paint_slope(ImDrawList& list) const;
  void draw_settings();
  bool choose_plot(Lecture& lecture);

  ScriptLog& log_;
  Session& session_;
  Controls& controls_;
  Viewport& viewport_;
  MouseTools& mouse_tools_;
  TextScale& text_scale_;
  PanelVisibility& panels_;
  PlotsPanel& plots_;
  SceneOpener& opener_;
  LectureSliders sliders_;
  bool pen_ = false;       // the mouse draws lines
  bool pointer_ = false;   // the pointer has a ring and a trail
  bool timeline_ = false;  // the timeline is shown
  bool captions_ = true;   // the caption of the scene is shown
  bool settings_ = false;  // the settings are shown
  bool plot_ = true;       // the large plot is shown
  Theme theme_ = Theme::Projector;
  FadingInk lines_{std::numeric_limits<double>::infinity(), 1.0};  // of the pen, until wiped
  std::optional<std::array<Vec2, 2>> slope_;  // ends of the triangle, points of the plot
  std::optional<PlotFrame> plot_frame_;       // of the large plot, while it is drawn
  FadingInk trail_{0.7, 0.7};  // of the pointer
  Stopwatch stopwatch_;
  std::uint64_t run_ = 0;      // the run that the stopwatch measures
  float plot_heading_ = 0.0f;  // height of title and legend of the plot, pixels
  float bar_height_ = 0.0f;    // pixels
};

}  // namespace clatter
