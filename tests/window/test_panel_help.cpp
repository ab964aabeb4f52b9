// The tooltips of the window. Those of sliders are in the test of the sliders.

#include <doctest/doctest.h>

#include "app/view/mouse_tools.h"
#include "app/view/panels.h"
#include "app/view/scene_opener.h"
#include "app/view/top_bar.h"
#include "tests/support/messages.h"
#include "tests/window/panel_actions.h"

namespace clatter {

using testing::says;

TEST_CASE("Tooltips: lists, boxes and buttons of the panels are explained") {
  PanelDriver disks(uneven_disks(), all_panels);
  check_explained(
      disks, {"rough", "dimension", "walls.left", "view.colour_by", "view.palette", "view.range",
              "view.range.ends", "view.field", "view.field_palette", "view.field_style",
              "view.field_range", "view.field_range.ends", "view.arrows", "view.theme", "view.grid",
              "view.overlay", "contact_time", "view.estimator"});
  Scene scene = uneven_disks();
  scene.bulk_drive.reset();
  scene.walls[kLeft].reset();
  scene.walls[kRight].reset();
  PanelDriver other(scene, all_panels);
  check_explained(other, {"bulk_drive", "view.tiling"});
  PanelDriver spheres(uneven_spheres(), all_panels);
  check_explained(spheres, {"view.from.x", "view.from.y", "view.from.z", "view.from.iso",
                            "view.slab.axis", "view.field", "view.slices.x"});
}

TEST_CASE("Tooltips: the top bar is explained, and its button for play has two meanings") {
  PanelVisibility shown;
  PanelDriver driver(uneven_disks(), [&](Session& session, Controls& controls) {
    top_bar(session, controls, shown, true);
  });
  check_explained(driver, {"gallery", "frame", "collision", "reset", "slower", "faster", "sound",
                           "plots", "lesson", "lecture", "help"});
  check_help(driver, {{"play", "Play (Space)"}});
  driver.session().play(true);
  driver.wait_for([](const Frame& frame) { return frame.plays; });
  check_help(driver, {{"play", "Pause (Space)"}});
}

TEST_CASE("Tooltips: the buttons for pictures, files and films are explained") {
  Films films = Films::OfRun;
  std::optional<double> filmed;
  PanelDriver driver(Scene{},
                     [&](Session&, Controls& controls) { record_panel(controls, films, filmed); });
  check_explained(driver, {"screenshot", "save", "restore", "film"});
  filmed = 0.45;
  check_help(driver, {{"film", "Keeps the frames"}});
  films = Films::OfScreen;
  check_help(driver, {{"film", "Downloads"}});
  filmed.reset();
  check_help(driver, {{"film", "from now on"}, {"link", "A link that opens"}});
}

TEST_CASE("Tooltips: comparisons, tools of the mouse and unsaved changes are explained") {
  MouseTools tools;
  bool asks = false;
  PanelDriver driver(uneven_disks(), [&](Session& session, Controls& controls) {
    compare_panel(session, controls, {"A: first", "B: second"});
    tools.panel(session.scene(), controls);
    if (asks) unsaved_question(controls, "", Answer::None);
  });
  check_explained(driver, {"compare.gas", "compare.add", "compare.remove", "tool.heat", "tool.cool",
                           "tool.kick", "tool.throw", "tool.add"});
  // A tool with a circle has sliders.
  tick(driver, "tool.add");
  driver.point_at(0.0f, 0.0f);
  CHECK(says(text_of(driver), "Radius 2.90 a"));
  CHECK(says(text_of(driver), "Particles 20"));
  check_explained(driver, {"tool.radius", "tool.count"});
  asks = true;
  for (int picture = 0; picture < 3; ++picture) driver.lines();
  check_explained(driver, {"unsaved.save", "unsaved.discard", "unsaved.cancel"});
}

}  // namespace clatter
