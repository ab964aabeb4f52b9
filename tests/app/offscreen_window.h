#pragma once

#include <array>
#include <memory>
#include <string>
#include <vector>

#include "app/view/gui.h"
#include "render/context/context.h"
#include "render/layers/gui_context.h"
#include "tests/support/temporary_folder.h"

namespace clatter {

/// Tests the content of the whole window without a display. It is drawn off screen, and its texts
/// are read from the draw lists.
class OffscreenWindow {
 public:
  /// Opens a scene with a halted gas in a window of this size, and waits until it is drawn.
  explicit OffscreenWindow(const Scene& scene, float width = 1500.0f, float height = 950.0f);
  ~OffscreenWindow();

  /// Draws the window once more.
  void draw();
  /// Presses the key of a letter.
  void press(char letter);
  /// Presses the key with this code of GLFW.
  void press_key(int key);
  /// Clicks a widget with this name in the script log.
  void click(const std::string& widget);
  /// The rectangle of a widget as in the script log: left, top, width, height.
  std::array<float, 4> place(const std::string& widget) const;
  /// The texts of the parts of the window whose names begin so, in drawing order. Line breaks are
  /// blanks.
  std::string text(const std::string& part) const;
  /// Whether a part of the window gets these words within some seconds.
  bool comes_to_say(const std::string& part, const std::string& words);
  /// The tooltip of a widget; empty: none.
  std::string tooltip(const std::string& widget);
  /// Checks that the tooltip of each widget has these words.
  void check_help(const std::vector<std::pair<std::string, std::string>>& words_of_widgets);

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
