#include <fmt/format.h>
#include <imgui.h>

#include "app/view/panels.h"

namespace clatter {

static Recording film_of_screen(Controls& controls, std::optional<double> seconds, float width) {
  if (seconds) {
    const std::string label = fmt::format("Stop film, {:.0f} s###film", *seconds);
    const bool stops = controls.button("film", label.c_str(), "Downloads the film", width);
    return stops ? Recording::StopScreen : Recording::None;
  }
  const bool films =
      controls.button("film", "Film###film", "Films the gas as it is shown, from now on", width);
  return films ? Recording::FilmScreen : Recording::None;
}

Recording record_panel(Controls& controls, Films films, std::optional<double> filmed) {
  if (!controls.group("Record")) return Recording::None;
  Recording asked = Recording::None;
  const float width = ImGui::GetContentRegionAvail().x;
  if (controls.button("screenshot", "Screenshot", "A PNG of the view, with its scene inside (F2)",
                      width)) {
    asked = Recording::Screenshot;
  }
  if (controls.button("save", "Save scene", "The scene with all changes so far (Ctrl+S)", width)) {
    asked = Recording::SaveScene;
  }
  if (controls.button("restore", "Restore scene",
                      "Starts the scene as it was opened (Ctrl+Z returns to the changes)", width)) {
    asked = Recording::RestoreScene;
  }
  if (films != Films::OfRun) {
    if (films == Films::OfScreen) {
      const Recording film = film_of_screen(controls, filmed, width);
      if (film != Recording::None) asked = film;
    }
    if (controls.button("link", "Copy link", "A link that opens this scene with all changes so far",
                        width)) {
      asked = Recording::CopyLink;
    }
    return asked;
  }
  if (filmed) {
    const std::string label = fmt::format("Stop film, {:.0f} %###film", 100.0 * *filmed);
    if (controls.button("film", label.c_str(), "Keeps the frames filmed so far", width)) {
      asked = Recording::StopFilm;
    }
  } else if (controls.button("film", "Film...###film",
                             "Films the run, or a part of it, in the background", width)) {
    asked = Recording::Film;
  }
  return asked;
}

}  // namespace clatter
