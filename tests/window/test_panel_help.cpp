// The tooltips of the window: each explains its own widget. Those of sliders are in the test of the
// sliders.

#include <doctest/doctest.h>

#include "app/view/mouse_tools.h"
#include "app/view/panels.h"
#include "app/view/top_bar.h"
#include "app/view/unsaved_question.h"
#include "tests/support/messages.h"
#include "tests/window/panel_actions.h"

namespace clatter {

using testing::says;

TEST_CASE("Tooltips: lists, boxes and buttons of the panels") {
  PanelDriver driver(uneven_disks(), all_panels);
  check_help(driver, {{"rough", "turn slip into spin"},
                      {"dimension", "as disks or as spheres"},
                      {"walls.left", "Wall at this side"},
                      {"view.colour_by", "the colour of a particle"},
                      {"view.palette", "colour-blind"},
                      {"view.range", "auto follows"},
                      {"view.range.ends", "Enter sets them"},
                      {"view.field", "below the disks"},
                      {"view.field_palette", "blue below zero"},
                      {"view.field_style", "smooth interpolates"},
                      {"view.field_range", "auto follows"},
                      {"view.field_range.ends", "Enter sets them"},
                      {"view.arrows", "with a direction"},
                      {"view.theme", "background and walls"},
                      {"view.grid", "the scale bar"},
                      {"view.overlay", "Text and legends"},
                      {"contact_time", "prevents inelastic collapse"},
                      {"view.estimator", "whole flights"}});
  Scene scene = uneven_disks();
  scene.bulk_drive.reset();
  scene.walls[kLeft].reset();
  scene.walls[kRight].reset();
  PanelDriver other(scene, all_panels);
  check_help(other, {{"bulk_drive", "random kicks"}, {"view.tiling", "Faint copies"}});
}

TEST_CASE("Tooltips: what only spheres have") {
  PanelDriver driver(uneven_spheres(), all_panels);
  check_help(driver, {{"view.from.x", "From the right"},
                      {"view.from.y", "From above"},
                      {"view.from.z", "From the front"},
                      {"view.from.iso", "Isometric"},
                      {"view.slab.axis", "between two planes"},
                      {"view.field", "on slices of the box"},
                      {"view.slices.x", "Plane on which"}});
}

TEST_CASE("Tooltips: the top bar, with the keys of its buttons") {
  PanelVisibility shown;
  Session* session = nullptr;
  PanelDriver driver(uneven_disks(), [&](Session& of, Controls& controls) {
    session = &of;
    top_bar(of, controls, shown, true);
  });
  check_help(driver, {{"gallery", "The gallery (G)"},
                      {"play", "Play (Space)"},
                      {"frame", "Next frame ( . )"},
                      {"collision", "Next collision (Shift + . )"},
                      {"reset", "Restart (R;"},
                      {"slower", "Slower ( - )"},
                      {"faster", "Faster ( + )"},
                      {"sound", "A click for each collision (S)"},
                      {"plots", "Curves of the run (P)"},
                      {"lesson", "Goal and suggestions (T)"},
                      {"lecture", "for a projector (L)"},
                      {"help", "Keys and mouse (F1)"}});
  session->play(true);
  driver.wait_for([](const Frame& frame) { return frame.plays; });
  check_help(driver, {{"play", "Pause (Space)"}});
}

TEST_CASE("Tooltips: the buttons for pictures, files and films") {
  Films films = Films::OfRun;
  std::optional<double> filmed;
  PanelDriver driver(Scene{},
                     [&](Session&, Controls& controls) { record_panel(controls, films, filmed); });
  check_help(driver, {{"screenshot", "A PNG of the view"},
                      {"save", "all changes so far (Ctrl+S)"},
                      {"restore", "as it was opened"},
                      {"film", "in the background"}});
  filmed = 0.45;
  check_help(driver, {{"film", "Keeps the frames"}});
  films = Films::OfScreen;
  check_help(driver, {{"film", "Downloads"}});
  filmed.reset();
  check_help(driver, {{"film", "from now on"}, {"link", "A link that opens"}});
}

TEST_CASE("Tooltips: comparisons, tools of the mouse and unsaved changes") {
  MouseTools tools;
  bool asks = false;
  PanelDriver driver(uneven_disks(), [&](Session& session, Controls& controls) {
    compare_panel(session, controls, {"A: first", "B: second"});
    tools.panel(session.scene(), controls);
    if (asks) unsaved_question(controls, "", Answer::None);
  });
  check_help(driver, {{"compare.gas", "that the panels change"},
                      {"compare.add", "Runs a copy"},
                      {"compare.remove", "Ends its comparison"},
                      {"tool.heat", "grow by a tenth"},
                      {"tool.cool", "shrink by a tenth"},
                      {"tool.kick", "adds a velocity"},
                      {"tool.throw", "dragged from a particle"},
                      {"tool.add", "as many as find room"}});
  CHECK(says(text_of(driver), "[ Heat ] [ Cool ] [ Kick ] [ Throw ] [ Add ]"));
  // A tool with a circle has sliders.
  tick(driver, "tool.add");
  for (const auto& [slider, line, help] : std::vector<std::array<const char*, 3>>{
           {"tool.radius", "Radius 2.90 a", "Of the circle at the mouse"},
           {"tool.count", "Particles 20", "Number that a click adds"}}) {
    const auto [left, top, width, height] = driver.place(slider);
    driver.point_at(left + 0.5f * width, top + 0.5f * height);
    const std::string told = text_of(driver);
    CAPTURE(told);
    CHECK(says(told, line));
    CHECK(says(told, help));
  }
  asks = true;
  for (int picture = 0; picture < 3; ++picture) driver.lines();
  CHECK(says(text_of(driver), "Save the changes of the scene? [ Save ] [ Discard ] [ Cancel ]"));
  check_help(driver, {{"unsaved.save", "Writes the scene"},
                      {"unsaved.discard", "are lost"},
                      {"unsaved.cancel", "Keeps the gas"}});
}

}  // namespace clatter
