#pragma once

#include <cstddef>
#include <cstdint>
#include <string>
#include <vector>

#include "app/view/controls.h"
#include "engine/scene/view.h"

namespace clatter {

/// Settings of a film of the run in the window.
struct FilmSettings {
  double from = 0.0;         ///< simulation time of the first frame
  double to = 0.0;           ///< simulation time of the end, > from
  double speed = 1.0;        ///< simulation time per second of film, > 0
  char quality = 'm';        ///< as of `clatter render --quality`: l, m or h
  std::string file;          ///< name; the extension selects the format
  bool overlay = true;       ///< title, time, colour bars and scale bar
  bool plots = false;        ///< plots beside the gas
  bool own_plots = false;    ///< whether the scene has plots
  bool sound = false;        ///< a click at each collision, where the format has sound
  bool motion_blur = false;  ///< a shutter that is open for half of the time
  bool transparent = false;  ///< no background, where the format has alpha
};

/// The run of which the dialog makes a film.
struct FilmedRun {
  double latest = 0.0;             ///< latest simulation time
  double speed = 1.0;              ///< simulation time per second, as it is shown
  bool overlay = true;             ///< whether its pictures have title, figures and scales
  bool plots = false;              ///< whether its scene has plots
  std::vector<PaceKey> pace = {};  ///< of its films, see View::pace
};

/// A film format that the dialog offers.
struct FilmFormat {
  const char* extension;  ///< with its dot
  const char* use;        ///< label in the list
  bool sound;             ///< whether it may have sound
  bool alpha;             ///< whether it may be transparent
};

/// The offered formats.
const std::vector<FilmFormat>& film_formats();

/// The words of `clatter render` for a film of these scene files. Values of the command that are
/// its defaults are left out, and settings that the film cannot have.
std::vector<std::string> film_command(const FilmSettings& film,
                                      const std::vector<std::string>& scenes, std::uint64_t seed);

/// The dialog for a film of the run, in the middle of the window. It blocks all other widgets.
class FilmDialog {
 public:
  /// Action that ends the dialog, or none yet.
  enum class Action { None, Film, CopyCommand, Cancel };

  /// Opens the dialog for a run, and proposes the whole run, its speed and a new file. Other
  /// settings stay as they were.
  void open(const FilmedRun& run, const std::string& file);
  /// Whether it is open.
  bool is_open() const { return open_; }
  /// Ends the dialog without a film.
  void close();
  /// Draws the dialog if it is open. Returns the action of the user.
  Action draw(Controls& controls);
  /// The settings.
  const FilmSettings& film() const { return film_; }

 private:
  double begin_of_last(double seconds) const;
  void choose_times(Controls& controls);
  void choose_form(Controls& controls);
  void choose_content(Controls& controls);
  Action choose_action(Controls& controls);
  std::string mistake() const;

  FilmSettings film_;
  FilmedRun run_;
  bool open_ = false;
};

}  // namespace clatter
