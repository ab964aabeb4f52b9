#include "app/view/plots_panel.h"

#include <imgui.h>

#include <algorithm>
#include <cmath>
#include <nlohmann/json.hpp>
#include <utility>

#include "app/film/compared_scenes.h"
#include "app/plots/table_plots.h"
#include "app/view/controls.h"
#include "app/view/style.h"
#include "engine/scene/enum_names.h"
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

// The values of the curves at the mouse, with a line at their x.
static void show_values(const LivePlot& plot, const PlotFrame& frame, ImU32 ink) {
  const ImVec2 mouse = ImGui::GetIO().MousePos;
  if (!ImGui::IsItemHovered() || !frame.contains(mouse) || ImGui::IsMouseDown(0)) return;
  const std::string values = readout(plot, frame, mouse);
  if (values.empty()) return;
  ImGui::GetWindowDrawList()->AddLine(ImVec2(mouse.x, frame.low.y), ImVec2(mouse.x, frame.high.y),
                                      ink);
  ImGui::SetTooltip("%s", values.c_str());
}

std::optional<PlotFrame> draw_plot(const LivePlot& plot, float height, bool reads) {
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
  const auto frame = draw_axes_and_curves(*ImGui::GetWindowDrawList(), plot, corner,
                                          ImVec2(corner.x + width, corner.y + height), style);
  ImGui::Dummy(ImVec2(width, height));
  if (frame && reads) show_values(plot, *frame, style.faint);
  return frame;
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

PlotsPanel::PlotsPanel(const WindowParts& parts)
    : log_(parts.log), session_(parts.session), controls_(parts.controls) {}

void PlotsPanel::add(const Frame& frame) {
  const std::vector<const Frame*> gases = frames_of(frame);
  std::erase_if(histories_, [&](const auto& known) {
    return std::ranges::find(gases, known.first, &Frame::id) == gases.end();
  });
  for (const Frame* gas : gases) histories_[gas->id].add(*gas);
  name(gases);
}

// The titles of compared gases: a letter, and the keys in which they differ.
void PlotsPanel::name(const std::vector<const Frame*>& gases) {
  std::vector<std::shared_ptr<const Scene>> scenes;
  for (const Frame* gas : gases) scenes.push_back(gas->scene);
  if (scenes == titled_) return;
  titled_ = scenes;
  titles_.clear();
  if (gases.size() == 1) return;
  std::vector<ComparedScene> compared;
  for (const Frame* gas : gases) {
    compared.push_back({*gas->scene, gas->seed});
    // Their laws at this time distinguish them. They have one view.
    compared.back().scene.changes.clear();
    compared.back().scene.view = {};
  }
  titles_ = cell_titles(compared);
}

std::vector<PlottedGas> PlotsPanel::gases() {
  std::vector<PlottedGas> gases;
  for (const Frame* gas : frames_of(session_.frame())) {
    const std::string name = gas->gas < titles_.size() ? titles_[gas->gas].substr(0, 1) : "";
    gases.push_back({&histories_[gas->id], gas, name});
  }
  return gases;
}

Axis PlotsPanel::profile_axis() const {
  return profile_axis_ < session_.scene().dimension() ? static_cast<Axis>(profile_axis_) : Axis::X;
}

void PlotsPanel::draw(const ThemeColours& theme) {
  const float height = std::round(0.62f * ImGui::GetWindowWidth());
  std::vector<std::string> axes;
  for (int axis = 0; axis < session_.scene().dimension(); ++axis) {
    axes.emplace_back(kAxes[static_cast<std::size_t>(axis)].name);
  }
  int axis = static_cast<int>(profile_axis());
  if (controls_.choice("plots.axis", "Profile along", "Axis of the profile", axes, axis,
                       static_cast<int>(session_.opened().measure.profile_axis))) {
    profile_axis_ = axis;
  }
  std::vector<std::string> profiles = profile_names(profile_axis());
  // The balances of cells do not include the shear.
  if (session_.scene().shear_rate) profiles.pop_back();
  profiled_ = std::min(profiled_, static_cast<int>(profiles.size()) - 1);
  controls_.choice(
      "plots.profile", "Profile of",
      "Averages with a band of one standard error, or the relative residuals of the balances of "
      "mass, momentum and energy in the worst window. They start when the plots open, or when "
      "laws, averages or trails change. The engine then does about twice the work",
      profiles, profiled_, 0);
  observable_plots(theme, height);
  const std::vector<PlottedGas> compared = gases();
  if (compared.size() > 1) {
    controls_.toggle("plots.differences", "Differences from A",
                     "The curves of the other gases minus that of the first one", differences_);
  }
  for (const LivePlot& plot : plots_of(compared, profiled(), theme, differences_)) {
    draw_plot(plot, height);
    ImGui::Spacing();
  }
}

// The tables of the scene's observables, one of them plotted.
void PlotsPanel::observable_plots(const ThemeColours& theme, float height) {
  const auto& tables = session_.frame().observables;
  if (!tables) return;
  if (tables->empty()) {
    ImGui::TextDisabled("The observables of the scene have no values yet.");
    return;
  }
  std::vector<std::string> titles;
  for (const ResultTable& table : *tables) titles.push_back(table_title(table));
  const auto known = std::ranges::find(titles, observable_);
  int chosen = known == titles.end() ? 0 : static_cast<int>(known - titles.begin());
  controls_.choice("plots.observable", "Observable",
                   "A table of measure.observables, with bands of one standard error. Averages "
                   "start with the run, and again when laws change",
                   titles, chosen, 0);
  const auto index = static_cast<std::size_t>(chosen);
  if (std::exchange(observable_, titles[index]) != titles[index]) {
    log_.event("observable", {{"table", observable_}});
  }
  const Frame& frame = session_.frame();
  const std::vector<LivePlot> plots =
      table_plots((*tables)[index], *frame.scene, histories_.at(frame.id), theme);
  for (const LivePlot& plot : plots) {
    draw_plot(plot, height);
    ImGui::Spacing();
  }
}

}  // namespace clatter
