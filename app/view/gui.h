#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "app/view/controls.h"
#include "app/view/gallery.h"
#include "app/view/host.h"
#include "app/view/lecture.h"
#include "app/view/messages.h"
#include "app/view/mouse_tools.h"
#include "app/view/picture_mouse.h"
#include "app/view/playlist.h"
#include "app/view/plots_panel.h"
#include "app/view/recorder.h"
#include "app/view/scene_opener.h"
#include "app/view/script_log.h"
#include "app/view/session.h"
#include "app/view/style.h"
#include "app/view/timeline.h"
#include "app/view/viewport.h"
#include "app/view/window_input.h"
#include "app/view/window_parts.h"
#include "render/typography/fonts.h"
#include "render/typography/gui_layer.h"

namespace clatter {

/// Content of the window: viewport, panels, keyboard and mouse.
class Gui {
 public:
  Gui(Host& host, const Gl& gl, WindowInput& input, EngineLink& engine, ScriptLog& log);

  /// Starts a scene, and those `beside` it in step. With `until` they play from time 0 to that
  /// simulation time.
  void open(const Scene& scene, std::uint64_t seed, std::optional<double> until = {},
            const std::vector<Scene>& others = {}) {
    opener_.open(scene, seed, until, others);
  }
  /// The scenes that follow each other by keys and buttons, instead of those of the gallery. The
  /// first one has been opened.
  void set_playlist(std::vector<PlaylistItem> playlist) {
    opener_.set_playlist(std::move(playlist));
  }
  /// Shows the gas alone and the controls with these names, as in the script log. A message names
  /// those that the scene lacks.
  void embed(std::vector<std::string> controls) { controls_.choose(std::move(controls)); }
  /// Switches the sound of the gas on or off. If no device can be opened, a message says so.
  void listen(bool on);
  /// Whether a place of the window shows the gas and no panel.
  bool shows_gas(float x, float y) const;
  /// Whether the gas has changes by hand that no file has.
  bool unsaved() const { return session_.unsaved(); }
  /// Whether the window may close now. With unsaved changes it asks the user first, and closes
  /// after the answer.
  bool may_close() { return opener_.may_close(); }
  /// Shows a message.
  void report(const std::string& message) { session_.report(message); }
  /// Handles the input and draws the next picture of the window.
  void draw();
  /// True while the window redraws without input: a film or pictures of the gallery are being made,
  /// a message is shown, or the tools of a lecture change.
  bool changes() const {
    return recorder_.films() || message_.shown() || (panels_.gallery && gallery_.busy()) ||
           lecture_.changes();
  }

 private:
  WindowParts parts();
  void begin();
  void play_sound();
  void draw_picture();
  float letters() const;

  void use_keys();
  void use_function_key(const KeyPress& press);
  void use_key(const KeyPress& press, const std::string& typed);
  void use_control_key(const KeyPress& press);
  void use_signs(const std::string& typed);
  void close_something();

  void panels();
  float top_panel();
  void left_panel(float top, float width);
  void plots_drawer(float top, float width);
  void all_controls();
  void sound_control();
  void window_controls();
  void sheets();
  float sheet_bar();
  void sheet();
  void chosen_controls();
  void viewport();

  Host& host_;
  const Gl* gl_;
  WindowInput& input_;
  ScriptLog& log_;
  Session session_;
  Controls controls_;
  Viewport viewport_;
  MouseTools mouse_tools_;
  TextScale text_scale_;
  PanelVisibility panels_;
  Gallery gallery_;
  Timeline timeline_;
  PlotsPanel plots_;
  Recorder recorder_;
  SceneOpener opener_;
  LectureMode lecture_;
  PictureMouse mouse_;
  MessageNote message_;
  GuiLayer gui_;
  std::optional<std::string> title_;  // of the window; absent: name of the program
  std::uint64_t drawn_views_ = 0;     // Session::views() at the last picture
  bool told_gallery_ = false;         // the script log has the gallery as open
  Fonts fonts_;                       // that are loaded
  float scale_ = 1.0f;                // pixels per window unit
  Area area_;                         // area of the viewport
  float strip_ = 0.0f;                // height of the strip with the chosen controls, pixels
  std::uint64_t checked_run_ = 0;     // run whose panels had the chosen controls
};

}  // namespace clatter
