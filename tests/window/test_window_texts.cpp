// The whole window: the texts of its bars, sheets, plots and gallery, with their tooltips.

#define GLFW_INCLUDE_NONE
#include <GLFW/glfw3.h>
#include <doctest/doctest.h>
#include <fmt/format.h>

#include <chrono>
#include <thread>

#include "engine/live/watched_run.h"
#include "engine/scene/scene_file.h"
#include "tests/support/messages.h"
#include "tests/window/offscreen_window.h"

namespace clatter {

using testing::says;

TEST_CASE("Window texts: the tools and the settings of lecture mode are explained") {
  const Scene scene = load_scene("conduction");
  OffscreenWindow window(scene);
  window.press('l');
  window.check_explained({"gallery", "previous_scene", "next_scene", "play", "reset",
                          "lecture.timeline", "tool.heat", "tool.cool", "tool.kick", "tool.throw",
                          "tool.add", "lecture.pen", "lecture.pointer", "lecture.stopwatch",
                          "lecture.settings", "lecture.close"});
  CHECK(says(window.text("caption"), scene.title + ' ' + scene.caption));
  window.click("lecture.settings");
  const std::string text = window.text("lecture_settings");
  CAPTURE(text);
  CHECK(says(text, "Slider 1 walls.right.temperature Slider 2 walls.left.temperature Slider 3"));
  CHECK(says(text, " Plot temperature Wipe Caption Theme projector"));
  window.check_explained({"window.scale", "lecture.slider.1", "lecture.plot_of", "lecture.wipe",
                          "lecture.captions", "lecture.theme"});
}

// Running, the stopwatch has other texts. Its seconds pass, but not the time of the halted gas.
TEST_CASE("Window texts: the bar of lecture mode keeps its places while the stopwatch runs") {
  OffscreenWindow window(load_scene("conduction"));
  window.press('l');
  window.press('w');
  std::this_thread::sleep_for(std::chrono::milliseconds(200));
  window.draw();
  const float running = window.place("lecture.settings")[0];
  const std::string text = window.text("lecture_bar");
  CAPTURE(text);
  CHECK(says(text, " s t = 0.00 …"));
  CHECK_FALSE(says(text, " 0.0 s"));
  window.press('w');
  CHECK(window.place("lecture.settings")[0] == running);
}

TEST_CASE("Window texts: the effect of the contact time is that of a frame of the engine") {
  const Scene scene = load_scene("vibrated", {{"collapse.contact_time", "0.05"}});
  const auto run = watched_run(scene, 1);
  run->run_until(1.0, kNoLimit, kNoLimit);
  Frame frame;
  run->fill(frame, true);
  REQUIRE(frame.contact_time_error);
  OffscreenWindow window(scene, 1280.0f, 1840.0f, 1.0);
  window.settle();
  const auto percent = [](double share) { return fmt::format("{:.2g} %", 100.0 * share); };
  CHECK(says(window.text("left"),
             "Not dissipated: " + percent(frame.contact_time_error->undissipated) +
                 " Elastic collisions: " + percent(frame.contact_time_error->elasticised)));
}

TEST_CASE(
    "Window texts: while disks are placed a note counts them, and its button keeps the former "
    "gas") {
  OffscreenWindow window(load_scene("conduction"));
  window.drop("box.size = [900.0, 900.0]\nparticles.count = 500000");
  CHECK(window.comes_to_say("opening", "Placing 500000 disks"));
  window.check_explained({"opening.cancel"});
  window.click("opening.cancel");
  window.settle();
  CHECK(window.text("opening").empty());
  CHECK(says(window.text("top"), load_scene("conduction").title));
}

TEST_CASE("Window texts: a card of the gallery has title, name, caption, goal and suggestion") {
  OffscreenWindow window(load_scene("conduction"));
  window.press('g');
  const Scene scene = load_scene("barometer");
  CHECK(says(window.text("Gallery"), scene.title + " barometer " + scene.caption + ' ' +
                                         scene.goal + " Try this: " + scene.try_this));
  window.check_explained({"gallery.close"});
}

TEST_CASE("Gallery: letters search it, also those of the picture in which it opens") {
  OffscreenWindow window(
      parse_scene("box.size = [16.0, 12.0]\nparticles = { count = 5 }\n", "gas"));
  window.type_all("gdense");
  CHECK(window.comes_to_say("Gallery/scenes", "dense"));
  // The scene of this name comes before those whose texts have the word.
  window.press_key(GLFW_KEY_ENTER);
  CHECK(window.logged("open")["title"] == load_scene("dense").title);
  window.press('g');
  window.type_all("zzz");
  CHECK(window.comes_to_say("Gallery/scenes", "No scene matches \"zzz\""));
  for (int letter = 0; letter < 3; ++letter) window.press_key(GLFW_KEY_BACKSPACE);
  window.type_all("/cradle");
  window.press_key(GLFW_KEY_ENTER);
  CHECK(window.logged("open")["title"] == "Newton's cradle");
}

TEST_CASE("Film dialog: Esc closes an open list, then the dialog") {
  OffscreenWindow window(parse_scene("box.size = [16.0, 12.0]\nparticles = { count = 5 }\n", "gas"),
                         1500.0f, 1900.0f);
  window.click("film");
  window.click("film.format");
  window.press_key(GLFW_KEY_ESCAPE);
  CHECK(window.text("film dialog") != "");
  window.press_key(GLFW_KEY_ESCAPE);
  CHECK(window.text("film dialog") == "");
}

TEST_CASE("Window texts: the plots and their choices") {
  OffscreenWindow window(load_scene("conduction"));
  if (window.text("plots").empty()) window.press('p');
  CHECK(says(window.text("plots"), "Profile along x Profile of "));
  window.check_explained({"plots.axis", "plots.profile"});
  window.press('c');
  CHECK(window.comes_to_say("plots", "Differences from A"));
  window.check_explained({"plots.differences"});
}

TEST_CASE("Window texts: the strip of the timeline and the group of the window") {
  OffscreenWindow window(load_scene("conduction"));
  CHECK(window.text("timeline") == "0.00");
  window.check_explained({"collision_back", "back", "head"});
  window.click("group.Record");
  window.check_explained({"window.scale", "full_screen", "group.Box and walls"});
}

TEST_CASE("Window texts: each button of a narrow window opens the sheet of its name") {
  const Scene scene = load_scene("conduction");
  OffscreenWindow window(scene, 420.0f, 800.0f);
  const auto whole = window.place("viewport");
  for (const auto& [sheet, words] : std::vector<std::pair<std::string, std::string>>{
           {"sheet.run", "Fields from"},
           {"sheet.gas", "Restitution"},
           {"sheet.view", "Disks coloured by"},
           {"sheet.record", "Save scene"},
           {"sheet.plots", "Profile along"},
           {"sheet.lesson", scene.goal + ' ' + scene.try_this}}) {
    CAPTURE(sheet);
    window.click(sheet);
    CHECK(says(window.text("sheet/"), words));
    CHECK(window.place("viewport")[3] < whole[3]);
  }
  window.click("sheet.close");
  CHECK(window.place("viewport") == whole);
}

TEST_CASE("Window texts: the dialog for films offers what the scene has: plots, but no overlay") {
  Scene scene = load_scene("conduction");
  scene.view.overlay = false;
  scene.view.plots = {FilmPlot::Temperature};
  OffscreenWindow window(scene, 1280.0f, 1840.0f);
  window.click("film");
  const std::string text = window.text("film dialog");
  CAPTURE(text);
  CHECK(says(text, "Plots beside the gas"));
  CHECK_FALSE(says(text, "Title, figures and scales"));
  CHECK(says(window.tooltip("film.plots"), "The plots of the scene"));
}

TEST_CASE("Window texts: Esc closes the list of keys before the settings below it") {
  OffscreenWindow window(load_scene("conduction"));
  window.press('l');
  window.click("lecture.settings");
  window.press('h');
  CHECK(says(window.text("help"), "Keys and mouse"));
  window.press_key(GLFW_KEY_ESCAPE);
  CHECK(window.text("help").empty());
  CHECK_FALSE(window.text("lecture_settings").empty());
  window.press_key(GLFW_KEY_ESCAPE);
  CHECK(window.text("lecture_settings").empty());
}

}  // namespace clatter
