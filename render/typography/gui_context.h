#pragma once

#include <imgui.h>

#include <memory>

namespace clatter {

/// Makes a context of Dear ImGui current during its life, and then restores the previous one. The
/// current context is global, and the window uses another one.
class CurrentContext {
 public:
  explicit CurrentContext(ImGuiContext* context) : previous_(ImGui::GetCurrentContext()) {
    ImGui::SetCurrentContext(context);
  }
  CurrentContext(const CurrentContext&) = delete;
  CurrentContext& operator=(const CurrentContext&) = delete;
  ~CurrentContext() { ImGui::SetCurrentContext(previous_); }

 private:
  ImGuiContext* previous_;
};

/// Deleter of a context.
struct DestroyGuiContext {
  void operator()(ImGuiContext* context) const { ImGui::DestroyContext(context); }
};

/// Owner of a context.
using GuiContext = std::unique_ptr<ImGuiContext, DestroyGuiContext>;

/// Creates a context that writes no settings file and supports meshes of any size.
inline GuiContext make_gui_context() {
  const CurrentContext restored(ImGui::GetCurrentContext());
  GuiContext context(ImGui::CreateContext());
  ImGui::SetCurrentContext(context.get());
  ImGui::GetIO().IniFilename = nullptr;
  ImGui::GetIO().BackendFlags |= ImGuiBackendFlags_RendererHasVtxOffset;
  return context;
}

}  // namespace clatter
