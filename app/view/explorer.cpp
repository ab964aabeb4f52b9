#include "app/view/explorer.h"

#define GLFW_INCLUDE_NONE
#include <GLFW/glfw3.h>
#include <imgui.h>

#include <algorithm>
#include <cmath>
#include <filesystem>
#include <nlohmann/json.hpp>

#include "app/view/panels.h"
#include "app/view/style.h"
#include "app/view/top_bar.h"
#include "app/write_file.h"
#include "engine/error.h"
#include "engine/scene/scene_file.h"
#include "render/theme.h"

namespace clatter {

// In sizes of text, at most the share of the window's width.
static constexpr float kPanelWidth = 17.0f;
static constexpr float kPanelShare = 0.175f;

Explorer::Explorer(const GlfwContext& context, Worker& worker, ScriptLog& log)
    : context_(context),
      log_(log),
      session_(worker, log),
      controls_(session_, log),
      stage_(context.gl()),
      gui_(context.gl()) {}

void Explorer::open(const Scene& scene, std::uint64_t seed) {
  session_.open(scene, seed);
  glfwSetWindowTitle(context_.window(), (scene.title + " – clatter").c_str());
}

// Takes the window's scale and loads fonts for it.
void Explorer::begin() {
  constexpr float kTextSize = 14.0f, kLectureSize = 22.0f;
  float scale = 1.0f;
  glfwGetWindowContentScale(context_.window(), &scale, nullptr);
  const float size = std::round((shown_.lecture ? kLectureSize : kTextSize) * scale);
  if (size != text_size_) {
    text_size_ = size;
    ImFontAtlas& atlas = *ImGui::GetIO().Fonts;
    atlas.Clear();
    ImGui::GetIO().FontDefault = const_cast<ImFont*>(add_fonts(atlas, size).text);
    gui_.upload(atlas);
    apply_style(size);
  }
  scale_ = std::max(1.0f, ImGui::GetIO().DisplayFramebufferScale.x);
  ImGui::NewFrame();
}

void Explorer::draw() {
  begin();
  if (session_.update()) stage_.redraw();
  use_keys();
  panels();
  stage();
  ImGui::Render();

  const ImVec2 whole = ImGui::GetIO().DisplaySize;
  const Gl& gl = context_.gl();
  const Size size{static_cast<int>((area_.high.x - area_.low.x) * scale_),
                  static_cast<int>((area_.high.y - area_.low.y) * scale_)};
  if (size.width > 0 && size.height > 0 && session_.frame().scene) {
    stage_.draw(session_.frame(), session_.view(), size);
    stage_.show(static_cast<int>(area_.low.x * scale_),
                static_cast<int>((whole.y - area_.high.y) * scale_));
  }
  gl.Viewport(0, 0, static_cast<int>(whole.x * scale_), static_cast<int>(whole.y * scale_));
  gl.Enable(GL_BLEND);
  gl.BlendFuncSeparate(GL_SRC_ALPHA, GL_ONE_MINUS_SRC_ALPHA, GL_ONE, GL_ONE_MINUS_SRC_ALPHA);
  gui_.draw(*ImGui::GetDrawData());
}

void Explorer::panels() {
  const ImVec2 whole = ImGui::GetIO().DisplaySize;
  area_ = {ImVec2(0, 0), whole};
  if (!shown_.panels || shown_.lecture) return;
  constexpr ImGuiWindowFlags kFixed = ImGuiWindowFlags_NoTitleBar | ImGuiWindowFlags_NoResize |
                                      ImGuiWindowFlags_NoMove | ImGuiWindowFlags_NoCollapse |
                                      ImGuiWindowFlags_NoSavedSettings |
                                      ImGuiWindowFlags_NoBringToFrontOnFocus;
  const float top = std::round(ImGui::GetFrameHeight() + 0.9f * ImGui::GetFontSize());
  ImGui::PushStyleVar(ImGuiStyleVar_WindowPadding,
                      ImVec2(ImGui::GetStyle().WindowPadding.x, 0.45f * ImGui::GetFontSize()));
  ImGui::SetNextWindowPos(ImVec2(0, 0));
  ImGui::SetNextWindowSize(ImVec2(whole.x, top));
  ImGui::Begin("top", nullptr, kFixed | ImGuiWindowFlags_NoScrollbar);
  top_bar(session_, controls_, shown_.gallery, shown_.plots, shown_.help);
  ImGui::End();
  ImGui::PopStyleVar();

  const float width =
      std::round(std::clamp(kPanelShare * whole.x, 0.75f * kPanelWidth * ImGui::GetFontSize(),
                            1.3f * kPanelWidth * ImGui::GetFontSize()));
  ImGui::SetNextWindowPos(ImVec2(0, top));
  ImGui::SetNextWindowSize(ImVec2(width, whole.y - top));
  ImGui::Begin("left", nullptr, kFixed);
  gas_panel(session_, controls_);
  box_panel(session_, controls_);
  view_panel(session_, controls_);
  switch (record_panel(controls_)) {
    case Recording::Screenshot:
      screenshot();
      break;
    case Recording::SaveScene:
      save_scene();
      break;
    case Recording::CopyCommand:
      copy_command();
      break;
    case Recording::None:
      break;
  }
  ImGui::End();
  area_ = {ImVec2(width, top), whole};
}

void Explorer::stage() {
  const ImVec2 whole = ImGui::GetIO().DisplaySize;
  const Frame& frame = session_.frame();
  if (shown_.gallery) {
    if (const auto name = gallery_.draw(controls_, whole.x, whole.y)) open_gallery_scene(*name);
  }
  if (shown_.help) help_window(whole.x, whole.y);
  if (!frame.scene) return;
  const ImVec2 mouse = ImGui::GetIO().MousePos;
  const bool over = mouse.x >= area_.low.x && mouse.y >= area_.low.y && mouse.x < area_.high.x &&
                    mouse.y < area_.high.y && !ImGui::GetIO().WantCaptureMouse;
  if (over) stage_.use_mouse(frame, area_.low, scale_);
  ImDrawList& list = *ImGui::GetBackgroundDrawList();
  list.PushClipRect(area_.low, area_.high);
  stage_.mark(list, frame, area_.low, scale_);
  list.PopClipRect();
  if (stage_.picked()) disk_note(frame, *stage_.picked(), stage_.follows(), area_);
  const ImGuiIO& io = ImGui::GetIO();
  if (io.MouseWheel != 0.0f || ImGui::IsAnyItemActive() || shown_.gallery) shown_.hint = false;
  if (shown_.hint) hint(area_);
  told(session_, area_);
  log_.widget("stage", area_.low.x, area_.low.y, area_.high.x - area_.low.x,
              area_.high.y - area_.low.y);
}

// Whether the key that types a letter on this keyboard was pressed.
static bool pressed(char letter) {
  for (int key = GLFW_KEY_A; key <= GLFW_KEY_Z; ++key) {
    if (!ImGui::IsKeyPressed(key, false)) continue;
    const char* name = glfwGetKeyName(key, 0);
    if (name ? name[0] == letter && !name[1] : key - GLFW_KEY_A == letter - 'a') return true;
  }
  return false;
}

void Explorer::use_keys() {
  if (ImGui::IsKeyPressed(GLFW_KEY_ESCAPE, false)) close_something();
  if (ImGui::IsKeyPressed(GLFW_KEY_F2, false)) screenshot();
  if (ImGui::IsKeyPressed(GLFW_KEY_F11, false)) toggle_full_screen();
  if (ImGui::IsKeyPressed(GLFW_KEY_F1, false)) shown_.help = !shown_.help;
  if (ImGui::GetIO().WantTextInput) return;
  if (ImGui::IsKeyPressed(GLFW_KEY_TAB, false)) shown_.panels = !shown_.panels;
  if (ImGui::IsKeyPressed(GLFW_KEY_SPACE, false)) session_.play(!session_.frame().plays);
  if (ImGui::IsKeyPressed(GLFW_KEY_PERIOD)) {
    ImGui::GetIO().KeyShift ? session_.step_collision() : session_.step_frame();
  }
  use_letter_keys();
  use_signs();
}

void Explorer::use_letter_keys() {
  const ImGuiIO& io = ImGui::GetIO();
  if (io.KeyCtrl) {
    if (pressed('z')) io.KeyShift ? session_.redo() : session_.undo();
    if (pressed('y')) session_.redo();
    if (pressed('s')) save_scene();
    if (pressed('q')) glfwSetWindowShouldClose(context_.window(), GLFW_TRUE);
    return;
  }
  if (pressed('f')) stage_.fit();
  if (pressed('g')) shown_.gallery = !shown_.gallery;
  if (pressed('h')) shown_.help = !shown_.help;
  if (pressed('l')) shown_.lecture = !shown_.lecture;
  if (pressed('m')) fix_range();
  if (pressed('p')) shown_.plots = !shown_.plots;
  if (pressed('r')) io.KeyShift ? session_.restart_with_new_seed() : session_.restart();
}

// Signs lie elsewhere on each keyboard.
void Explorer::use_signs() {
  for (const ImWchar sign : ImGui::GetIO().InputQueueCharacters) {
    const double speed = session_.frame().speed;
    if (sign == '+' || sign == '=') session_.set_speed(speed * std::sqrt(2.0));
    if (sign == '-') session_.set_speed(speed / std::sqrt(2.0));
    if (sign == '[') open_gallery_scene(gallery_.neighbour(session_.opened().title, -1));
    if (sign == ']') open_gallery_scene(gallery_.neighbour(session_.opened().title, +1));
  }
}

void Explorer::close_something() {
  for (bool* open : {&shown_.gallery, &shown_.help, &shown_.plots, &shown_.lecture}) {
    if (!*open) continue;
    *open = false;
    return;
  }
  stage_.let_go();
}

void Explorer::open_gallery_scene(const std::string& name) {
  shown_.gallery = false;
  open(load_scene(name), session_.frame().seed);
}

void Explorer::toggle_full_screen() {
  GLFWwindow* window = context_.window();
  auto& [x, y, width, height] = windowed_;
  if (glfwGetWindowMonitor(window)) {
    glfwSetWindowMonitor(window, nullptr, x, y, width, height, 0);
    return;
  }
  glfwGetWindowPos(window, &x, &y);
  glfwGetWindowSize(window, &width, &height);
  GLFWmonitor* monitor = glfwGetPrimaryMonitor();
  const GLFWvidmode* mode = glfwGetVideoMode(monitor);
  glfwSetWindowMonitor(window, monitor, 0, 0, mode->width, mode->height, mode->refreshRate);
}

// A range of round numbers up to twice the thermal speed, or again one that follows.
void Explorer::fix_range() {
  View view = session_.view();
  if (view.range) {
    view.range.reset();
  } else {
    const double end = round_up(2.0 * std::sqrt(2.0 * session_.frame().snapshot.temperature));
    const bool signs = view.colour_by != ColourBy::Speed;
    if (end > 0.0) view.range = {{signs ? -end : 0.0, end}};
  }
  session_.set_view(view);
  stage_.redraw();
}

// The first name that is free: "clatter-1.png", "clatter-2.png", ...
static std::string free_name(const std::string& extension) {
  for (int number = 1;; ++number) {
    const std::string name = "clatter-" + std::to_string(number) + extension;
    if (!std::filesystem::exists(name)) return name;
  }
}

void Explorer::screenshot() {
  if (!session_.frame().scene) return;
  try {
    const std::string name = free_name(".png");
    const Scene scene = session_.recorded();
    const std::vector<PngText> texts = {{"Title", scene.title},
                                        {"Software", "clatter " CLATTER_VERSION},
                                        {"Seed", std::to_string(session_.frame().seed)},
                                        {"Scene", scene_to_toml(scene)}};
    write_png(name, stage_.picture(), texts);
    log_.event("screenshot", {{"file", name}});
    session_.tell("Screenshot: " + name);
  } catch (const std::exception& error) {
    session_.tell(error.what());
  }
}

std::string Explorer::save_scene() {
  try {
    const std::string name = free_name(".toml");
    write_file(name, scene_to_toml(session_.recorded()));
    log_.event("saved", {{"file", name}});
    session_.tell("Saved: " + name);
    return name;
  } catch (const std::exception& error) {
    session_.tell(error.what());
  }
  return "";
}

void Explorer::copy_command() {
  const std::string name = save_scene();
  if (name.empty()) return;
  char command[512];
  std::snprintf(command, sizeof command, "clatter render %s --seed %llu --to %.6g --out %s.mp4",
                name.c_str(), static_cast<unsigned long long>(session_.frame().seed),
                session_.frame().snapshot.time,
                std::filesystem::path(name).stem().string().c_str());
  glfwSetClipboardString(context_.window(), command);
  log_.event("command", {{"line", command}});
  session_.tell(std::string("In the clipboard: ") + command);
}

}  // namespace clatter
