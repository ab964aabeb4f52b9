#pragma once

#include <array>
#include <functional>
#include <memory>
#include <nlohmann/json.hpp>
#include <string>
#include <vector>

#include "app/view/gui.h"
#include "render/context/context.h"
#include "render/output/image.h"
#include "render/typography/gui_context.h"
#include "tests/support/temporary_folder.h"

namespace clatter {

/// Tests the content of the whole window without a display. It is drawn off screen, and its texts
/// are read from the draw lists.
class OffscreenWindow {
 public:
  /// Opens a scene, and those beside it, in a window of this size. Waits until the gases are drawn.
  /// They halt at the simulation time `until`.
  explicit OffscreenWindow(const Scene& scene, float width = 1500.0f, float height = 950.0f,
                           double until = 0.0, const std::vector<Scene>& beside = {});
  ~OffscreenWindow();

  /// Draws the window once more.
  void draw();
  /// Draws the window until the engine has answered, the gas is halted and nothing changes without
  /// input.
  void settle();
  /// Presses the key of a letter.
  void press(char letter);
  /// Presses the key with this code of GLFW.
  void press_key(int key);
  /// Presses the keys of letters, and types their signs, all before the next picture.
  void type_all(const std::string& signs);
  /// Types a sign of ASCII.
  void type(char sign);
  /// Holds or releases the Shift key.
  void shift(bool down);
  /// Drops a scene of this text on the window.
  void drop(const std::string& scene);
  /// Moves the mouse to these shares of the width and height of a widget with this name in the
  /// script log.
  void point_at(const std::string& widget, float right, float down);
  /// Presses or releases the left button of the mouse.
  void hold(bool down);
  /// Clicks a widget.
  void click(const std::string& widget);
  /// The latest picture of all panels. Grey is in the place of the gas.
  Image picture();
  /// The rectangle of a widget as in the script log: left, top, width, height.
  std::array<float, 4> place(const std::string& widget) const;
  /// The newest event of a name in the script log. Fails the test if there is none.
  nlohmann::json logged(const std::string& event) const;
  /// The texts of the parts of the window whose names begin so, in drawing order. Line breaks are
  /// blanks.
  std::string text(const std::string& part) const;
  /// Draws the window until the condition holds, for some seconds. Returns whether it holds.
  bool comes_to(const std::function<bool()>& holds);
  /// Whether a part of the window gets these words within some seconds.
  bool comes_to_say(const std::string& part, const std::string& words);
  /// The tooltip of a widget; empty: none.
  std::string tooltip(const std::string& widget);
  /// Checks that each widget has a tooltip.
  void check_explained(const std::vector<std::string>& widgets);

 private:
  class NoDesktop;

  void point_at(const std::string& widget);

  testing::TemporaryFolder folder_;
  std::unique_ptr<GlContext> gl_ = open_context(Backend::Auto);
  GuiContext context_ = make_gui_context();
  CurrentContext current_{context_.get()};
  std::unique_ptr<NoDesktop> desktop_;
  WindowInput input_;
  ScriptLog log_;
  Worker worker_{60.0};
  std::unique_ptr<Gui> gui_;
};

}  // namespace clatter
