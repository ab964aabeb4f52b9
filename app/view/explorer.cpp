#include "app/view/explorer.h"

#define GLFW_INCLUDE_NONE
#include <GLFW/glfw3.h>
#include <imgui.h>

#include <algorithm>
#include <cmath>
#include <filesystem>
#include <nlohmann/json.hpp>
#include <utility>

#include "app/view/panels.h"
#include "app/view/plots.h"
#include "app/view/style.h"
#include "app/view/top_bar.h"
#include "app/write_file.h"
#include "engine/error.h"
#include "engine/scene/scene_file.h"
#include "engine/scene/state_file.h"
#include "render/theme.h"

namespace clatter {

// In sizes of text, at most the share of the window's width.
static constexpr float kPanelWidth = 17.0f;
static constexpr float kPanelShare = 0.175f;

Explorer::Explorer(const GlfwContext& context, Keys& keys, Worker& worker, ScriptLog& log)
    : context_(context),
      keys_(keys),
      log_(log),
      session_(worker, log),
      controls_(session_, log),
      stage_(context.gl()),
      gallery_(context.gl()),
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
  if (session_.update()) {
    stage_.redraw();
    history_.add(session_.frame());
  }
  use_keys();
  panels();
  stage();
  ImGui::Render();

  const ImVec2 whole = ImGui::GetIO().DisplaySize;
  const Gl& gl = context_.gl();
  const Size size{static_cast<int>((area_.high.x - area_.low.x) * scale_),
                  static_cast<int>((area_.high.y - area_.low.y) * scale_)};
  if (size.width > 0 && size.height > 0 && session_.frame().scene) {
    if (std::exchange(drawn_views_, session_.views()) != session_.views()) stage_.redraw();
    stage_.draw(session_.frame(), session_.view(), size);
    stage_.show(static_cast<int>(area_.low.x * scale_),
                static_cast<int>((whole.y - area_.high.y) * scale_));
  }
  gl.Viewport(0, 0, static_cast<int>(whole.x * scale_), static_cast<int>(whole.y * scale_));
  gl.Enable(GL_BLEND);
  gl.BlendFuncSeparate(GL_SRC_ALPHA, GL_ONE_MINUS_SRC_ALPHA, GL_ONE, GL_ONE_MINUS_SRC_ALPHA);
  gui_.draw(*ImGui::GetDrawData());
}

static constexpr ImGuiWindowFlags kFixed = ImGuiWindowFlags_NoTitleBar | ImGuiWindowFlags_NoResize |
                                           ImGuiWindowFlags_NoMove | ImGuiWindowFlags_NoCollapse |
                                           ImGuiWindowFlags_NoSavedSettings |
                                           ImGuiWindowFlags_NoBringToFrontOnFocus;

void Explorer::panels() {
  const ImVec2 whole = ImGui::GetIO().DisplaySize;
  area_ = {ImVec2(0, 0), whole};
  if (!shown_.panels || shown_.lecture) return;
  const float unit = ImGui::GetFontSize();
  const float top = std::round(ImGui::GetFrameHeight() + 0.9f * unit);
  ImGui::PushStyleVar(ImGuiStyleVar_WindowPadding,
                      ImVec2(ImGui::GetStyle().WindowPadding.x, 0.45f * unit));
  ImGui::SetNextWindowPos(ImVec2(0, 0));
  ImGui::SetNextWindowSize(ImVec2(whole.x, top));
  ImGui::Begin("top", nullptr, kFixed | ImGuiWindowFlags_NoScrollbar);
  top_bar(session_, controls_, shown_.gallery, shown_.plots, shown_.help);
  ImGui::End();
  ImGui::PopStyleVar();

  const float width = std::round(
      std::clamp(kPanelShare * whole.x, 0.75f * kPanelWidth * unit, 1.3f * kPanelWidth * unit));
  left_panel(top, width);
  area_ = {ImVec2(width, top), whole};
  if (shown_.plots && session_.frame().scene) {
    plots_drawer(top, width);
    area_.high.x -= width;
  }
}

void Explorer::left_panel(float top, float width) {
  ImGui::SetNextWindowPos(ImVec2(0, top));
  ImGui::SetNextWindowSize(ImVec2(width, ImGui::GetIO().DisplaySize.y - top));
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
}

void Explorer::plots_drawer(float top, float width) {
  const ImVec2 whole = ImGui::GetIO().DisplaySize;
  ImGui::SetNextWindowPos(ImVec2(whole.x - width, top));
  ImGui::SetNextWindowSize(ImVec2(width, whole.y - top));
  ImGui::Begin("plots", nullptr, kFixed);
  for (const Plot& plot : plots_of(history_, session_.frame())) {
    draw_plot(plot, std::round(0.62f * width));
    ImGui::Spacing();
  }
  ImGui::End();
}

void Explorer::stage() {
  const ImVec2 whole = ImGui::GetIO().DisplaySize;
  const Frame& frame = session_.frame();
  if (shown_.gallery != told_gallery_ && shown_.gallery) log_.event("gallery", {{"open", true}});
  told_gallery_ = shown_.gallery;
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
  if (const auto place = stage_.picked_place(frame, area_.low, scale_)) {
    disk_note(frame, *stage_.picked(), stage_.follows(), *place, area_);
  }
  const ImGuiIO& io = ImGui::GetIO();
  if (io.MouseWheel != 0.0f || ImGui::IsAnyItemActive() || shown_.gallery) shown_.hint = false;
  if (!told(session_, area_) && shown_.hint && !shown_.help && !shown_.lecture) hint(area_);
  log_.widget("stage", area_.low.x, area_.low.y, area_.high.x - area_.low.x,
              area_.high.y - area_.low.y);
}

void Explorer::use_keys() {
  for (const std::string& file : keys_.take_dropped()) open_file(file);
  for (const KeyPress& press : keys_.take_presses()) {
    use_function_key(press);
    if (!ImGui::GetIO().WantTextInput) use_key(press);
  }
  if (!ImGui::GetIO().WantTextInput) use_signs();
}

void Explorer::use_function_key(const KeyPress& press) {
  switch (press.key) {
    case GLFW_KEY_ESCAPE:
      return close_something();
    case GLFW_KEY_F1:
      shown_.help = !shown_.help;
      return;
    case GLFW_KEY_F2:
      return screenshot();
    case GLFW_KEY_F11:
      return toggle_full_screen();
    default:
      return;
  }
}

void Explorer::use_key(const KeyPress& press) {
  if (press.ctrl) return use_control_key(press);
  switch (press.key) {
    case GLFW_KEY_TAB:
      shown_.panels = !shown_.panels;
      return;
    case GLFW_KEY_SPACE:
      return session_.play(!session_.frame().plays);
    case GLFW_KEY_PERIOD:
      return press.shift ? session_.step_collision() : session_.step_frame();
    default:
      break;
  }
  switch (press.letter()) {
    case 'f':
      return stage_.fit();
    case 'g':
      shown_.gallery = !shown_.gallery;
      return;
    case 'h':
      shown_.help = !shown_.help;
      return;
    case 'l':
      shown_.lecture = !shown_.lecture;
      return;
    case 'm':
      return fix_range();
    case 'p':
      shown_.plots = !shown_.plots;
      return;
    case 'r':
      return press.shift ? session_.restart_with_new_seed() : session_.restart();
    default:
      return;
  }
}

void Explorer::use_control_key(const KeyPress& press) {
  switch (press.letter()) {
    case 'z':
      return press.shift ? session_.redo() : session_.undo();
    case 'y':
      return session_.redo();
    case 's':
      save_scene();
      return;
    case 'q':
      glfwSetWindowShouldClose(context_.window(), GLFW_TRUE);
      return;
    default:
      return;
  }
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

// A scene file, or one of our pictures with its scene inside.
void Explorer::open_file(const std::string& file) {
  try {
    const auto inside = png_text(file, "Scene");
    open(inside ? parse_scene(*inside, file) : load_scene(file), session_.frame().seed);
  } catch (const std::exception& error) {
    session_.tell(error.what());
  }
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
  if (view.range.kind != ColourRange::Auto) {
    view.range = {};
  } else {
    const double end = round_up(2.0 * std::sqrt(2.0 * session_.frame().snapshot.temperature));
    const bool signs = view.colour_by != ColourBy::Speed;
    if (end > 0.0) view.range = {ColourRange::Given, {signs ? -end : 0.0, end}};
  }
  session_.set_view(view);
}

// The first name that is free: "clatter-1.png", "clatter-2.png", ...
static std::string free_name(const std::string& extension) {
  for (int number = 1;; ++number) {
    const std::string name = "clatter-" + std::to_string(number) + extension;
    if (!std::filesystem::exists(name)) return name;
  }
}

// What is on screen as a scene. A start state that is in no file gets one of that name.
static Scene recorded_beside(const std::string& file, const Session& session) {
  Scene scene = session.recorded();
  Start& start = scene.disks.start;
  if (start.layout == Layout::File && start.file.empty()) {
    start.file = std::filesystem::path(file).replace_extension(".csv");
    write_file(start.file, state_to_csv(start.state));
  }
  return scene;
}

void Explorer::screenshot() {
  if (!session_.frame().scene) return;
  try {
    const std::string name = free_name(".png");
    const Scene scene = recorded_beside(name, session_);
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
  if (!session_.frame().scene) return "";
  try {
    const std::string name = free_name(".toml");
    write_file(name, scene_to_toml(recorded_beside(name, session_)));
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
