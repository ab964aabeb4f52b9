#include "app/view/timeline.h"

#include <fmt/ranges.h>
#include <imgui.h>

#include <algorithm>
#include <cmath>
#include <utility>

#include "app/plots/plot_colours.h"
#include "app/view/style.h"
#include "app/view/top_bar.h"
#include "render/typography/fonts.h"

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

// The change whose mark is at a place, if there is one that can move.
std::optional<std::size_t> mark_at(const Frame& frame, const TimeScale& scale, float place,
                                   float reach) {
  std::optional<std::size_t> found;
  const std::vector<Change>& changes = frame.scene->changes;
  for (std::size_t number = 0; number < changes.size(); ++number) {
    const float distance = std::fabs(scale.place(changes[number].time) - place);
    if (changes[number].time <= 0.0 || changes[number].time > scale.end || distance > reach)
      continue;
    reach = distance;
    found = number;
  }
  return found;
}

// The number with the fewest digits within a pixel of the time at a place, > 0.
double round_time(const TimeScale& scale, float place) {
  const double pixel = scale.end / std::max(1.0f, scale.right - scale.left);
  const double step = std::pow(10.0, std::ceil(std::log10(pixel)));
  return std::max(1.0, std::round(scale.time(place) / step)) * step;
}

std::string text_of(const VecX& vector) {
  return fmt::format("({:.4g})", fmt::join(vector, ", "));
}

std::string text_of(const Nudge& nudge) {
  std::string text = nudge.particle ? fmt::format("Velocity of particle {}", *nudge.particle)
                                    : fmt::format("Velocities within {:.4g} of {}", *nudge.radius,
                                                  text_of(*nudge.centre));
  if (nudge.scale) text += fmt::format(", from their mean: times {:.4g}", *nudge.scale);
  if (nudge.add) text += ": plus " + text_of(*nudge.add);
  if (nudge.set) text += " = " + text_of(*nudge.set);
  return text;
}

// Whether a change needs time.
bool lasts(const Change& change) {
  return change.ramp || change.piston;
}

std::string text_of(const Change& change) {
  std::string text = lasts(change) ? fmt::format("t = {:.6g} to {:.6g}", change.time, change.until)
                                   : fmt::format("t = {:.6g}", change.time);
  for (const Override& law : change.set) text += fmt::format("\n{} = {}", law.key, law.value);
  if (change.nudge) text += "\n" + text_of(*change.nudge);
  if (change.puff) {
    text += fmt::format("\n{} particles added within {:.4g} of {}", change.puff->count,
                        change.puff->radius, text_of(change.puff->centre));
  }
  if (change.reverse) text += "\nAll velocities reversed";
  if (change.piston) text += fmt::format("\nPiston to x = {:.6g}", *change.piston);
  return text;
}

// The marks under the mouse in words, the first of many; empty: none.
std::string marks_near(const Frame& frame, const TimeScale& scale, float place, float reach) {
  constexpr std::size_t kMost = 3;
  std::vector<std::string> marks;
  const auto add = [&](double time, const std::string& mark) {
    if (time > frame.head || std::fabs(scale.place(time) - place) >= reach) return;
    marks.push_back(mark);
  };
  for (const Change& change : frame.scene->changes) add(change.time, text_of(change));
  for (const double stop : frame.stops) {
    add(stop, fmt::format("t = {:.6g}\nThe run stopped by itself", stop));
  }
  if (marks.size() > kMost) {
    const std::string rest = fmt::format("and {} more", marks.size() - kMost + 1);
    marks.resize(kMost - 1);
    marks.push_back(rest);
  }
  return fmt::format("{}", fmt::join(marks, "\n\n"));
}

void draw_mark(ImDrawList& list, const TimeScale& scale, const Change& change, float y,
               float size) {
  const float x = scale.place(change.time);
  if (lasts(change)) {
    list.AddLine(ImVec2(x, y - size), ImVec2(scale.place(change.until), y - size), packed(kOrange),
                 0.25f * size);
  }
  list.AddTriangleFilled(ImVec2(x - 0.6f * size, y - 1.6f * size),
                         ImVec2(x + 0.6f * size, y - 1.6f * size), ImVec2(x, y - 0.5f * size),
                         packed(kOrange));
}

void draw_stop(ImDrawList& list, const TimeScale& scale, double stop, float y, float size) {
  const float x = scale.place(stop);
  list.AddRectFilled(ImVec2(x - 0.4f * size, y - 1.4f * size),
                     ImVec2(x + 0.4f * size, y - 0.6f * size), packed(kRed));
}

// The change with its mark moved to another time.
Change moved(Change change, double time) {
  change.until += time - change.time;
  change.time = time;
  return change;
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
  const ImVec2 low = ImGui::GetCursorScreenPos(), mouse = ImGui::GetIO().MousePos;
  const TimeScale scale(frame, low.x + 0.5f * unit, low.x + width - 0.5f * unit);
  const float line = low.y + 0.6f * height, thin = low.y + 0.9f * height;
  const float reach = 0.35f * unit;
  ImGui::InvisibleButton("##track", ImVec2(width, height));
  log.widget("timeline", scale.left, low.y, scale.right - scale.left, height);
  const double time = snapped(frame, scale, mouse.x, reach);
  const bool on_other = frame.other_future && mouse.y > line + reach &&
                        mouse.x >= scale.place((*frame.other_future)[0]);
  if (ImGui::IsItemActivated() && on_other) {
    session.exchange_futures();
  } else if (ImGui::IsItemActivated()) {
    press_ = Press{.place = mouse.x, .time = time};
    if (mouse.y < line - reach) press_->mark = mark_at(frame, scale, mouse.x, 0.5f * unit);
    press_->repeats = ImGui::GetIO().KeyShift && !press_->mark;
    press_->played = frame.plays;
    press_->backwards = frame.backwards;
  }
  if (ImGui::IsItemHovered() && !press_) {
    std::string text = marks_near(frame, scale, mouse.x, reach);
    if (text.empty()) text = fmt::format("t = {:.6g}", time);
    if (on_other) text = "The other future: a click returns to it";
    // Above the strip, so that it covers no mark, and within the window.
    ImGui::SetNextWindowPos(ImVec2(mouse.x, low.y - unit), ImGuiCond_Always,
                            ImVec2(mouse.x / ImGui::GetIO().DisplaySize.x, 1.0f));
    ImGui::SetTooltip("%s", text.c_str());
  }

  ImDrawList& list = *ImGui::GetWindowDrawList();
  const float thick = 0.28f * unit;
  const ImU32 known = ImGui::GetColorU32(ImGuiCol_TextDisabled);
  const float now = scale.place(frame.snapshot.time);
  const auto bar = [&](float right, ImU32 ink) {
    list.AddRectFilled(ImVec2(scale.left, line - 0.5f * thick), ImVec2(right, line + 0.5f * thick),
                       ink, 0.5f * thick);
  };
  bar(scale.right, ImGui::GetColorU32(ImGuiCol_FrameBgHovered));
  bar(scale.place(frame.head), known);
  bar(now, packed(accent_colour()));
  if (const auto loop =
          press_ && press_->repeats ? std::optional(press_->stretch(time)) : frame.loop) {
    list.AddRect(ImVec2(scale.place((*loop)[0]), line - 1.2f * thick),
                 ImVec2(scale.place((*loop)[1]), line + 1.2f * thick), packed(accent_colour()),
                 thick, 0, 0.4f * thick);
  }
  if (frame.other_future) {
    const float from = scale.place((*frame.other_future)[0]),
                to = scale.place((*frame.other_future)[1]);
    list.AddLine(ImVec2(from, line), ImVec2(from, thin), known);
    list.AddLine(ImVec2(from, thin), ImVec2(to, thin), on_other ? packed(accent_colour()) : known,
                 0.5f * thick);
    log.widget("timeline.other_future", from, thin - thick, to - from, 2.0f * thick);
  }
  const float size = 0.5f * unit;
  const std::vector<Change>& changes = frame.scene->changes;
  for (std::size_t number = 0; number < changes.size(); ++number) {
    const Change& change = changes[number];
    if (change.time > scale.end) continue;
    const bool drags = press_ && press_->mark == number && press_->moved(mouse.x);
    draw_mark(list, scale, drags ? moved(change, round_time(scale, mouse.x)) : change, line, size);
    log.widget(fmt::format("timeline.change.{}", number), scale.place(change.time) - size,
               line - 1.6f * size, 2.0f * size, size);
  }
  for (const double stop : frame.stops) draw_stop(list, scale, stop, line, size);
  list.AddCircleFilled(ImVec2(now, line), 0.42f * unit, packed(accent_colour()));
  if (press_) drag(session, time, round_time(scale, mouse.x), mouse.x);
}

// A drag shows the gas at each time. A stretch and a mark count when the mouse is released.
void Timeline::drag(Session& session, double time, double mark_time, float place) {
  const bool down = ImGui::IsMouseDown(0), moves_mark = press_->mark && press_->moved(place);
  if (!press_->mark && !press_->repeats && press_->jumped_to != time) {
    press_->jumped_to = time;
    session.jump(time);
  }
  if (down) return;
  const Press press = *std::exchange(press_, std::nullopt);
  if (press.repeats) {
    const auto [from, to] = press.stretch(time);
    session.repeat(from, to);
  } else if (moves_mark) {
    session.move_change(*press.mark, mark_time);
  } else {
    if (press.mark) session.jump(press.time);
    if (press.backwards) {
      session.play_backwards();
    } else if (press.played) {
      session.play(true);
    }
  }
}

}  // namespace clatter
