#pragma once

#include <functional>
#include <string>
#include <vector>

#include "app/view/controls.h"
#include "app/view/window_parts.h"
#include "render/typography/fonts.h"
#include "render/typography/gui_context.h"
#include "tests/support/temporary_folder.h"

namespace clatter {

/// Tests panels without a window. Dear ImGui lays them out and receives the mouse of the test. The
/// text is read from the draw lists.
class PanelDriver {
 public:
  using Panel = std::function<void(Session&, Controls&)>;

  /// Opens a scene with a halted gas, and shows a panel.
  PanelDriver(const Scene& scene, Panel panel);

  /// The lines of the panel from top to bottom: names, symbols and values. Values of sliders and
  /// lists are in braces. A tooltip, if any, comes last.
  std::vector<std::string> lines();
  /// The rectangle of a widget as in the script log: left, top, width, height.
  std::array<float, 4> place(const std::string& widget);
  /// Number of widgets in the script log so far.
  std::size_t widgets_told() const;
  /// Clicks at a position, or drags the mouse from there to another.
  void click(float x, float y) { drag(x, y, x); }
  void drag(float x, float y, float to_x);
  /// Moves the mouse to a position.
  void point_at(float x, float y);
  /// Takes frames of the engine until the condition holds.
  void wait_for(const std::function<bool(const Frame&)>& holds);

  Session& session() { return session_; }
  const Session& session() const { return session_; }

 private:
  void draw();

  testing::TemporaryFolder folder_;
  Worker worker_{60.0};
  ScriptLog log_;
  Session session_{worker_, log_};
  Controls controls_{session_, log_};
  GuiContext context_ = make_gui_context();
  Fonts fonts_;
  Panel panel_;
  std::string text_;  // of the last frame
};

}  // namespace clatter
