#pragma once

#include <functional>
#include <string>
#include <vector>

#include "app/view/controls.h"
#include "app/view/panel_visibility.h"
#include "render/layers/gui_context.h"
#include "tests/support/temporary_folder.h"

namespace clatter {

/// Panels of the window without a window: Dear ImGui lays them out and takes a mouse that the test
/// moves; what they write is read as text.
class PanelDriver {
 public:
  using Panel = std::function<void(Session&, Controls&)>;

  /// Opens a scene, whose gas halts, and shows a panel.
  PanelDriver(const Scene& scene, Panel panel);

  /// The lines of the panel from top to bottom, down to a tooltip where there is one: names,
  /// symbols and values; what sliders and lists hold in braces.
  std::vector<std::string> lines();
  /// Where a widget is, as the script log tells it: left, top, width, height. Of several under one
  /// key the one of that number from the top.
  std::array<float, 4> place(const std::string& widget, std::size_t number = 0);
  /// Clicks on a place, or presses there, moves the mouse to another and lets go.
  void click(float x, float y) { drag(x, y, x); }
  void drag(float x, float y, float to_x);
  /// Moves the mouse to a place, where it rests.
  void point_at(float x, float y);
  /// Takes the engine's frames until one holds.
  void wait_for(const std::function<bool(const Frame&)>& holds);

  const Session& session() const { return session_; }

 private:
  void draw();

  testing::TemporaryFolder folder_;
  Worker worker_{60.0};
  ScriptLog log_;
  Session session_{worker_, log_};
  Controls controls_{session_, log_};
  GuiContext context_ = make_gui_context();
  Panel panel_;
  std::string text_;  // of the last picture
};

}  // namespace clatter
