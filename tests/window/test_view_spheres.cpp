// Spheres in the window, controlled by mouse and keys on a virtual display.

#include <doctest/doctest.h>

#include <cmath>

#include "engine/scene/scene_file.h"
#include "tests/window/gui_driver.h"

namespace clatter {

using nlohmann::json;

namespace {

// The files of two scenes: a moving gas, and spheres at rest in rows through the middle of the box,
// two along each axis and two along the diagonal. Without texts the middle of the box is in the
// middle of the viewport.
class Scenes {
 public:
  Scenes() {
    folder_.write("rows.toml", R"(
title = "Rows"
[box]
size = [10.0, 10.0, 10.0]
[particles.start]
layout = "file"
file = "rows.csv"
[walls]
left = { kind = "static" }
right = { kind = "static" }
bottom = { kind = "static" }
top = { kind = "static" }
back = { kind = "static" }
front = { kind = "static" }
[view]
azimuth = 0.0
elevation = 0.0
overlay = false
)");
    folder_.write("rows.csv",
                  "x,y,z,vx,vy,vz\n"
                  "5,5,8,0,0,0\n"
                  "5,5,2,0,0,0\n"
                  "8,5,5,0,0,0\n"
                  "2,5,5,0,0,0\n"
                  "5,8,5,0,0,0\n"
                  "5,2,5,0,0,0\n"
                  "7,7,7,0,0,0\n"
                  "3,3,3,0,0,0\n");
    folder_.write("gas.toml", R"(
title = "Gas"
[box]
size = [9.0, 8.0, 7.0]
[particles]
count = 100
restitution = 0.9
[walls]
left = { kind = "driven", drive_speed = 1.0 }
right = { kind = "static" }
bottom = { kind = "static" }
top = { kind = "static" }
back = { kind = "static" }
front = { kind = "static" }
)");
  }
  std::string rows() const { return folder_.path("rows.toml").string(); }
  std::string gas() const { return folder_.path("gas.toml").string(); }

 private:
  Shell folder_;
};

Scene saved_scene(const GuiDriver& driver) {
  const std::size_t told = driver.told();
  driver.key("ctrl+s");
  return load_scene(driver.shell().path(driver.wait_for("saved", told)["file"]).string());
}

// The sphere that a click in the middle of the viewport picks. It must not be the second click of a
// double click, which also follows the sphere.
json picked_in_the_middle(const GuiDriver& driver) {
  driver.tool("sleep 0.4");
  const std::size_t told = driver.told();
  driver.click("viewport");
  return driver.wait_for("pick", told)["particle"];
}

// The sphere that is picked after a click at the mouse.
json picked_here(const GuiDriver& driver) {
  driver.tool("click 1 sleep 0.3");
  return driver.events("pick").back()["particle"];
}

// The share of the width of the viewport, right of the middle, at which a click picks a sphere.
double share_of(const GuiDriver& driver, int sphere) {
  for (double share = 0.5; share < 1.0; share += 0.015) {
    driver.point_at("viewport", share);
    if (picked_here(driver) == sphere) return share;
  }
  FAIL("sphere " << sphere << " is not on the picture");
  return 0.0;
}

// Waits for a picture from another direction or place after the first `told` events: the handles of
// the walls are then elsewhere. Clicks refer to the picture on the screen.
void wait_for_picture(const GuiDriver& driver, std::size_t told) {
  driver.wait_for("widget", told, [](const json& event) {
    return event["name"].get<std::string>().starts_with("wall.");
  });
}

void look_from(const GuiDriver& driver, const std::string& key) {
  const std::size_t told = driver.told();
  driver.key(key);
  wait_for_picture(driver, told);
}

bool turned(const json& event, double azimuth, double elevation) {
  return std::fabs(event["azimuth"].get<double>() - azimuth) < 1e-9 &&
         std::fabs(event["elevation"].get<double>() - elevation) < 1e-9;
}

}  // namespace

TEST_SUITE_BEGIN("display");

// By hand: along each direction the nearer sphere of the row is in front of the other. From behind
// it is the other one.
TEST_CASE("Window: a click picks the sphere in front, from each direction and after a move") {
  const Scenes scenes;
  const GuiDriver driver(scenes.rows());
  CHECK(picked_in_the_middle(driver) == 0);
  look_from(driver, "x");
  CHECK(picked_in_the_middle(driver) == 2);
  look_from(driver, "y");
  CHECK(picked_in_the_middle(driver) == 4);
  look_from(driver, "i");
  CHECK(picked_in_the_middle(driver) == 6);
  look_from(driver, "z");
  std::size_t told = driver.told();
  driver.pull("viewport", 450, 0);
  driver.wait_for("turn", told);
  wait_for_picture(driver, told);
  CHECK(picked_in_the_middle(driver) == 1);
  // A drag with Shift moves the view: another sphere, or none, is then in the middle.
  look_from(driver, "z");
  told = driver.told();
  driver.tool("keydown shift");
  driver.pull("viewport", 60, 0);
  driver.tool("keyup shift");
  wait_for_picture(driver, told);
  CHECK(picked_in_the_middle(driver).is_null());
  look_from(driver, "f");
  CHECK(picked_in_the_middle(driver) == 0);
  // Away from all spheres it picks none, and a drag picks nothing.
  driver.key("Escape");
  told = driver.told();
  driver.pull("viewport", 0, 60);
  driver.wait_for("turn", told);
  CHECK(driver.events("pick").back()["particle"].is_null());
}

TEST_CASE("Window: a drag turns the view, undo turns it back, and the saved scene has it") {
  const Scenes scenes;
  const GuiDriver driver(scenes.rows());
  std::size_t told = driver.told();
  // 0.4 degrees a pixel; the front follows the mouse.
  driver.pull("viewport", 100, 60);
  driver.wait_for("turn", told, [](const json& turn) { return turned(turn, -40.0, 24.0); });
  told = driver.told();
  driver.key("ctrl+z");
  driver.wait_for("turn", told, [](const json& turn) { return turned(turn, 0.0, 0.0); });
  driver.key("ctrl+y");
  const Scene scene = saved_scene(driver);
  CHECK(scene.view.azimuth == doctest::Approx(-40.0));
  CHECK(scene.view.elevation == doctest::Approx(24.0));
}

TEST_CASE("Window: the wheel zooms about the mouse") {
  const Scenes scenes;
  const GuiDriver driver(scenes.rows());
  CHECK(picked_in_the_middle(driver) == 0);
  CHECK(share_of(driver, 2) > 0.55);
  // By a factor of 0.85^4. About the middle of the viewport the sphere would move by 1.6 diameters.
  driver.tool("click --repeat 4 --delay 100 4 sleep 0.5");
  driver.key("Escape");
  CHECK(picked_here(driver) == 2);
}

TEST_CASE("Window: V shows the path of the picked sphere, and hides it") {
  const Scenes scenes;
  const GuiDriver driver(scenes.rows());
  CHECK(picked_in_the_middle(driver) == 0);
  driver.key("v");
  const Scene traced = saved_scene(driver);
  REQUIRE(traced.view.tracer);
  CHECK(traced.view.tracer->particle == 0);
  CHECK(traced.view.tracer->time == doctest::Approx(20.0 * traced.view.speed));
  driver.key("v");
  CHECK_FALSE(saved_scene(driver).view.tracer);
  driver.key("ctrl+z");
  CHECK(saved_scene(driver).view.tracer);
}

TEST_CASE("Window: a wall of a box of spheres moves with the mouse, and undo moves it back") {
  const Scenes scenes;
  const GuiDriver driver(scenes.gas() + " --set view.azimuth=0 --set view.elevation=0");
  const json before = driver.wait_for("status");
  const auto opened_after = [](const json& last) {
    return [run = last["run"]](const json& status) { return status["run"] > run; };
  };
  // From the front the outline is the front side. The right handle is as long as the box is high.
  const json right = driver.wait_for(
      "widget", 0, [](const json& event) { return event["name"] == "wall.right"; })["place"];
  const double pixels = right[3].get<double>() / 8.0;  // per diameter
  std::size_t told = driver.told();
  driver.tool("keydown shift");
  driver.pull("wall.right", 50, 0);
  driver.tool("keyup shift");
  json now = driver.wait_for("status", told, opened_after(before));
  CHECK(std::fabs(now["box"][0].get<double>() - 9.0 - 50.0 / pixels) <= 0.06);
  CHECK(now["box"][1] == 8.0);
  CHECK(now["box"][2] == 7.0);
  CHECK(now["particles"] == 100);
  told = driver.told();
  driver.key("ctrl+z");
  now = driver.wait_for("status", told, opened_after(now));
  CHECK(now["box"] == before["box"]);
  // From the right the front wall is at the left.
  driver.key("x");
  told = driver.told();
  driver.pull("wall.front", -50, 0);
  now = driver.wait_for("status", told, opened_after(now));
  CHECK(now["box"][0] == 9.0);
  CHECK(now["box"][2] > 7.5);
  // In a turned view the top wall moves upwards.
  told = driver.told();
  driver.key("ctrl+z");
  now = driver.wait_for("status", told, opened_after(now));
  driver.pull("viewport", 60, 60);
  told = driver.told();
  driver.pull("wall.top", 0, -40);
  now = driver.wait_for("status", told, opened_after(now));
  CHECK(now["box"][1] > 8.5);
  CHECK(now["box"][0] == 9.0);
}

TEST_SUITE_END();

}  // namespace clatter
