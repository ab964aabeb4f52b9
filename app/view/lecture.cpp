#include "app/view/lecture.h"

#include <fmt/format.h>
#include <imgui.h>

#include <algorithm>
#include <cmath>
#include <nlohmann/json.hpp>
#include <utility>

#include "app/plots/plot_colours.h"
#include "app/plots/plots.h"
#include "app/view/controls.h"
#include "app/view/enum_list.h"
#include "app/view/messages.h"
#include "app/view/plots_panel.h"
#include "app/view/scene_opener.h"
#include "app/view/style.h"
#include "app/view/timeline.h"
#include "app/view/top_bar.h"
#include "app/view/viewport.h"
#include "engine/scene/enum_names.h"
#include "render/typography/fonts.h"

namespace clatter {

static constexpr float kSliderWidth = 12.0f;  // least width of a slider, in text sizes

LectureMode::LectureMode(const WindowParts& parts, PlotsPanel& plots, SceneOpener& opener)
    : log_(parts.log),
      session_(parts.session),
      controls_(parts.controls),
      viewport_(parts.viewport),
      mouse_tools_(parts.mouse_tools),
      text_scale_(parts.text_scale),
      panels_(parts.panels),
      plots_(plots),
      opener_(opener),
      sliders_(parts, plots) {}

void LectureMode::toggle() {
  const bool on = !panels_.lecture;
  if (on) panels_.lesson = panels_.plots = false;
  panels_.lecture = on;
  panels_.panels = !on;
  wipe();
  trail_.clear();
  viewport_.redraw();
}

void LectureMode::draw(Area& area, Timeline& timeline) {
  area.high.y -= bar();
  if (!session_.frame().scene) return;
  if (timeline_) area.high.y -= timeline.draw(session_, controls_, log_, area);
  if (panels_.lesson) {
    area.high.y -= lesson_strip(session_.scene(), area, controls_, panels_.lesson);
  }
  area.low.y += caption_strip(area);
  column(area);
  if (settings_) draw_settings();
}

bool LectureMode::use_key(char key) {
  switch (key) {
    case 'd':
      toggle_pen();
      return true;
    case 'e':
      wipe();
      return true;
    case 'k':
      pointer_ = !pointer_;
      return true;
    case 'w':
      press_stopwatch();
      return true;
    default:
      return false;
  }
}

bool LectureMode::shows_profile() const {
  return panels_.lecture && !panels_.panels && plot_ &&
         session_.view().lecture.plot == LecturePlot::Profile;
}

View LectureMode::shown_view() const {
  View view = session_.view();
  view.theme = theme();
  return view;
}

bool LectureMode::changes() const {
  return panels_.lecture && (trail_.visible() || stopwatch_.runs());
}

// Title and caption of the scene along the upper edge, as far as they leave enough room. Returns
// the height of the strip.
float LectureMode::caption_strip(const Area& area) {
  constexpr float kMost = 0.25f;   // height over that of the window
  constexpr float kLeast = 14.0f;  // width of the caption beside the title, in text sizes
  const auto& [title, caption] = std::pair(session_.scene().title, session_.scene().caption);
  if (!captions_ || (title.empty() && caption.empty())) return 0.0f;
  const ImGuiStyle& style = ImGui::GetStyle();
  const float unit = ImGui::GetFontSize();
  const float width = area.high.x - area.low.x, room = width - 2.0f * style.WindowPadding.x;
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
  ImGui::SetNextWindowPos(area.low);
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
  log_.widget("lecture.caption", area.low.x, area.low.y, width, height);
  ImGui::End();
  return height;
}

// The large plot with the sliders below it, right of the gas; in small windows the sliders alone,
// below the gas.
void LectureMode::column(Area& area) {
  constexpr float kLeast = 15.0f, kMost = 30.0f;  // width of the plot, in text sizes
  constexpr float kShare = 0.36f, kMostShare = 0.46f;
  constexpr float kLeastPlot = 6.0f;             // height of the plot, in text sizes
  constexpr float kLeastOfWindow = 1.0f / 3.0f;  // the same, over that of the window
  constexpr float kMostHeight = 0.4f;
  const ImGuiStyle& style = ImGui::GetStyle();
  const float unit = ImGui::GetFontSize();
  const float whole = area.high.x - area.low.x, tall = area.high.y - area.low.y;
  std::vector<std::string> names = sliders_.names();
  const std::size_t profile =
      plots_.profiled() < profile_names(plots_.profile_axis()).size() - 1 ? plots_.profiled() : 0;
  const auto plot = lecture_plot(plot_ ? session_.view().lecture.plot : LecturePlot::None,
                                 plots_.gases(), profile, panel_theme(shown_view()));
  const bool wide = plot && kLeast * unit <= kMostShare * whole;
  // The plot keeps its height; sliders without room are left out.
  const float least = std::max(kLeastPlot * unit, kLeastOfWindow * ImGui::GetIO().DisplaySize.y);
  const auto has_room = [&] { return sliders_.height(names, 1) + least + 3.0f * unit <= tall; };
  while (wide && names.size() > 1 && !has_room()) names.pop_back();
  const float below = sliders_.height(names, 1);
  const bool beside = wide && has_room();
  plot_frame_.reset();
  if (beside) {
    const float width = std::round(
        std::clamp(kShare * whole, kLeast * unit, std::min(kMost * unit, kMostShare * whole)));
    ImGui::SetNextWindowPos(ImVec2(area.high.x - width, area.low.y));
    ImGui::SetNextWindowSize(ImVec2(width, tall));
    ImGui::Begin("lecture", nullptr, kFixedPanel | ImGuiWindowFlags_NoScrollbar);
    const ImVec2 low = ImGui::GetCursorScreenPos();
    const float room = ImGui::GetContentRegionAvail().y - below;
    ImGui::BeginChild("plot", ImVec2(0.0f, room), false, ImGuiWindowFlags_NoScrollbar);
    const float height = std::max(room - plot_heading_, kLeastPlot * unit);
    plot_frame_ = draw_plot(*plot, height, !pen_);
    lines_.paint(*ImGui::GetWindowDrawList(), packed(kRed), 0.25f * unit, ImGui::GetTime());
    paint_slope(*ImGui::GetWindowDrawList());
    plot_heading_ = ImGui::GetCursorPosY() - height;
    ImGui::EndChild();
    log_.widget("lecture.plot", low.x, low.y, ImGui::GetContentRegionAvail().x, room);
    if (sliders_.draw(names, 1)) lift_pen();
    ImGui::End();
    area.high.x -= width;
    return;
  }
  if (names.empty()) return;
  const auto columns = static_cast<std::size_t>(
      std::clamp((whole - 2.0f * style.WindowPadding.x) / (kSliderWidth * unit), 1.0f,
                 static_cast<float>(names.size())));
  const float height = std::round(
      std::min(sliders_.height(names, columns) + 2.0f * style.WindowPadding.y, kMostHeight * tall));
  ImGui::SetNextWindowPos(ImVec2(area.low.x, area.high.y - height));
  ImGui::SetNextWindowSize(ImVec2(whole, height));
  ImGui::Begin("lecture", nullptr, kFixedPanel);
  if (sliders_.draw(names, columns)) lift_pen();
  ImGui::End();
  area.high.y -= height;
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
float LectureMode::bar() {
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
  if (button("previous_scene", "←", "Previous scene ( [ )", false)) opener_.step(-1);
  if (const std::string place = opener_.place(); !place.empty()) {
    place_next(ImGui::CalcTextSize(place.c_str()).x);
    ImGui::AlignTextToFramePadding();
    ImGui::TextUnformatted(place.c_str());
  }
  if (button("next_scene", "→", "Next scene ( ] )", false)) opener_.step(1);
  place_next(2.0f * icon);
  if (icon_button(controls_, "play", session_.frame().plays ? Icon::Pause : Icon::Play,
                  "Play or pause (Space)")) {
    session_.play(!session_.frame().plays);
  }
  if (icon_button(controls_, "reset", Icon::Reset, "Restart (R)")) session_.restart();
  if (button("lecture.timeline", "Timeline", "The time of the run", timeline_)) {
    timeline_ = !timeline_;
  }
  for (const ToolText& tool : kTools) {
    if (!bar_has_tools() || draws_fixtures(tool.tool)) break;
    if (button(tool.key, tool.name, tool.help, mouse_tools_.tool() == tool.tool)) {
      toggle_tool(tool.tool);
    }
  }
  if (button("lecture.pen", "Pen",
             "The mouse draws lines; with Shift on the plot, a slope (D). E wipes them", pen_)) {
    toggle_pen();
  }
  if (button("lecture.pointer", "Pointer", "Ring and trail of the pointer (K)", pointer_)) {
    pointer_ = !pointer_;
  }
  stopwatch_button();
  if (button("lecture.settings", "…", "Sliders, plot, caption, colours and size", settings_)) {
    settings_ = !settings_;
  }
  if (button("lecture.close", "×", "Ends lecture mode (L)", false)) toggle();
  bar_height_ = std::round(ImGui::GetCursorPosY());
  ImGui::End();
  ImGui::PopStyleVar(2);
  return height;
}

// Whether the bar has room for the mouse tools in its only line. Else they are in the settings.
bool LectureMode::bar_has_tools() const {
  constexpr float kWidth = 52.0f;  // of the bar with them, in text sizes
  return ImGui::GetIO().DisplaySize.x > kWidth * ImGui::GetFontSize();
}

// The stopwatch with its times. The room for the times does not depend on their digits.
void LectureMode::stopwatch_button() {
  const Frame& frame = session_.frame();
  if (std::exchange(run_, frame.run) != frame.run) stopwatch_.clear();
  const auto now = Stopwatch::Clock::now();
  const auto [simulated, seconds] = stopwatch_.read(frame.snapshot.time, now);
  const bool zero = stopwatch_.at_zero();
  const std::string label =
      (zero ? "Stopwatch" : fmt::format("{:.1f} s   t = {:.2f}", seconds, simulated)) +
      "###stopwatch";
  const float width =
      std::max(zero ? 0.0f : button_width("000.0 s   t = 000.00"), button_width(label.c_str()));
  place_next(width);
  if (controls_.button("lecture.stopwatch", label.c_str(),
                       "Stopwatch of real time and simulation time: start, stop, zero (W)", width,
                       stopwatch_.runs())) {
    press_stopwatch();
  }
}

void LectureMode::press_stopwatch() {
  const double time = session_.frame().snapshot.time;
  const auto now = Stopwatch::Clock::now();
  stopwatch_.press(time, now);
  const auto [simulated, seconds] = stopwatch_.read(time, now);
  log_.event("stopwatch", {{"runs", stopwatch_.runs()},
                           {"time", time},
                           {"simulated", simulated},
                           {"seconds", seconds}});
}

void LectureMode::toggle_pen() {
  pen_ = !pen_;
  lines_.lift();
  if (pen_) mouse_tools_.leave();
}

void LectureMode::wipe() {
  lines_.clear();
  slope_.reset();
}

void LectureMode::lift_pen() {
  pen_ = false;
  lines_.lift();
}

void LectureMode::toggle_tool(Tool tool) {
  mouse_tools_.toggle(tool);
  if (mouse_tools_.tool()) lift_pen();
}

// The settings of lecture mode, above the right end of the bar.
void LectureMode::draw_settings() {
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
  text_scale_.draw(controls_);
  View view = session_.view();
  const bool sliders = sliders_.choose(view.lecture);
  const bool plot = choose_plot(view.lecture);
  controls_.show(view, sliders || plot);
  if (bar_has_tools()) {
    mouse_tools_.sliders(session_.scene(), controls_);
  } else if (mouse_tools_.panel(session_.scene(), controls_)) {
    lift_pen();
  }
  if (controls_.button("lecture.wipe", "Wipe", "Removes the lines of the pen (E)",
                       ImGui::GetContentRegionAvail().x)) {
    wipe();
  }
  controls_.toggle("lecture.captions", "Caption", "The caption of the scene", captions_);
  if (choose(controls_, "lecture.theme", "Theme", "Colours in lecture mode", kThemes, theme_,
             Theme::Projector)) {
    viewport_.redraw();
  }
  ImGui::End();
  ImGui::PopStyleVar();
  ImGui::PopStyleColor();
}

bool LectureMode::choose_plot(Lecture& lecture) {
  return choose(controls_, "lecture.plot_of", "Plot", "The large plot", kLecturePlots, lecture.plot,
                session_.opened().view.lecture.plot);
}

void LectureMode::use_pen(bool over) {
  const ImGuiIO& io = ImGui::GetIO();
  const double now = ImGui::GetTime();
  const bool on_plot = plot_frame_ && plot_frame_->contains(io.MousePos);
  const bool held = draws() && (over || on_plot) && ImGui::IsMouseDown(0);
  const bool slope = io.KeyShift && on_plot;
  if (slope) draw_slope(held);
  held && !slope ? lines_.draw_to(io.MousePos, now) : lines_.lift();
  if (panels_.lecture && pointer_ && over) {
    trail_.draw_to(io.MousePos, now);
  } else {
    trail_.lift();
  }
  lines_.update(now);
  trail_.update(now);
}

// A press begins a triangle, and its other end follows the mouse.
void LectureMode::draw_slope(bool held) {
  if (!held) return;
  const Vec2 point = plot_frame_->point(ImGui::GetIO().MousePos);
  if (ImGui::IsMouseClicked(0) || !slope_) slope_ = {point, point};
  (*slope_)[1] = point;
}

void LectureMode::paint_slope(ImDrawList& list) const {
  if (!slope_ || !plot_frame_) return;
  const float unit = ImGui::GetFontSize();
  const auto& [from, to] = *slope_;
  const ImVec2 a = plot_frame_->at(from), b = plot_frame_->at(to), corner(b.x, a.y);
  const ImU32 ink = packed(kRed);
  list.AddTriangle(a, corner, b, ink, 0.12f * unit);
  const std::string text = slope_text(*plot_frame_, from, to);
  const ImVec2 size = ImGui::CalcTextSize(text.c_str());
  const float left = std::clamp(b.x + 0.4f * unit, plot_frame_->low.x,
                                std::max(plot_frame_->low.x, plot_frame_->high.x - size.x));
  const ImVec2 low(left, 0.5f * (a.y + b.y - size.y));
  list.AddRectFilled(low, ImVec2(low.x + size.x, low.y + size.y),
                     ImGui::GetColorU32(ImGuiCol_PopupBg));
  list.AddText(low, ink, text.c_str());
}

void LectureMode::paint_ink(ImDrawList& list, bool over) const {
  const float unit = ImGui::GetFontSize();
  const double now = ImGui::GetTime();
  lines_.paint(list, packed(kRed), 0.25f * unit, now);
  trail_.paint(list, packed(accent_colour()), 0.35f * unit, now);
  if (panels_.lecture && pointer_ && over) {
    list.AddCircle(ImGui::GetIO().MousePos, 0.9f * unit, packed(accent_colour()), 0, 0.15f * unit);
  }
}

}  // namespace clatter
