#include "app/view/recorder.h"

#include <fmt/format.h>
#include <fmt/ranges.h>
#include <imgui.h>

#include <algorithm>
#include <array>
#include <cctype>
#include <cstring>
#include <filesystem>
#include <nlohmann/json.hpp>
#include <utility>

#include "app/runs/picture_scene.h"
#include "app/system/batch_script.h"
#include "app/system/exit_code.h"
#include "app/view/host.h"
#include "app/view/link.h"
#include "app/view/panels.h"
#include "app/view/viewport.h"
#include "engine/scene/scene_file.h"
#include "engine/scene/state_file.h"
#include "engine/system/write_file.h"

namespace clatter {

Recorder::Recorder(const WindowParts& parts)
    : host_(parts.host),
      log_(parts.log),
      session_(parts.session),
      controls_(parts.controls),
      viewport_(parts.viewport) {}

// The first free name: "clatter-1.png", "clatter-2.png", ... All extensions must be free, because a
// start state and a film of a scene share its name.
static std::string free_name(const std::string& extension) {
  for (int number = 1;; ++number) {
    const std::string name = "clatter-" + std::to_string(number);
    const auto is_taken = [&](const char* other) { return std::filesystem::exists(name + other); };
    if (std::ranges::none_of(
            std::array{".png", ".toml", ".csv", ".mp4", ".webm", ".gif", ".mov", ".mkv"},
            is_taken)) {
      return name + extension;
    }
  }
}

// The scene of a gas on screen. A start state that no file of the user has is written beside
// `file`, as .csv. Start states of the gallery are not files.
Scene Recorder::recorded_beside(const Frame& gas, const std::string& file, Theme theme) const {
  Scene scene = session_.recorded(gas);
  scene.view.theme = theme;
  Start& start = scene.particles.start;
  const bool copied = !host_.has_user_files() && std::filesystem::exists(start.file);
  if (start.layout == Layout::File && (start.file.empty() || copied)) {
    start.file = std::filesystem::path(file).replace_extension(".csv");
    write_file(start.file,
               std::visit([&](const auto& state) { return state_to_csv(state, scene.species); },
                          start.state));
    host_.deliver(start.file);
  }
  return scene;
}

// The scenes of all gases for a picture, whose start states have its name and a letter.
std::vector<ComparedScene> Recorder::recorded_beside(const std::string& file, Theme theme) const {
  std::vector<ComparedScene> scenes;
  for (const Frame* gas : frames_of(session_.frame())) {
    std::filesystem::path own = file;
    if (gas->gas > 0) {
      own.replace_filename(own.stem().string() + '-' + static_cast<char>('a' + gas->gas));
    }
    scenes.push_back({recorded_beside(*gas, own.string(), theme), gas->seed});
  }
  return scenes;
}

void Recorder::screenshot(Theme theme) {
  if (!viewport_.drawn()) return;
  try {
    const std::string name = free_name(".png");
    write_png(name, viewport_.picture(), picture_texts(recorded_beside(name, theme)));
    host_.deliver(name);
    session_.set_saved();
    log_.event("screenshot", {{"file", name}});
    session_.report("Screenshot: " + name);
  } catch (const std::exception& error) {
    session_.report(error.what());
  }
}

std::vector<std::string> Recorder::save_scenes(Theme theme) {
  if (!session_.frame().scene) return {};
  try {
    std::vector<std::string> names;
    for (const Frame* gas : frames_of(session_.frame())) {
      names.push_back(free_name(".toml"));
      write_file(names.back(), scene_to_toml(recorded_beside(*gas, names.back(), theme)));
      host_.deliver(names.back());
      log_.event("saved", {{"file", names.back()}});
    }
    session_.set_saved();
    session_.report(fmt::format("Saved: {}", fmt::join(names, ", ")));
    return names;
  } catch (const std::exception& error) {
    session_.report(error.what());
  }
  return {};
}

void Recorder::copy_link() {
  if (!session_.frame().scene) return;
  try {
    const std::string link =
        host_.link_to(link_of(session_.recorded(session_.frame()), session_.frame().seed));
    host_.copy(link);
    log_.event("link", {{"link", link}});
    session_.report("The link is in the clipboard");
  } catch (const std::exception& error) {
    session_.report(error.what());
  }
}

void Recorder::draw(Theme theme) {
  std::optional<double> filmed;
  if (film_) filmed = film_->done();
  if (screen_film_) filmed = ImGui::GetTime() - screen_film_->since;
  const Films films = host_.has_processes() ? Films::OfRun
                      : host_.recorder()    ? Films::OfScreen
                                            : Films::None;
  switch (record_panel(controls_, films, filmed)) {
    case Recording::Screenshot:
      screenshot(theme);
      break;
    case Recording::SaveScene:
      save_scenes(theme);
      break;
    case Recording::RestoreScene:
      session_.restore();
      break;
    case Recording::CopyLink:
      copy_link();
      break;
    case Recording::Film:
      open_dialog();
      break;
    case Recording::StopFilm:
      film_->interrupt();
      break;
    case Recording::FilmScreen:
      film_screen();
      break;
    case Recording::StopScreen:
      stop_screen_film();
      break;
    case Recording::None:
      break;
  }
}

void Recorder::open_dialog() {
  const Frame& frame = session_.frame();
  if (!frame.scene) return;
  film_dialog_.open({frame.head, frame.speed, session_.view().overlay,
                     !session_.view().plots.empty(), session_.view().pace},
                    free_name(".mp4"));
}

void Recorder::draw_dialog(Theme theme) {
  switch (film_dialog_.draw(controls_)) {
    case FilmDialog::Action::Film:
      return film(theme);
    case FilmDialog::Action::CopyCommand:
      return copy_command(theme);
    case FilmDialog::Action::Cancel:
    case FilmDialog::Action::None:
      return;
  }
}

// Saves the scenes of the film, and returns its command. No words: they could not be saved.
std::vector<std::string> Recorder::prepared_film(Theme theme) {
  const std::vector<std::string> scenes = save_scenes(theme);
  if (scenes.empty()) return {};
  return film_command(film_dialog_.film(), scenes, session_.frame().seed);
}

// Whether a shell reads a word as it is.
static bool is_plain(const std::string& word) {
  return std::ranges::all_of(word, [](char c) {
    return std::isalnum(static_cast<unsigned char>(c)) || std::strchr("._-/+", c) != nullptr;
  });
}

void Recorder::copy_command(Theme theme) {
  const std::vector<std::string> words = prepared_film(theme);
  if (words.empty()) return;
  std::string command;
  for (const std::string& word : words) {
    command += (command.empty() ? "" : " ") + (is_plain(word) ? word : shell_word(word));
  }
  host_.copy(command);
  log_.event("command", {{"line", command}});
  session_.report("Copied: " + command);
}

void Recorder::film(Theme theme) {
  std::vector<std::string> arguments = prepared_film(theme);
  if (arguments.empty()) return;
  try {
    arguments.insert(arguments.end(), {"--progress", "json"});
    film_.emplace(arguments);
    film_file_ = film_dialog_.film().file;
    session_.report("Filming into " + film_file_);
  } catch (const std::exception& error) {
    session_.report(error.what());
  }
}

void Recorder::update() {
  if (!film_) return;
  const auto code = film_->poll();
  if (!code) return;
  const bool made = *code == 0 || *code == kInterrupted;
  log_.event("film", {{"file", film_file_}, {"code", *code}});
  session_.report(made ? "Film: " + film_file_ : film_->message());
  film_.reset();
}

// Begins a film of the gas as the window shows it.
void Recorder::film_screen() {
  if (!viewport_.drawn()) return;
  try {
    ScreenRecorder& recorder = *host_.recorder();
    recorder.begin(viewport_.size());
    screen_film_ = {free_name(recorder.extension()), ImGui::GetTime()};
    session_.report("Stop film ends the film");
  } catch (const std::exception& error) {
    session_.report(error.what());
  }
}

// A film that the host no longer records ends.
void Recorder::add_picture(int x, int y, Size size) {
  if (!screen_film_) return;
  const std::string failure = host_.recorder()->add(x, y, size);
  if (failure.empty()) return;
  stop_screen_film();
  session_.report(failure);
}

void Recorder::stop_screen_film() {
  host_.recorder()->end(screen_film_->file);
  log_.event("film", {{"file", screen_film_->file}});
  session_.report("Film: " + screen_film_->file);
  screen_film_.reset();
}

}  // namespace clatter
