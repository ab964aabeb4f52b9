#include "app/view/film_dialog.h"

#include <fmt/format.h>
#include <imgui.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <filesystem>
#include <utility>

#include "app/film/frame_times.h"
#include "engine/text.h"

namespace clatter {

namespace {

constexpr double kLastSeconds = 20.0;  // of the film, for its button
constexpr const char* kDialog = "film dialog";
constexpr const char* kPlots =  // of a scene without own plots
    R"(view.plots=["temperature", "energy", "density_profile"])";

struct QualityName {
  char letter;
  const char* name;
};

constexpr std::array<QualityName, 3> kQualities = {{{'l', "854 x 480, 15 per second"},
                                                    {'m', "1280 x 720, 30 per second"},
                                                    {'h', "1920 x 1080, 60 per second"}}};

// The format of a file name; nullptr: none.
const FilmFormat* format_of(const std::string& file) {
  const std::string extension = std::filesystem::path(file).extension().string();
  const auto& all = film_formats();
  const auto found = std::ranges::find(all, extension, &FilmFormat::extension);
  return found == all.end() ? nullptr : &*found;
}

// A time with few digits, for the command line.
double short_time(double time) {
  return std::stod(fmt::format("{:.6g}", time));
}

}  // namespace

const std::vector<FilmFormat>& film_formats() {
  static const std::vector<FilmFormat> all = {
      {".mp4", "MP4, plays everywhere", true, false},
      {".webm", "WebM, for web pages", true, true},
      {".gif", "GIF, for pages without a player", false, false},
      {".mov", "MOV (ProRes), for editing", true, true},
      {".mkv", "MKV, without loss", true, true}};
  return all;
}

std::vector<std::string> film_command(const FilmSettings& film,
                                      const std::vector<std::string>& scenes, std::uint64_t seed) {
  std::vector<std::string> words = {"clatter", "render"};
  const auto add = [&](bool needed, std::initializer_list<std::string> more) {
    if (needed) words.insert(words.end(), more);
  };
  const FilmFormat* format = format_of(film.file);
  words.insert(words.end(), scenes.begin(), scenes.end());
  add(true, {"--seed", std::to_string(seed)});
  add(film.from > 0.0, {"--from", number_text(film.from)});
  add(true, {"--to", number_text(film.to), "--speed", number_text(film.speed)});
  add(film.quality != 'm', {std::string("-q") + film.quality});
  add(!film.overlay, {"--set", "view.overlay=false"});
  if (film.plots != film.own_plots) {
    add(true, {"--set", film.plots ? kPlots : "view.plots=[]"});
  }
  add(film.sound && format && format->sound, {"--sound"});
  add(film.motion_blur, {"--shutter", "0.5"});
  add(film.transparent && format && format->alpha, {"--transparent"});
  add(true, {"--out", film.file});
  return words;
}

void FilmDialog::open(const FilmedRun& run, const std::string& file) {
  run_ = run;
  run_.latest = short_time(run.latest);
  film_.from = 0.0;
  film_.to = run_.latest;
  film_.speed = run.speed;
  film_.plots = film_.own_plots = run.plots;
  const FilmFormat* former = format_of(film_.file);
  film_.file = file;
  if (former)
    film_.file = std::filesystem::path(file).replace_extension(former->extension).string();
  open_ = true;
}

void FilmDialog::close() {
  open_ = false;
}

FilmDialog::Action FilmDialog::draw(Controls& controls) {
  const bool shown = ImGui::IsPopupOpen(kDialog);
  if (!open_ && !shown) return Action::None;
  if (!shown) ImGui::OpenPopup(kDialog);
  const ImVec2 whole = ImGui::GetIO().DisplaySize;
  const float unit = ImGui::GetFontSize();
  ImGui::SetNextWindowPos(ImVec2(0.5f * whole.x, 0.5f * whole.y), 0, ImVec2(0.5f, 0.5f));
  ImGui::SetNextWindowSize(ImVec2(std::min(26.0f * unit, whole.x), 0.0f));
  ImGui::SetNextWindowSizeConstraints(ImVec2(0.0f, 0.0f), whole);
  if (!ImGui::BeginPopupModal(kDialog, nullptr,
                              ImGuiWindowFlags_NoTitleBar | ImGuiWindowFlags_NoMove |
                                  ImGuiWindowFlags_NoSavedSettings)) {
    return Action::None;
  }
  Action action = Action::None;
  if (open_) {
    choose_times(controls);
    ImGui::Separator();
    choose_form(controls);
    ImGui::Separator();
    choose_content(controls);
    ImGui::Separator();
    action = choose_action(controls);
  }
  if (action != Action::None) open_ = false;
  if (!open_) ImGui::CloseCurrentPopup();
  ImGui::EndPopup();
  return action;
}

// The beginning of the last seconds of the film.
double FilmDialog::begin_of_last(double seconds) const {
  FrameTimes times{.from = 0.0, .speed = film_.speed, .pace = run_.pace};
  if (times.seconds_at(film_.to) <= seconds) return 0.0;
  double low = 0.0, high = film_.to;
  for (int step = 0; step < 60; ++step) {
    times.from = 0.5 * (low + high);
    (times.seconds_at(film_.to) > seconds ? low : high) = times.from;
  }
  return high;
}

// The stretch of simulation time, and the time that it takes in the film.
void FilmDialog::choose_times(Controls& controls) {
  const float gap = ImGui::GetStyle().ItemSpacing.x;
  const float half = 0.5f * (ImGui::GetContentRegionAvail().x - gap);
  if (controls.button("film.whole", "Whole run", "From time 0 to the latest time", half)) {
    film_.from = 0.0;
    film_.to = run_.latest;
  }
  ImGui::SameLine();
  const std::string last = fmt::format("Last {:g} s", kLastSeconds);
  if (controls.button("film.last", last.c_str(), "The last seconds of playing at this speed",
                      half)) {
    film_.to = run_.latest;
    film_.from = short_time(begin_of_last(kLastSeconds));
  }
  controls.entry("film.from", "From", "Simulation time of the first frame", film_.from);
  controls.entry("film.to", "To", "Simulation time of the end. It may be later than the run",
                 film_.to);
  controls.entry("film.speed", "Speed", "Simulation time per second of film", film_.speed);
  const FrameTimes at_speed_1{.from = film_.from, .pace = run_.pace};
  const double span = at_speed_1.seconds_at(film_.to);
  double length = span / film_.speed;
  if (controls.entry("film.length", "Length in s", "Length of the film. It sets the speed",
                     length)) {
    film_.speed = short_time(span / length);
  }
}

// Size, frame rate, file and format.
void FilmDialog::choose_form(Controls& controls) {
  std::vector<std::string> names;
  for (const QualityName& quality : kQualities) names.emplace_back(quality.name);
  const auto at = std::ranges::find(kQualities, film_.quality, &QualityName::letter);
  int chosen = static_cast<int>(at - kQualities.begin());
  if (controls.choice("film.quality", "Pictures", "Size in pixels, and frames per second", names,
                      chosen, chosen)) {
    film_.quality = kQualities[static_cast<std::size_t>(chosen)].letter;
  }
  names.clear();
  for (const FilmFormat& format : film_formats()) names.emplace_back(format.use);
  const FilmFormat* format = format_of(film_.file);
  chosen = format ? static_cast<int>(format - film_formats().data()) : 0;
  if (controls.choice("film.format", "Format", "The extension of the file", names, chosen,
                      chosen)) {
    const char* extension = film_formats()[static_cast<std::size_t>(chosen)].extension;
    film_.file = std::filesystem::path(film_.file).replace_extension(extension).string();
  }
  controls.entry("film.file", "File", "Name of the file", film_.file);
}

void FilmDialog::choose_content(Controls& controls) {
  if (run_.overlay) {
    controls.toggle("film.overlay", "Title, figures and scales",
                    "Time, temperature, colour bars and scale bar, too", film_.overlay);
  }
  controls.toggle("film.plots", "Plots beside the gas",
                  run_.plots ? "The plots of the scene, view.plots"
                             : "Temperature, energy and the profile of the density",
                  film_.plots);
  controls.toggle("film.blur", "Motion blur", "A shutter that is open for half of the time",
                  film_.motion_blur);
  const FilmFormat* format = format_of(film_.file);
  if (format && format->sound) {
    controls.toggle("film.sound", "Sound", "A click at each collision", film_.sound);
  }
  if (format && format->alpha) {
    controls.toggle("film.transparent", "Transparent", "No background", film_.transparent);
  }
}

// The mistake in the settings; empty: none.
std::string FilmDialog::mistake() const {
  if (!(film_.from >= 0.0) || !(film_.to > film_.from)) return "The film must end after its start";
  const bool has_speed = film_.speed > 0.0 && std::isfinite(film_.speed);
  if (!has_speed || !std::isfinite(film_.to)) return "The speed must be a number greater than 0";
  if (format_of(film_.file)) return "";
  std::string extensions;
  for (const FilmFormat& format : film_formats()) {
    extensions += (extensions.empty() ? "" : ", ") + std::string(format.extension);
  }
  return "The name of the file must end in one of " + extensions;
}

FilmDialog::Action FilmDialog::choose_action(Controls& controls) {
  const std::string problem = mistake();
  std::error_code none;
  if (!problem.empty()) {
    controls.note("film.mistake", problem);
  } else if (std::filesystem::exists(film_.file, none)) {
    controls.note("film.replaces", film_.file + " exists and will be replaced");
  } else {
    controls.note("film.saves", "The scene is saved beside the film");
  }
  constexpr struct {
    const char* key;
    const char* label;
    const char* help;
    Action action;
    bool needs_film;
  } kActions[] = {
      {"film.make", "Film", "Makes the film in the background. The gas keeps moving", Action::Film,
       true},
      {"film.command", "Copy command",
       "Puts the command line that makes this film into the clipboard", Action::CopyCommand, true},
      {"film.cancel", "Cancel", "No film (Esc)", Action::Cancel, false}};
  const float gap = ImGui::GetStyle().ItemSpacing.x;
  const float width = (ImGui::GetContentRegionAvail().x - 2.0f * gap) / 3.0f;
  Action chosen = Action::None;
  for (const auto& [key, label, help, action, needs_film] : kActions) {
    ImGui::BeginDisabled(needs_film && !problem.empty());
    if (controls.button(key, label, help, width)) chosen = action;
    ImGui::EndDisabled();
    ImGui::SameLine();
  }
  ImGui::NewLine();
  return chosen;
}

}  // namespace clatter
