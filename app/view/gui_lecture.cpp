#include <fmt/format.h>
#include <imgui.h>

#include <algorithm>
#include <cmath>
#include <nlohmann/json.hpp>
#include <utility>

#include "app/plots/plot_colours.h"
#include "app/plots/plots.h"
#include "app/view/enum_list.h"
#include "app/view/gui.h"
#include "app/view/icons.h"
#include "app/view/lesson.h"
#include "app/view/panels.h"
#include "app/view/plot.h"
#include "app/view/style.h"
#include "engine/scene/enum_names.h"
#include "render/typography/fonts.h"

// Lecture mode: the gas with three sliders, a large plot and the tools of a lecturer.

namespace clatter {

static constexpr float kSliderWidth = 12.0f;  // least width of a slider, in text sizes

void Gui::lecture(bool on) {
  if (on) panels_.lesson = panels_.plots = false;
  panels_.lecture = on;
  panels_.panels = !on;
  tools_.lines.clear();
  tools_.trail.clear();
  viewport_.redraw();
}

// All controls of the panels, one below the other.
void Gui::all_controls() {
  gas_panel(session_, controls_);
  compare_panel(session_, controls_, titles_);
  if (mouse_tools_.panel(session_.scene(), controls_)) lift_pen();
  box_panel(session_, controls_);
  view_panel(session_, controls_);
  accuracy_panel(session_, controls_);
}

// The names of the sliders of lecture mode, each once.
std::vector<std::string> Gui::lecture_sliders() const {
  const Lecture& lecture = session_.view().lecture;
  std::vector<std::string> names;
  for (const std::string& name :
       lecture.sliders.empty() ? usual_sliders(session_.scene()) : lecture.sliders) {
    if (std::ranges::find(names, name) == names.end()) names.push_back(name);
  }
  return names;
}

void Gui::lecture_panels() {
  area_.high.y -= lecture_bar();
  if (!session_.frame().scene) return;
  if (tools_.timeline) area_.high.y -= timeline_.draw(session_, controls_, log_, area_);
  if (panels_.lesson) {
    area_.high.y -= lesson_strip(session_.scene(), area_, controls_, panels_.lesson);
  }
  area_.low.y += caption_strip();
  lecture_column();
  if (tools_.settings) lecture_settings();
}

// Title and caption of the scene along the upper edge, as far as they leave enough room. Returns
// the height of the strip.
float Gui::caption_strip() {
  constexpr float kMost = 0.25f;   // height over that of the window
  constexpr float kLeast = 14.0f;  // width of the caption beside the title, in text sizes
  const auto& [title, caption] = std::pair(session_.scene().title, session_.scene().caption);
  if (!tools_.captions || (title.empty() && caption.empty())) return 0.0f;
  const ImGuiStyle& style = ImGui::GetStyle();
  const float unit = ImGui::GetFontSize();
  const float width = area_.high.x - area_.low.x, room = width - 2.0f * style.WindowPadding.x;
  const auto height_of = [](const std::string& text, float wrap) {
    return text.empty() ? 0.0f : ImGui::CalcTextSize(text.c_str(), nullptr, false, wrap).y;
  };
  const float first = ImGui::CalcTextSize(title.c_str()).x + 1.5f * unit;
  const bool beside = room - first >= kLeast * unit;
  const float title_height = height_of(title, room);
  float text = beside ? std::max(title_height, height_of(caption, room - first))
                      : title_height + style.ItemSpacing.y + height_of(caption, room);
  const float most = kMost * ImGui::GetIO().DisplaySize.y - 2.0f * style.WindowPadding.y;
  const bool captioned = text <= most;
  if (!captioned) text = title_height;
  if (text > most) return 0.0f;
  const float height = std::round(text + 2.0f * style.WindowPadding.y);
  ImGui::SetNextWindowPos(area_.low);
  ImGui::SetNextWindowSize(ImVec2(width, height));
  ImGui::Begin("caption", nullptr, kFixedPanel | ImGuiWindowFlags_NoScrollbar);
  ImGui::PushTextWrapPos(0.0f);
  ImGui::TextUnformatted(title.c_str());
  if (captioned) {
    if (beside) ImGui::SameLine(style.WindowPadding.x + first);
    ImGui::PushStyleColor(ImGuiCol_Text, style.Colors[ImGuiCol_TextDisabled]);
    ImGui::TextUnformatted(caption.c_str());
    ImGui::PopStyleColor();
  }
  ImGui::PopTextWrapPos();
  log_.widget("lecture.caption", area_.low.x, area_.low.y, width, height);
  ImGui::End();
  return height;
}

// The large plot with the sliders below it, right of the gas; in small windows the sliders alone,
// below the gas.
void Gui::lecture_column() {
  constexpr float kLeast = 15.0f, kMost = 30.0f;  // width of the plot, in text sizes
  constexpr float kShare = 0.36f, kMostShare = 0.46f;
  constexpr float kLeastPlot = 6.0f;  // height of the plot, in text sizes
  constexpr float kMostHeight = 0.4f;
  const ImGuiStyle& style = ImGui::GetStyle();
  const float unit = ImGui::GetFontSize();
  const float whole = area_.high.x - area_.low.x, tall = area_.high.y - area_.low.y;
  const std::vector<std::string> names = lecture_sliders();
  const std::size_t profile =
      profiled() < profile_names(profile_axis()).size() - 1 ? profiled() : 0;
  const auto plot = lecture_plot(tools_.plot ? session_.view().lecture.plot : LecturePlot::None,
                                 plotted_gases(), profile, panel_theme(shown_view()));
  const float column = sliders_height(names, 1);
  const bool beside =
      plot && kLeast * unit <= kMostShare * whole && column + (kLeastPlot + 3.0f) * unit <= tall;
  if (beside) {
    const float width = std::round(
        std::clamp(kShare * whole, kLeast * unit, std::min(kMost * unit, kMostShare * whole)));
    ImGui::SetNextWindowPos(ImVec2(area_.high.x - width, area_.low.y));
    ImGui::SetNextWindowSize(ImVec2(width, tall));
    ImGui::Begin("lecture", nullptr, kFixedPanel | ImGuiWindowFlags_NoScrollbar);
    const ImVec2 low = ImGui::GetCursorScreenPos();
    const float room = ImGui::GetContentRegionAvail().y - column;
    ImGui::BeginChild("plot", ImVec2(0.0f, room), false, ImGuiWindowFlags_NoScrollbar);
    const float height = std::max(room - plot_heading_, kLeastPlot * unit);
    draw_plot(*plot, height);
    plot_heading_ = ImGui::GetCursorPosY() - height;
    ImGui::EndChild();
    log_.widget("lecture.plot", low.x, low.y, ImGui::GetContentRegionAvail().x, room);
    draw_sliders(names, 1);
    ImGui::End();
    area_.high.x -= width;
    return;
  }
  if (names.empty()) return;
  const auto columns = static_cast<std::size_t>(
      std::clamp((whole - 2.0f * style.WindowPadding.x) / (kSliderWidth * unit), 1.0f,
                 static_cast<float>(names.size())));
  const float height = std::round(
      std::min(sliders_height(names, columns) + 2.0f * style.WindowPadding.y, kMostHeight * tall));
  ImGui::SetNextWindowPos(ImVec2(area_.low.x, area_.high.y - height));
  ImGui::SetNextWindowSize(ImVec2(whole, height));
  ImGui::Begin("lecture", nullptr, kFixedPanel);
  draw_sliders(names, columns);
  ImGui::End();
  area_.high.y -= height;
}

// Height of a control as it was drawn last.
float Gui::slider_height(const std::string& name) const {
  const auto known = slider_heights_.find(name);
  return known == slider_heights_.end() ? 3.0f * ImGui::GetTextLineHeightWithSpacing()
                                        : known->second;
}

// Height of the controls with these names in rows of `columns`.
float Gui::sliders_height(const std::vector<std::string>& names, std::size_t columns) const {
  float sum = 0.0f;
  for (std::size_t row = 0; row < names.size(); row += columns) {
    float highest = 0.0f;
    for (std::size_t k = row; k < std::min(row + columns, names.size()); ++k) {
      highest = std::max(highest, slider_height(names[k]));
    }
    sum += highest + ImGui::GetStyle().ItemSpacing.y;
  }
  return sum;
}

// The controls with these names, in rows of `columns`.
void Gui::draw_sliders(const std::vector<std::string>& names, std::size_t columns) {
  const float gap = 2.0f * ImGui::GetStyle().ItemSpacing.x;
  const auto count = static_cast<float>(columns);
  const float width = std::floor((ImGui::GetContentRegionAvail().x - (count - 1.0f) * gap) / count);
  for (std::size_t k = 0; k < names.size(); ++k) {
    if (k % columns > 0) ImGui::SameLine(0.0f, gap);
    ImGui::BeginChild(names[k].c_str(), ImVec2(width, slider_height(names[k])), false,
                      ImGuiWindowFlags_NoScrollbar);
    const ChosenControls chosen(controls_, {names[k]});
    for (const char* side : kSideNames) {
      if (names[k].starts_with(std::string("walls.") + side + '.')) {
        ImGui::TextDisabled("%s wall", side);
      }
    }
    all_controls();
    slider_heights_[names[k]] = std::round(ImGui::GetCursorPosY());
    ImGui::EndChild();
    name_missing_controls();
  }
  checked_run_ = session_.frame().run;
}

// Width of a button, which is at least square.
static float button_width(const char* label) {
  return std::max(
      ImGui::CalcTextSize(label, nullptr, true).x + 2.0f * ImGui::GetStyle().FramePadding.x,
      ImGui::GetFrameHeight());
}

// Puts the next widget into the same line if there is room, else into a new line.
static void place_next(float width) {
  ImGui::SameLine();
  if (ImGui::GetContentRegionAvail().x < width) ImGui::NewLine();
}

// The bar along the lower edge with the tools, in as many lines as it needs. Returns its height.
float Gui::lecture_bar() {
  const ImVec2 whole = ImGui::GetIO().DisplaySize;
  const float edge = 0.35f * ImGui::GetFontSize();
  const float icon = 1.35f * ImGui::GetFrameHeight();
  const float height = std::max(bar_height_, std::round(ImGui::GetFrameHeight() + 2.0f * edge));
  ImGui::PushStyleVar(ImGuiStyleVar_WindowPadding, ImVec2(edge, edge));
  ImGui::PushStyleVar(ImGuiStyleVar_ItemSpacing, ImVec2(edge, edge));
  ImGui::SetNextWindowPos(ImVec2(0, whole.y - height));
  ImGui::SetNextWindowSize(ImVec2(whole.x, height));
  ImGui::Begin("lecture_bar", nullptr, kFixedPanel | ImGuiWindowFlags_NoScrollbar);
  const auto button = [&](const char* key, const char* label, const char* help, bool on) {
    place_next(button_width(label));
    return controls_.button(key, label, help, button_width(label), on);
  };
  if (controls_.button("gallery", "≡", "The gallery (G)", button_width("≡"), panels_.gallery)) {
    panels_.toggle_gallery();
  }
  if (button("previous_scene", "←", "Previous scene ( [ )", false)) step_scene(-1);
  if (!playlist_.empty()) {
    const std::string place = fmt::format("{}/{}", at_ + 1, playlist_.size());
    place_next(ImGui::CalcTextSize(place.c_str()).x);
    ImGui::AlignTextToFramePadding();
    ImGui::TextUnformatted(place.c_str());
  }
  if (button("next_scene", "→", "Next scene ( ] )", false)) step_scene(1);
  place_next(2.0f * icon);
  if (icon_button(controls_, "play", session_.frame().plays ? Icon::Pause : Icon::Play,
                  "Play or pause (Space)")) {
    session_.play(!session_.frame().plays);
  }
  if (icon_button(controls_, "reset", Icon::Reset, "Restart (R)")) session_.restart();
  if (button("lecture.timeline", "Timeline", "The time of the run", tools_.timeline)) {
    tools_.timeline = !tools_.timeline;
  }
  for (const ToolText& tool : kTools) {
    if (!bar_has_tools()) break;
    if (button(tool.key, tool.name, tool.help, mouse_tools_.tool() == tool.tool)) {
      toggle_tool(tool.tool);
    }
  }
  if (button("lecture.pen", "Pen", "The mouse draws lines that fade out (D)", tools_.pen)) {
    toggle_pen();
  }
  if (button("lecture.pointer", "Pointer", "Ring and trail of the pointer (K)", tools_.pointer)) {
    tools_.pointer = !tools_.pointer;
  }
  stopwatch_button();
  if (button("lecture.settings", "…", "Sliders, plot, caption, colours and size",
             tools_.settings)) {
    tools_.settings = !tools_.settings;
  }
  if (button("lecture.close", "×", "Ends lecture mode (L)", false)) lecture(false);
  bar_height_ = std::round(ImGui::GetCursorPosY());
  ImGui::End();
  ImGui::PopStyleVar(2);
  return height;
}

// Whether the bar has room for the mouse tools in its only line. Else they are in the settings.
bool Gui::bar_has_tools() const {
  constexpr float kWidth = 52.0f;  // of the bar with them, in text sizes
  return ImGui::GetIO().DisplaySize.x > kWidth * ImGui::GetFontSize();
}

// The stopwatch with its times. The room for the times does not depend on their digits.
void Gui::stopwatch_button() {
  const Frame& frame = session_.frame();
  if (std::exchange(tools_.run, frame.run) != frame.run) tools_.stopwatch.clear();
  const auto now = Stopwatch::Clock::now();
  const auto [simulated, seconds] = tools_.stopwatch.read(frame.snapshot.time, now);
  const bool zero = tools_.stopwatch.at_zero();
  const std::string label =
      (zero ? "Stopwatch" : fmt::format("{:.1f} s   t = {:.2f}", seconds, simulated)) +
      "###stopwatch";
  const float width =
      std::max(zero ? 0.0f : button_width("000.0 s   t = 000.00"), button_width(label.c_str()));
  place_next(width);
  if (controls_.button("lecture.stopwatch", label.c_str(),
                       "Stopwatch of real time and simulation time: start, stop, zero (W)", width,
                       tools_.stopwatch.runs())) {
    press_stopwatch();
  }
}

void Gui::press_stopwatch() {
  const double time = session_.frame().snapshot.time;
  const auto now = Stopwatch::Clock::now();
  tools_.stopwatch.press(time, now);
  const auto [simulated, seconds] = tools_.stopwatch.read(time, now);
  log_.event("stopwatch", {{"runs", tools_.stopwatch.runs()},
                           {"time", time},
                           {"simulated", simulated},
                           {"seconds", seconds}});
}

void Gui::toggle_pen() {
  tools_.pen = !tools_.pen;
  tools_.lines.lift();
  if (tools_.pen) mouse_tools_.leave();
}

void Gui::lift_pen() {
  tools_.pen = false;
  tools_.lines.lift();
}

void Gui::toggle_tool(Tool tool) {
  mouse_tools_.toggle(tool);
  if (mouse_tools_.tool()) lift_pen();
}

// The settings of lecture mode, above the right end of the bar.
void Gui::lecture_settings() {
  constexpr float kWidth = 17.0f;
  const ImVec2 whole = ImGui::GetIO().DisplaySize;
  const float width = std::min(kWidth * ImGui::GetFontSize(), whole.x);
  const float low = whole.y - std::max(bar_height_, ImGui::GetFrameHeight());
  ImGui::SetNextWindowPos(ImVec2(whole.x, low), 0, ImVec2(1.0f, 1.0f));
  ImGui::SetNextWindowSizeConstraints(ImVec2(width, 0.0f), ImVec2(width, low));
  ImGui::PushStyleColor(ImGuiCol_WindowBg, ImGui::GetStyleColorVec4(ImGuiCol_PopupBg));
  ImGui::PushStyleVar(ImGuiStyleVar_WindowBorderSize, 1.0f);
  ImGui::Begin("lecture_settings", nullptr,
               ImGuiWindowFlags_NoTitleBar | ImGuiWindowFlags_NoMove | ImGuiWindowFlags_NoResize |
                   ImGuiWindowFlags_NoCollapse | ImGuiWindowFlags_NoSavedSettings |
                   ImGuiWindowFlags_AlwaysAutoResize);
  scale_slider();
  View view = session_.view();
  const bool sliders = choose_sliders(view.lecture);
  const bool plot = choose_lecture_plot(view.lecture);
  controls_.show(view, sliders || plot);
  if (bar_has_tools()) {
    mouse_tools_.sliders(session_.scene(), controls_);
  } else if (mouse_tools_.panel(session_.scene(), controls_)) {
    lift_pen();
  }
  controls_.toggle("lecture.captions", "Caption", "The caption of the scene", tools_.captions);
  if (choose(controls_, "lecture.theme", "Theme", "Colours in lecture mode", kThemes, tools_.theme,
             Theme::Projector)) {
    viewport_.redraw();
  }
  ImGui::End();
  ImGui::PopStyleVar();
  ImGui::PopStyleColor();
}

// Lists of the names of sliders. Returns true if another slider was chosen.
bool Gui::choose_sliders(Lecture& lecture) {
  std::vector<std::string> words = {"none"};
  {
    const ChosenControls none(controls_, {});
    all_controls();
    for (std::string& name : controls_.take_sliders()) words.push_back(std::move(name));
  }
  std::vector<std::string> names = lecture_sliders();
  names.resize(Lecture::kMostSliders, words.front());
  const std::vector<std::string> usual = usual_sliders(session_.scene());
  bool changed = false;
  for (std::size_t k = 0; k < names.size(); ++k) {
    const auto place = [&](const std::string& name) {
      const auto found = std::ranges::find(words, name);
      return found == words.end() ? 0 : static_cast<int>(found - words.begin());
    };
    int chosen = place(names[k]);
    if (controls_.choice(fmt::format("lecture.slider.{}", k + 1).c_str(),
                         fmt::format("Slider {}", k + 1).c_str(), "Name of a slider", words, chosen,
                         k < usual.size() ? place(usual[k]) : 0)) {
      names[k] = words[static_cast<std::size_t>(chosen)];
      changed = true;
    }
  }
  if (!changed) return false;
  std::erase(names, words.front());
  lecture.sliders = std::move(names);
  return true;
}

bool Gui::choose_lecture_plot(Lecture& lecture) {
  return choose(controls_, "lecture.plot_of", "Plot", "The large plot", kLecturePlots, lecture.plot,
                session_.opened().view.lecture.plot);
}

// Scale of all texts and widgets. It acts when the slider is released, because it moves the slider.
void Gui::scale_slider() {
  controls_.number({.key = "window.scale",
                    .name = "Size",
                    .help = "Of all texts and widgets of the window",
                    .low = 1.0,
                    .high = 3.0,
                    .format = "%.2f"},
                   wanted_scale_, 1.0);
  if (!ImGui::IsMouseDown(0)) text_scale_ = wanted_scale_;
}

// Draws with the pen, and follows the pointer. Returns whether the mouse belongs to the pen.
bool Gui::use_pen(bool over) {
  const ImGuiIO& io = ImGui::GetIO();
  const double now = ImGui::GetTime();
  const bool held = panels_.lecture && tools_.pen && over && ImGui::IsMouseDown(0);
  held ? tools_.lines.draw_to(io.MousePos, now) : tools_.lines.lift();
  if (panels_.lecture && tools_.pointer && over) {
    tools_.trail.draw_to(io.MousePos, now);
  } else {
    tools_.trail.lift();
  }
  tools_.lines.update(now);
  tools_.trail.update(now);
  return panels_.lecture && tools_.pen;
}

void Gui::paint_ink(ImDrawList& list, bool over) const {
  const float unit = ImGui::GetFontSize();
  const double now = ImGui::GetTime();
  tools_.lines.paint(list, packed(kRed), 0.25f * unit, now);
  tools_.trail.paint(list, packed(accent_colour()), 0.35f * unit, now);
  if (panels_.lecture && tools_.pointer && over) {
    list.AddCircle(ImGui::GetIO().MousePos, 0.9f * unit, packed(accent_colour()), 0, 0.15f * unit);
  }
}

void Gui::set_playlist(std::vector<PlaylistItem> playlist) {
  playlist_ = std::move(playlist);
}

// Opens the scene some places further in the playlist, or in the gallery.
void Gui::step_scene(int step) {
  if (playlist_.empty()) {
    return open_gallery_scene(gallery_.neighbour(session_.opened().title, step));
  }
  const auto next = static_cast<std::size_t>(static_cast<std::ptrdiff_t>(at_) + step);
  if (next >= playlist_.size()) {
    return session_.report(step < 0 ? "This is the first scene of the playlist"
                                  : "This is the last scene of the playlist");
  }
  before_loss([this, next] {
    at_ = next;
    const auto& [scene, seed] = playlist_[next];
    open(scene, seed.value_or(session_.frame().seed));
  });
}

}  // namespace clatter
