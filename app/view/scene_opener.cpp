#include "app/view/scene_opener.h"

#define GLFW_INCLUDE_NONE
#include <GLFW/glfw3.h>
#include <fmt/format.h>
#include <imgui.h>

#include <array>
#include <nlohmann/json.hpp>
#include <utility>

#include "app/runs/picture_scene.h"
#include "app/view/gallery.h"
#include "app/view/host.h"
#include "app/view/plots_panel.h"
#include "app/view/recorder.h"
#include "engine/scene/scene_file.h"
#include "engine/text.h"

namespace clatter {

Answer unsaved_question(Controls& controls, const std::string& title, Answer typed) {
  constexpr const char* kName = "unsaved";
  constexpr struct {
    const char* key;
    const char* label;
    const char* help;
    Answer answer;
  } kAnswers[] = {
      {"unsaved.save", "Save", "Writes the scene with its changes (S)", Answer::Save},
      {"unsaved.discard", "Discard", "The changes are lost (D)", Answer::Discard},
      {"unsaved.cancel", "Cancel", "Keeps the gas in the window (Esc)", Answer::Cancel}};
  if (!ImGui::IsPopupOpen(kName)) ImGui::OpenPopup(kName);
  const ImVec2 whole = ImGui::GetIO().DisplaySize;
  ImGui::SetNextWindowPos(ImVec2(0.5f * whole.x, 0.5f * whole.y), 0, ImVec2(0.5f, 0.5f));
  Answer answer = typed;
  if (!ImGui::BeginPopupModal(kName, nullptr,
                              ImGuiWindowFlags_NoTitleBar | ImGuiWindowFlags_AlwaysAutoResize |
                                  ImGuiWindowFlags_NoMove | ImGuiWindowFlags_NoSavedSettings)) {
    return answer;
  }
  const float width = 6.0f * ImGui::GetFontSize(), gap = ImGui::GetStyle().ItemSpacing.x;
  ImGui::PushTextWrapPos(3.0f * width + 2.0f * gap + ImGui::GetStyle().WindowPadding.x);
  ImGui::TextUnformatted(
      ("Save the changes of " + (title.empty() ? "the scene" : in_quotes(title)) + "?").c_str());
  ImGui::PopTextWrapPos();
  ImGui::Spacing();
  for (const auto& [key, label, help, meant] : kAnswers) {
    if (controls.button(key, label, help, width)) answer = meant;
    ImGui::SameLine();
  }
  if (answer != Answer::None) ImGui::CloseCurrentPopup();
  ImGui::EndPopup();
  return answer;
}

SceneOpener::SceneOpener(const WindowParts& parts, const Gallery& gallery, PlotsPanel& plots,
                         Recorder& recorder)
    : host_(parts.host),
      log_(parts.log),
      session_(parts.session),
      controls_(parts.controls),
      panels_(parts.panels),
      gallery_(gallery),
      plots_(plots),
      recorder_(recorder) {}

void SceneOpener::open(Scene scene, std::uint64_t seed, std::optional<double> until,
                       const std::vector<Scene>& others) {
  if (until) scene.view.open_at.reset();
  plots_.measure_along(scene.measure.profile_axis);
  session_.open(scene, seed, !until, others);
  if (until) session_.play_until(*until);
}

void SceneOpener::open(const EmbeddedFile& scene) {
  before_loss([this, &scene] {
    panels_.gallery = false;
    open(load_gallery_scene(scene), session_.frame().seed);
  });
}

void SceneOpener::set_playlist(std::vector<PlaylistItem> playlist) {
  playlist_ = std::move(playlist);
}

void SceneOpener::step(int step) {
  if (playlist_.empty()) {
    return open(gallery_.neighbour(session_.opened().title, step));
  }
  const auto next = static_cast<std::size_t>(static_cast<std::ptrdiff_t>(at_) + step);
  if (next >= playlist_.size()) {
    return session_.report(step < 0 ? "This is the first scene of the playlist"
                                    : "This is the last scene of the playlist");
  }
  before_loss([this, next] {
    at_ = next;
    const auto& [scene, seed] = playlist_[next];
    open(scene, seed.value_or(session_.frame().seed));
  });
}

std::string SceneOpener::place() const {
  return playlist_.empty() ? "" : fmt::format("{}/{}", at_ + 1, playlist_.size());
}

void SceneOpener::open_file(const std::string& file) {
  try {
    const std::uint64_t seed = seed_of_picture(file).value_or(session_.frame().seed);
    before_loss([this, scene = load_any_scene(file), seed] { open(scene, seed); });
  } catch (const std::exception& error) {
    session_.report(error.what());
  }
}

// Does something by which unsaved changes are lost, after a question if there are any.
void SceneOpener::before_loss(std::function<void()> action) {
  if (!session_.unsaved() || panels_.lecture) return action();
  delayed_ = std::move(action);
}

bool SceneOpener::may_close() {
  if (!session_.unsaved()) return true;
  delayed_ = [this] {
    session_.set_saved();
    host_.close();
  };
  return false;
}

void SceneOpener::draw_question(Theme theme) {
  if (!delayed_) return;
  const Answer typed = std::exchange(typed_answer_, Answer::None);
  use(unsaved_question(controls_, session_.opened().title, typed), theme);
}

void SceneOpener::use(Answer answer, Theme theme) {
  if (answer == Answer::None) return;
  const std::function<void()> action = std::exchange(delayed_, nullptr);
  if (answer == Answer::Save) recorder_.save_scenes(theme);
  // A scene that could not be saved stays.
  const bool acts = answer == Answer::Discard || !session_.unsaved();
  log_.event("answer", {{"acts", acts}});
  if (acts) action();
}

void SceneOpener::press(const KeyPress& press) {
  if (press.sign == 's') typed_answer_ = Answer::Save;
  if (press.sign == 'd') typed_answer_ = Answer::Discard;
  if (press.key == GLFW_KEY_ESCAPE) typed_answer_ = Answer::Cancel;
}

}  // namespace clatter
