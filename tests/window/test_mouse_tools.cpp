// The tools of the window that act on the gas at the mouse.

#include <doctest/doctest.h>
#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "tests/window/gui_driver.h"

namespace clatter {

using nlohmann::json;

namespace {

json halt(const GuiDriver& driver) {
  const std::size_t told = driver.told();
  driver.key("space");
  return driver.wait_for("status", told, halted);
}

// The result of a run without a window, up to the time of a status.
json measured(const GuiDriver& driver, const std::string& scene, const json& status) {
  const Outcome outcome = driver.shell().run(
      fmt::format("clatter measure {} --quiet --set measure.burn_in=0 --until {}", scene,
                  status["time"].get<double>()));
  CAPTURE(outcome.err);
  REQUIRE(outcome.code == 0);
  return json::parse(outcome.out);
}

// Saves the scene of a halted gas. A run of it must give the same bits. Returns its result.
json check_saved_run(const GuiDriver& driver, const json& status) {
  const std::size_t told = driver.told();
  driver.key("ctrl+s");
  const json result = measured(driver, driver.wait_for("saved", told)["file"], status);
  CHECK(result["state_hash"] == status["hash"]);
  return result;
}

// Presses and releases the left button over the gas, and returns the nudge.
json press(const GuiDriver& driver) {
  const std::size_t told = driver.told();
  driver.click("viewport");
  return driver.wait_for("nudge", told)["nudge"];
}

json place_of(const GuiDriver& driver, const std::string& widget) {
  return driver.wait_for("widget", 0,
                         [&](const json& event) { return event["name"] == widget; })["place"];
}

std::size_t nudges(const GuiDriver& driver) {
  return driver.events("nudge").size();
}

}  // namespace

TEST_SUITE_BEGIN("display");

TEST_CASE("Mouse tools: a held press heats again and again, and undo removes it from the run") {
  const GuiDriver driver("--set view.speed=4");
  driver.wait_for("status", 0, [](const json& status) { return status["time"] > 2.0; });
  driver.click("tool.heat");
  driver.point_at("viewport");
  driver.tool("mousedown 1");
  driver.wait_for("nudge", 0, [&](const json&) { return nudges(driver) >= 4; });
  driver.tool("mouseup 1");
  std::size_t told = driver.told();
  driver.wait_for("status", told);
  const json head = halt(driver);
  const std::size_t count = nudges(driver);
  CHECK(head["changes"] == count);
  const json heat = driver.events("nudge")[0]["nudge"];
  CHECK(heat["scale"] == 1.1);
  CHECK(heat["radius"] == 3.0);
  CHECK(check_saved_run(driver, head)["energy"]["nudges_in"]["mean"] > 0.0);

  told = driver.told();
  driver.key("Home");
  driver.wait_for("status", told, halted);
  told = driver.told();
  driver.key("End");
  CHECK(driver.wait_for("status", told, halted)["hash"] == head["hash"]);

  told = driver.told();
  driver.key("ctrl+z");
  const json undone = driver.wait_for(
      "status", told, [](const json& status) { return halted(status) && status["changes"] == 0; });
  CHECK(undone["time"] < head["time"]);
  CHECK(undone["other_future"][1].get<double>() == doctest::Approx(head["time"].get<double>()));
  CHECK(measured(driver, "vibrated", undone)["state_hash"] == undone["hash"]);
  told = driver.told();
  driver.key("ctrl+y");
  driver.wait_for("status", told, [&](const json& status) { return status["changes"] == count; });
  told = driver.told();
  driver.key("End");
  CHECK(driver.wait_for("status", told, [&](const json& status) {
    return halted(status) && status["time"] == head["time"];
  })["hash"] == head["hash"]);
}

TEST_CASE("Mouse tools: undo and redo of two presses return to their times") {
  const GuiDriver driver("--until 3");
  driver.wait_for("status", 0, halted);
  driver.key("2");
  CHECK(press(driver)["scale"].get<double>() == doctest::Approx(1.0 / 1.1));
  const auto step_to = [&](double time) {
    driver.key("space");
    driver.wait_for("status", 0, [&](const json& status) { return status["time"] > time; });
    return halt(driver);
  };
  step_to(4.0);
  press(driver);
  const json head = step_to(5.0);
  REQUIRE(head["changes"] == 2);
  std::size_t told = driver.told();
  driver.key("ctrl+s");
  const std::string saved = driver.wait_for("saved", told)["file"];
  const auto changes_after = [&](const char* key) {
    told = driver.told();
    driver.key(key);
    return driver.wait_for("status", told, halted);
  };
  json now = changes_after("ctrl+z");
  CHECK(now["changes"] == 1);
  CHECK(now["time"] >= 4.0);
  now = changes_after("ctrl+z");
  CHECK(now["changes"] == 0);
  CHECK(now["time"] < 4.0);
  CHECK(changes_after("ctrl+y")["changes"] == 1);
  CHECK(changes_after("ctrl+y")["changes"] == 2);
  const json again = step_to(4.5);
  CHECK(measured(driver, saved, again)["state_hash"] == again["hash"]);
}

TEST_CASE("Mouse tools: a halted gas is nudged once by a press, however long") {
  const GuiDriver driver("--until 1");
  driver.wait_for("status", 0, halted);
  driver.click("tool.heat");
  driver.point_at("viewport");
  driver.tool("mousedown 1 sleep 1 mouseup 1");
  const std::size_t told = driver.told();
  driver.key("period");
  const json next = driver.wait_for("status", told, halted);
  CHECK(next["changes"] == 1);
  check_saved_run(driver, next);
}

TEST_CASE("Mouse tools: a kick has the direction of its arrow, and its length in a second") {
  const GuiDriver driver("--until 1");
  driver.wait_for("status", 0, halted);
  driver.click("tool.kick");
  std::size_t told = driver.told();
  driver.click("viewport");
  CHECK(says(driver.wait_for("message", told)["text"], "Drag an arrow"));
  CHECK(nudges(driver) == 0);

  const json left = place_of(driver, "wall.left"), right = place_of(driver, "wall.right");
  const double width = right[0].get<double>() - left[0].get<double>() - left[2].get<double>();
  const double speed = 60.0 / (width / 20.0) / 2.0;  // box.size, view.speed
  driver.pull("viewport", 60, 0);
  const json to_right = driver.wait_for("nudge", told)["nudge"]["add"];
  CHECK(to_right[0].get<double>() == doctest::Approx(speed).epsilon(0.03));
  CHECK(std::fabs(to_right[1].get<double>()) < 0.03 * speed);
  told = driver.told();
  driver.pull("viewport", 0, -60);
  const json up = driver.wait_for("nudge", told)["nudge"]["add"];
  CHECK(up[1].get<double>() == doctest::Approx(speed).epsilon(0.03));
  CHECK(std::fabs(up[0].get<double>()) < 0.03 * speed);
  told = driver.told();
  driver.key("period");
  check_saved_run(driver, driver.wait_for("status", told, halted));
}

TEST_CASE("Mouse tools: a throw sets the velocity of one disk, and Esc ends the tool") {
  const GuiDriver driver("--until 1 --set particles.count=330");
  driver.wait_for("status", 0, halted);
  driver.click("tool.throw");
  std::size_t told = driver.told();
  driver.pull("viewport", -80, 40);
  const json nudge = driver.wait_for("nudge", told)["nudge"];
  CHECK(nudge["particle"].get<int>() < 330);
  CHECK(nudge["set"][0] < 0.0);
  CHECK(nudge["set"][1] < 0.0);
  CHECK(nudge.size() == 2);
  told = driver.told();
  driver.key("period");
  check_saved_run(driver, driver.wait_for("status", told, halted));

  driver.key("Escape");
  told = driver.told();
  driver.pull("viewport", -80, 40);
  driver.key("period");
  driver.wait_for("step_frame", told);
  CHECK(nudges(driver) == 1);
}

TEST_CASE("Mouse tools: spheres are heated in a ball in the box") {
  const GuiDriver driver("spheres_vibrated --until 1");
  driver.wait_for("status", 0, halted);
  driver.click("tool.heat");
  const json heat = press(driver);
  const json box = driver.wait_for("status")["box"];
  REQUIRE(heat["centre"].size() == 3);
  for (std::size_t axis = 0; axis < 3; ++axis) {
    CHECK(heat["centre"][axis] >= 0.0);
    CHECK(heat["centre"][axis] <= box[axis]);
  }
  const std::size_t told = driver.told();
  driver.key("period");
  check_saved_run(driver, driver.wait_for("status", told, halted));
}

TEST_CASE("Mouse tools: a click adds particles in the circle, and undo removes them") {
  const GuiDriver driver("--until 1 --set particles.count=60");
  const json before = driver.wait_for("status", 0, halted);
  driver.key("5");
  std::size_t told = driver.told();
  driver.click("viewport");
  const json puff = driver.wait_for("puff", told);
  CHECK(puff["count"] == 20);
  CHECK(puff["radius"] == 3.0);
  CHECK(puff["temperature"].get<double>() ==
        doctest::Approx(before["temperature"].get<double>()).epsilon(5e-3));
  driver.wait_for("status", told, [](const json& status) { return status["particles"] == 80; });
  told = driver.told();
  driver.key("period");
  const json next = driver.wait_for("status", told, halted);
  CHECK(next["changes"] == 1);
  CHECK(next["particles"] == 80);
  check_saved_run(driver, next);

  told = driver.told();
  driver.key("ctrl+z");
  CHECK(driver.wait_for("status", told, [](const json& status) {
    return halted(status) && status["particles"] == 60;
  })["changes"] == 0);
  told = driver.told();
  driver.key("ctrl+y");
  driver.wait_for("status", told, [](const json& status) { return status["particles"] == 80; });
}

TEST_CASE("Mouse tools: particles are added while they find room, and then a message tells it") {
  const GuiDriver driver("--until 1 --set particles.count=60");
  driver.wait_for("status", 0, halted);
  driver.click("tool.add");
  const std::size_t told = driver.told();
  for (int click = 0; click < 4; ++click) driver.click("viewport");
  CHECK(driver.wait_for("message", told)["text"].get<std::string>().find("there is no room") !=
        std::string::npos);
  // A circle of radius 3 has no room for 60 further disks.
  const json after = driver.wait_for("status", told);
  CHECK(after["particles"] >= 80);
  CHECK(after["particles"] < 120);
}

TEST_CASE("Mouse tools: lecture mode has them, and the pen takes their place") {
  const GuiDriver driver("");
  driver.key("l");
  driver.click("tool.cool");
  press(driver);
  driver.key("d");
  const std::size_t count = nudges(driver);
  driver.click("viewport");
  driver.key("w");
  driver.wait_for("stopwatch");
  CHECK(nudges(driver) == count);
  driver.key("1");
  CHECK(press(driver)["scale"] == 1.1);
}

TEST_CASE("Mouse tools: a narrow window has them in the sheet of the gas") {
  const GuiDriver driver("", "420x800");
  driver.click("sheet.gas");
  driver.click("tool.heat");
  driver.click("sheet.close");
  CHECK(press(driver)["scale"] == 1.1);
}

TEST_CASE("Mouse tools: the dragged right wall is a piston, and undo takes its strokes back") {
  const GuiDriver driver("--set view.speed=2");
  driver.wait_for("status", 0, [](const json& status) { return status["time"] > 1.0; });
  const double right = driver.place("wall.right")[0];
  driver.point_at("wall.right");
  driver.tool("mousedown 1 mousemove_relative -- -150 0");
  driver.wait_for("piston", 0, [&](const json&) { return driver.events("piston").size() >= 5; });
  driver.tool("mouseup 1");
  std::size_t told = driver.told();
  driver.wait_for("status", told);
  const json head = halt(driver);
  CHECK(head["run"] == 1);
  CHECK(head["box"][0] == 20.0);
  const std::size_t count = driver.events("piston").size();
  CHECK(head["changes"] == count);
  double before = 20.0;
  for (const json& stroke : driver.events("piston")) {
    CHECK(stroke["position"] < before);
    CHECK(stroke["duration"] == 0.2);
    before = stroke["position"];
  }
  // The handle follows the wall.
  CHECK(driver.place("wall.right")[0] < right - 5.0);
  check_saved_run(driver, head);

  told = driver.told();
  driver.key("Home");
  driver.wait_for("status", told, halted);
  told = driver.told();
  driver.key("End");
  CHECK(driver.wait_for("status", told, halted)["hash"] == head["hash"]);
  told = driver.told();
  driver.key("ctrl+z");
  const json undone = driver.wait_for(
      "status", told, [](const json& status) { return halted(status) && status["changes"] == 0; });
  CHECK(undone["time"] < head["time"]);
  CHECK(measured(driver, "vibrated", undone)["state_hash"] == undone["hash"]);
  told = driver.told();
  driver.key("ctrl+y");
  driver.wait_for("status", told, [&](const json& status) { return status["changes"] == count; });
}

TEST_CASE("Mouse tools: the piston of a halted gas stays, with a message") {
  const GuiDriver driver("--until 1");
  driver.wait_for("status", 0, halted);
  const std::size_t told = driver.told();
  driver.pull("wall.right", -60, 0);
  CHECK(driver.wait_for("message", told)["text"].get<std::string>().find("while the gas plays") !=
        std::string::npos);
  CHECK(driver.events("piston").empty());
}

TEST_SUITE_END();

}  // namespace clatter
