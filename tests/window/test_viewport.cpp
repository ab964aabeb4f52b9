// The picture of the gas in the window: its cameras, and the mouse on it.

#include <doctest/doctest.h>
#include <imgui.h>

#include <array>
#include <cmath>
#include <cstdint>
#include <memory>
#include <string>
#include <vector>

#include "app/view/viewport.h"
#include "engine/run/scheduled_run.h"
#include "engine/scene/scene_file.h"
#include "render/context/context.h"
#include "render/output/cells.h"
#include "render/typography/gui_context.h"
#include "tests/render/picture.h"
#include "tests/support/messages.h"
#include "tests/support/scenes.h"
#include "tests/window/offscreen_window.h"

namespace clatter {

using testing::gas;
using testing::wall_in;

namespace {

Frame frame_of(const Scene& scene, double time = 0.0) {
  Frame frame;
  frame.run = 1;
  ScheduledRun<2> run(scene, 1);
  run.run_until(time);
  frame.snapshot = run.snapshot();
  frame.scene = std::make_shared<const Scene>(scene);
  return frame;
}

// The picture of a whole gas in a film.
Image film_picture(const Gl& gl, const Frame& frame, Size size, const OverlayText& text) {
  const View& view = frame.scene->view;
  Renderer renderer(gl);
  const Canvas canvas(gl, size);
  canvas.bind();
  renderer.draw(frame.snapshot, renderer.fit(frame.snapshot, size, view, text), size, view, text);
  return canvas.read();
}

// The pixels of a cell of three.
std::vector<std::uint8_t> cell_of(const Image& picture, int number) {
  const auto [left, top, size] = picture_cell(picture.size, number, 3);
  std::vector<std::uint8_t> pixels;
  for (int y = top; y < top + size.height; ++y) {
    const auto row = picture.rgba.begin() + 4 * (y * picture.size.width + left);
    pixels.insert(pixels.end(), row, row + 4 * size.width);
  }
  return pixels;
}

// A box of 16 x 12 between four walls.
Scene box_of_disks() {
  Scene scene = gas(16.0, 12.0, 40, 0.9);
  for (const int axis : {0, 1}) wall_in(scene, axis, Wall{.kind = WallKind::Static});
  return scene;
}

// The places of the walls in the window: left, right, top, bottom.
std::array<float, 4> walls_in(const OffscreenWindow& window) {
  // A handle is outside of its wall.
  const auto left = window.place("wall.left"), right = window.place("wall.right"),
             top = window.place("wall.top"), bottom = window.place("wall.bottom");
  return {left[0] + left[2], right[0], top[1] + top[3], bottom[1]};
}

void check_walls(const OffscreenWindow& window, const std::array<float, 4>& expected) {
  const std::array<float, 4> walls = walls_in(window);
  for (std::size_t wall = 0; wall < 4; ++wall) {
    CAPTURE(wall);
    CHECK(walls[wall] == doctest::Approx(expected[wall]).epsilon(1e-4));
  }
}

void turn_wheel(OffscreenWindow& window, float steps) {
  ImGui::GetIO().MouseWheel = steps;
  window.draw();
}

// Moves the mouse with the right button down.
void drag_right(OffscreenWindow& window, float right, float down) {
  ImGui::GetIO().MouseDown[1] = true;
  window.draw();
  ImGui::GetIO().MousePos.x += right;
  ImGui::GetIO().MousePos.y += down;
  window.draw();
  ImGui::GetIO().MouseDown[1] = false;
  window.draw();
}

// Advances the gas by a frame.
void step(OffscreenWindow& window) {
  window.type('.');
  window.settle();
}

std::array<float, 4> shifted(const std::array<float, 4>& walls, float right, float down) {
  return {walls[0] + right, walls[1] + right, walls[2] + down, walls[3] + down};
}

// Double-clicks a disk. Returns the places of the walls if it is in the middle.
std::array<float, 4> follow(OffscreenWindow& window, const Scene& scene, int disk) {
  const std::array<float, 4> walls = walls_in(window);
  const auto [left, right, top, bottom] = walls;
  const VecX position = ScheduledRun<2>(scene, 1).snapshot().positions.col(disk);
  const auto x = static_cast<float>(position.x() / scene.box.x()),
             y = static_cast<float>(position.y() / scene.box.y());
  const ImVec2 place(left + x * (right - left), bottom - y * (bottom - top));
  ImGui::GetIO().MousePos = place;
  for (int click = 0; click < 2; ++click) {
    ImGui::GetIO().MouseDown[0] = true;
    window.draw();
    ImGui::GetIO().MouseDown[0] = false;
    window.draw();
  }
  window.settle();
  REQUIRE(testing::says(window.text("particle"), "Disk " + std::to_string(disk)));
  const auto area = window.place("viewport");
  return shifted(walls, area[0] + 0.5f * area[2] - place.x, area[1] + 0.5f * area[3] - place.y);
}

// Places relative to a point of the window, after a zoom about it.
std::array<float, 4> zoomed(const std::array<float, 4>& walls, ImVec2 about, float factor) {
  const auto [left, right, top, bottom] = walls;
  return {about.x + factor * (left - about.x), about.x + factor * (right - about.x),
          about.y + factor * (top - about.y), about.y + factor * (bottom - about.y)};
}

}  // namespace

TEST_CASE("Viewport: it draws a gas with its heading as a film does") {
  const auto context = open_context(Backend::Auto);
  Scene scene = box_of_disks();
  scene.title = "Box";
  scene.caption = "Four walls.";
  // The caption fades out in half a second of playing.
  scene.view.captions = {{.text = "Until soon", .to = 4.0}};
  Frame frame = frame_of(scene, 3.7);
  frame.speed = 2.0;
  const Size size{320, 240};
  const OverlayText text{
      .title = scene.title, .caption = scene.caption, .letters = 1.2, .least = 30.0, .speed = 2.0};
  Viewport viewport(context->gl());
  viewport.draw(frame, scene.view, size, 1.2, 30.0, true, {});
  CHECK(viewport.picture().rgba == film_picture(context->gl(), frame, size, text).rgba);
}

TEST_CASE("Viewport: compared gases with equal boxes have the camera of the selected one") {
  const auto context = open_context(Backend::Auto);
  const GuiContext gui = make_gui_context();
  const CurrentContext current(gui.get());
  const Scene scene = box_of_disks();
  Scene other = scene;
  other.box = Vec2(10.0, 20.0);
  const std::vector<std::string> titles(3, "Gas");
  const Size size{600, 240};
  Frame selected = frame_of(scene);
  selected.gas = 1;
  Frame former = frame_of(scene), latter = frame_of(other);
  latter.gas = 2;
  selected.others = {former, latter};
  Viewport viewport(context->gl());
  const auto cells = [&](Viewport& drawn) {
    drawn.redraw();
    drawn.draw(selected, scene.view, size, 1.0, 0.0, false, titles);
    return std::array{cell_of(drawn.picture(), 0), cell_of(drawn.picture(), 1),
                      cell_of(drawn.picture(), 2)};
  };
  const auto whole = cells(viewport);
  CHECK(whole[0] == whole[1]);

  ImGui::GetIO().MouseWheel = 5.0f;
  ImGui::GetIO().MousePos = ImVec2(300.0f, 100.0f);
  View view;
  viewport.use_mouse(selected, view, viewport.map(ImVec2(0, 0), 1.0f), true, true);
  const auto zoomed = cells(viewport);
  CHECK(zoomed[1] != whole[1]);
  CHECK(zoomed[0] == zoomed[1]);
  CHECK(zoomed[2] == whole[2]);

  // A gas with a new box is shown whole.
  other.box = Vec2(30.0, 20.0);
  Frame resized = frame_of(other);
  resized.gas = 2;
  selected.others[1] = resized;
  Viewport fresh(context->gl());
  const auto wider = cells(viewport);
  CHECK(wider[0] == zoomed[0]);
  CHECK(wider[1] == zoomed[1]);
  CHECK(wider[2] == cells(fresh)[2]);
}

TEST_CASE("Viewport: the wheel zooms about the mouse, between limits") {
  OffscreenWindow window(box_of_disks(), 1000.0f, 700.0f);
  const std::array<float, 4> whole = walls_in(window);
  window.point_at("viewport", 0.4f, 0.7f);
  const ImVec2 mouse = ImGui::GetIO().MousePos;
  turn_wheel(window, 2.0f);
  check_walls(window, zoomed(whole, mouse, std::pow(0.85f, -2.0f)));
  // The widest view has ten times the longest side of the box, the narrowest two diameters.
  const float width = window.place("viewport")[2];
  turn_wheel(window, -100.0f);
  CHECK(walls_in(window)[1] - walls_in(window)[0] == doctest::Approx(0.1 * width).epsilon(1e-3));
  turn_wheel(window, 100.0f);
  CHECK(walls_in(window)[1] - walls_in(window)[0] == doctest::Approx(8.0 * width).epsilon(1e-3));
}

TEST_CASE("Viewport: the widest view of a small box has 20 diameters") {
  Scene scene = box_of_disks();
  scene.box = Vec2(1.5, 1.2);
  scene.particles.count = 1;
  OffscreenWindow window(scene, 1000.0f, 700.0f);
  window.point_at("viewport", 0.5f, 0.5f);
  turn_wheel(window, -100.0f);
  const float width = window.place("viewport")[2];
  CHECK(walls_in(window)[1] - walls_in(window)[0] ==
        doctest::Approx(1.5 / 20.0 * width).epsilon(1e-3));
}

TEST_CASE("Viewport: a double click follows a disk, until the right button or F changes the view") {
  const Scene scene = box_of_disks();
  for (const bool moved : {true, false}) {
    CAPTURE(moved);
    OffscreenWindow window(scene, 1000.0f, 700.0f);
    const std::array<float, 4> whole = walls_in(window);
    const std::array<float, 4> followed = follow(window, scene, 7);
    check_walls(window, followed);
    if (moved) {
      drag_right(window, 40.0f, -25.0f);
    } else {
      window.press('f');
    }
    step(window);
    check_walls(window, moved ? shifted(followed, 40.0f, -25.0f) : whole);
  }
}

TEST_CASE("Viewport: the cursor over a wall has the direction in which it moves") {
  OffscreenWindow window(box_of_disks(), 1000.0f, 700.0f);
  for (const char* wall : {"left", "right", "bottom", "top"}) {
    CAPTURE(wall);
    window.point_at(std::string("wall.") + wall, 0.5f, 0.5f);
    const bool sideways = wall == std::string("left") || wall == std::string("right");
    CHECK(ImGui::GetMouseCursor() ==
          (sideways ? ImGuiMouseCursor_ResizeEW : ImGuiMouseCursor_ResizeNS));
  }
}

TEST_CASE("Viewport: a restart shows the whole box again, and a zoom after it stays") {
  OffscreenWindow window(box_of_disks(), 1000.0f, 700.0f);
  const std::array<float, 4> whole = walls_in(window);
  window.point_at("viewport", 0.5f, 0.5f);
  const ImVec2 mouse = ImGui::GetIO().MousePos;
  for (int run = 0; run < 2; ++run) {
    turn_wheel(window, 3.0f);
    window.press('r');
    window.settle();
    check_walls(window, whole);
  }
  turn_wheel(window, 1.0f);
  window.settle();
  check_walls(window, zoomed(whole, mouse, 1.0f / 0.85f));
}

}  // namespace clatter
