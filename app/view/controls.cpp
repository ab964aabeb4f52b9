#include "app/view/controls.h"

#include <fmt/printf.h>
#include <imgui.h>
// TempInputIsActive: only it tells whether a slider is a text field; OpenPopupStack: whether a
// popup is a list.
#include <imgui_internal.h>

#include <algorithm>
#include <cmath>
#include <cstdlib>
#include <type_traits>

#include "app/view/style.h"
#include "engine/scene/key_writer.h"
#include "engine/text.h"
#include "render/typography/fonts.h"

namespace clatter {

static constexpr float kTipWidth = 22.0f;  // in text sizes

// A tooltip of the last widget, beside its window, so that it covers no other widget. At the mouse
// if there is no room beside the window.
static void begin_tip() {
  const float unit = ImGui::GetFontSize();
  const ImVec2 window = ImGui::GetWindowPos(), screen = ImGui::GetIO().DisplaySize;
  const float left = window.x, right = left + ImGui::GetWindowWidth();
  const float room = (kTipWidth + 3.0f) * unit;
  const bool low = ImGui::GetItemRectMin().y > 0.5f * screen.y;
  const float y = low ? ImGui::GetItemRectMax().y : ImGui::GetItemRectMin().y;
  if (low && left <= 0.0f && right >= screen.x) {
    // Above a bar along the lower edge, within the screen.
    const float x = ImGui::GetItemRectMin().x;
    ImGui::SetNextWindowPos(ImVec2(x, window.y - 0.3f * unit), 0, ImVec2(x / screen.x, 1.0f));
  } else if (right + room < screen.x) {
    ImGui::SetNextWindowPos(ImVec2(right + 0.3f * unit, y), 0, ImVec2(0.0f, low ? 1.0f : 0.0f));
  } else if (left > room) {
    ImGui::SetNextWindowPos(ImVec2(left - 0.3f * unit, y), 0, ImVec2(1.0f, low ? 1.0f : 0.0f));
  }
  ImGui::BeginTooltip();
  ImGui::PushTextWrapPos(kTipWidth * unit);
}

static void end_tip() {
  ImGui::PopTextWrapPos();
  ImGui::EndTooltip();
}

static void show_help(const char* help) {
  if (!*help || !ImGui::IsItemHovered()) return;
  begin_tip();
  ImGui::TextUnformatted(help);
  end_tip();
}

// Round arrow at the right end of a line. Returns true if it was clicked.
static bool reset_button() {
  const float size = ImGui::GetFontSize();
  ImGui::SameLine(right_edge() - size);
  const Reach reach(size);
  const bool clicked = ImGui::InvisibleButton("reset", ImVec2(size, size));
  const ImVec2 low = ImGui::GetItemRectMin();
  const ImVec2 centre(low.x + 0.5f * size, low.y + 0.58f * size);
  const ImU32 ink =
      ImGui::GetColorU32(ImGui::IsItemHovered() ? ImGuiCol_Text : ImGuiCol_TextDisabled);
  ImDrawList& list = *ImGui::GetWindowDrawList();
  const float r = 0.32f * size;
  list.PathArcTo(centre, r, -0.9f, 4.4f, 20);
  list.PathStroke(ink, 0, 0.1f * size);
  const ImVec2 tip(centre.x + r * std::cos(-0.9f), centre.y + r * std::sin(-0.9f));
  list.AddTriangleFilled(ImVec2(tip.x - 0.28f * size, tip.y), ImVec2(tip.x + 0.1f * size, tip.y),
                         ImVec2(tip.x + 0.02f * size, tip.y - 0.34f * size), ink);
  if (ImGui::IsItemHovered()) ImGui::SetTooltip("Back to the scene's value");
  return clicked;
}

// Whether the last press of the mouse was on the last widget.
static bool pressed_in_last_item() {
  const ImVec2 low = ImGui::GetItemRectMin(), high = ImGui::GetItemRectMax();
  const ImVec2 press = ImGui::GetIO().MouseClickedPos[ImGuiMouseButton_Left];
  return press.x >= low.x && press.x < high.x && press.y >= low.y && press.y < high.y;
}

// Name and symbol at the left of a line, value with its unit at its right, with room for the arrow.
// Symbol and unit are only in the tooltip if they have no room. Returns true if the value was
// clicked.
static bool headline(const Slider& slider, double value) {
  const float gap = ImGui::GetStyle().ItemSpacing.x;
  const float right = right_edge() - 1.4f * ImGui::GetFontSize();
  std::string text = fmt::sprintf(slider.format, value);
  ImGui::TextUnformatted(slider.name);
  ImGui::SameLine();
  const auto fits = [&](const std::string& words) {
    return ImGui::CalcTextSize((words + text).c_str()).x + gap < right - ImGui::GetCursorPosX();
  };
  if (*slider.symbol && fits(slider.symbol)) {
    ImGui::TextDisabled("%s", slider.symbol);
    ImGui::SameLine();
  }
  const std::string unit = *slider.unit ? std::string(" ") + slider.unit : "";
  if (fits(unit)) text += unit;
  ImGui::SameLine(right - ImGui::CalcTextSize(text.c_str()).x);
  ImGui::TextUnformatted(text.c_str());
  if (!ImGui::IsItemHovered()) return false;
  ImGui::SetMouseCursor(ImGuiMouseCursor_TextInput);
  // At the release: a press on a panel takes the focus from all widgets.
  return ImGui::IsMouseReleased(ImGuiMouseButton_Left) && pressed_in_last_item();
}

// Rounds to three digits, the resolution of dragging.
static double rounded(double value) {
  return std::stod(fmt::format("{:.3g}", value));
}

// Whether a slider may have its tooltip. It would hide a message about the number, so there is none
// until the mouse moves.
bool Controls::explains() {
  const ImVec2 mouse = ImGui::GetIO().MousePos;
  if (std::exchange(messages_, session_.messages()) != session_.messages()) told_at_ = mouse;
  return mouse.x != told_at_.x || mouse.y != told_at_.y;
}

void Controls::explain(const Slider& slider, double usual) {
  if (!ImGui::IsItemHovered() || ImGui::IsItemActive() || !explains()) return;
  const std::string text = fmt::sprintf(slider.format, usual);
  begin_tip();
  ImGui::Text("%s%s%s", slider.name, *slider.symbol ? "  " : "", slider.symbol);
  if (*slider.help) ImGui::TextDisabled("%s", slider.help);
  ImGui::TextDisabled("Here: %s%s%s. Click the number to type.", text.c_str(),
                      *slider.unit ? " " : "", slider.unit);
  end_tip();
}

bool Controls::shows(const std::string& name) {
  if (!chosen_) return true;
  offered_.push_back(name);
  return std::ranges::find(*chosen_, name) != chosen_->end();
}

std::vector<std::pair<std::string, std::string>> Controls::take_missing() {
  std::vector<std::pair<std::string, std::string>> missing;
  for (const std::string& name : *chosen_) {
    if (std::ranges::find(offered_, name) != offered_.end()) continue;
    missing.emplace_back(name, near_miss(name, offered_));
  }
  offered_.clear();
  return missing;
}

void Controls::report_missing(std::uint64_t checked) {
  const auto missing = take_missing();
  if (checked == session_.frame().run) return;
  for (const auto& [name, near] : missing) {
    session_.report("the scene has no control " + in_quotes(name) +
                    (near.empty() ? "" : "; try " + in_quotes(near)));
  }
}

bool Controls::group(const char* name) {
  if (chosen_) return true;
  if (ImGui::GetCursorPosY() > ImGui::GetCursorStartPos().y) ImGui::Spacing();
  ImGui::PushStyleColor(ImGuiCol_Header, ImVec4(0, 0, 0, 0));
  const bool revealed = revealed_ == name;
  if (revealed) ImGui::SetNextItemOpen(true);
  const bool open = ImGui::CollapsingHeader(name, ImGuiTreeNodeFlags_DefaultOpen);
  ImGui::PopStyleColor();
  if (!revealed) return open;
  ImGui::SetScrollHereY(0.0f);
  revealed_.clear();
  return open;
}

void Controls::group_row(std::initializer_list<const char*> names) {
  std::vector<std::string> words;
  float free = ImGui::GetContentRegionAvail().x + ImGui::GetStyle().ItemSpacing.x;
  const auto width = [](const std::string& word) { return ImGui::CalcTextSize(word.c_str()).x; };
  for (const std::string name : names) {
    words.push_back(name.substr(0, name.find(' ')));
    free -= width(words.back()) + ImGui::GetStyle().ItemSpacing.x;
  }
  const float padding = std::floor(free / static_cast<float>(words.size()));
  auto word = words.begin();
  ImGui::PushStyleVar(ImGuiStyleVar_FramePadding, ImVec2(0.0f, ImGui::GetStyle().FramePadding.y));
  for (const std::string name : names) {
    const std::string key = "group." + name, help = "Scrolls to " + name;
    if (button(key.c_str(), word->c_str(), help.c_str(), width(*word) + padding)) revealed_ = name;
    ImGui::SameLine();
    ++word;
  }
  ImGui::PopStyleVar();
  ImGui::NewLine();
}

// The value in the range of the slider. A message states the limit.
double Controls::limited(const Slider& slider, double value) {
  const double within = std::clamp(value, slider.low, slider.high);
  if (within == value) return value;
  const char* side = value > slider.high ? "at most" : "at least";
  const std::string number = fmt::sprintf(slider.logarithmic ? "%g" : slider.format, within);
  session_.report(fmt::format("{}: {} {}{}{}{}{}", slider.name, side, number,
                              *slider.unit ? " " : "", slider.unit, *slider.limit ? "; " : "",
                              slider.limit));
  return within;
}

// Reports typed signs that no number has. Dear ImGui drops them.
void Controls::refuse_letters(const char* name) {
  constexpr std::string_view kOfNumbers = "0123456789.+-*/eE";
  for (const ImWchar sign : ImGui::GetIO().InputQueueCharacters) {
    if (sign < 0x80 && kOfNumbers.find(static_cast<char>(sign)) != std::string_view::npos) continue;
    return session_.report(fmt::format("{}: type a number", name));
  }
}

// `place` is the name of the slider in the script log.
Controls::Moved Controls::draw(const Slider& slider, double& value, double usual,
                               const std::string& place) {
  Moved moved;
  if (chosen_) sliders_.push_back(place);
  if (!shows(place)) return moved;
  ImGui::PushID(slider.key);
  ImGui::PushID(slider.name);
  const bool asked = headline(slider, value);
  log_place(place + ".number");
  if (value != usual) moved.reset = reset_button();

  // ImGui edits a slider as text after Ctrl + click. A double click, and a click on the number,
  // shall do the same.
  ImGuiIO& io = ImGui::GetIO();
  const bool ctrl = io.KeyCtrl;
  io.KeyCtrl = ctrl || io.MouseDoubleClicked[0];
  if (asked) ImGui::SetKeyboardFocusHere();
  const bool typing = ImGui::TempInputIsActive(ImGui::GetID("##value"));
  const float tall = ImGui::GetFrameHeight();
  ImGui::PushStyleVar(ImGuiStyleVar_FramePadding,
                      ImVec2(ImGui::GetStyle().FramePadding.x, typing ? 3.0f : 0.0f));
  if (!typing) ImGui::PushStyleColor(ImGuiCol_Text, ImVec4(0, 0, 0, 0));
  ImGui::SetNextItemWidth(-FLT_MIN);
  // ImGui takes the smallest magnitude of a logarithmic slider from the digits of its format.
  const char* format = slider.logarithmic ? "%.9g" : slider.format;
  const ImGuiSliderFlags flags =
      slider.logarithmic ? ImGuiSliderFlags_Logarithmic | ImGuiSliderFlags_NoRoundToFormat : 0;
  const double was = value;
  if (typing) refuse_letters(slider.name);
  const Reach reach(ImGui::GetFrameHeight(), tall);
  moved.changed = ImGui::SliderScalar("##value", ImGuiDataType_Double, &value, &slider.low,
                                      &slider.high, format, flags);
  if (!typing) ImGui::PopStyleColor();
  ImGui::PopStyleVar();
  io.KeyCtrl = ctrl;
  moved.taken = ImGui::IsItemActivated();
  if (moved.taken) {
    before_ = was;
    cancelled_ = false;
  }
  if (typing) {
    // The number counts once it is complete.
    typed_.reset();
    if (moved.changed && !std::isnan(value)) typed_ = value;
    moved.changed = false;
  } else if (moved.changed && slider.logarithmic) {
    value = rounded(value);
  }
  // A click without a drag changes nothing.
  constexpr float kDrag = 3.0f;
  moved.changed = moved.changed && ImGui::IsMouseDragging(ImGuiMouseButton_Left, kDrag);
  if (!moved.changed) value = was;
  if (ImGui::IsItemDeactivatedAfterEdit()) {
    if (typed_ && !cancelled_) value = limited(slider, *typed_);
    typed_.reset();
    moved.changed = value != was;
    moved.let_go = true;
  }
  log_place(place);
  explain(slider, usual);
  ImGui::PopID();
  ImGui::PopID();
  return moved;
}

// Whether a drag shall change the laws now. Each change is a [[change]] of the saved scene, so
// there are few.
bool Controls::due() {
  constexpr double kBetween = 0.25;  // seconds
  if (!session_.frame().plays || ImGui::GetTime() - set_at_ < kBetween) return false;
  set_at_ = ImGui::GetTime();
  return true;
}

void Controls::law(const Slider& slider, double value, double usual) {
  double shown = holding_ == slider.key ? held_ : value;
  const Moved moved = draw(slider, shown, usual, slider.key);
  const auto text = [&](double number) {
    return std::vector<Override>{{slider.key, value_text(number)}};
  };
  if (moved.changed) {
    holding_ = slider.key;
    held_ = shown;
  }
  if (shown != value && (moved.let_go || due())) session_.set(text(shown));
  if (moved.let_go) {
    holding_.clear();
    if (shown != before_) session_.remember({.before = text(before_), .after = text(shown)});
  }
  if (moved.reset) set(text(value), text(usual));
}

template <class Number>
void Controls::restart(const Slider& slider, Number value, Number usual) {
  const auto nearest = [](double number) {
    return std::is_same_v<Number, int> ? std::round(number) : number;
  };
  double shown = holding_ == slider.key ? held_ : value;
  const Moved moved = draw(slider, shown, usual, slider.key);
  const auto put = [&](Number number) {
    if (number == value) return;
    set({{slider.key, value_text(value)}}, {{slider.key, value_text(number)}});
  };
  if (moved.changed) {
    holding_ = slider.key;
    held_ = nearest(shown);
  }
  if (moved.let_go) {
    put(static_cast<Number>(nearest(shown)));
    holding_.clear();
  }
  if (moved.reset) put(usual);
}

void Controls::whole(const Slider& slider, int value, int usual) {
  restart(slider, value, usual);
}

void Controls::of_start(const Slider& slider, double value, double usual) {
  restart(slider, value, usual);
}

void Controls::component(const Slider& slider, const VecX& vector, int axis, const VecX& usual,
                         bool at_once) {
  const std::string name = slider.key + std::string(".") + "xyz"[axis];
  double shown = holding_ == name ? held_ : vector[axis];
  const Moved moved = draw(slider, shown, usual[axis], name);
  const auto text = [&](double number) {
    VecX changed = vector;
    changed[axis] = number;
    return std::vector<Override>{{slider.key, value_text(changed)}};
  };
  if (moved.changed) {
    holding_ = name;
    held_ = shown;
  }
  if (shown != vector[axis] && (moved.let_go || (at_once && due()))) session_.set(text(shown));
  if (moved.let_go) {
    holding_.clear();
    if (shown != before_) session_.remember({.before = text(before_), .after = text(shown)});
  }
  if (moved.reset) set(text(vector[axis]), text(usual[axis]));
}

bool Controls::number(const Slider& slider, double& value, double usual) {
  const Moved moved = draw(slider, value, usual, slider.key);
  if (moved.reset) value = usual;
  return moved.changed || moved.reset;
}

static std::string_view first_word(std::string_view words) {
  return words.substr(0, words.find(' '));
}

bool Controls::choice(const char* key, const char* name, const char* help,
                      const std::vector<std::string>& words, int& chosen, int usual, bool grouped) {
  if (!shows(key)) return false;
  ImGui::PushID(key);
  ImGui::TextUnformatted(name);
  bool changed = chosen != usual && reset_button();
  if (changed) chosen = usual;
  ImGui::SetNextItemWidth(-FLT_MIN);
  const bool open = ImGui::BeginCombo("##choice", words[static_cast<std::size_t>(chosen)].c_str(),
                                      grouped ? ImGuiComboFlags_HeightLargest : 0);
  if (!open) {
    log_place(key);
    show_help(help);
  } else {
    for (int i = 0; i < static_cast<int>(words.size()); ++i) {
      const std::string& word = words[static_cast<std::size_t>(i)];
      if (grouped && i > 0 &&
          first_word(words[static_cast<std::size_t>(i - 1)]) != first_word(word))
        ImGui::Separator();
      const float tall = ImGui::GetFrameHeight() - ImGui::GetStyle().ItemSpacing.y;
      if (ImGui::Selectable(word.c_str(), i == chosen, 0, ImVec2(0.0f, tall))) {
        changed = i != chosen;
        chosen = i;
      }
      log_place(std::string(key) + '.' + word);
    }
    if (std::exchange(closes_list_, false)) ImGui::CloseCurrentPopup();
    ImGui::EndCombo();
  }
  ImGui::PopID();
  return changed;
}

bool Controls::close_list() {
  const auto& popups = ImGui::GetCurrentContext()->OpenPopupStack;
  const ImGuiWindow* top = popups.empty() ? nullptr : popups.back().Window;
  closes_list_ = top && std::string_view(top->Name).starts_with("##Combo");
  return closes_list_;
}

bool Controls::ends(const char* key, const char* help, std::array<double, 2>& ends) {
  if (!shows(key)) return false;
  std::array<double, 2> typed = ends;
  ImGui::PushID(key);
  ImGui::SetNextItemWidth(-FLT_MIN);
  if (ImGui::InputScalarN("##ends", ImGuiDataType_Double, typed.data(), 2, nullptr, nullptr,
                          "%.4g")) {
    typed_ends_ = typed;
  }
  // The numbers count once they are complete.
  if (ImGui::IsItemActivated()) cancelled_ = false;
  const bool complete = ImGui::IsItemDeactivatedAfterEdit() && !cancelled_;
  if (complete) typed = typed_ends_;
  const bool ordered = typed[0] < typed[1];
  if (complete && !ordered) session_.report("The lower end must be less than the upper end");
  const bool changed = complete && typed != ends && ordered;
  log_place(key);
  show_help(help);
  ImGui::PopID();
  if (changed) ends = typed;
  return changed;
}

// A field whose name is at its left. `field` draws it and returns whether it changed.
template <class Field>
bool Controls::named_field(const char* key, const char* name, const char* help,
                           const Field& field) {
  if (!shows(key)) return false;
  ImGui::PushID(key);
  ImGui::AlignTextToFramePadding();
  ImGui::TextUnformatted(name);
  ImGui::SameLine(0.3f * ImGui::GetWindowWidth());
  ImGui::SetNextItemWidth(-FLT_MIN);
  const bool changed = field();
  log_place(key);
  show_help(help);
  ImGui::PopID();
  return changed;
}

bool Controls::entry(const char* key, const char* name, const char* help, double& value) {
  return named_field(key, name, help,
                     [&] { return ImGui::InputDouble("##entry", &value, 0.0, 0.0, "%.6g"); });
}

bool Controls::entry(const char* key, const char* name, const char* help, std::string& text) {
  return named_field(key, name, help, [&] {
    std::array<char, 256> typed = {};
    text.copy(typed.data(), typed.size() - 1);
    const bool changed =
        ImGui::InputText("##entry", typed.data(), typed.size(), ImGuiInputTextFlags_AutoSelectAll);
    if (changed) text = typed.data();
    return changed;
  });
}

bool Controls::toggle(const char* key, const char* name, const char* help, bool& on) {
  if (!shows(key)) return false;
  const bool changed = ImGui::Checkbox(name, &on);
  log_place(key);
  show_help(help);
  return changed;
}

bool Controls::button(const char* key, const char* label, const char* help, float width, bool on) {
  if (!shows(key)) return false;
  const ImGuiCol colour = on ? ImGuiCol_ButtonActive : ImGuiCol_Button;
  ImGui::PushStyleColor(ImGuiCol_Button, ImGui::GetStyleColorVec4(colour));
  const bool clicked = ImGui::Button(label, ImVec2(width, 0.0f));
  ImGui::PopStyleColor();
  log_place(key);
  show_help(help);
  return clicked;
}

bool Controls::card(const char* key, float height, bool selected) {
  ImGui::PushStyleColor(ImGuiCol_Header, ImGui::GetStyleColorVec4(ImGuiCol_TextSelectedBg));
  const bool clicked = ImGui::Selectable("##card", selected, 0, ImVec2(0.0f, height));
  ImGui::PopStyleColor();
  log_place(key);
  return clicked;
}

void Controls::note(const char* key, const std::string& text) {
  if (!shows(key)) return;
  ImGui::PushStyleColor(ImGuiCol_Text, ImGui::GetStyleColorVec4(ImGuiCol_TextDisabled));
  ImGui::TextWrapped("%s", text.c_str());
  ImGui::PopStyleColor();
  log_place(key);
}

bool Controls::area(const char* key, float width, float height, const std::string& help) {
  if (!shows(key)) return false;
  ImGui::Dummy(ImVec2(width, height));
  log_place(key);
  show_help(help.c_str());
  return true;
}

void Controls::show(const View& view, bool changed) {
  if (changed) {
    if (!shown_before_) shown_before_ = session_.view();
    session_.set_view(view);
  }
  if (!shown_before_ || ImGui::IsAnyItemActive() || ImGui::IsMouseDown(0)) return;
  session_.remember({.views = {{*shown_before_, session_.view()}}});
  shown_before_.reset();
}

void Controls::set(const std::vector<Override>& before, const std::vector<Override>& after,
                   const VecX& shift) {
  const View view = session_.view();
  const std::uint64_t views = session_.views();
  if (!session_.set(after, shift)) return;
  Edit edit{.before = before, .after = after, .shift = shift};
  if (session_.views() != views) edit.views = {{view, session_.view()}};
  session_.remember(std::move(edit));
}

// The place of a list or a dialog is not final in its first picture.
void Controls::log_place(const std::string& key) {
  if (ImGui::IsWindowAppearing()) return;
  const ImVec2 low = ImGui::GetItemRectMin(), size = ImGui::GetItemRectSize();
  log_.widget(key, low.x, low.y, size.x, size.y);
}

}  // namespace clatter
