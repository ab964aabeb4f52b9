// The texts of the window's panels: each name with the value of its own key.

#include <doctest/doctest.h>
#include <fmt/format.h>
#include <imgui.h>
#include <imgui_internal.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>

#include "app/view/messages.h"
#include "app/view/panels.h"
#include "app/view/plots_panel.h"
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

// The top bar, and the colour in the place of its light.
struct HealthBar {
  explicit HealthBar(const Scene& scene)
      : driver(scene, [this](Session& session, Controls& controls) {
          top_bar(session, controls, shown, true);
          colour = colour_in(light);
        }) {}

  PanelVisibility shown;
  std::array<float, 4> light = {};
  Colour colour;
  PanelDriver driver;
};

}  // namespace

TEST_CASE("Panels: the list of keys has those of spheres for spheres alone") {
  const auto text_for = [](int dimension) {
    PanelDriver driver(uneven_disks(), [dimension](Session&, Controls&) {
      help_window(dimension, 1280.0f, 1800.0f);
    });
    return text_of(driver);
  };
  const std::string disks = text_for(2), spheres = text_for(3);
  for (const std::string& text : {disks, spheres})
    CHECK(says(text, "Ctrl + Z Ctrl + Y undo, redo"));
  CHECK(says(spheres, "X Y Z I view along an axis"));
  CHECK_FALSE(says(disks, "X Y Z I"));
}

// Those of numbers are in the test of the sliders.
TEST_CASE("Panels: every name is beside the value of its own key, of disks and of spheres") {
  const auto check = [](const Scene& scene, const std::vector<const char*>& lines) {
    PanelDriver driver(scene, all_panels);
    const std::string text = text_of(driver);
    for (const char* line : lines) {
      CAPTURE(line);
      CHECK(says(text, line));
    }
    return text;
  };
  check(uneven_disks(), {"Disks N 14",
                         "Area fraction φ = 0.025",
                         "[x] Rough disks",
                         "Dimension { 2: disks }",
                         "Left { driven }",
                         "Right { static }",
                         "Bottom { thermal }",
                         "Top { sinusoidal }",
                         "Disks coloured by { velocity y }",
                         "Palette { cividis }",
                         "Range of the disks { given } { -1.25 } { 3.5 }",
                         "Heatmap { stress xy }",
                         "Palette of the heatmap { inferno }",
                         "Style of the heatmap { smooth }",
                         "Range of the heatmap { given } { -4.5 } { 6.75 }",
                         "Arrows { heat flux }",
                         "Theme { light }",
                         "[x] Grid",
                         "[ ] Title, figures and scales",
                         "[x] Contact time",
                         "Fields from { snapshot x1.1 }"});
  const std::string spheres = check(
      uneven_spheres(),
      {"Spheres N 14", "Volume fraction 0.001", "Rough spheres", "Dimension { 3: spheres }",
       "Back { thermal }", "Front { driven }", "View from [ x ] [ y ] [ z ] [ iso ]",
       "Slab across { y }", "Spheres coloured by { velocity z }", "Range of the spheres",
       "Heatmap { stress yz }", "[x] Slice across x", "[ ] Slice across y", "[x] Slice across z"});
  CHECK_FALSE(says(spheres, "isks"));
  CHECK_FALSE(says(spheres, "Grid"));
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
  ImVec2 low, high;
  const auto place_at = [&](ImVec2 place, const Area& picture) {
    PanelDriver driver(Scene{}, [&](Session&, Controls&) {
      particle_label(frame, 0, false, place, picture);
      if (const ImGuiWindow* label = ImGui::FindWindowByName("particle")) {
        low = label->Pos;
        high = {low.x + label->Size.x, low.y + label->Size.y};
      }
    });
    driver.lines();
  };
  for (const float x : {300.0f, 600.0f}) {
    for (const float y : {300.0f, 600.0f}) {
      CAPTURE(x);
      CAPTURE(y);
      place_at({x, y}, {{0.0f, 0.0f}, {900.0f, 900.0f}});
      CHECK((x < 450.0f ? low.x > x : high.x < x));
      CHECK((y < 450.0f ? low.y > y : high.y < y));
    }
  }
  // That of a particle outside of the picture is at its border.
  place_at({20.0f, 10.0f}, {{200.0f, 100.0f}, {900.0f, 800.0f}});
  CHECK(low.x == 200.0f);
  CHECK(low.y == 100.0f);
}

TEST_CASE("Panels: the light of health is green, and red after the run has stopped by itself") {
  Scene scene = load_scene("collapse");
  scene.contact_time.reset();
  HealthBar bar(scene);
  PanelDriver& driver = bar.driver;
  const auto reasons = [&] {
    bar.light = driver.place("health");
    const auto [x, y, width, height] = bar.light;
    driver.point_at(x + 0.5f * width, y + 0.5f * height);
    return text_of(driver);
  };
  CHECK_FALSE(says(reasons(), "inelastic collapse"));
  CHECK(bar.colour.green > std::max(bar.colour.red, bar.colour.blue));
  driver.session().set_speed(1e6);
  driver.session().play(true);
  driver.wait_for([](const Frame& frame) { return !frame.stop.empty(); });
  CHECK(says(reasons(), "inelastic collapse"));
  CHECK(bar.colour.red > 2 * bar.colour.green);
  CHECK(bar.colour.green > bar.colour.blue);
  const Frame& stopped = driver.session().frame();
  REQUIRE(stopped.deepest_overlap != std::fabs(stopped.ledger_residual));
  CHECK(says(reasons(), fmt::format("Deepest overlap {:.1e} diameters", stopped.deepest_overlap)));
  CHECK(says(reasons(), fmt::format("its ledger {:.1e}", stopped.ledger_residual)));
  driver.session().restart();
  driver.wait_for([](const Frame& frame) { return frame.run == 2 && frame.stop.empty(); });
}

TEST_CASE("Panels: the light of health is yellow while the engine is too slow for the speed") {
  HealthBar bar(load_scene("vibrated"));
  bar.light = bar.driver.place("health");
  bar.driver.session().set_speed(1e6);
  bar.driver.session().play(true);
  bar.driver.wait_for([](const Frame& frame) { return frame.plays && frame.held < 0.5; });
  bar.driver.lines();
  CHECK(bar.colour.red > bar.colour.green);
  CHECK(bar.colour.green > 2 * bar.colour.blue);
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
  PanelDriver driver(Scene{}, [&](Session& session, Controls&) {
    ImGui::GetIO().DeltaTime = 0.5f;
    note.draw(session, {{0.0f, 0.0f}, {400.0f, 400.0f}});
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
  driver.session().report("Saved: a");
  CHECK(seconds() == 4.0);
  driver.session().report("Saved: " + std::string(100, 'a'));
  const double longer = seconds();
  CHECK(longer > 5.0);
  CHECK(longer < 8.0);
  driver.session().report("Saved: " + std::string(1000, 'a'));
  CHECK(seconds() == 8.0);
  driver.session().report("Saved: a");
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

}  // namespace clatter
