#pragma once

#include "render/gl/shader_program.h"

struct ImDrawData;
struct ImDrawList;
struct ImFontAtlas;

namespace clatter {

/// Draws what Dear ImGui collected. Its own OpenGL renderer loads the system's OpenGL library,
/// which is not the one that draws off screen.
class GuiLayer {
 public:
  explicit GuiLayer(const Gl& gl);

  /// Builds the atlas, copies it to the GPU and names the texture in it; anew after each change.
  void upload(ImFontAtlas& atlas);

  /// Draws over the whole viewport, whose extent is DisplaySize times FramebufferScale, blended as
  /// Renderer::draw leaves it.
  void draw(const ImDrawData& data) const;

 private:
  void draw_list(const ImDrawList& list, const ImDrawData& data) const;

  const Gl* gl_;
  Program program_;
  Texture font_;
  Buffer vertices_;
  Buffer indices_;
  VertexArray array_;
};

}  // namespace clatter
