#pragma once

#include <imgui.h>

#include <cstddef>
#include <cstdint>
#include <functional>

#include "render/context/gl.h"
#include "render/gl/shader_program.h"
#include "render/output/image.h"
#include "render/palette.h"

namespace clatter {

/// The texture as Dear ImGui identifies it: by a pointer up to version 1.91, then by an integer.
inline ImTextureID texture_id(GLuint texture) {
  return (ImTextureID) static_cast<std::uintptr_t>(texture);
}

/// Renderer for Dear ImGui. The one of Dear ImGui loads the OpenGL library of the system, which is
/// not the library of an off-screen context.
class GuiLayer {
 public:
  explicit GuiLayer(const Gl& gl);

  /// Builds the atlas, copies it to the GPU and stores the texture in it. Call it after each change
  /// of the atlas.
  void upload(ImFontAtlas& atlas);

  /// Draws over the whole viewport, of size DisplaySize times FramebufferScale in pixels. Blending
  /// must be set as by Renderer::draw().
  void draw(const ImDrawData& data) const;

 private:
  void read_from(std::size_t first) const;
  void draw_list(const ImDrawList& list, const ImDrawData& data) const;

  const Gl* gl_;
  Program program_;
  Texture font_;
  Buffer vertices_;
  Buffer indices_;
  VertexArray array_;
};

/// The picture that a function draws by Dear ImGui, with the fonts that another function has added
/// to the atlas before. Throws RunError if OpenGL does not support the size.
Image gui_picture(const Gl& gl, Size size, Colour background,
                  const std::function<void(ImFontAtlas&)>& add_fonts,
                  const std::function<void(ImDrawList&)>& draw);

}  // namespace clatter
