#include "render/typography/gui_layer.h"

#include <imgui.h>

#include <utility>
#include <vector>

#include "render/gl/canvas.h"
#include "render/typography/gui_context.h"

namespace clatter {

GuiLayer::GuiLayer(const Gl& gl)
    : gl_(&gl),
      program_(gl, "gui.vert", "gui.frag"),
      font_(generate<Texture>(gl, gl.GenTextures)),
      vertices_(generate<Buffer>(gl, gl.GenBuffers)),
      indices_(generate<Buffer>(gl, gl.GenBuffers)),
      array_(generate<VertexArray>(gl, gl.GenVertexArrays)) {
  gl.BindVertexArray(array_.id());
  gl.BindBuffer(GL_ARRAY_BUFFER, vertices_.id());
  gl.BindBuffer(GL_ELEMENT_ARRAY_BUFFER, indices_.id());
  for (GLuint attribute : {0, 1, 2}) gl.EnableVertexAttribArray(attribute);
}

// Makes vertex `first` of the buffer the vertex 0 of later draw calls.
void GuiLayer::read_from(std::size_t first) const {
  const auto read = [&](GLuint attribute, GLint size, GLenum type, std::size_t offset) {
    gl_->VertexAttribPointer(attribute, size, type, type == GL_UNSIGNED_BYTE, sizeof(ImDrawVert),
                             reinterpret_cast<const void*>(first * sizeof(ImDrawVert) + offset));
  };
  read(0, 2, GL_FLOAT, offsetof(ImDrawVert, pos));
  read(1, 2, GL_FLOAT, offsetof(ImDrawVert, uv));
  read(2, 4, GL_UNSIGNED_BYTE, offsetof(ImDrawVert, col));
}

void GuiLayer::upload(ImFontAtlas& atlas) {
  unsigned char* opacities = nullptr;
  int width = 0, height = 0;
  atlas.GetTexDataAsAlpha8(&opacities, &width, &height);
  // White also between the letters, because the filter mixes the colours of neighbours. Versions
  // from 1.92 on have black there, which would show as dark fringes.
  std::vector<unsigned char> pixels(4 * static_cast<std::size_t>(width) * height, 255);
  for (std::size_t k = 3; k < pixels.size(); k += 4) pixels[k] = opacities[k / 4];
  gl_->ActiveTexture(GL_TEXTURE0);
  gl_->BindTexture(GL_TEXTURE_2D, font_.id());
  gl_->TexParameteri(GL_TEXTURE_2D, GL_TEXTURE_MIN_FILTER, GL_LINEAR);
  gl_->TexParameteri(GL_TEXTURE_2D, GL_TEXTURE_MAG_FILTER, GL_LINEAR);
  gl_->TexImage2D(GL_TEXTURE_2D, 0, GL_RGBA8, width, height, 0, GL_RGBA, GL_UNSIGNED_BYTE,
                  pixels.data());
  atlas.SetTexID(texture_id(font_.id()));
  atlas.ClearTexData();
}

void GuiLayer::draw(const ImDrawData& data) const {
  gl_->Enable(GL_SCISSOR_TEST);
  gl_->ActiveTexture(GL_TEXTURE0);
  program_.use();
  gl_->Uniform2f(program_.uniform("u_origin"), data.DisplayPos.x, data.DisplayPos.y);
  gl_->Uniform2f(program_.uniform("u_size"), data.DisplaySize.x, data.DisplaySize.y);
  gl_->Uniform1i(program_.uniform("u_texture"), 0);
  gl_->BindVertexArray(array_.id());
  gl_->BindBuffer(GL_ARRAY_BUFFER, vertices_.id());
  for (int i = 0; i < data.CmdListsCount; ++i) draw_list(*data.CmdLists[i], data);
  gl_->Disable(GL_SCISSOR_TEST);
}

void GuiLayer::draw_list(const ImDrawList& list, const ImDrawData& data) const {
  gl_->BufferData(GL_ARRAY_BUFFER, list.VtxBuffer.size_in_bytes(), list.VtxBuffer.Data,
                  GL_STREAM_DRAW);
  gl_->BufferData(GL_ELEMENT_ARRAY_BUFFER, list.IdxBuffer.size_in_bytes(), list.IdxBuffer.Data,
                  GL_STREAM_DRAW);
  const ImVec2 scale = data.FramebufferScale;
  const float height = data.DisplaySize.y * scale.y;
  unsigned first = 0;
  read_from(first);
  for (const ImDrawCmd& command : list.CmdBuffer) {
    const ImVec4& clip = command.ClipRect;
    const float left = (clip.x - data.DisplayPos.x) * scale.x;
    const float right = (clip.z - data.DisplayPos.x) * scale.x;
    const float top = (clip.y - data.DisplayPos.y) * scale.y;
    const float bottom = (clip.w - data.DisplayPos.y) * scale.y;
    if (right <= left || bottom <= top) continue;
    // OpenGL counts rows from the lower edge.
    gl_->Scissor(static_cast<GLint>(left), static_cast<GLint>(height - bottom),
                 static_cast<GLsizei>(right - left), static_cast<GLsizei>(bottom - top));
    gl_->BindTexture(GL_TEXTURE_2D, static_cast<GLuint>((std::uintptr_t)command.GetTexID()));
    if (std::exchange(first, command.VtxOffset) != command.VtxOffset) read_from(first);
    gl_->DrawElements(GL_TRIANGLES, static_cast<GLsizei>(command.ElemCount),
                      sizeof(ImDrawIdx) == 2 ? GL_UNSIGNED_SHORT : GL_UNSIGNED_INT,
                      reinterpret_cast<const void*>(command.IdxOffset * sizeof(ImDrawIdx)));
  }
}

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
