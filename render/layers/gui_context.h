#pragma once

#include <imgui.h>

#include <memory>

namespace clatter {

/// Dear ImGui's functions act on a context that is global: one of our own is current only while
/// this object lives, so that the window's is left alone.
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

/// Destroys a context that goes.
struct DestroyContext {
  void operator()(ImGuiContext* context) const { ImGui::DestroyContext(context); }
};

/// A context of our own.
using GuiContext = std::unique_ptr<ImGuiContext, DestroyContext>;

/// A context that keeps no settings and takes meshes of any size.
inline GuiContext make_gui_context() {
  const CurrentContext restored(ImGui::GetCurrentContext());
  GuiContext context(ImGui::CreateContext());
  ImGui::SetCurrentContext(context.get());
  ImGui::GetIO().IniFilename = nullptr;
  ImGui::GetIO().BackendFlags |= ImGuiBackendFlags_RendererHasVtxOffset;
  return context;
}

}  // namespace clatter
