#include "tests/window/panel_driver.h"

#include <doctest/doctest.h>
#include <imgui.h>

#include <sstream>
#include <thread>

#include "app/view/style.h"
#include "render/typography/fonts.h"
#include "tests/window/logged_widgets.h"

namespace clatter {

using namespace testing;

// Large enough for all panels, so that nothing is clipped.
static constexpr float kWidth = 900.0f, kHeight = 4000.0f, kTextSize = 14.0f;

PanelDriver::PanelDriver(const Scene& scene, Panel panel)
    : log_(folder_ / "log"), panel_(std::move(panel)) {
  const CurrentContext current(context_.get());
  ImGuiIO& io = ImGui::GetIO();
  io.DisplaySize = ImVec2(kWidth, kHeight);
  fonts_ = add_fonts(*io.Fonts, kTextSize);
  io.FontDefault = fonts_.text.face;
  io.ClipboardUserData = &text_;
  io.SetClipboardTextFn = [](void* text, const char* written) {
    *static_cast<std::string*>(text) = written;
  };
  apply_style(kTextSize, 0.0f, kDarkTheme);
  session_.open(scene, 1, false);
  for (int picture = 0; picture < 2; ++picture) draw();
}

void PanelDriver::draw() {
  const CurrentContext current(context_.get());
  ImGui::NewFrame();
  ImGui::SetNextWindowPos(ImVec2(0.0f, 0.0f));
  ImGui::SetNextWindowSize(ImVec2(kWidth, kHeight));
  ImGui::Begin("panel", nullptr, kFixedPanel);
  ImGui::LogToClipboard();
  panel_(session_, controls_);
  ImGui::LogFinish();
  ImGui::End();
  ImGui::EndFrame();
}

std::vector<std::string> PanelDriver::lines() {
  draw();
  std::vector<std::string> lines;
  std::istringstream text(text_);
  for (std::string line, words; std::getline(text, line);) {
    std::istringstream stream(line);
    words.clear();
    for (std::string word; stream >> word;) words += (words.empty() ? "" : " ") + word;
    if (!words.empty()) lines.push_back(words);
  }
  return lines;
}

std::array<float, 4> PanelDriver::place(const std::string& widget) {
  draw();
  const auto place = place_in(folder_ / "log", widget);
  CAPTURE(widget);
  REQUIRE(place);
  return *place;
}

std::size_t PanelDriver::widgets_told() const {
  return widgets_in(folder_ / "log").size();
}

void PanelDriver::point_at(float x, float y) {
  {
    const CurrentContext current(context_.get());
    ImGui::GetIO().MousePos = ImVec2(x, y);
  }
  for (int picture = 0; picture < 3; ++picture) draw();
}

void PanelDriver::drag(float x, float y, float to_x) {
  const auto press = [&](bool down) {
    const CurrentContext current(context_.get());
    ImGui::GetIO().MouseDown[0] = down;
    // An early second click would be a double click, which opens the text input.
    ImGui::GetIO().DeltaTime = 1.0f;
  };
  point_at(x, y);
  press(true);
  draw();
  point_at(to_x, y);
  press(false);
  for (int picture = 0; picture < 3; ++picture) draw();
}

void PanelDriver::wait_for(const std::function<bool(const Frame&)>& holds) {
  for (int look = 0; look < 6000 && !holds(session_.frame()); ++look) {
    std::this_thread::sleep_for(std::chrono::milliseconds(10));
    session_.update();
  }
  CAPTURE(session_.frame().run);
  CAPTURE(session_.frame().speed);
  CAPTURE(session_.message());
  REQUIRE(holds(session_.frame()));
}

}  // namespace clatter
