// The texts of the window's panels: each name with the value of its own key.

#include <doctest/doctest.h>
#include <fmt/format.h>
#include <imgui.h>
#include <imgui_internal.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>

#include "app/view/lesson.h"
#include "app/view/messages.h"
#include "app/view/panels.h"
#include "app/view/plot.h"
#include "app/view/top_bar.h"
#include "engine/scene/scene_file.h"
#include "tests/support/messages.h"
#include "tests/window/panel_actions.h"

namespace clatter {

using testing::says;

namespace {

// The colour of the last opaque corner of the current window in a rectangle.
Colour colour_in(const std::array<float, 4>& place) {
  const auto [x, y, width, height] = place;
  Colour colour;
  for (const ImDrawVert& corner : ImGui::GetWindowDrawList()->VtxBuffer) {
    const auto channel = [&](int shift) {
      return static_cast<std::uint8_t>(corner.col >> shift & 255u);
    };
    if (channel(IM_COL32_A_SHIFT) == 255 && corner.pos.x > x && corner.pos.x < x + width &&
        corner.pos.y > y && corner.pos.y < y + height) {
      colour = {channel(IM_COL32_R_SHIFT), channel(IM_COL32_G_SHIFT), channel(IM_COL32_B_SHIFT)};
    }
  }
  return colour;
}

}  // namespace

TEST_CASE("Panels: the list of keys has each key beside its action") {
  PanelDriver driver(uneven_disks(), [](Session&, Controls&) { help_window(2, 1280.0f, 1800.0f); });
  check_lines(driver.lines(),
              {"Keys and mouse",
               "Space play or pause",
               "B play backwards, or forwards again",
               ". , next frame, previous frame",
               "Shift + . Shift + , next, previous collision, with the pair marked",
               "← → Home End back, forth by a second of playing; start, latest time",
               "Shift + drag on the timeline: repeat this stretch; a click ends that",
               "Drag a mark on the timeline: move a change to another time",
               "R Shift + R restart; with a new seed",
               "+ − faster, slower",
               "S sound of the collisions",
               "G gallery; / searches it",
               "[ ] previous scene, next scene",
               "Ctrl + Z Ctrl + Y undo, redo",
               "Ctrl + Q quit",
               "Ctrl + S F2 save the scene with its changes; screenshot",
               "P plots",
               "C N compare: a copy of the gas beside it; the next gas",
               "T goal and suggestions of the scene",
               "M colour range of the particles: fixed or automatic",
               "V path of the picked particle",
               "Tab hide or show the panels",
               "L lecture: large type, three sliders and a plot",
               "D K W lecture: pen, pointer with a trail, stopwatch",
               "F11 full screen",
               "1 2 3 4 5 heat, cool, kick, throw, add particles with the mouse",
               "Esc close the open panel, end a tool, or deselect the particle",
               "Right or Shift + drag move the view",
               "Scroll F zoom about the cursor; fit the box",
               "Click a particle its state; double-click follows it",
               "Drag a wall resize the box; press just outside of it",
               "Drag the right wall a piston, while the gas plays; with Shift: resize",
               "Drop a file open a scene, or the scene in a picture"});
}

TEST_CASE("Panels: the list of keys for spheres has two lines more") {
  PanelDriver disks(uneven_disks(), [](Session&, Controls&) { help_window(2, 1280.0f, 1800.0f); });
  PanelDriver driver(uneven_disks(), [](Session&, Controls&) { help_window(3, 1280.0f, 1800.0f); });
  std::vector<std::string> lines = disks.lines();
  const auto place = std::ranges::find(lines, "Right or Shift + drag move the view");
  lines.insert(place, {"Drag turn the view", "X Y Z I view along an axis, isometric view"});
  check_lines(driver.lines(), lines);
}

TEST_CASE("Panels: every name is beside the value of its own key, in its unit") {
  PanelDriver driver(uneven_disks(), all_panels);
  check_lines(driver.lines(), {"### Gas ###",
                               "Disks N 14",
                               "{ 14 }",
                               "Area fraction φ = 0.025",
                               "Restitution α 0.810",
                               "{ 0.810 }",
                               "[x] Rough disks",
                               "Friction μ 0.420",
                               "{ 0.420 }",
                               "Tangential β₀ 0.530",
                               "{ 0.530 }",
                               "### Box and walls ###",
                               "Dimension",
                               "{ 2: disks }",
                               "Width Lx 19.0 a",
                               "{ 19.0 }",
                               "Height Ly 23.0 a",
                               "{ 23.0 }",
                               "Left",
                               "{ driven }",
                               "Drive speed v_dr 1.500 a/t",
                               "{ 1.500 }",
                               "Restitution α_w 0.940",
                               "{ 0.940 }",
                               "Right",
                               "{ static }",
                               "Restitution α_w 0.730",
                               "{ 0.730 }",
                               "Bottom",
                               "{ thermal }",
                               "Temperature T_w 2.500 m a²/t²",
                               "{ 2.500 }",
                               "Top",
                               "{ sinusoidal }",
                               "Stroke 0.310 a",
                               "{ 0.310 }",
                               "Frequency f 1.120 1/t",
                               "{ 1.120 }",
                               "Restitution α_w 0.860",
                               "{ 0.860 }",
                               "Gravity along x g_x 0.150 a/t²",
                               "{ 0.150 }",
                               "Gravity along y g_y -0.470 a/t²",
                               "{ -0.470 }",
                               "Kicks s 0.220 a/t",
                               "{ 0.220 }",
                               "### View ###",
                               "Disks coloured by",
                               "{ velocity y }",
                               "Palette",
                               "{ cividis }",
                               "Range of the disks",
                               "{ given }",
                               "{ -1.25 } { 3.5 }",
                               "Opacity 0.65",
                               "{ 0.65 }",
                               "Heatmap",
                               "{ stress xy }",
                               "Palette of the heatmap",
                               "{ inferno }",
                               "Style of the heatmap",
                               "{ smooth }",
                               "Range of the heatmap",
                               "{ given }",
                               "{ -4.5 } { 6.75 }",
                               "Arrows",
                               "{ heat flux }",
                               "Trails 0.25 t",
                               "{ 0.25 }",
                               "Path of the tracer 3.5 t",
                               "{ 3.5 }",
                               "Theme",
                               "{ light }",
                               "[x] Grid",
                               "[ ] Title, figures and scales",
                               "### Accuracy ###",
                               "[x] Contact time",
                               "Duration t_c 2.0e-04 t",
                               "{ 0.0002 }",
                               "CPU time x1",
                               "Not dissipated: -",
                               "Elastic collisions: -",
                               "Fields from",
                               "{ snapshot x1.1 }",
                               "Snapshots every 0.300 t",
                               "{ 0.3 }",
                               "Averaged over 4.00 t",
                               "{ 4 }"});
}

TEST_CASE("Panels: spheres have the names of spheres, and no grid") {
  PanelDriver driver(uneven_spheres(), all_panels);
  const std::string text = text_of(driver);
  for (const char* line :
       {"Spheres N 14", "Volume fraction 0.001", "Rough spheres", "Dimension { 3: spheres }",
        "Back { thermal }", "Front { driven }", "View from [ x ] [ y ] [ z ] [ iso ]",
        "Slab across { y }", "Spheres coloured by { velocity z }", "Range of the spheres",
        "Heatmap { stress yz }", "[x] Slice across x", "[ ] Slice across y",
        "[x] Slice across z"}) {
    CAPTURE(line);
    CHECK(says(text, line));
  }
  CHECK_FALSE(says(text, "isks"));
  CHECK_FALSE(says(text, "Grid"));
}

TEST_CASE("Panels: a picked disk shows its state, its last and its next collision") {
  Frame frame;
  frame.snapshot.positions.resize(2, 3);
  frame.snapshot.positions << 1.25, 2.5, 3.75, 4.125, 5.25, 6.5;
  frame.snapshot.velocities.resize(2, 3);
  frame.snapshot.velocities << 0.5, -3.0, 7.0, 0.25, 4.0, 9.0;
  frame.snapshot.spins.resize(1, 3);
  frame.snapshot.spins << 0.125, -0.625, 0.75;
  frame.last_collision = ParticleCollision{.time = 11.5, .partner = {}, .side = kTop};
  frame.next_collision = ParticleCollision{.time = 12.25, .partner = 2};
  bool follows = false;
  PanelDriver driver(Scene{}, [&](Session&, Controls&) {
    particle_label(frame, 1, follows, {100.0f, 100.0f}, {{0.0f, 0.0f}, {400.0f, 400.0f}});
  });
  check_lines(driver.lines(), {"Disk 1", "position 2.50, 5.25", "velocity -3.000, 4.000",
                               "speed 5.000", "spin -0.625", "last collision t = 11.5000, top wall",
                               "next collision t = 12.2500, disk 2", "double-click to follow",
                               "V shows or hides its path"});
  follows = true;
  const auto lines = driver.lines();
  CHECK(lines[lines.size() - 2] == "followed; Esc stops following");
}

TEST_CASE("Panels: a picked sphere shows three components") {
  Frame frame;
  frame.snapshot.positions = Vec<3>(2.5, 5.25, 7.125);
  frame.snapshot.velocities = Vec<3>(-3.0, 4.0, 12.0);
  frame.snapshot.spins = Vec<3>(-0.625, 0.5, 0.25);
  frame.last_collision = ParticleCollision{.time = 11.5, .partner = {}, .side = kFront};
  frame.next_collision = ParticleCollision{.time = 12.25, .partner = 2};
  PanelDriver driver(Scene{}, [&](Session&, Controls&) {
    particle_label(frame, 0, false, {100.0f, 100.0f}, {{0.0f, 0.0f}, {400.0f, 400.0f}});
  });
  check_lines(driver.lines(),
              {"Sphere 0", "position 2.50, 5.25, 7.12", "velocity -3.000, 4.000, 12.000",
               "speed 13.000", "spin -0.625, 0.500, 0.250",
               "last collision t = 11.5000, front wall", "next collision t = 12.2500, sphere 2",
               "double-click to follow", "V shows or hides its path"});
}

TEST_CASE("Panels: the label of a particle is beside it, on the side of the middle") {
  Frame frame;
  frame.snapshot.positions = Vec2(1.0, 2.0);
  frame.snapshot.velocities = Vec2(3.0, 4.0);
  for (const float x : {300.0f, 600.0f}) {
    for (const float y : {300.0f, 600.0f}) {
      CAPTURE(x);
      CAPTURE(y);
      ImVec2 low, high;
      PanelDriver driver(Scene{}, [&](Session&, Controls&) {
        particle_label(frame, 0, false, {x, y}, {{0.0f, 0.0f}, {900.0f, 900.0f}});
        if (const ImGuiWindow* label = ImGui::FindWindowByName("particle")) {
          low = label->Pos;
          high = {low.x + label->Size.x, low.y + label->Size.y};
        }
      });
      driver.lines();
      CHECK((x < 450.0f ? low.x > x : high.x < x));
      CHECK((y < 450.0f ? low.y > y : high.y < y));
    }
  }
}

TEST_CASE("Panels: the label of a particle outside of the picture is at its border") {
  Frame frame;
  frame.snapshot.positions = Vec2(1.0, 2.0);
  frame.snapshot.velocities = Vec2(3.0, 4.0);
  ImVec2 place;
  PanelDriver driver(Scene{}, [&](Session&, Controls&) {
    particle_label(frame, 0, false, {20.0f, 10.0f}, {{200.0f, 100.0f}, {900.0f, 800.0f}});
    if (const ImGuiWindow* label = ImGui::FindWindowByName("particle")) place = label->Pos;
  });
  driver.lines();
  CHECK(place.x == 200.0f);
  CHECK(place.y == 100.0f);
}

TEST_CASE("Panels: the light of health is green, and red after the run has stopped by itself") {
  Session* session = nullptr;
  std::array<float, 4> light = {};
  Colour colour;
  PanelVisibility shown;
  Scene scene = load_scene("collapse");
  scene.contact_time.reset();
  PanelDriver driver(scene, [&](Session& of, Controls& controls) {
    session = &of;
    top_bar(of, controls, shown, true);
    colour = colour_in(light);
  });
  const auto reasons = [&] {
    light = driver.place("health");
    const auto [x, y, width, height] = light;
    driver.point_at(x + 0.5f * width, y + 0.5f * height);
    return text_of(driver);
  };
  CHECK_FALSE(says(reasons(), "inelastic collapse"));
  CHECK(colour.green > std::max(colour.red, colour.blue));
  session->set_speed(1e6);
  session->play(true);
  driver.wait_for([](const Frame& frame) { return !frame.stop.empty(); });
  CHECK(says(reasons(), "inelastic collapse"));
  CHECK(colour.red > 2 * colour.green);
  CHECK(colour.green > colour.blue);
  const Frame& stopped = session->frame();
  REQUIRE(stopped.deepest_overlap != std::fabs(stopped.ledger_residual));
  CHECK(says(reasons(), fmt::format("Deepest overlap {:.1e} diameters", stopped.deepest_overlap)));
  CHECK(says(reasons(), fmt::format("its ledger {:.1e}", stopped.ledger_residual)));
  session->restart();
  driver.wait_for([](const Frame& frame) { return frame.run == 2 && frame.stop.empty(); });
}

TEST_CASE("Panels: the light of health is yellow while the engine is too slow for the speed") {
  Session* session = nullptr;
  std::array<float, 4> light = {};
  Colour colour;
  PanelVisibility shown;
  PanelDriver driver(load_scene("vibrated"), [&](Session& of, Controls& controls) {
    session = &of;
    top_bar(of, controls, shown, true);
    colour = colour_in(light);
  });
  light = driver.place("health");
  session->set_speed(1e6);
  session->play(true);
  driver.wait_for([](const Frame& frame) { return frame.plays && frame.held < 0.5; });
  driver.lines();
  CHECK(colour.red > colour.green);
  CHECK(colour.green > 2 * colour.blue);
}

TEST_CASE("Panels: the strip of a lesson has its goal and its suggestion beside their names") {
  Scene scene = default_scene(2);
  scene.goal = "See the first.";
  scene.try_this = "Drag the second.";
  bool open = true;
  PanelDriver driver(scene, [&](Session& session, Controls& controls) {
    lesson_strip(session.scene(), {{0.0f, 0.0f}, {600.0f, 300.0f}}, controls, open);
  });
  const std::string text = text_of(driver);
  CHECK(says(text, "Goal See the first."));
  CHECK(says(text, "Try this Drag the second."));
  const auto close = driver.place("close_lesson");
  CHECK(close[0] > 550.0f);
  CHECK(close[0] + close[2] <= 600.0f);
}

TEST_CASE("Panels: the title gives way to the other widgets of the bar") {
  Scene scene = default_scene(2);
  scene.title = "A title that is much longer than the bar has room for";
  PanelVisibility shown;
  PanelDriver driver(scene, [&](Session& session, Controls& controls) {
    ImGui::SetNextWindowPos(ImVec2(0.0f, 0.0f));
    ImGui::SetNextWindowSize(ImVec2(46.0f * ImGui::GetFontSize(), 40.0f));
    ImGui::Begin("bar", nullptr, ImGuiWindowFlags_NoTitleBar);
    top_bar(session, controls, shown, true);
    ImGui::End();
  });
  const auto help = driver.place("help"), light = driver.place("health");
  CHECK(help[0] + help[2] <= light[0]);
}

TEST_CASE("Panels: a tooltip is beside its panel") {
  ImVec4 tip;
  bool on = false;
  PanelDriver driver(Scene{}, [&](Session&, Controls& controls) {
    ImGui::SetNextWindowPos(ImVec2(20.0f, 20.0f));
    ImGui::SetNextWindowSize(ImVec2(200.0f, 300.0f));
    ImGui::Begin("narrow");
    controls.toggle("box", "Box", "Its help", on);
    if (const ImGuiWindow* window = ImGui::FindWindowByName("##Tooltip_00")) {
      tip = ImVec4(window->Pos.x, window->Pos.y, window->Size.x, window->Size.y);
    }
    ImGui::End();
  });
  const auto [x, y, width, height] = driver.place("box");
  driver.point_at(x + 5.0f, y + 5.0f);
  CHECK(says(text_of(driver), "Its help"));
  CHECK(tip.x >= 220.0f);
  CHECK(tip.y == y);
}

TEST_CASE("Panels: where there is little room, names and values have it") {
  float wide = 400.0f;
  PanelDriver driver(Scene{}, [&](Session&, Controls& controls) {
    ImGui::SetNextWindowSize(ImVec2(wide, 300.0f));
    ImGui::Begin("other");
    double speed = 1.25;
    controls.number({.key = "speed", .name = "Drive speed", .symbol = "v_dr", .unit = "a/t"}, speed,
                    speed);
    draw_plot({.title = "Energy per time", .x_label = "t", .curves = {}, .y_label = "m a²/t³"},
              200.0f);
    ImGui::End();
  });
  CHECK(says(text_of(driver), "Drive speed v_dr 1.250 a/t"));
  CHECK(says(text_of(driver), "Energy per time m a²/t³ [ CSV ]"));
  wide = 170.0f;
  CHECK(says(text_of(driver), "Drive speed 1.250"));
  CHECK_FALSE(says(text_of(driver), "v_dr"));
  CHECK(says(text_of(driver), "Energy per time [ CSV ]"));
}

TEST_CASE("Panels: a message is shown for 4 to 8 seconds, and stays under the mouse") {
  MessageNote note;
  Session* session = nullptr;
  PanelDriver driver(Scene{}, [&](Session& of, Controls&) {
    session = &of;
    ImGui::GetIO().DeltaTime = 0.5f;
    note.draw(of, {{0.0f, 0.0f}, {400.0f, 400.0f}});
  });
  const auto shown = [&] { return says(text_of(driver), "Saved"); };
  // Half a second passes at each look.
  const auto seconds = [&] {
    double time = 0.0;
    for (; shown() && time < 30.0; time += 0.5) {
    }
    CHECK_FALSE(note.shown());
    return time;
  };
  driver.point_at(0.0f, 3000.0f);
  CHECK_FALSE(shown());
  session->report("Saved: a");
  CHECK(seconds() == 4.0);
  session->report("Saved: " + std::string(100, 'a'));
  const double longer = seconds();
  CHECK(longer > 5.0);
  CHECK(longer < 8.0);
  session->report("Saved: " + std::string(1000, 'a'));
  CHECK(seconds() == 8.0);
  session->report("Saved: a");
  driver.point_at(200.0f, 340.0f);
  for (int look = 0; look < 40; ++look) CHECK(shown());
  driver.point_at(0.0f, 3000.0f);
  CHECK(seconds() <= 4.0);
}

TEST_CASE("Panels: a curve of theory has its meaning beside the mouse") {
  const LivePlot plot{
      .title = "Temperature",
      .x_label = "t",
      .curves = {{.name = "refined", .colour = {}, .points = {}, .help = "Holds somewhere"}}};
  PanelDriver driver(Scene{}, [&](Session&, Controls&) { draw_plot(plot, 200.0f); });
  CHECK_FALSE(says(text_of(driver), "Holds somewhere"));
  driver.point_at(45.0f, 36.0f);  // the first name of the legend
  CHECK(says(text_of(driver), "Holds somewhere"));
}

TEST_CASE("Panels: chosen controls are drawn alone, and those that are missing are named") {
  std::vector<std::pair<std::string, std::string>> missing;
  PanelDriver driver(uneven_disks(), [&](Session& session, Controls& controls) {
    controls.choose({"walls.bottom.temperature", "particles.restitution", "box.size.y",
                     "walls.left.temperature", "particles.restitutoin"});
    play_row(session, controls);
    all_panels(session, controls);
    missing = controls.take_missing();
  });
  check_lines(driver.lines(), {"Restitution α 0.810", "{ 0.810 }", "Height Ly 23.0 a", "{ 23.0 }",
                               "Temperature T_w 2.500 m a²/t²", "{ 2.500 }"});
  REQUIRE(missing.size() == 2);
  CHECK(missing[0].first == "walls.left.temperature");
  CHECK(missing[1] ==
        std::pair<std::string, std::string>("particles.restitutoin", "particles.restitution"));
}

TEST_CASE("Panels: the top bar of a narrow window keeps the title, play and restart") {
  Scene scene = uneven_disks();
  scene.title = "Uneven";
  PanelVisibility shown{.narrow = true};
  PanelDriver driver(scene, [&](Session& session, Controls& controls) {
    top_bar(session, controls, shown, true);
  });
  CHECK(says(text_of(driver), "Uneven"));
  CHECK_FALSE(says(text_of(driver), "Plots"));
  tick(driver, "play");
  driver.wait_for([](const Frame& frame) { return frame.plays; });
  tick(driver, "gallery");
  driver.lines();
  CHECK(shown.gallery);
}

TEST_CASE("Panels: a hint in the top bar is on disks or on spheres") {
  const auto hint_of = [](const Scene& scene) {
    PanelVisibility shown{.hint = true};
    PanelDriver driver(scene, [&](Session& session, Controls& controls) {
      ImGui::SetNextWindowSize(ImVec2(1600.0f, 100.0f));
      ImGui::Begin("wide");
      top_bar(session, controls, shown, true);
      ImGui::End();
    });
    driver.wait_for([](const Frame& frame) { return frame.run == 1; });
    return text_of(driver);
  };
  CHECK(says(hint_of(uneven_disks()), "drag a slider · scroll to zoom"));
  CHECK(says(hint_of(uneven_spheres()), "drag to turn · scroll to zoom"));
}

TEST_CASE("Panels: the top bar shows the time and sets the speed in steps of 1, 2, 5") {
  Scene scene = uneven_disks();
  scene.title = "Uneven";
  scene.view.speed = 2.0;
  PanelVisibility shown;
  PanelDriver driver(scene, [&](Session& session, Controls& controls) {
    top_bar(session, controls, shown, true);
  });
  const auto click = [&](const char* widget) {
    const auto [x, y, width, height] = driver.place(widget);
    driver.click(x + 0.5f * width, y + 0.5f * height);
  };
  const auto speed_is = [](double speed) {
    return [speed](const Frame& frame) {
      return frame.run > 0 && std::fabs(frame.speed - speed) < 1e-9;
    };
  };
  driver.wait_for(speed_is(2.0));
  CHECK(says(text_of(driver), "Uneven"));
  CHECK(says(text_of(driver), "2 /s"));
  CHECK(says(text_of(driver), "t = 0.00"));
  click("faster");
  driver.wait_for(speed_is(5.0));
  CHECK(says(text_of(driver), "5 /s"));
  click("slower");
  driver.wait_for(speed_is(2.0));
  // A frame lasts 1/60 s.
  for (int k = 1; k <= 3; ++k) {
    click("frame");
    driver.wait_for(
        [&](const Frame& frame) { return std::fabs(frame.snapshot.time - k * 2.0 / 60.0) < 1e-9; });
  }
  driver.point_at(0.0f, 3000.0f);  // away from buttons, whose help would be the last text
  CHECK(says(text_of(driver), "t = 0.10"));
  click("plots");
  CHECK(shown.plots);
  click("help");
  CHECK(shown.help);
  click("gallery");
  CHECK(shown.gallery);
  CHECK(shown.lesson);
  click("lesson");
  CHECK_FALSE(shown.lesson);
}

}  // namespace clatter
