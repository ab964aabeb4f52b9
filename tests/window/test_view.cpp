// The window as a program: its size, its end and its errors, on a virtual display.

#include <doctest/doctest.h>
#include <fmt/format.h>

#include <cstdlib>

#include "engine/scene/scene_file.h"
#include "tests/render/picture.h"
#include "tests/window/gui_driver.h"
#include "tests/window/offscreen_window.h"

namespace clatter {

using nlohmann::json;

TEST_SUITE_BEGIN("display");

TEST_CASE("Window: it is no larger than the screen") {
  const GuiDriver driver("", "1280x800", "1200x720");
  const json place = driver.wait_for("widget", 0, [](const json& event) {
    return event["name"] == "close_lesson" && event["place"][1] < 720.0;
  })["place"];
  CHECK(place[0].get<double>() + place[2].get<double>() <= 1200.0);
}

TEST_CASE("Window: its panels have the colours of their picture off screen") {
  OffscreenWindow window(load_scene("vibrated"), 1280.0f, 800.0f);
  const Image picture = window.picture();
  const GuiDriver driver("--until 1", "1280x800");
  driver.wait_for("status", 0, halted);
  // A row of pixels through the triangle of the button.
  const auto [left, top, width, height] = window.place("play");
  const int y = static_cast<int>(top + 0.4f * height);
  for (int x = static_cast<int>(left) - 6; x < static_cast<int>(left + width); x += 3) {
    CAPTURE(x);
    const Colour expected = pixel(picture, x, y);
    const std::vector<int> colour = driver.pixel(x, y);
    CHECK(std::abs(colour[0] - expected.red) <= 2);
    CHECK(std::abs(colour[1] - expected.green) <= 2);
    CHECK(std::abs(colour[2] - expected.blue) <= 2);
  }
}

TEST_CASE("Window: F11 fills the screen, and restores the window at its place") {
  const GuiDriver driver("", "1000x640", "1280x800");
  driver.tool("search --name clatter windowmove --sync 40 30");
  const auto window = [&] {
    return driver.run("xdotool search --name clatter getwindowgeometry | tail -2").out;
  };
  const std::string before = window();
  REQUIRE(says(before, "Position: 40,30"));
  REQUIRE(says(before, "Geometry: 1000x640"));
  std::size_t told = driver.told();
  driver.key("F11");
  driver.place("viewport", told);
  CHECK(says(window(), "Position: 0,0"));
  CHECK(says(window(), "Geometry: 1280x800"));
  told = driver.told();
  driver.key("F11");
  driver.place("viewport", told);
  CHECK(window() == before);
}

TEST_CASE("Window: letters, comma and period are those of the keyboard layout") {
  // On this layout W, V and Z have the places of the comma, the period and the slash.
  const GuiDriver driver("--until 1", "1280x800");
  REQUIRE(driver.run("setxkbmap us dvorak").code == 0);
  driver.wait_for("status", 0, halted);
  driver.drag("particles.restitution", 0.88, 0.5);
  driver.wait_for("set");
  std::size_t told = driver.told();
  driver.key("ctrl+z");
  driver.wait_for("undo", told);
  const json undone = driver.wait_for("set", told);
  driver.wait_for("status", told, [&](const json& status) {
    return halted(status) && status["handled"] >= undone["command"];
  });
  const auto time_after = [&](const std::string& key) {
    told = driver.told();
    driver.key(key);
    return driver.wait_for("status", told, halted)["time"].get<double>();
  };
  CHECK(time_after("period") == doctest::Approx(1.0 + 2.0 / 60.0));
  CHECK(time_after("comma") == doctest::Approx(1.0));
  told = driver.told();
  driver.key("v");
  driver.key("w");
  driver.key("l");
  driver.place("viewport", told);
  for (const char* step : {"step_frame", "jump"}) CHECK(driver.events(step).size() == 1);
  told = driver.told();
  driver.key("shift+period");
  driver.wait_for("step_collision", told);

  // Other alphabets have the letters of a US keyboard.
  REQUIRE(driver.run("setxkbmap ru").code == 0);
  told = driver.told();
  driver.key("ctrl+Cyrillic_en");
  driver.wait_for("redo", told);
}

TEST_CASE("Window: if OpenGL is too old, or its context is lost, it names an alternative") {
  const GuiDriver driver("");
  const Outcome old = driver.run("MESA_GL_VERSION_OVERRIDE=2.1 clatter view");
  CHECK(old.code == 1);
  CHECK(says(old.err, "OpenGL 3.3"));
  CHECK(says(old.err, "clatter render"));
  const Outcome off_screen = driver.run("clatter view --backend osmesa");
  CHECK(off_screen.code == 2);
  CHECK(says(off_screen.err, "clatter render"));
  // The sanitizers require the first position in the preload order.
  const Outcome lost = driver.run("ASAN_OPTIONS=verify_asan_link_order=0 LD_PRELOAD=" +
                                  std::string(CLATTER_LOST_CONTEXT) + " clatter view");
  CHECK(lost.code == 1);
  CHECK(says(lost.err, "context is lost"));
  CHECK(says(lost.err, "clatter render"));
}

TEST_CASE("Window: the table of bench window has the cost of its pictures") {
  const GuiDriver driver("--set particles.count=1");
  const Outcome outcome = driver.run("clatter bench window --count 100 --json times");
  CAPTURE(outcome.err);
  REQUIRE(outcome.code == 0);
  const json row = json::parse(driver.shell().read("times"));
  CHECK(row["count"] == 100);
  CHECK(says(outcome.out, fmt::format("{:.2f}", row["median_milliseconds"].get<double>())));
  CHECK(row["median_milliseconds"] > 0.0);
  CHECK(row["percentile_99_milliseconds"] >= row["median_milliseconds"]);
  CHECK(row["change_milliseconds"] > 0.0);
  CHECK(row["build_milliseconds"] > 0.0);
}

TEST_CASE("Window: without a display, it names an alternative") {
  const Shell shell;
  for (const char* line : {"DISPLAY= clatter view vibrated", "DISPLAY= clatter"}) {
    const Outcome outcome = shell.run(line);
    CHECK(outcome.code == 1);
    CHECK(says(outcome.err, "clatter render"));
  }
}

TEST_SUITE_END();

}  // namespace clatter
