#include "app/view/gui_keys.h"

#define GLFW_INCLUDE_NONE
#include <GLFW/glfw3.h>
#include <imgui.h>

#include <utility>

namespace clatter {

namespace {

struct KeyName {
  ImGuiKey own;
  int key;  // of GLFW
};

// The keys of text fields.
constexpr KeyName kKeyNames[] = {{ImGuiKey_Tab, GLFW_KEY_TAB},
                             {ImGuiKey_LeftArrow, GLFW_KEY_LEFT},
                             {ImGuiKey_RightArrow, GLFW_KEY_RIGHT},
                             {ImGuiKey_UpArrow, GLFW_KEY_UP},
                             {ImGuiKey_DownArrow, GLFW_KEY_DOWN},
                             {ImGuiKey_PageUp, GLFW_KEY_PAGE_UP},
                             {ImGuiKey_PageDown, GLFW_KEY_PAGE_DOWN},
                             {ImGuiKey_Home, GLFW_KEY_HOME},
                             {ImGuiKey_End, GLFW_KEY_END},
                             {ImGuiKey_Delete, GLFW_KEY_DELETE},
                             {ImGuiKey_Backspace, GLFW_KEY_BACKSPACE},
                             {ImGuiKey_Space, GLFW_KEY_SPACE},
                             {ImGuiKey_Enter, GLFW_KEY_ENTER},
                             {ImGuiKey_Escape, GLFW_KEY_ESCAPE},
                             {ImGuiKey_A, GLFW_KEY_A},
                             {ImGuiKey_C, GLFW_KEY_C},
                             {ImGuiKey_V, GLFW_KEY_V},
                             {ImGuiKey_X, GLFW_KEY_X},
                             {ImGuiKey_Y, GLFW_KEY_Y},
                             {ImGuiKey_Z, GLFW_KEY_Z}};

}  // namespace

#if IMGUI_VERSION_NUM < 18700

void prepare_keys() {
  for (const auto& [own, key] : kKeyNames) ImGui::GetIO().KeyMap[own] = key;
}

void pass_key(int key, bool down) {
  ImGui::GetIO().KeysDown[key] = down;
}

void pass_modifiers(bool shift, bool ctrl) {
  ImGui::GetIO().KeyShift = shift;
  ImGui::GetIO().KeyCtrl = ctrl;
}

void begin_picture(const std::vector<KeyPress>& presses) {
  auto& down = ImGui::GetIO().KeysDown;
  std::vector<int> released;
  for (const KeyPress& press : presses) {
    if (!std::exchange(down[press.key], true)) released.push_back(press.key);
  }
  ImGui::NewFrame();
  for (const int key : released) down[key] = false;
}

#else

void prepare_keys() {}

void pass_key(int key, bool down) {
  for (const KeyName& name : kKeyNames) {
    if (name.key == key) ImGui::GetIO().AddKeyEvent(name.own, down);
  }
}

void pass_modifiers(bool shift, bool ctrl) {
  ImGui::GetIO().AddKeyEvent(ImGuiMod_Shift, shift);
  ImGui::GetIO().AddKeyEvent(ImGuiMod_Ctrl, ctrl);
}

// The queue has the press before the release.
void begin_picture(const std::vector<KeyPress>&) {
  ImGui::NewFrame();
}

#endif

}  // namespace clatter
