#pragma once

#include <functional>
#include <map>
#include <memory>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "app/film/compared_scenes.h"
#include "app/plots/history.h"
#include "app/plots/plots.h"
#include "app/system/program_job.h"
#include "app/view/controls.h"
#include "app/view/film_dialog.h"
#include "app/view/gallery.h"
#include "app/view/host.h"
#include "app/view/lecture.h"
#include "app/view/messages.h"
#include "app/view/mouse_tools.h"
#include "app/view/panel_visibility.h"
#include "app/view/piston_hand.h"
#include "app/view/playlist.h"
#include "app/view/script_log.h"
#include "app/view/session.h"
#include "app/view/timeline.h"
#include "app/view/unsaved_question.h"
#include "app/view/viewport.h"
#include "app/view/wall_grip.h"
#include "app/view/window_input.h"
#include "render/typography/fonts.h"
#include "render/typography/gui_layer.h"

namespace clatter {

/// Content of the window: viewport, panels, keyboard and mouse.
class Gui {
 public:
  Gui(Host& host, const Gl& gl, WindowInput& input, EngineLink& engine, ScriptLog& log);

  /// Starts a scene, and those `beside` it in step. With `until` they stop at that simulation time.
  void open(const Scene& scene, std::uint64_t seed, std::optional<double> until = {},
            const std::vector<Scene>& others = {});
  /// The scenes that follow each other by keys and buttons, instead of those of the gallery. The
  /// first one has been opened.
  void set_playlist(std::vector<PlaylistItem> playlist);
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
  bool may_close();
  /// Shows a message.
  void report(const std::string& message) { session_.report(message); }
  /// Handles the input and draws the next picture of the window.
  void draw();
  /// True while the window redraws without input: a film or pictures of the gallery are being made,
  /// a message is shown, or the tools of a lecture change.
  bool changes() const {
    return film_.has_value() || message_.shown() || (panels_.gallery && gallery_.busy()) ||
           (panels_.lecture && tools_.changes());
  }

 private:
  void begin();
  void use_keys();
  void before_loss(std::function<void()> action);
  void ask_about_changes();
  void answer_question(Answer answer);
  void use_question_key(const KeyPress& press);
  void use_function_key(const KeyPress& press);
  void use_key(const KeyPress& press, const std::string& typed);
  void use_control_key(const KeyPress& press);
  void use_signs(const std::string& typed);
  bool use_lecture_key(char key);
  void close_something();
  void lecture(bool on);
  void all_controls();
  std::vector<std::string> lecture_sliders() const;
  void lecture_panels();
  float caption_strip();
  void lecture_column();
  float slider_height(const std::string& name) const;
  float sliders_height(const std::vector<std::string>& names, std::size_t columns) const;
  void draw_sliders(const std::vector<std::string>& names, std::size_t columns);
  float lecture_bar();
  void stopwatch_button();
  void press_stopwatch();
  void toggle_pen();
  void lift_pen();
  void toggle_tool(Tool tool);
  bool bar_has_tools() const;
  void lecture_settings();
  bool choose_sliders(Lecture& lecture);
  bool choose_lecture_plot(Lecture& lecture);
  void scale_slider();
  void sound_control();
  void window_controls();
  bool use_pen(bool over);
  void paint_ink(ImDrawList& list, bool over) const;
  void step_scene(int step);
  float letters() const;
  View shown_view() const;
  void panels();
  float top_panel();
  void left_panel(float top, float width);
  void record();
  void plots_drawer(float top, float width);
  void plots();
  void sheets();
  float sheet_bar();
  void sheet();
  void chosen_controls();
  void observable_plots(float height);
  std::size_t profiled() const { return static_cast<std::size_t>(profiled_); }
  Axis profile_axis() const;
  void viewport();
  void use_viewport();
  void use_cells();
  void name_gases();
  void name_missing_controls();
  std::vector<PlottedGas> plotted_gases();
  void log_handles(const WindowMap& map) const;
  void open_gallery_scene(const EmbeddedFile& scene);
  void open_file(const std::string& file);
  void fix_range();
  void trace();
  void face_preset(char key);
  void screenshot();
  Scene recorded_beside(const Frame& gas, const std::string& file) const;
  std::vector<ComparedScene> recorded_beside(const std::string& file) const;
  std::vector<std::string> save_scenes();
  void copy_link();
  void open_film_dialog();
  void use_film_dialog();
  std::vector<std::string> prepared_film();
  void copy_command();
  void film();
  void play_sound();
  void watch_film();
  void film_screen();
  void add_to_screen_film(int x, int y, Size size);
  void stop_screen_film();

  Host& host_;
  const Gl* gl_;
  WindowInput& input_;
  ScriptLog& log_;
  Session session_;
  Controls controls_;
  Viewport viewport_;
  WallGrip wall_grip_;
  PistonHand piston_hand_;
  MouseTools mouse_tools_;
  Gallery gallery_;
  std::map<std::uint64_t, History> histories_;        // of the gases, by Frame::id
  std::vector<std::string> titles_;                   // of compared gases; empty: there is one
  std::vector<std::shared_ptr<const Scene>> titled_;  // scenes that have these titles
  bool differences_ = false;                          // plots show differences from the first gas
  Timeline timeline_;
  int profiled_ = 0;  // index into profile_names()
  int profile_axis_ = 0;
  std::string observable_;  // table_title() of the plotted table; unknown: the first
  FilmDialog film_dialog_;
  std::optional<ProgramJob> film_;
  std::string film_file_;  // file of the film that is made
  struct ScreenFilm {
    std::string file;
    double since;  // ImGui::GetTime() at its beginning
  };
  std::optional<ScreenFilm> screen_film_;
  GuiLayer gui_;
  PanelVisibility panels_;
  LectureTools tools_;
  std::map<std::string, float> slider_heights_;  // of the controls in lecture mode, pixels
  std::vector<PlaylistItem> playlist_;           // empty: the scenes of the gallery
  std::size_t at_ = 0;                           // of the scene in the playlist
  MessageNote message_;
  std::function<void()> delayed_;  // action after the question about unsaved changes; empty: none
  Answer typed_answer_ = Answer::None;            // to this question, by a key
  std::optional<std::string> title_;              // of the window; absent: name of the program
  std::uint64_t drawn_views_ = 0;                 // Session::views() at the last picture
  bool told_gallery_ = false;                     // the script log has the gallery as open
  Fonts fonts_;                                   // that are loaded
  float scale_ = 1.0f;                            // pixels per window unit
  Area area_;                                     // area of the viewport
  double wanted_scale_ = 1.0, text_scale_ = 1.0;  // of the slider, and of the texts
  float plot_heading_ = 0.0f;      // height of title and legend of the plot in lecture mode, pixels
  float bar_height_ = 0.0f;        // of the bar in lecture mode, pixels
  float strip_ = 0.0f;             // height of the strip with the chosen controls, pixels
  std::uint64_t checked_run_ = 0;  // run whose panels had the chosen controls
};

}  // namespace clatter
