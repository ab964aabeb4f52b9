// Pictures of the window's panels, kept in assets/golden. They hold places, shapes and colours. The
// words have tests of their own. Where a change of the looks is meant,
//   CLATTER_WRITE_GOLDEN=1 build/release/tests/window_tests -tc='Golden window*'
// draws them again; look at each before it is kept.

#define GLFW_INCLUDE_NONE
#include <GLFW/glfw3.h>
#include <doctest/doctest.h>
#include <imgui.h>

#include "engine/scene/scene_file.h"
#include "tests/support/golden_picture.h"
#include "tests/support/messages.h"
#include "tests/window/offscreen_window.h"

namespace clatter {

namespace {

// Other versions of Dear ImGui draw widgets in another way. CTest reports a case as skipped if it
// prints so.
void check_panels(const std::string& name, const Image& picture) {
  if (std::string(ImGui::GetVersion()) != "1.86") {
    MESSAGE("[skipped] the pictures are those of Dear ImGui 1.86");
    return;
  }
  testing::check_golden(name, picture);
}

Scene golden_scene(const std::string& keys) {
  return parse_scene(keys, "golden");
}

// The pixels of a widget, and `around` it.
Image part_of(const Image& image, const std::array<float, 4>& place, float around = 0.0f) {
  const float left = place[0] - around, top = place[1] - around;
  const float width = place[2] + 2.0f * around, height = place[3] + 2.0f * around;
  Image part{{static_cast<int>(width), static_cast<int>(height)}, {}};
  for (int y = 0; y < part.size.height; ++y) {
    const auto row = image.rgba.begin() +
                     4 * ((static_cast<int>(top) + y) * image.size.width + static_cast<int>(left));
    part.rgba.insert(part.rgba.end(), row, row + 4 * part.size.width);
  }
  return part;
}

const std::string kBox = R"(
title = "Conduction"
caption = "From the hot wall to the cold one."
goal = "See the heat flux."
try_this = "Heat the left wall. Then cool the right one."
box.size = [16.0, 12.0]
particles = { count = 70, restitution = 0.9 }
walls.left = { kind = "thermal", temperature = 2.0 }
walls.right = { kind = "sinusoidal", stroke = 0.5, frequency = 0.4 }
walls.bottom = { kind = "static" }
walls.top = { kind = "static" }
)";

}  // namespace

TEST_CASE("Golden window: all panels, a slider under the mouse") {
  OffscreenWindow window(golden_scene(kBox), 1100.0f, 1500.0f);
  window.press('p');
  window.settle();
  window.point_at("particles.restitution", 0.5f, 1.15f);  // thin sliders have a margin
  check_panels("window_panels", window.picture());
}

TEST_CASE("Golden window: light colours and an open list") {
  OffscreenWindow window(golden_scene(kBox + "view.theme = \"light\""), 800.0f, 600.0f);
  window.click("walls.left");
  check_panels("window_list", window.picture());
}

TEST_CASE("Golden window: marks, a loop and a second future on the timeline") {
  OffscreenWindow window(golden_scene(kBox + R"(
view.speed = 50.0
[[change]]
time = 1.0
until = 2.5
ramp = "linear"
set = { "walls.left.temperature" = 3.0 }
[[change]]
time = 3.0
puff = { count = 5, centre = [5.0, 6.0], radius = 4.0, temperature = 2.0 }
[[change]]
time = 8.0
set = { "particles.restitution" = 0.8 }
)"),
                         900.0f, 600.0f, 9.0);
  window.settle();
  window.point_at("timeline", 0.6f, 0.6f);
  window.hold(true);
  window.hold(false);
  window.settle();
  window.click("tool.heat");
  window.click("viewport");
  window.settle();
  window.point_at("timeline.change.1", 0.5f, 0.5f);
  check_panels("window_timeline", window.picture());
  CHECK(window.tooltip("timeline.change.0") == "t = 1 to 2.5 walls.left.temperature = 3.0");
  window.shift(true);
  window.point_at("timeline", 0.3f, 0.6f);
  window.hold(true);
  window.point_at("timeline", 0.5f, 0.6f);
  check_panels("window_loop", window.picture());
}

TEST_CASE("Golden window: the mark of a ramp is dragged on the timeline") {
  OffscreenWindow window(golden_scene(kBox + R"(
view.speed = 50.0
[[change]]
time = 2.0
until = 3.5
ramp = "linear"
set = { "walls.left.temperature" = 3.0 }
)"),
                         900.0f, 600.0f, 9.0);
  window.settle();
  window.point_at("timeline.change.0", 0.5f, 0.5f);
  window.hold(true);
  window.point_at("timeline", 0.6f, 0.2f);
  check_panels("window_dragged_mark", part_of(window.picture(), window.place("timeline"), 8.0f));
}

TEST_CASE("Golden window: the timeline of a run that stopped by itself") {
  Scene scene = load_scene("collapse");
  scene.contact_time.reset();
  scene.view.speed = 1000.0;
  OffscreenWindow window(scene, 900.0f, 600.0f, 1000.0);
  window.settle();
  REQUIRE(testing::says(window.logged("message")["text"], "inelastic collapse"));
  check_panels("window_stopped", part_of(window.picture(), window.place("timeline"), 8.0f));
}

TEST_CASE("Golden window: rings around a picked disk and a pair across a periodic border") {
  OffscreenWindow window(golden_scene(R"(
box.size = [4.0, 3.0]
particles = { count = 5, restitution = 0.9 }
)"),
                         800.0f, 600.0f);
  for (int collision = 0; collision < 3; ++collision) {
    window.click("collision");
    window.settle();
  }
  window.point_at("viewport", 0.53f, 0.42f);
  window.hold(true);
  window.hold(false);
  REQUIRE(window.comes_to_say("particle", "next collision"));
  window.settle();
  check_panels("window_pair", window.picture());
}

TEST_CASE("Golden window: lecture mode with its settings") {
  OffscreenWindow window(golden_scene(kBox), 1000.0f, 640.0f);
  window.press('l');
  window.settle();
  window.click("lecture.settings");
  check_panels("window_lecture", window.picture());
}

TEST_CASE("Golden window: lecture mode with sliders and a plot") {
  OffscreenWindow window(golden_scene(kBox), 1000.0f, 640.0f);
  window.press('l');
  window.settle();
  window.click("lecture.timeline");
  window.click("lecture.pointer");
  check_panels("window_lecture_plot", window.picture());
}

TEST_CASE("Golden window: lecture mode in a small window, with a caption below the title") {
  OffscreenWindow window(golden_scene(kBox), 290.0f, 700.0f);
  window.press('l');
  window.settle();
  check_panels("window_lecture_small", window.picture());
}

TEST_CASE("Golden window: the button that pauses a gas") {
  OffscreenWindow window(golden_scene(kBox), 900.0f, 600.0f);
  window.press_key(GLFW_KEY_SPACE);
  window.point_at("play", 0.5f, 0.5f);
  REQUIRE(window.comes_to_say("##Tooltip", "Pause"));
  const Image icon = part_of(window.picture(), window.place("play"));
  check_panels("window_pause", icon);
}

TEST_CASE("Golden window: the gallery") {
  OffscreenWindow window(golden_scene(kBox), 800.0f, 600.0f);
  window.press('g');
  window.settle();
  window.point_at("gallery.conduction", 0.5f, 0.5f);
  check_panels("window_gallery", window.picture());
}

TEST_CASE("Golden window: a wall of a sphere gas is dragged") {
  OffscreenWindow window(golden_scene(R"(
box.size = [10.0, 7.0, 8.0]
particles = { count = 150, restitution = 0.9 }
walls.left = { kind = "driven", drive_speed = 1.0 }
walls.right = { kind = "thermal", temperature = 2.0 }
walls.back = { kind = "static" }
walls.front = { kind = "sinusoidal", stroke = 0.5, frequency = 0.5 }
)"),
                         900.0f, 700.0f);
  window.shift(true);
  window.point_at("wall.right", 0.5f, 0.5f);
  window.hold(true);
  window.point_at("wall.right", 0.8f, 0.7f);
  check_panels("window_spheres", window.picture());
}

TEST_CASE("Golden window: the state of a particle, and the arrow that throws another one") {
  OffscreenWindow window(load_scene("cradle"), 800.0f, 500.0f);
  window.point_at("viewport", 0.55f, 0.53f);
  window.hold(true);
  window.hold(false);
  REQUIRE(window.comes_to_say("particle", "next collision"));
  window.click("tool.throw");
  window.point_at("viewport", 0.45f, 0.5f);
  window.hold(true);
  window.point_at("viewport", 0.3f, 0.8f);
  check_panels("window_throw", window.picture());
}

TEST_CASE(
    "Golden window: a tool that heats, and one that adds particles, with its sliders and its "
    "hint") {
  OffscreenWindow window(golden_scene(kBox), 800.0f, 500.0f);
  for (const std::string tool : {"heat", "add"}) {
    window.click("tool." + tool);
    window.point_at("viewport", 0.6f, 0.4f);
    check_panels("window_" + tool, window.picture());
  }
}

TEST_CASE("Golden window: a long list in a sheet of a narrow window") {
  OffscreenWindow window(golden_scene(kBox), 420.0f, 700.0f);
  window.click("sheet.view");
  window.click("view.field");
  check_panels("window_narrow", window.picture());
}

TEST_CASE("Golden window: compared gases and a tooltip of their plots") {
  const Scene scene = golden_scene(kBox);
  OffscreenWindow window(scene, 900.0f, 600.0f, 0.0, {scene, scene});
  window.press('n');
  window.settle();
  window.press('p');
  window.settle();
  window.point_at("plots.profile", 0.5f, 0.5f);
  check_panels("window_compared", window.picture());
}

TEST_CASE("Golden window: the question before changes are lost") {
  OffscreenWindow window(golden_scene(kBox), 800.0f, 500.0f);
  window.click("tool.heat");
  window.click("viewport");
  window.settle();
  window.drop(kBox);
  ImGui::GetIO().MousePos = ImVec2(-1.0f, -1.0f);
  window.draw();
  check_panels("window_question", window.picture());
}

TEST_CASE("Golden window: the list of keys") {
  OffscreenWindow window(golden_scene(kBox), 1000.0f, 620.0f);
  window.press_key(GLFW_KEY_F1);
  check_panels("window_keys", window.picture());
}

}  // namespace clatter
