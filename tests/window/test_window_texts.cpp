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

TEST_CASE("Window texts: the bar of lecture mode has its tools, each explained") {
  OffscreenWindow window(load_scene("conduction"));
  window.press('l');
  CHECK(window.text("lecture_bar") ==
        "≡ ← → Timeline Heat Cool Kick Throw Add Pen Pointer Stopwatch … ×");
  window.check_help({{"gallery", "The gallery (G)"},
                     {"previous_scene", "Previous scene ( [ )"},
                     {"next_scene", "Next scene ( ] )"},
                     {"play", "Play or pause (Space)"},
                     {"reset", "Restart (R)"},
                     {"lecture.timeline", "The time of the run"},
                     {"tool.heat", "grow by a tenth"},
                     {"tool.cool", "shrink by a tenth"},
                     {"tool.kick", "adds a velocity"},
                     {"tool.throw", "dragged from a particle"},
                     {"tool.add", "as many as find room"},
                     {"lecture.pen", "lines that fade out (D)"},
                     {"lecture.pointer", "trail of the pointer (K)"},
                     {"lecture.stopwatch", "start, stop, zero (W)"},
                     {"lecture.settings", "Sliders, plot, caption, colours and size"},
                     {"lecture.close", "Ends lecture mode (L)"}});
  const Scene scene = load_scene("conduction");
  CHECK(says(window.text("caption"), scene.title + ' ' + scene.caption));
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

TEST_CASE("Window texts: the settings of lecture mode, each explained") {
  OffscreenWindow window(load_scene("conduction"));
  window.press('l');
  window.click("lecture.settings");
  const std::string text = window.text("lecture_settings");
  CAPTURE(text);
  CHECK(says(text, "Size 1.00 Slider 1"));
  CHECK(says(text, "Slider 1 walls.left.temperature Slider 2 walls.right.temperature Slider 3"));
  CHECK(says(text, " Plot temperature Caption Theme projector"));
  window.check_help({{"window.scale", "Of all texts and widgets"},
                     {"lecture.slider.1", "Name of a slider"},
                     {"lecture.plot_of", "The large plot"},
                     {"lecture.captions", "The caption of the scene"},
                     {"lecture.theme", "Colours in lecture mode"}});
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
  CHECK(says(window.text("opening"), "Cancel"));
  CHECK(window.tooltip("opening.cancel") == "Keeps the former gas (Esc)");
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
  CHECK(says(window.text("Gallery"), "Search the gallery ( / ) ×"));
  window.check_help({{"gallery.close", "Close (G)"}});
}

TEST_CASE("Window texts: the plots and their choices") {
  OffscreenWindow window(load_scene("conduction"));
  if (window.text("plots").empty()) window.press('p');
  CHECK(says(window.text("plots"), "Profile along x Profile of "));
  window.check_help(
      {{"plots.axis", "Axis of the profile"}, {"plots.profile", "a band of one standard error"}});
  window.press('c');
  CHECK(window.comes_to_say("plots", "Differences from A"));
  window.check_help({{"plots.differences", "minus that of the first one"}});
}

TEST_CASE("Window texts: the list of the observables, explained") {
  OffscreenWindow window(load_scene("conduction", {{"measure.observables", "[\"probe\"]"}}));
  if (window.text("plots").empty()) window.press('p');
  window.press_key(GLFW_KEY_SPACE);
  CHECK(window.comes_to_say("plots", "Observable probe, series"));
  window.check_help({{"plots.observable", "A table of measure.observables"}});
}

TEST_CASE("Window texts: the strip of the timeline and the group of the window") {
  OffscreenWindow window(load_scene("conduction"));
  CHECK(window.text("left").starts_with("Gas Box View Record "));
  CHECK(window.text("timeline") == "0.00");
  window.check_help({{"collision_back", "Previous collision (Shift + , )"},
                     {"back", "Play backwards (B)"},
                     {"head", "Latest time of the run (End)"}});
  window.click("group.Record");
  CHECK(says(window.text("left"), "Window Size 1.00 Full screen"));
  window.check_help({{"window.scale", "Of all texts and widgets"},
                     {"full_screen", "Enter or leave (F11)"},
                     {"group.Box and walls", "Scrolls to Box and walls"}});
}

TEST_CASE("Window texts: each button of a narrow window opens the sheet of its name") {
  const Scene scene = load_scene("conduction");
  OffscreenWindow window(scene, 420.0f, 800.0f);
  CHECK(window.text("sheets") == "Run Gas View Record Plots Goal");
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
  }
}

TEST_CASE("Window texts: the plot of lecture mode takes a third of the window, beside the gas") {
  OffscreenWindow window(load_scene("conduction"), 1500.0f, 700.0f);
  window.press('l');
  const auto [left, top, width, height] = window.place("lecture.plot");
  CHECK(height < 0.3f * 1500.0f);
  CHECK(width > 0.3f * 1500.0f);
  CHECK(width < 0.4f * 1500.0f);
  CHECK(left + width < 1500.0f);
  CHECK(top + height < window.place("lecture.close")[1]);
  const auto caption = window.place("lecture.caption");
  CHECK(caption[2] > 10.0f * caption[3]);
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
