#include "app/view/timeline.h"

#include <fmt/format.h>
#include <imgui.h>

#include <algorithm>
#include <cmath>

#include "app/view/icons.h"
#include "app/view/plot_colours.h"
#include "app/view/style.h"

namespace clatter {

namespace {

// The times of a run along a line of the window, from 0 to the end of both futures.
struct TimeScale {
  float left, right;
  double end;

  TimeScale(const Frame& frame, float from, float to)
      : left(from),
        right(to),
        end(std::max(frame.head, frame.other_future ? (*frame.other_future)[1] : 0.0)) {}

  float place(double time) const {
    const double share = end > 0.0 ? std::min(time / end, 1.0) : 1.0;
    return left + static_cast<float>(share) * (right - left);
  }
  double time(float place) const {
    return end * std::clamp(static_cast<double>(place - left) / (right - left), 0.0, 1.0);
  }
};

// A time near a place that the mouse snaps to: the head, or that of a change or stop.
double snapped(const Frame& frame, const TimeScale& scale, float place, float reach) {
  double time = scale.time(place);
  const auto snap = [&](double to) {
    const float distance = std::fabs(scale.place(to) - place);
    if (to <= frame.head && distance < reach) {
      reach = distance;
      time = to;
    }
  };
  snap(0.0);
  snap(frame.head);
  for (const Change& change : frame.scene->changes) snap(change.time);
  for (const double stop : frame.stops) snap(stop);
  return std::min(time, frame.head);
}

std::string text_of(const Change& change) {
  std::string text = change.ramp ? fmt::format("t = {:.6g} to {:.6g}", change.time, change.until)
                                 : fmt::format("t = {:.6g}", change.time);
  for (const Override& law : change.set) text += fmt::format("\n{} = {}", law.key, law.value);
  return text;
}

// The marks under the mouse in words.
std::string marks_near(const Frame& frame, const TimeScale& scale, float place, float reach) {
  std::string text;
  const auto near = [&](double time) {
    return time <= frame.head && std::fabs(scale.place(time) - place) < reach;
  };
  for (const Change& change : frame.scene->changes) {
    if (near(change.time)) text += "\n\n" + text_of(change);
  }
  for (const double stop : frame.stops) {
    if (near(stop)) text += fmt::format("\n\nt = {:.6g}\nThe run stopped by itself", stop);
  }
  return text;
}

void draw_marks(ImDrawList& list, const Frame& frame, const TimeScale& scale, float y, float size) {
  for (const Change& change : frame.scene->changes) {
    if (change.time > scale.end) continue;
    const float x = scale.place(change.time);
    if (change.ramp) {
      list.AddLine(ImVec2(x, y - size), ImVec2(scale.place(change.until), y - size),
                   packed(kOrange), 0.25f * size);
    }
    list.AddTriangleFilled(ImVec2(x - 0.6f * size, y - 1.6f * size),
                           ImVec2(x + 0.6f * size, y - 1.6f * size), ImVec2(x, y - 0.5f * size),
                           packed(kOrange));
  }
  for (const double stop : frame.stops) {
    const float x = scale.place(stop);
    list.AddRectFilled(ImVec2(x - 0.4f * size, y - 1.4f * size),
                       ImVec2(x + 0.4f * size, y - 0.6f * size), packed(kRed));
  }
}

}  // namespace

float Timeline::draw(Session& session, Controls& controls, ScriptLog& log, const Area& area) {
  const Frame& frame = session.frame();
  const float unit = ImGui::GetFontSize(), width = area.high.x - area.low.x;
  const float height = std::round(ImGui::GetFrameHeight() + 0.9f * unit);
  ImGui::PushStyleVar(ImGuiStyleVar_WindowPadding,
                      ImVec2(ImGui::GetStyle().WindowPadding.x, 0.45f * unit));
  ImGui::SetNextWindowPos(ImVec2(area.low.x, area.high.y - height));
  ImGui::SetNextWindowSize(ImVec2(width, height));
  ImGui::Begin("timeline", nullptr, kFixedPanel | ImGuiWindowFlags_NoScrollbar);
  if (icon_button(controls, "collision_back", Icon::CollisionBack,
                  "Previous collision (Shift + , )")) {
    session.step_collision_back();
  }
  const bool back = frame.backwards;
  if (icon_button(controls, "back", back ? Icon::Pause : Icon::Back,
                  back ? "Pause (Space)" : "Play backwards (B)")) {
    back ? session.play(false) : session.play_backwards();
  }
  const std::string end = fmt::format("{:.2f}", frame.head);
  const float right = ImGui::CalcTextSize(end.c_str()).x + 1.35f * ImGui::GetFrameHeight() +
                      2.0f * ImGui::GetStyle().ItemSpacing.x;
  track(session, log, ImGui::GetContentRegionAvail().x - right);
  ImGui::SameLine();
  if (icon_button(controls, "head", Icon::Head, "Latest time of the run (End)")) {
    session.go_to_head();
  }
  ImGui::AlignTextToFramePadding();
  ImGui::TextDisabled("%s", end.c_str());
  ImGui::End();
  ImGui::PopStyleVar();
  return height;
}

void Timeline::track(Session& session, ScriptLog& log, float width) {
  const Frame& frame = session.frame();
  const float unit = ImGui::GetFontSize(), height = ImGui::GetFrameHeight();
  const ImVec2 low = ImGui::GetCursorScreenPos();
  const TimeScale scale(frame, low.x + 0.5f * unit, low.x + width - 0.5f * unit);
  const float line = low.y + 0.6f * height, thin = low.y + 0.9f * height;
  const float reach = 0.35f * unit;
  ImGui::InvisibleButton("##track", ImVec2(width, height));
  log.widget("timeline", scale.left, low.y, scale.right - scale.left, height);
  const ImVec2 mouse = ImGui::GetIO().MousePos;
  const bool on_other = frame.other_future && !held_ && mouse.y > line + reach &&
                        mouse.x >= scale.place((*frame.other_future)[0]);
  if (ImGui::IsItemActivated() && on_other) {
    session.exchange_futures();
  } else if (ImGui::IsItemActivated() && ImGui::GetIO().KeyShift) {
    loop_from_ = snapped(frame, scale, mouse.x, reach);
  } else if (ImGui::IsItemActivated()) {
    held_ = true;
    played_ = frame.plays;
    backwards_ = frame.backwards;
    sent_ = -1.0;
  }
  const double under_mouse = snapped(frame, scale, mouse.x, reach);
  std::optional<std::array<double, 2>> loop = frame.loop;
  if (loop_from_) {
    loop = {std::min(*loop_from_, under_mouse), std::max(*loop_from_, under_mouse)};
    mark_loop(session, *loop);
  }
  if (held_) use_mouse(session, under_mouse);
  if (ImGui::IsItemHovered() && !held_) {
    const std::string text = on_other ? "The other future: a click returns to it"
                                      : fmt::format("t = {:.6g}", under_mouse) +
                                            marks_near(frame, scale, mouse.x, reach);
    // Above the strip, so that it covers no mark.
    ImGui::SetNextWindowPos(ImVec2(mouse.x, low.y - unit), ImGuiCond_Always, ImVec2(0.5f, 1.0f));
    ImGui::SetTooltip("%s", text.c_str());
  }

  ImDrawList& list = *ImGui::GetWindowDrawList();
  const float thick = 0.28f * unit;
  const ImU32 empty = ImGui::GetColorU32(ImGuiCol_FrameBgHovered);
  const ImU32 known = ImGui::GetColorU32(ImGuiCol_TextDisabled);
  const float now = scale.place(frame.snapshot.time);
  list.AddRectFilled(ImVec2(scale.left, line - 0.5f * thick),
                     ImVec2(scale.right, line + 0.5f * thick), empty, 0.5f * thick);
  list.AddRectFilled(ImVec2(scale.left, line - 0.5f * thick),
                     ImVec2(scale.place(frame.head), line + 0.5f * thick), known, 0.5f * thick);
  list.AddRectFilled(ImVec2(scale.left, line - 0.5f * thick), ImVec2(now, line + 0.5f * thick),
                     packed(accent_colour()), 0.5f * thick);
  if (loop) {
    const auto [from, to] = *loop;
    list.AddRect(ImVec2(scale.place(from), line - 1.2f * thick),
                 ImVec2(scale.place(to), line + 1.2f * thick), packed(accent_colour()), thick, 0,
                 0.4f * thick);
  }
  if (frame.other_future) {
    const auto [from, to] = *frame.other_future;
    list.AddLine(ImVec2(scale.place(from), line), ImVec2(scale.place(from), thin), known);
    list.AddLine(ImVec2(scale.place(from), thin), ImVec2(scale.place(to), thin),
                 on_other ? packed(accent_colour()) : known, 0.5f * thick);
    log.widget("timeline.other_future", scale.place(from), thin - thick,
               scale.place(to) - scale.place(from), 2.0f * thick);
  }
  draw_marks(list, frame, scale, line, 0.5f * unit);
  list.AddCircleFilled(ImVec2(now, line), 0.42f * unit, packed(accent_colour()));
}

// The stretch counts when the mouse is released.
void Timeline::mark_loop(Session& session, const std::array<double, 2>& loop) {
  if (ImGui::IsMouseDown(0)) return;
  loop_from_.reset();
  session.repeat(loop[0], loop[1]);
}

// A drag shows the gas at each time; the gas plays on after it if it played before.
void Timeline::use_mouse(Session& session, double time) {
  if (time != sent_) session.jump(time);
  sent_ = time;
  if (ImGui::IsMouseDown(0)) return;
  held_ = false;
  if (backwards_) {
    session.play_backwards();
  } else if (played_) {
    session.play(true);
  }
}

}  // namespace clatter
