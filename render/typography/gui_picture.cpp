#include "render/typography/gui_picture.h"

#include <imgui.h>

#include "render/gl/canvas.h"
#include "render/typography/gui_context.h"
#include "render/typography/gui_layer.h"

namespace clatter {

Image gui_picture(const Gl& gl, Size size, Colour background,
                  const std::function<void(ImFontAtlas&)>& add_fonts,
                  const std::function<void(ImDrawList&)>& draw) {
  const Canvas canvas(gl, size);
  canvas.bind();
  gl.Viewport(0, 0, size.width, size.height);
  gl.ClearColor(background.red / 255.0f, background.green / 255.0f, background.blue / 255.0f, 1.0f);
  gl.Clear(GL_COLOR_BUFFER_BIT);
  gl.Enable(GL_BLEND);
  gl.BlendFuncSeparate(GL_SRC_ALPHA, GL_ONE_MINUS_SRC_ALPHA, GL_ONE, GL_ONE_MINUS_SRC_ALPHA);

  GuiLayer gui(gl);
  const GuiContext context = make_gui_context();
  const CurrentContext current(context.get());
  ImGui::GetIO().DisplaySize =
      ImVec2(static_cast<float>(size.width), static_cast<float>(size.height));
  ImFontAtlas& fonts = *ImGui::GetIO().Fonts;
  add_fonts(fonts);
  gui.upload(fonts);
  ImGui::NewFrame();
  draw(*ImGui::GetForegroundDrawList());
  ImGui::Render();
  gui.draw(*ImGui::GetDrawData());
  return canvas.read();
}

}  // namespace clatter
