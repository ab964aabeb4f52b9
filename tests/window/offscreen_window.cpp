#include "tests/window/offscreen_window.h"

#include <doctest/doctest.h>
#include <imgui.h>

#include <cctype>
#include <chrono>
#include <fstream>
#include <thread>

#include "app/view/gui_keys.h"
#include "tests/render/picture.h"
#include "tests/support/drawn_text.h"
#include "tests/support/messages.h"
#include "tests/window/logged_widgets.h"

namespace clatter {

// A desktop without clipboard, files and devices.
class OffscreenWindow::NoDesktop final : public Host {
 public:
  float content_scale() const override { return 1.0f; }
  float least_target() const override { return 0.0f; }
  void set_title(const std::string&) override {}
  void copy(const std::string&) override {}
  void toggle_full_screen() override {}
  void close() override {}
  bool has_user_files() const override { return true; }
  void deliver(const std::string&) override {}
  std::string link_to(const std::string& fragment) const override { return fragment; }
  bool has_processes() const override { return true; }
  ScreenRecorder* recorder() override { return nullptr; }
  Loudspeaker* loudspeaker() override { return nullptr; }
};

OffscreenWindow::OffscreenWindow(const Scene& scene, float width, float height, double until,
                                 const std::vector<Scene>& beside)
    : desktop_(std::make_unique<NoDesktop>()), log_(folder_ / "log") {
  ImGui::GetIO().DisplaySize = ImVec2(width, height);
  gui_ = std::make_unique<Gui>(*desktop_, gl_->gl(), input_, worker_, log_);
  gui_->open(scene, 1, until, beside);
  REQUIRE(comes_to([&] { return place_in(folder_ / "log", "viewport").has_value(); }));
  draw();
}

OffscreenWindow::~OffscreenWindow() = default;

// Panels settle within this number of pictures.
void OffscreenWindow::draw() {
  for (int picture = 0; picture < 4; ++picture) gui_->draw();
}

void OffscreenWindow::settle() {
  REQUIRE(comes_to([&] { return !gui_->changes() && at_rest(folder_ / "log"); }));
  draw();
}

void OffscreenWindow::press(char letter) {
  input_.press({.key = letter - 'a' + 'A', .sign = letter});
  draw();
}

void OffscreenWindow::press_key(int key) {
  input_.press({.key = key});
  draw();
}

void OffscreenWindow::type_all(const std::string& signs) {
  for (const char sign : signs) {
    input_.press({.key = std::toupper(sign), .sign = sign});
    input_.type(static_cast<unsigned char>(sign));
  }
  draw();
}

void OffscreenWindow::type(char sign) {
  input_.type(static_cast<unsigned char>(sign));
  draw();
}

void OffscreenWindow::shift(bool down) {
  pass_modifiers(down, false);
}

void OffscreenWindow::drop(const std::string& scene) {
  const auto file = folder_ / "dropped.toml";
  std::ofstream(file) << scene;
  input_.drop(file);
  draw();
}

std::array<float, 4> OffscreenWindow::place(const std::string& widget) const {
  const auto place = place_in(folder_ / "log", widget);
  CAPTURE(widget);
  REQUIRE(place);
  return *place;
}

void OffscreenWindow::point_at(const std::string& widget) {
  const auto [left, top, width, height] = place(widget);
  ImGui::GetIO().MousePos = ImVec2(left + 0.5f * std::min(width, height), top + 0.5f * height);
  draw();
}

void OffscreenWindow::point_at(const std::string& widget, float right, float down) {
  const auto [left, top, width, height] = place(widget);
  ImGui::GetIO().MousePos = ImVec2(left + right * width, top + down * height);
  draw();
}

void OffscreenWindow::hold(bool down) {
  ImGui::GetIO().MouseDown[0] = down;
  // An early second click would be a double click.
  ImGui::GetIO().DeltaTime = 1.0f;
  draw();
}

void OffscreenWindow::click(const std::string& widget) {
  point_at(widget);
  hold(true);
  hold(false);
}

Image OffscreenWindow::picture() {
  const Gl& gl = gl_->gl();
  const ImVec2 size = ImGui::GetIO().DisplaySize;
  const Canvas canvas =
      blank_canvas(gl, {static_cast<int>(size.x), static_cast<int>(size.y)}, {0x60, 0x60, 0x60});
  canvas.bind();
  GuiLayer(gl).draw(*ImGui::GetDrawData());
  return canvas.read();
}

nlohmann::json OffscreenWindow::logged(const std::string& event) const {
  return newest_event(folder_ / "log", event);
}

std::string OffscreenWindow::text(const std::string& part) const {
  std::string text;
  const ImDrawData& data = *ImGui::GetDrawData();
  for (int k = 0; k < data.CmdListsCount; ++k) {
    const ImDrawList& list = *data.CmdLists[k];
    if (!std::string(list._OwnerName).starts_with(part)) continue;
    for (const auto& drawn : testing::texts_in(list)) {
      text += (text.empty() ? "" : " ") + drawn.text;
    }
  }
  return text;
}

bool OffscreenWindow::comes_to(const std::function<bool()>& holds) {
  for (int look = 0; look < 2000; ++look) {
    if (holds()) return true;
    std::this_thread::sleep_for(std::chrono::milliseconds(10));
    gui_->draw();
  }
  return false;
}

bool OffscreenWindow::comes_to_say(const std::string& part, const std::string& words) {
  return comes_to([&] { return testing::says(text(part), words); });
}

std::string OffscreenWindow::tooltip(const std::string& widget) {
  point_at(widget);
  return text("##Tooltip");
}

void OffscreenWindow::check_explained(const std::vector<std::string>& widgets) {
  for (const std::string& widget : widgets) {
    CAPTURE(widget);
    CHECK_FALSE(tooltip(widget).empty());
  }
}

}  // namespace clatter
