#include "render/charts/plot_strip.h"

#include <imgui.h>

#include <algorithm>
#include <cmath>

namespace clatter {

PlotStrip::PlotStrip(const Gl& gl, Size size, Size whole, bool transparent)
    : gl_(&gl),
      transparent_(transparent),
      canvas_(gl, size),
      gui_(gl),
      context_(make_gui_context()) {
  const CurrentContext current(context_.get());
  const float unit = static_cast<float>(std::min(whole.width, whole.height)) / 42.0f;
  fonts_ = add_fonts(*ImGui::GetIO().Fonts, std::round(std::max(10.0f, unit)));
  gui_.upload(*ImGui::GetIO().Fonts);
}

// Draws a plot between two corners.
static void draw_one(ImDrawList& list, const LivePlot& plot, ImVec2 low, ImVec2 high,
                     const PlotStyle& style) {
  const float size = style.text.size;
  list.AddText(style.text.face, size, low, style.ink, plot.title.c_str());
  const float unit = text_extent(style.text, plot.y_label).x;
  const float right = low.x + text_extent(style.text, plot.title).x + 0.6f * size;
  if (right + unit <= high.x) {
    list.AddText(style.text.face, size, ImVec2(right, low.y), style.faint, plot.y_label.c_str());
  }
  const ImVec2 names(low.x, low.y + 1.3f * size);
  float below = 0.0f;
  for (const LegendEntry& entry : legend_of(plot, high.x - low.x, style)) {
    draw_entry(list, entry, names, style);
    below = entry.high.y;
  }
  draw_axes_and_curves(list, plot, ImVec2(low.x, names.y + below), high, style);
}

Image PlotStrip::draw(const std::vector<std::optional<LivePlot>>& plots,
                      const ThemeColours& theme) {
  const CurrentContext current(context_.get());
  const Size size = canvas_.size();
  const Colour ground = transparent_ ? Colour{0, 0, 0, 0} : theme.background;
  canvas_.bind();
  gl_->Viewport(0, 0, size.width, size.height);
  gl_->ClearColor(ground.red / 255.0f, ground.green / 255.0f, ground.blue / 255.0f,
                  ground.alpha / 255.0f);
  gl_->Clear(GL_COLOR_BUFFER_BIT);
  gl_->Enable(GL_BLEND);
  gl_->BlendFuncSeparate(GL_SRC_ALPHA, GL_ONE_MINUS_SRC_ALPHA, GL_ONE, GL_ONE_MINUS_SRC_ALPHA);

  const float unit = fonts_.unit(), edge = std::round(1.2f * unit);
  const PlotStyle style{.text = fonts_.text,
                        .numbers = fonts_.small,
                        .ink = packed(theme.text),
                        .faint = packed(theme.faint_text),
                        .line = packed(mix(theme.background, theme.faint_text, 0.35))};
  const auto width = static_cast<float>(size.width), height = static_cast<float>(size.height);
  const auto count = static_cast<float>(plots.size());
  const bool column = height > width;
  // In a column plots are at most as high as wide, around the middle.
  const float tall = std::min((height - edge) / count, width);
  const float top = column ? std::round(0.5f * (height - edge - count * tall)) : 0.0f;
  const ImVec2 step = column ? ImVec2(0.0f, tall) : ImVec2((width - edge) / count, 0.0f);
  ImGui::GetIO().DisplaySize = ImVec2(width, height);
  ImGui::NewFrame();
  ImDrawList& list = *ImGui::GetForegroundDrawList();
  for (std::size_t k = 0; k < plots.size(); ++k) {
    if (!plots[k]) continue;
    const auto place = static_cast<float>(k);
    const ImVec2 low(edge + place * step.x, top + edge + place * step.y);
    const ImVec2 high(column ? width - edge : low.x + step.x - edge,
                      column ? low.y + step.y - edge : height - edge);
    draw_one(list, *plots[k], low, high, style);
  }
  ImGui::Render();
  gui_.draw(*ImGui::GetDrawData());
  return canvas_.read();
}

}  // namespace clatter
