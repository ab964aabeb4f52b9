// The gallery of the window, by mouse and keys on a virtual display.

#include <doctest/doctest.h>

#include <cmath>
#include <sstream>

#include "tests/window/gui_driver.h"

namespace clatter {

using nlohmann::json;

TEST_SUITE_BEGIN("display");

TEST_CASE("Window: a scene of the gallery is found by its name") {
  const GuiDriver driver("");
  // Scene files with the names of gallery scenes, and files of other content.
  driver.shell().run("echo none | tee cooling cradle rough_cooling equilibrium");
  std::size_t told = driver.told();
  driver.key("g");
  driver.wait_for("gallery", told);
  // Letters are no shortcuts there, because names are typed.
  driver.key("r");
  driver.key("slash");
  driver.tool("type --delay 100 cradle");
  driver.tool("sleep 0.3");
  driver.key("Return");
  CHECK(driver.wait_for("open", told)["title"] == "Newton's cradle");
  CHECK(driver.wait_for("status", told, [](const json& status) {
    return status["run"] == 2;
  })["temperature"] > 0.0);
  told = driver.told();
  driver.key("g");
  driver.wait_for("gallery", told);
  driver.click("gallery.cooling");
  CHECK(driver.wait_for("open", told)["title"] == "Haff's cooling");
}

TEST_CASE("Window: arrows and Enter choose a scene of the gallery") {
  const GuiDriver driver("");
  std::size_t told = driver.told();
  driver.key("g");
  driver.wait_for("gallery", told);
  // Pictures are slow while thumbnails are made, and the window sees a key only in a picture.
  for (const std::string key : {"Down", "Down", "Down", "Up"}) {
    driver.tool("keydown " + key + " sleep 0.2 keyup " + key + " sleep 0.2");
  }
  driver.key("Return");
  const json third = driver.wait_for("open", told);
  // Without the keys of the list, the third scene of it.
  std::istringstream list(driver.shell().run("clatter scenes | sed -n 3p").out);
  std::string name;
  list >> name;
  driver.shell().run("clatter check " + name + " >checked");
  CHECK(says(driver.shell().read("checked"), third["title"].get<std::string>()));

  // With a search that finds no scene, Enter opens none.
  told = driver.told();
  driver.key("g");
  driver.wait_for("gallery", told);
  driver.key("slash");
  driver.tool("type --delay 100 zzz");
  driver.place("gallery.none", told);
  driver.key("Return");
  CHECK(driver.events("open").size() == 2);
}

TEST_CASE("Window: the pictures of the gallery are upright") {
  const GuiDriver driver("");
  driver.key("g");
  const std::vector<double> card = driver.place("gallery.barometer");
  // The mean brightness of a part of its picture, below the upper edge by this share of its height.
  const auto brightness = [&](double down) {
    const auto pixels = [](double length) { return std::to_string(std::lround(length)); };
    const Outcome outcome = driver.run(
        "ffmpeg -v error -f x11grab -draw_mouse 0 -video_size " + pixels(0.4 * card[3]) + 'x' +
        pixels(0.2 * card[3]) + " -i $DISPLAY+" + pixels(card[0] + 0.4 * card[3]) + ',' +
        pixels(card[1] + down * card[3]) +
        " -frames:v 1 -vf scale=1:1:flags=area -pix_fmt gray -f rawvideo - </dev/null | od -An "
        "-tu1");
    return std::stoi(outcome.out);
  };
  // The first looks may be earlier than the picture.
  int looks_in_a_row = 0;
  for (int look = 0; look < 40 && looks_in_a_row < 5; ++look) {
    const bool dense_below = brightness(0.65) > brightness(0.15) + 10;
    looks_in_a_row = dense_below ? looks_in_a_row + 1 : 0;
  }
  CHECK(looks_in_a_row == 5);
}

TEST_SUITE_END();

}  // namespace clatter
