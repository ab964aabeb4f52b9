#include "app/view/plot.h"

#include <imgui.h>

#include "app/view/controls.h"
#include "app/view/style.h"
#include "engine/text.h"
#include "render/typography/fonts.h"

namespace clatter {

// The legend as widgets, with tooltips.
static void legend(const LivePlot& plot, const PlotStyle& style) {
  const ImVec2 corner = ImGui::GetCursorScreenPos();
  ImDrawList& list = *ImGui::GetWindowDrawList();
  float height = 0.0f;
  for (const LegendEntry& entry : legend_of(plot, ImGui::GetContentRegionAvail().x, style)) {
    draw_entry(list, entry, corner, style);
    height = entry.high.y;
    const ImVec2 low(corner.x + entry.low.x, corner.y + entry.low.y);
    const ImVec2 high(corner.x + entry.high.x, corner.y + entry.high.y);
    if (!entry.curve->help.empty() && ImGui::IsWindowHovered() &&
        ImGui::IsMouseHoveringRect(low, high)) {
      ImGui::SetTooltip("%s", entry.curve->help.c_str());
    }
  }
  if (height > 0.0f) ImGui::Dummy(ImVec2(0.0f, height));
}

void draw_plot(const LivePlot& plot, float height) {
  const float unit = ImGui::GetFontSize();
  const PlotStyle style{.text = {ImGui::GetFont(), unit},
                        .numbers = {ImGui::GetFont(), 0.8f * unit},
                        .ink = ImGui::GetColorU32(ImGuiCol_Text),
                        .faint = ImGui::GetColorU32(ImGuiCol_TextDisabled),
                        .line = ImGui::GetColorU32(ImGuiCol_Border)};
  const float button = right_edge() - ImGui::CalcTextSize("CSV").x - unit;
  ImGui::PushTextWrapPos(button);
  ImGui::TextUnformatted(plot.title.c_str());
  ImGui::PopTextWrapPos();
  ImGui::SameLine();
  if (ImGui::GetCursorPosX() + ImGui::CalcTextSize(plot.y_label.c_str()).x < button) {
    ImGui::TextDisabled("%s", plot.y_label.c_str());
  }
  ImGui::SameLine(button);
  ImGui::PushID(plot.title.c_str());
  const Reach reach(ImGui::GetFontSize());
  if (ImGui::SmallButton("CSV")) ImGui::SetClipboardText(csv_of(plot).c_str());
  if (ImGui::IsItemHovered()) ImGui::SetTooltip("Copy the numbers");
  ImGui::PopID();
  legend(plot, style);

  const ImVec2 corner = ImGui::GetCursorScreenPos();
  const float width = ImGui::GetContentRegionAvail().x;
  draw_axes_and_curves(*ImGui::GetWindowDrawList(), plot, corner,
                       ImVec2(corner.x + width, corner.y + height), style);
  ImGui::Dummy(ImVec2(width, height));
}

std::string csv_of(const LivePlot& plot) {
  std::string text;
  for (const Curve& curve : plot.curves) {
    text += plot.x_label + ',' + (curve.name.empty() ? plot.title : curve.name);
    text += curve.errors.empty() ? "\n" : ",standard error\n";
    for (std::size_t i = 0; i < curve.points.size(); ++i) {
      text += number_text(curve.points[i].x()) + ',' + number_text(curve.points[i].y());
      text += curve.errors.empty() ? "\n" : ',' + number_text(curve.errors[i]) + '\n';
    }
    text += '\n';
  }
  return text;
}

}  // namespace clatter
