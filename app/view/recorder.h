#pragma once

#include <optional>
#include <string>
#include <vector>

#include "app/film/compared_scenes.h"
#include "app/system/program_job.h"
#include "app/view/film_dialog.h"
#include "app/view/session.h"
#include "app/view/window_parts.h"
#include "render/camera.h"

namespace clatter {

/// Files of the gases in the window: pictures, scenes, films and links. A film is made of the run,
/// by a process of its own, or of the screen. `theme` is that of the picture in the window, which
/// the files get.
class Recorder {
 public:
  explicit Recorder(const WindowParts& parts);

  /// Draws the buttons of the record panel, and does their actions.
  void draw(Theme theme);
  /// Draws the dialog for a film if it is open, and does its action.
  void draw_dialog(Theme theme);
  /// Whether the dialog for a film is open.
  bool has_dialog() const { return film_dialog_.is_open(); }
  /// Closes the dialog without a film.
  void close_dialog() { film_dialog_.close(); }

  /// Writes the picture, with the scenes of its gases inside.
  void screenshot(Theme theme);
  /// Writes the scene of each gas. Returns the names of the files; none after an error.
  std::vector<std::string> save_scenes(Theme theme);

  /// Tells the end of a film of the run. Call it for each picture of the window.
  void update();
  /// Adds the picture that is now on the window to a film of the screen, if there is one. (x, y) is
  /// its upper left corner, in pixels.
  void add_picture(int x, int y, Size size);
  /// Whether a film of the run is being made.
  bool films() const { return film_.has_value(); }

 private:
  struct ScreenFilm {
    std::string file;
    double since;  // ImGui::GetTime() at its beginning
  };

  Scene recorded_beside(const Frame& gas, const std::string& file, Theme theme) const;
  std::vector<ComparedScene> recorded_beside(const std::string& file, Theme theme) const;
  void copy_link();
  void open_dialog();
  std::vector<std::string> prepared_film(Theme theme);
  void copy_command(Theme theme);
  void film(Theme theme);
  void film_screen();
  void stop_screen_film();

  Host& host_;
  ScriptLog& log_;
  Session& session_;
  Controls& controls_;
  Viewport& viewport_;
  FilmDialog film_dialog_;
  std::optional<ProgramJob> film_;
  std::string film_file_;  // file of the film that is made
  std::optional<ScreenFilm> screen_film_;
};

}  // namespace clatter
