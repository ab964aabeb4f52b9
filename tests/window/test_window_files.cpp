// Screenshots and films of the window, by mouse and keys on a virtual display.

#include <doctest/doctest.h>

#include <chrono>
#include <thread>

#include "tests/window/gui_driver.h"

namespace clatter {

using nlohmann::json;

TEST_SUITE_BEGIN("display");

TEST_CASE("Window: a screenshot equals the screen, and its scene plays it again") {
  const GuiDriver driver("");
  driver.wait_for("status", 0, [](const json& status) { return status["time"] > 2.0; });
  driver.drag("walls.left.drive_speed", 0.3, 0.8);
  driver.key("space");
  std::size_t told = driver.told();
  // No file is replaced, also none that a scene of this name would write.
  driver.shell().run("touch clatter-1.csv clatter-2.mp4 clatter-3.toml clatter-4.png");
  driver.key("F2");
  const std::string file = driver.wait_for("screenshot", told)["file"];
  CHECK(file == "clatter-5.png");
  CHECK(driver.shell().read(file).starts_with("\x89PNG"));
  // Background above the left wall, wall colour on the wall.
  CHECK(driver.corner_becomes({0x10, 0x14, 0x18}));

  check_saved_scene(driver);
}

TEST_CASE("Window: its film of a changed gas equals the film of the command that it shows") {
  const GuiDriver driver("--set view.speed=4", "1280x1840");
  driver.drag("particles.restitution", 0.88, 0.7);
  driver.drag("walls.left.drive_speed", 0.2, 0.4);
  driver.drag("walls.right.restitution", 0.9, 0.8);
  driver.key("space");
  // A short film with few pictures.
  for (int i = 0; i < 6; ++i) driver.key("plus");
  check_saved_scene(driver);
  const std::size_t told = driver.told();
  driver.click("film");
  driver.click("film.make");
  const json film = driver.wait_for("film", told);
  CHECK(film["code"] == 0);
  driver.click("film");
  driver.click("film.command");
  const std::string line = driver.wait_for("command", told)["line"];
  REQUIRE(driver.shell().run(line + " --quiet").code == 0);
  const auto pictures = [&](const std::string& file) {
    return driver.shell().run("ffmpeg -v error -i " + file + " -f md5 - </dev/null").out;
  };
  const std::string mine = pictures(film["file"]);
  CHECK(mine.starts_with("MD5="));
  CHECK(mine == pictures(line.substr(line.rfind(' ') + 1)));
}

TEST_CASE("Window: it closes while it films, and the film plays as far as it got") {
  const GuiDriver driver("--set view.speed=0.5 --set particles.count=20", "1280x1840");
  driver.wait_for("status", 0, [](const json& status) { return status["time"] > 4.0; });
  driver.click("film");
  driver.click("film.make");
  std::this_thread::sleep_for(std::chrono::seconds(2));
  driver.key("ctrl+q");
  driver.wait_for("quit");
  // The window is found by its name while it is visible.
  CHECK(driver.run("xdotool search --onlyvisible --name 'Vibrated box'").code != 0);
  CHECK(driver.exit_code() == 0);
  CHECK(driver.shell().run("ffmpeg -v error -i clatter-1.mp4 -f null - </dev/null").code == 0);
}

TEST_SUITE_END();

}  // namespace clatter
