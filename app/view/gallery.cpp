#include "app/view/gallery.h"

#define GLFW_INCLUDE_NONE
#include <GLFW/glfw3.h>
#include <imgui.h>

#include <algorithm>
#include <cctype>
#include <chrono>
#include <utility>

#include "app/view/style.h"
#include "engine/scene/scene_file.h"
#include "render/typography/gui_layer.h"

namespace clatter {

Gallery::Gallery(const Gl& gl, Renderer& renderer) : thumbnails_(gl, renderer) {
  for (const EmbeddedFile& file : embedded_scenes()) {
    const Scene scene = load_gallery_scene(file);
    entries_.push_back({&file, std::string(file.name.substr(0, file.name.rfind('.'))), scene.title,
                        scene.caption, scene.goal, scene.try_this});
  }
}

static std::string lower(std::string text) {
  std::ranges::transform(text, text.begin(), [](unsigned char c) { return std::tolower(c); });
  return text;
}

// Draws picture, title, caption, goal and suggestion of a scene. Returns true if it was clicked.
bool Gallery::draw_card(const Entry& entry, bool selected, Controls& controls) {
  const float unit = ImGui::GetFontSize(), edge = 0.4f * unit;
  const float tall = 5.4f * unit;
  const float wide = tall * Thumbnails::kSize.width / Thumbnails::kSize.height;
  const ImVec2 at = ImGui::GetCursorPos();
  const ImVec2 corner = ImGui::GetCursorScreenPos();
  const float left = at.x + wide + 3.0f * edge;
  const std::string try_this = "Try this: " + entry.try_this;
  float height = ImGui::GetTextLineHeightWithSpacing() + 2.0f * edge;
  for (const std::string* text : {&entry.caption, &entry.goal, &try_this}) {
    height += ImGui::CalcTextSize(text->c_str(), nullptr, false, right_edge() - left).y;
    height += ImGui::GetStyle().ItemSpacing.y;
  }
  height = std::max(height, tall + 2.0f * edge);
  ImGui::PushID(entry.name.c_str());
  const bool clicked = controls.card(("gallery." + entry.name).c_str(), height, selected);
  ImGui::PopID();
  const ImVec2 after = ImGui::GetCursorPos();
  if (const GLuint texture = thumbnails_.of(*entry.file)) {
    ImGui::GetWindowDrawList()->AddImageRounded(
        texture_id(texture), ImVec2(corner.x + edge, corner.y + edge),
        ImVec2(corner.x + edge + wide, corner.y + edge + tall), ImVec2(0, 1), ImVec2(1, 0),
        IM_COL32_WHITE, 0.3f * unit);
  }
  ImGui::SetCursorPos(ImVec2(left, at.y + edge));
  ImGui::BeginGroup();
  ImGui::TextUnformatted(entry.title.c_str());
  ImGui::SameLine();
  ImGui::TextDisabled("%s", entry.name.c_str());
  ImGui::PushTextWrapPos(0.0f);
  ImGui::PushStyleColor(ImGuiCol_Text, ImGui::GetStyleColorVec4(ImGuiCol_TextDisabled));
  for (const std::string* text : {&entry.caption, &entry.goal, &try_this}) {
    ImGui::TextUnformatted(text->c_str());
  }
  ImGui::PopStyleColor();
  ImGui::PopTextWrapPos();
  ImGui::EndGroup();
  // An item must end the card: a place alone does not enlarge the list.
  ImGui::SetCursorPos(ImVec2(after.x, after.y - ImGui::GetStyle().ItemSpacing.y));
  ImGui::Dummy(ImVec2(0.0f, 0.0f));
  return clicked;
}

// How well a scene matches a searched text: 0 is the best, kRanks no match.
int Gallery::rank(const Entry& entry, const std::string& wanted) {
  const std::string name = lower(entry.name), title = lower(entry.title);
  if (name.starts_with(wanted)) return 0;
  if (title.starts_with(wanted)) return 1;
  const std::string texts = lower(entry.caption + ' ' + entry.goal + ' ' + entry.try_this);
  const auto has = [&](const std::string& text) { return text.find(wanted) != std::string::npos; };
  return has(name) || has(title) ? 2 : has(texts) ? 3 : kRanks;
}

// The scenes with the searched text, the best match first.
std::vector<const Gallery::Entry*> Gallery::matches() const {
  const std::string wanted = lower(search_.data());
  std::vector<const Entry*> found;
  for (int rank = 0; rank < kRanks; ++rank) {
    for (const Entry& entry : entries_) {
      if (Gallery::rank(entry, wanted) == rank) found.push_back(&entry);
    }
  }
  return found;
}

void Gallery::search(const std::string& text) {
  search_ = {};
  text.copy(search_.data(), search_.size() - 1);
  selected_ = 0;
}

void Gallery::press(const KeyPress& press) {
  if (press.key == GLFW_KEY_DOWN) ++steps_;
  if (press.key == GLFW_KEY_UP) --steps_;
  if (press.key == GLFW_KEY_ENTER) enters_ = true;
  // A field with the focus takes its own keys.
  const std::string text = search_.data();
  if (press.key == GLFW_KEY_BACKSPACE && !text.empty() && !ImGui::GetIO().WantTextInput) {
    search(text.substr(0, text.size() - 1));
  }
}

void Gallery::type(const std::string& signs) {
  std::string text = search_.data();
  for (const char sign : signs) {
    if (sign == '/') {
      text.clear();
    } else {
      text += sign;
    }
  }
  if (!signs.empty()) search(text);
}

// Moves the selection by the pressed arrow keys. Returns true if it moved.
bool Gallery::select(int matches) {
  const int before = selected_;
  selected_ = std::clamp(selected_ + std::exchange(steps_, 0), 0, std::max(0, matches - 1));
  return selected_ != before;
}

const EmbeddedFile* Gallery::draw(Controls& controls, float width, float height, bool& open) {
  constexpr std::chrono::milliseconds kBudget{8};
  thumbnails_.work(kBudget);
  const EmbeddedFile* chosen = nullptr;
  const float unit = ImGui::GetFontSize();
  const ImVec2 size(std::min(58.0f * unit, 0.9f * width), std::min(46.0f * unit, 0.9f * height));
  ImGui::SetNextWindowPos(ImVec2(0.5f * width, 0.5f * height), 0, ImVec2(0.5f, 0.5f));
  ImGui::SetNextWindowSize(size);
  ImGui::PushStyleColor(ImGuiCol_WindowBg, ImGui::GetStyleColorVec4(ImGuiCol_PopupBg));
  ImGui::PushStyleVar(ImGuiStyleVar_WindowRounding, 0.5f * unit);
  ImGui::Begin("Gallery", nullptr,
               ImGuiWindowFlags_NoTitleBar | ImGuiWindowFlags_NoMove | ImGuiWindowFlags_NoResize |
                   ImGuiWindowFlags_NoCollapse | ImGuiWindowFlags_NoSavedSettings);
  const float side = ImGui::GetFrameHeight();
  ImGui::SetNextItemWidth(-side - ImGui::GetStyle().ItemSpacing.x);
  // While a text is typed, Enter is the one of the field, which comes after all letters before it.
  const bool entered =
      ImGui::InputTextWithHint("##search", "Type to search the gallery", search_.data(),
                               search_.size(), ImGuiInputTextFlags_EnterReturnsTrue);
  if (ImGui::IsItemEdited()) selected_ = 0;
  // The field loses the focus at Enter. Without a match it gets the focus back.
  if (entered && matches().empty()) ImGui::SetKeyboardFocusHere(-1);
  const bool typing = ImGui::IsItemActive() || ImGui::IsItemDeactivated();
  const bool enter = (std::exchange(enters_, false) && !typing) || entered;
  ImGui::SameLine();
  if (controls.button("gallery.close", "×", "Close (Esc)", side)) open = false;
  ImGui::Spacing();
  ImGui::BeginChild("scenes");
  const std::vector<const Entry*> found = matches();
  if (found.empty()) {
    controls.note("gallery.none", "No scene matches \"" + std::string(search_.data()) + '"');
  }
  const bool moved = select(static_cast<int>(found.size()));
  for (std::size_t i = 0; i < found.size(); ++i) {
    const bool selected = static_cast<int>(i) == selected_;
    if (draw_card(*found[i], selected, controls)) chosen = found[i]->file;
    if (selected && moved) ImGui::SetScrollHereY();
    if (selected && enter) chosen = found[i]->file;
  }
  ImGui::EndChild();
  ImGui::End();
  ImGui::PopStyleVar();
  ImGui::PopStyleColor();
  return chosen;
}

const EmbeddedFile& Gallery::neighbour(const std::string& title, int step) const {
  const auto count = static_cast<int>(entries_.size());
  const auto found = std::ranges::find(entries_, title, &Entry::title);
  const int at = found == entries_.end() ? 0 : static_cast<int>(found - entries_.begin()) + step;
  return *entries_[static_cast<std::size_t>((at + count) % count)].file;
}

}  // namespace clatter
