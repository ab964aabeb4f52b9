#include "app/view/unsaved_question.h"

#include <imgui.h>

#include <array>

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
      {"unsaved.save", "Save", "Writes the scene with its changes (Enter)", Answer::Save},
      {"unsaved.discard", "Discard", "The changes are lost", Answer::Discard},
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

}  // namespace clatter
