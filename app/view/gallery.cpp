#include "app/view/gallery.h"

#include <imgui.h>

#include <algorithm>
#include <cctype>

#include "engine/embedded_file.h"
#include "engine/scene/scene_file.h"

namespace clatter {

Gallery::Gallery() {
  for (const EmbeddedFile& file : embedded_scenes()) {
    const Scene scene = load_gallery_scene(file);
    entries_.push_back(
        {std::string(file.name.substr(0, file.name.rfind('.'))), scene.title, scene.caption});
  }
  std::ranges::sort(entries_, {}, &Entry::title);
}

static std::string lower(std::string text) {
  std::ranges::transform(text, text.begin(), [](unsigned char c) { return std::tolower(c); });
  return text;
}

std::optional<std::string> Gallery::draw(Controls& controls, float width, float height) {
  std::optional<std::string> chosen;
  const float unit = ImGui::GetFontSize();
  const ImVec2 size(std::min(46.0f * unit, 0.9f * width), std::min(40.0f * unit, 0.86f * height));
  ImGui::SetNextWindowPos(ImVec2(0.5f * width, 0.5f * height), 0, ImVec2(0.5f, 0.5f));
  ImGui::SetNextWindowSize(size);
  ImGui::PushStyleColor(ImGuiCol_WindowBg, ImGui::GetStyleColorVec4(ImGuiCol_PopupBg));
  ImGui::PushStyleVar(ImGuiStyleVar_WindowRounding, 0.5f * unit);
  ImGui::Begin("Gallery", nullptr,
               ImGuiWindowFlags_NoTitleBar | ImGuiWindowFlags_NoMove | ImGuiWindowFlags_NoResize |
                   ImGuiWindowFlags_NoCollapse | ImGuiWindowFlags_NoSavedSettings);
  if (ImGui::IsWindowAppearing()) {
    search_ = {};
    ImGui::SetKeyboardFocusHere();
  }
  ImGui::SetNextItemWidth(-FLT_MIN);
  const bool entered =
      ImGui::InputTextWithHint("##search", "Search the gallery", search_.data(), search_.size(),
                               ImGuiInputTextFlags_EnterReturnsTrue);
  ImGui::Spacing();
  ImGui::BeginChild("scenes");
  const std::string wanted = lower(search_.data());
  for (const Entry& entry : entries_) {
    if (lower(entry.name + ' ' + entry.title + ' ' + entry.caption).find(wanted) ==
        std::string::npos) {
      continue;
    }
    if (entered && !chosen) chosen = entry.name;
    const float wrap = ImGui::GetContentRegionAvail().x - unit;
    const float lines = ImGui::CalcTextSize(entry.caption.c_str(), nullptr, false, wrap).y;
    const ImVec2 at = ImGui::GetCursorPos();
    ImGui::PushID(entry.name.c_str());
    if (controls.card(("gallery." + entry.name).c_str(), 1.3f * unit + lines + 0.9f * unit)) {
      chosen = entry.name;
    }
    ImGui::PopID();
    const ImVec2 after = ImGui::GetCursorPos();
    ImGui::SetCursorPos(ImVec2(at.x + 0.5f * unit, at.y + 0.4f * unit));
    ImGui::BeginGroup();
    ImGui::TextUnformatted(entry.title.c_str());
    ImGui::PushTextWrapPos(at.x + 0.5f * unit + wrap);
    ImGui::PushStyleColor(ImGuiCol_Text, ImGui::GetStyleColorVec4(ImGuiCol_TextDisabled));
    ImGui::TextUnformatted(entry.caption.c_str());
    ImGui::PopStyleColor();
    ImGui::PopTextWrapPos();
    ImGui::EndGroup();
    ImGui::SetCursorPos(after);
  }
  ImGui::EndChild();
  ImGui::End();
  ImGui::PopStyleVar();
  ImGui::PopStyleColor();
  return chosen;
}

const std::string& Gallery::neighbour(const std::string& title, int step) const {
  const auto count = static_cast<int>(entries_.size());
  const auto found = std::ranges::find(entries_, title, &Entry::title);
  const int at = found == entries_.end() ? 0 : static_cast<int>(found - entries_.begin()) + step;
  return entries_[static_cast<std::size_t>((at + count) % count)].name;
}

}  // namespace clatter
