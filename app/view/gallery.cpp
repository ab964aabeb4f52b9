#include "app/view/gallery.h"

#define GLFW_INCLUDE_NONE
#include <GLFW/glfw3.h>
#include <imgui.h>

#include <algorithm>
#include <cctype>
#include <cstdint>

#include "engine/embedded_file.h"
#include "engine/scene/scene_file.h"

namespace clatter {

Gallery::Gallery(const Gl& gl) : thumbnails_(gl, [] { glfwPostEmptyEvent(); }) {
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

// Its picture, its title, and what to watch.
bool Gallery::draw_card(const Entry& entry, Controls& controls) {
  const float unit = ImGui::GetFontSize();
  const float height = 5.6f * unit, edge = 0.4f * unit;
  const float width = (height - 2.0f * edge) * Thumbnails::kSize.width / Thumbnails::kSize.height;
  const ImVec2 at = ImGui::GetCursorPos();
  const ImVec2 corner = ImGui::GetCursorScreenPos();
  ImGui::PushID(entry.name.c_str());
  const bool clicked = controls.card(("gallery." + entry.name).c_str(), height);
  ImGui::PopID();
  const ImVec2 after = ImGui::GetCursorPos();
  if (const GLuint texture = thumbnails_.of(entry.name)) {
    ImGui::GetWindowDrawList()->AddImageRounded(
        reinterpret_cast<ImTextureID>(static_cast<std::uintptr_t>(texture)),
        ImVec2(corner.x + edge, corner.y + edge),
        ImVec2(corner.x + edge + width, corner.y + height - edge), ImVec2(0, 0), ImVec2(1, 1),
        IM_COL32_WHITE, 0.3f * unit);
  }
  ImGui::SetCursorPos(ImVec2(at.x + width + 3.0f * edge, at.y + 1.2f * edge));
  ImGui::BeginGroup();
  ImGui::TextUnformatted(entry.title.c_str());
  ImGui::PushTextWrapPos(0.0f);
  ImGui::PushStyleColor(ImGuiCol_Text, ImGui::GetStyleColorVec4(ImGuiCol_TextDisabled));
  ImGui::TextUnformatted(entry.caption.c_str());
  ImGui::PopStyleColor();
  ImGui::PopTextWrapPos();
  ImGui::EndGroup();
  ImGui::SetCursorPos(after);
  return clicked;
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
    if (draw_card(entry, controls)) chosen = entry.name;
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
