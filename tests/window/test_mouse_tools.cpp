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

// Steps to the next frame. A run of the saved scene must give the same bits. Returns its status.
json check_next_frame(const GuiDriver& driver) {
  const std::size_t told = driver.told();
  driver.key("period");
  const json next = driver.wait_for("status", told, halted);
  check_saved_run(driver, next);
  return next;
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
  driver.key("ctrl+z");
  const json undone = driver.wait_for(
      "status", told, [](const json& status) { return halted(status) && status["changes"] == 0; });
  CHECK(undone["time"] < head["time"]);
  CHECK(measured(driver, "vibrated", undone)["state_hash"] == undone["hash"]);
  told = driver.told();
  driver.key("ctrl+y");
  driver.wait_for("status", told, [&](const json& status) { return status["changes"] == count; });
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
  check_next_frame(driver);
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
  check_next_frame(driver);

  driver.key("Escape");
  told = driver.told();
  driver.pull("viewport", -80, 40);
  driver.key("period");
  driver.wait_for("step_frame", told);
  CHECK(nudges(driver) == 1);
}

TEST_CASE("Mouse tools: halted spheres are heated once by a press, however long, in a ball") {
  const GuiDriver driver("spheres_vibrated --until 1");
  driver.wait_for("status", 0, halted);
  driver.click("tool.heat");
  driver.point_at("viewport");
  driver.tool("mousedown 1 sleep 1 mouseup 1");
  const json heat = driver.wait_for("nudge")["nudge"];
  const json box = driver.wait_for("status")["box"];
  REQUIRE(heat["centre"].size() == 3);
  for (std::size_t axis = 0; axis < 3; ++axis) {
    CHECK(heat["centre"][axis] >= 0.0);
    CHECK(heat["centre"][axis] <= box[axis]);
  }
  CHECK(check_next_frame(driver)["changes"] == 1);
}

TEST_CASE("Mouse tools: a ball is drawn among the disks, and undo removes it") {
  const GuiDriver driver("--until 1 --set particles.count=60");
  driver.wait_for("status", 0, halted);
  driver.click("tool.ball");
  std::size_t told = driver.told();
  driver.pull("viewport", 40, 0);
  const json keys = driver.wait_for("set", told)["keys"];
  CHECK(says(keys["obstacle"], "\"ball\""));
  const json status = driver.wait_for("status", told, halted);
  told = driver.told();
  driver.key("ctrl+s");
  const std::string file = driver.wait_for("saved", told)["file"];
  const Outcome drawn = driver.shell().run("clatter check --quiet " + file);
  CHECK(says(drawn.out, "[[obstacle]]"));

  told = driver.told();
  driver.key("ctrl+z");
  CHECK(says(driver.wait_for("set", told)["keys"]["obstacle"], "[]"));
}

TEST_CASE("Mouse tools: a click adds particles to a halted gas, which has no piston") {
  const GuiDriver driver("--until 1 --set particles.count=60");
  const json before = driver.wait_for("status", 0, halted);
  std::size_t told = driver.told();
  driver.pull("wall.right", -60, 0);
  CHECK(says(driver.wait_for("message", told)["text"], "while the gas plays"));
  CHECK(driver.events("piston").empty());
  driver.key("5");
  told = driver.told();
  driver.click("viewport");
  const json puff = driver.wait_for("puff", told);
  CHECK(puff["count"] == 20);
  CHECK(puff["radius"] == 3.0);
  CHECK(puff["temperature"].get<double>() ==
        doctest::Approx(before["temperature"].get<double>()).epsilon(5e-3));
  driver.wait_for("status", told, [](const json& status) { return status["particles"] == 80; });
  const json next = check_next_frame(driver);
  CHECK(next["changes"] == 1);
  CHECK(next["particles"] == 80);

  told = driver.told();
  driver.key("ctrl+z");
  CHECK(driver.wait_for("status", told, [](const json& status) {
    return halted(status) && status["particles"] == 60;
  })["changes"] == 0);
  told = driver.told();
  driver.key("ctrl+y");
  driver.wait_for("status", told, [](const json& status) { return status["particles"] == 80; });
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
  driver.key("ctrl+z");
  driver.wait_for("status", told,
                  [](const json& status) { return halted(status) && status["changes"] == 0; });
}

TEST_SUITE_END();

}  // namespace clatter
