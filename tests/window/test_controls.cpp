// The panels, plots and walls of the window, by mouse and keys on a virtual display.

#include <doctest/doctest.h>
#include <imgui.h>

#include <algorithm>
#include <cmath>
#include <sstream>

#include "engine/scene/scene_file.h"
#include "tests/window/gui_driver.h"
#include "tests/window/offscreen_window.h"

namespace clatter {

using nlohmann::json;

namespace {

// The file of the disks at the start of the gas.
std::string saved_start(const GuiDriver& driver) {
  const std::size_t told = driver.told();
  driver.key("ctrl+s");
  std::string file = driver.wait_for("saved", told)["file"];
  return driver.shell().read(file.replace(file.rfind('.'), file.size(), ".csv"));
}

// A column of a table with column names in the first line.
std::vector<double> column_of(const std::string& table, const std::string& name) {
  std::istringstream lines(table);
  std::string line;
  std::getline(lines, line);
  const auto column =
      std::count(line.begin(), line.begin() + static_cast<long>(line.find(name)), ',');
  std::vector<double> values;
  while (std::getline(lines, line)) {
    std::istringstream cells(line);
    std::string cell;
    for (long i = 0; i <= column; ++i) std::getline(cells, cell, ',');
    values.push_back(std::stod(cell));
  }
  return values;
}

}  // namespace

TEST_CASE("Controls: a typed number beyond the range becomes its end, with its digits") {
  OffscreenWindow window(parse_scene("box.size = [16.0, 12.0]\nparticles = { count = 5 }\n", "gas"),
                         900.0f, 700.0f);
  window.click("tool.heat");
  const auto answer = [&](const std::string& widget, const std::string& number) {
    window.click(widget + ".number");
    for (const char digit : number) {
      ImGui::GetIO().AddInputCharacter(static_cast<unsigned>(digit));
      window.draw();
    }
    window.click("viewport");
    return window.logged("message")["text"].get<std::string>();
  };
  CHECK(answer("particles.restitution", "1.5") == "Restitution: at most 1.000");
  CHECK(answer("tool.radius", "50") == "Radius: at most 16 a");
  CHECK(answer("tool.radius", "0.1") == "Radius: at least 0.5 a");
  CHECK(answer("particles.restitution", "abc") == "Restitution: type a number");
}

TEST_SUITE_BEGIN("display");

// Grains at rest on a floor with a small stroke. With a long stroke the floor would overlap them.
TEST_CASE("Window: a refused change stays neither in the panels nor in the saved scene") {
  const GuiDriver driver(
      "shaker --set walls.bottom.kind=sawtooth --set walls.bottom.stroke=0.1 --set view.speed=20 "
      "--set collapse.contact_time=1e-3 "
      "--until 30.25",
      "1280x1500");
  driver.wait_for("status", 0, halted);
  std::size_t told = driver.told();
  driver.drag("walls.bottom.stroke", 0.1, 0.95);
  const json message = driver.wait_for("message", told);
  CHECK(says(message["text"], "into a particle"));
  driver.key("r");
  driver.wait_for("status", told, [](const json& status) { return status["run"] == 2; });
  told = driver.told();
  driver.key("ctrl+s");
  const std::string scene = driver.shell().read(driver.wait_for("saved", told)["file"]);
  const std::size_t stroke = scene.find("stroke = ");
  REQUIRE(stroke != std::string::npos);
  CHECK(std::stod(scene.substr(stroke + 9)) < 1.0);
}

// Drags a wall with Shift, without which the right wall is a piston.
static void pull_with_shift(const GuiDriver& driver, const char* wall, int right, int down) {
  driver.tool("keydown shift");
  driver.pull(wall, right, down);
  driver.tool("keyup shift");
}

TEST_CASE("Window: a wall that is dragged makes another box for the same disks") {
  const GuiDriver driver("--set walls.bottom.kind=static --set walls.top.kind=static");
  const double pixels = driver.place("wall.left")[3] / 25.0;  // per diameter
  // Clicks change nothing.
  driver.click("wall.right");
  driver.click("wall.left");
  CHECK(driver.wait_for("status")["run"] == 1);
  struct Case {
    const char* wall;
    int right, down;  // outwards
    int axis;
    const char* column;  // of the positions of the disks along it
  };
  for (const auto& [wall, right, down, axis, column] :
       {Case{"wall.right", 75, 0, 0, "x"}, Case{"wall.left", -75, 0, 0, "x"},
        Case{"wall.top", 0, -75, 1, "y"}, Case{"wall.bottom", 0, 75, 1, "y"}}) {
    CAPTURE(wall);
    const json before = driver.wait_for("status");
    const std::size_t told = driver.told();
    const auto opened = [&](const json& status) { return status["run"] > before["run"]; };
    pull_with_shift(driver, wall, right, down);
    const json wider = driver.wait_for("status", told, opened);
    CHECK(wider["particles"] == before["particles"]);
    const double grown = wider["box"][axis].get<double>() - before["box"][axis].get<double>();
    CHECK(grown > 1.0);
    if (wall == std::string("wall.right")) CHECK(std::fabs(grown - right / pixels) <= 0.051);
    CHECK(wider["box"][1 - axis] == before["box"][1 - axis]);
    // The disks keep their positions. The new part of the box is empty.
    const std::string saved = saved_start(driver);
    const bool low = right + down == (axis == 0 ? -75 : 75);
    const auto [least, most] = std::ranges::minmax(column_of(saved, column));
    const double room = low ? least : wider["box"][axis].get<double>() - most;
    CHECK(room >= grown + 0.5 - 1e-9);
    driver.key("ctrl+z");
    driver.wait_for("status", told,
                    [&](const json& status) { return status["box"] == before["box"]; });
    const auto [lowest, highest] = std::ranges::minmax(column_of(saved_start(driver), column));
    CHECK(lowest >= 0.5 - 1e-9);
    CHECK(highest <= before["box"][axis].get<double>() - 0.5 + 1e-9);
  }
  driver.pull("wall.left", 40, 0);
  driver.key("space");
  check_saved_scene(driver);
}

TEST_CASE("Window: Esc closes the open list, then the panel with it") {
  const GuiDriver driver("");
  driver.key("p");
  driver.click("plots.profile");
  std::size_t told = driver.told();
  driver.key("Escape");
  driver.click("plots.profile.density");  // a place in the plots, if the list is closed
  CHECK(driver.place("viewport")[2] < 1000.0);
  told = driver.told();
  driver.key("Escape");
  CHECK(driver.place("viewport", told)[2] > 1000.0);
}

TEST_CASE("Window: a click on a number types another one, at most the largest") {
  const GuiDriver driver("");
  const auto type = [&](const std::string& number) {
    const std::size_t told = driver.told();
    driver.click("particles.count.number");
    driver.key("ctrl+a");
    driver.tool("type --delay 100 " + number);
    driver.key("Return");
    return driver.wait_for("set", told)["keys"]["particles.count"].get<std::string>();
  };
  CHECK(type("123") == "123");
  const std::size_t told = driver.told();
  const std::string most = type("5000");
  CHECK(std::stoi(most) < 5000);
  CHECK(std::stoi(most) > 200);
  CHECK(says(driver.wait_for("message", told)["text"],
             "Disks: at most " + most + "; no more fit into the box; enlarge it first"));
  const std::size_t after = driver.told();
  driver.click("particles.restitution.number");
  driver.tool("type --delay 100 0.123");
  driver.key("Escape");
  driver.key("p");
  driver.place("viewport", after);
  CHECK(driver.events("set").size() == 2);
}

TEST_CASE("Window: the plots list the observables of the scene") {
  const GuiDriver driver(
      "spheres_vibrated --set view.speed=10 --set "
      "'measure.observables=[\"probe\",\"collisions\"]'");
  driver.key("p");
  CHECK(driver.wait_for("observable")["table"] == "probe, series");
  driver.click("plots.observable");
  const std::size_t told = driver.told();
  driver.click("plots.observable.collisions, normal speed");
  CHECK(driver.wait_for("observable", told)["table"] == "collisions, normal speed");
  CHECK(driver.wait_for("status")["run"] == 1);
}

TEST_CASE("Window: balance residuals are computed only while they are plotted") {
  const GuiDriver driver("--set view.speed=10");
  const auto told_residuals = [](const json& status) { return status.contains("residuals"); };
  driver.key("p");
  driver.click("plots.profile");
  std::size_t told = driver.told();
  driver.click("plots.profile.balance residuals");
  const json with = driver.wait_for("status", told, [&](const json& status) {
    return told_residuals(status) && status["residuals"][3] > 0.0;
  });
  for (const json& residual : with["residuals"]) CHECK(residual < 1e-9);
  CHECK(with["run"] == 1);
  driver.key("p");
  told = driver.told();
  driver.wait_for("status", told, [&](const json& status) { return !told_residuals(status); });
}

TEST_CASE("Window: lecture mode has the colours for a projector, also after undo") {
  const GuiDriver driver("", "1280x1500");
  // A change of the view, to be undone in lecture mode.
  driver.click("view.grid");
  driver.key("l");
  CHECK(driver.corner_becomes({255, 255, 255}));
  const std::size_t told = driver.told();
  driver.key("ctrl+z");
  driver.wait_for("undo", told);
  CHECK(driver.corner_becomes({255, 255, 255}));
  driver.key("Escape");
  CHECK(driver.corner_becomes({0x10, 0x14, 0x18}));
}

TEST_CASE("Window: flights are recorded while their trails are drawn") {
  const GuiDriver driver("equilibrium --set view.speed=5", "1280x1500");
  const json before = driver.wait_for("status");
  CHECK(before["flights"] == 0);
  std::size_t told = driver.told();
  driver.drag("view.trails", 0.02, 0.9);
  const json with =
      driver.wait_for("status", told, [](const json& status) { return status["flights"] > 0; });
  // Only the picture changes.
  CHECK(with["run"] == before["run"]);
  CHECK(with["changes"] == 0);
  // A drag is one undo step.
  told = driver.told();
  driver.key("ctrl+z");
  driver.wait_for("status", told, [](const json& status) { return status["flights"] == 0; });
}

TEST_SUITE_END();

}  // namespace clatter
