#include <doctest/doctest.h>
#include <imgui.h>

#include "render/typography/gui_layer.h"
#include "tests/render/picture.h"

namespace clatter {

TEST_CASE("Gui layer: shapes of Dear ImGui come out at their pixels, clipped") {
  const auto context = open_context(Backend::Auto);
  const Canvas canvas = blank_canvas(context->gl(), {80, 60});
  GuiLayer layer(context->gl());
  ImGui::CreateContext();
  ImGui::GetIO().IniFilename = nullptr;
  ImGui::GetIO().DisplaySize = ImVec2(40, 30);
  ImGui::GetIO().DisplayFramebufferScale = ImVec2(2, 2);
  layer.upload(*ImGui::GetIO().Fonts);

  ImGui::NewFrame();
  ImDrawList& list = *ImGui::GetForegroundDrawList();
  list.PushClipRect(ImVec2(0, 0), ImVec2(10, 8));
  list.AddRectFilled(ImVec2(5, 5), ImVec2(20, 10), IM_COL32(200, 100, 50, 255));
  list.PopClipRect();
  ImGui::Render();
  layer.draw(*ImGui::GetDrawData());
  ImGui::DestroyContext();

  const Image image = canvas.read();
  for (int y = 0; y < 60; ++y) {
    for (int x = 0; x < 80; ++x) {
      const bool inside = x >= 10 && x < 20 && y >= 10 && y < 16;
      REQUIRE(pixel(image, x, y) == (inside ? Colour{200, 100, 50} : kDarkTheme.background));
    }
  }
}

}  // namespace clatter
