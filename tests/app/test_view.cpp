// The window, controlled by mouse and keys on a virtual display.

#include <doctest/doctest.h>
#include <fmt/format.h>

#include <algorithm>
#include <chrono>
#include <cmath>
#include <map>
#include <regex>
#include <sstream>
#include <thread>

#include "tests/app/gui_driver.h"

namespace clatter {

using nlohmann::json;

namespace {

// The hash of a run without a window at the time of a status.
json hash_of_run(const GuiDriver& driver, const std::string& scene, const json& status) {
  char line[256];
  std::snprintf(line, sizeof line,
                "clatter measure %s --quiet --set measure.burn_in=0 --until %.17g", scene.c_str(),
                status["time"].get<double>());
  const Outcome outcome = driver.shell().run(line);
  CAPTURE(outcome.err);
  REQUIRE(outcome.code == 0);
  return json::parse(outcome.out)["state_hash"];
}

// Saves the scene of a halted gas. A run of it must give the same bits.
void check_saved_scene(const GuiDriver& driver) {
  const std::size_t told = driver.told();
  driver.key("ctrl+s");
  const std::string scene = driver.wait_for("saved", told)["file"];
  const json now = driver.wait_for("status", 0, halted);
  CHECK(hash_of_run(driver, scene, now) == now["hash"]);
}

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

// Whether the upper left corner of the viewport gets a colour. The log is ahead of the screen by a
// picture.
bool corner_becomes(const GuiDriver& driver, const std::vector<int>& colour) {
  for (int look = 0; look < 50; ++look) {
    const std::vector<double> place = driver.place("viewport");
    if (driver.pixel(static_cast<int>(place[0]) + 3, static_cast<int>(place[1]) + 3) == colour)
      return true;
  }
  return false;
}

}  // namespace

TEST_SUITE_BEGIN("window");

TEST_CASE("Window: a gas plays, halts, steps to a frame and to a collision, plays on") {
  const GuiDriver driver("");
  const double began = driver.wait_for("status")["time"];
  std::size_t told = driver.told();
  CHECK(driver.wait_for("status", told)["time"].get<double>() > began);

  driver.click("play");
  driver.wait_for("pause", told);
  const json still = driver.wait_for("status", told, halted);
  told = driver.told();
  driver.key("period");
  const json frame = driver.wait_for("status", told, halted);
  CHECK(frame["time"].get<double>() ==
        doctest::Approx(still["time"].get<double>() + 2.0 / 60.0).epsilon(1e-9));

  told = driver.told();
  driver.key("shift+period");
  const json hit = driver.wait_for("status", told,
                                   [](const json& status) { return status.contains("partners"); });
  CHECK(hit["collisions"].get<int>() == frame["collisions"].get<int>() + 1);

  // The same run without a window has the same hash.
  CHECK(hash_of_run(driver, "vibrated", hit) == hit["hash"]);

  told = driver.told();
  driver.key("space");
  driver.wait_for("status", told, [](const json& status) { return status["plays"]; });
}

TEST_CASE("Window: dragging the restitution cools the gas, undo takes it back") {
  const GuiDriver driver("--set view.speed=20");
  const double hot = driver.wait_for(
      "status", 0, [](const json& status) { return status["time"] > 40.0; })["temperature"];
  driver.drag("particles.restitution", 0.88, 0.5);
  const std::size_t told = driver.told();
  const json cold = driver.wait_for(
      "status", told, [&](const json& status) { return status["temperature"] < 0.4 * hot; });
  CHECK(cold["restitution"].get<double>() == doctest::Approx(0.5).epsilon(0.05));
  // A busy engine skips laws that later ones replace, so its changes can be fewer.
  CHECK(driver.events("set").size() > 2);
  CHECK(cold["changes"] >= 1);
  driver.key("ctrl+z");
  driver.wait_for("undo", told);
  driver.wait_for("status", told, [](const json& status) { return status["restitution"] == 0.9; });
}

// Grains at rest on a floor with a small stroke. With a long stroke the floor would overlap them.
TEST_CASE("Window: a refused change stays neither in the panels nor in the saved scene") {
  const GuiDriver driver(
      "shaker --set walls.bottom.stroke=0.1 --set view.speed=20 --set collapse.contact_time=1e-3 "
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

TEST_CASE("Window: a scene of the gallery is found by its name") {
  const GuiDriver driver("");
  // Scene files with the names of gallery scenes, and files of other content.
  driver.shell().run("echo none | tee cooling cradle rough_cooling equilibrium");
  std::size_t told = driver.told();
  driver.key("g");
  driver.wait_for("gallery", told);
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

TEST_CASE("Window: a screenshot equals the screen, and its scene plays it again") {
  const GuiDriver driver("");
  driver.wait_for("status", 0, [](const json& status) { return status["time"] > 2.0; });
  driver.drag("walls.left.drive_speed", 0.3, 0.8);
  driver.key("space");
  std::size_t told = driver.told();
  // Also the files that a scene of this name would write.
  driver.shell().run("touch clatter-1.csv clatter-2.mp4");
  driver.key("F2");
  const std::string file = driver.wait_for("screenshot", told)["file"];
  CHECK(file == "clatter-3.png");
  CHECK(driver.shell().read(file).starts_with("\x89PNG"));
  // Background above the left wall, wall colour on the wall.
  CHECK(corner_becomes(driver, {0x10, 0x14, 0x18}));

  check_saved_scene(driver);
}

TEST_CASE("Window: a gas with some disks removed plays on, and can be saved") {
  const GuiDriver driver("");
  driver.wait_for("status", 0, [](const json& status) { return status["time"] > 3.0; });
  std::size_t told = driver.told();
  driver.drag("particles.count", 0.8, 0.6);
  driver.wait_for("refit", told);
  const json again = driver.wait_for("status", told, [](const json& status) {
    return status["run"] == 2 && status["time"] > 0.5;
  });
  CHECK(again["particles"] < 150);
  driver.drag("particles.restitution", 0.88, 0.8);
  driver.key("space");
  check_saved_scene(driver);
}

TEST_CASE("Window: a wall that is dragged makes another box for the same disks") {
  const GuiDriver driver("--set walls.bottom.kind=static --set walls.top.kind=static");
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
    driver.pull(wall, right, down);
    const json wider = driver.wait_for("status", told, opened);
    CHECK(wider["particles"] == before["particles"]);
    const double grown = wider["box"][axis].get<double>() - before["box"][axis].get<double>();
    CHECK(grown > 1.0);
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

TEST_CASE("Window: a click on a wall changes nothing, and a dragged wall moves with the mouse") {
  const GuiDriver driver("");
  const std::vector<double> left = driver.place("wall.left");
  const double pixels = left[3] / 25.0;  // per diameter
  driver.click("wall.right");
  driver.click("wall.left");
  driver.pull("wall.right", 30, 0);
  const json wider = driver.wait_for("status", 0, [](const json& status) {
    return status["run"] > 1 && status["box"][0] != 20.0;
  });
  CHECK(wider["run"] == 2);
  CHECK(std::fabs(wider["box"][0].get<double>() - 20.0 - 30.0 / pixels) <= 0.051);
}

TEST_CASE("Window: G opens and closes the gallery, and the list of keys takes its place") {
  const GuiDriver driver("");
  const auto open = [](bool is) { return [=](const json& event) { return event["open"] == is; }; };
  std::size_t told = driver.told();
  driver.key("g");
  driver.wait_for("gallery", told, open(true));
  // Letters are no shortcuts there, because names are typed.
  driver.key("r");
  told = driver.told();
  driver.key("g");
  driver.wait_for("gallery", told, open(false));
  CHECK(driver.wait_for("status")["run"] == 1);
  told = driver.told();
  driver.key("g");
  driver.wait_for("gallery", told, open(true));
  told = driver.told();
  driver.key("F1");
  driver.wait_for("gallery", told, open(false));
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

TEST_CASE("Window: it is no larger than the screen") {
  const GuiDriver driver("", "1280x800", "1200x720");
  const json place = driver.wait_for("widget", 0, [](const json& event) {
    return event["name"] == "close_lesson" && event["place"][1] < 720.0;
  })["place"];
  CHECK(place[0].get<double>() + place[2].get<double>() <= 1200.0);
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
  for (int i = 0; i < 3; ++i) driver.key("BackSpace");
  driver.tool("type --delay 100 cradle");
  driver.key("Return");
  CHECK(driver.wait_for("open", told)["title"] == "Newton's cradle");
  CHECK(driver.events("open").size() == 3);
}

TEST_CASE("Window: the gallery has the order of the list of scenes") {
  const GuiDriver driver("");
  const std::size_t told = driver.told();
  driver.key("g");
  driver.wait_for("gallery", told);
  std::map<std::string, double> tops;
  std::this_thread::sleep_for(std::chrono::seconds(1));
  for (const json& event : driver.events("widget")) {
    const std::string name = event["name"];
    if (name.starts_with("gallery.")) tops[name.substr(8)] = event["place"][1];
  }
  CHECK(tops.size() > 3);
  std::istringstream list(driver.shell().run("clatter scenes").out);
  double above = 0.0;
  for (std::string line; std::getline(list, line);) {
    const auto card = tops.find(line.substr(0, line.find(' ')));
    if (card == tops.end()) continue;  // out of sight
    CHECK(card->second > above);
    above = card->second;
  }
}

TEST_CASE("Window: the plots list the observables of the scene, of disks and of spheres") {
  for (const char* scene : {"vibrated", "spheres_vibrated"}) {
    const GuiDriver driver(std::string(scene) +
                           " --set view.speed=10 --set "
                           "'measure.observables=[\"probe\",\"collisions\"]'");
    driver.key("p");
    CHECK(driver.wait_for("observable")["table"] == "probe, series");
    for (const char* table : {"collisions, normal speed", "probe, series"}) {
      CAPTURE(table);
      driver.click("plots.observable");
      const std::size_t told = driver.told();
      driver.click(std::string("plots.observable.") + table);
      CHECK(driver.wait_for("observable", told)["table"] == table);
    }
    CHECK(driver.wait_for("status")["run"] == 1);
  }
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

TEST_CASE("Window: the lesson closes, and lecture mode has the colours for a projector") {
  const GuiDriver driver("", "1280x1500");
  const auto height = [&](std::size_t told) { return driver.place("viewport", told)[3]; };
  const double before = height(0);
  std::size_t told = driver.told();
  driver.click("close_lesson");
  CHECK(height(told) > before + 20.0);
  // A change of the view, to be undone in lecture mode.
  driver.click("view.grid");
  told = driver.told();
  driver.key("l");
  height(told);
  CHECK(corner_becomes(driver, {255, 255, 255}));
  driver.key("ctrl+z");
  driver.wait_for("undo", told);
  CHECK(corner_becomes(driver, {255, 255, 255}));
  // Panels and plots on request, and without them again.
  told = driver.told();
  driver.key("Tab");
  const std::vector<double> beside = driver.place("viewport", told);
  CHECK(beside[0] > 100.0);
  told = driver.told();
  driver.key("p");
  CHECK(driver.place("viewport", told)[2] < beside[2] - 100.0);
  // The plot of lecture mode on request, and the sliders below the gas without it.
  told = driver.told();
  driver.key("Tab");
  CHECK(driver.place("viewport", told)[2] < 1180.0);
  told = driver.told();
  driver.key("p");
  CHECK(driver.place("viewport", told)[2] == 1280.0);
  driver.key("p");
  told = driver.told();
  driver.key("Escape");
  height(told);
  CHECK(corner_becomes(driver, {0x10, 0x14, 0x18}));
}

TEST_CASE("Window: a narrow one has one sheet at a time below the gas") {
  const GuiDriver driver("", "480x800");
  const auto viewport = [&](std::size_t told) { return driver.place("viewport", told); };
  const std::vector<double> whole = viewport(0);
  CHECK(whole[2] == 480.0);
  std::size_t told = driver.told();
  driver.click("sheet.gas");
  const std::vector<double> half = viewport(told);
  CHECK(half[2] == 480.0);
  CHECK(half[3] < 0.6 * whole[3]);
  told = driver.told();
  driver.click("rough");
  driver.wait_for("set", told);
  told = driver.told();
  driver.click("sheet.close");
  CHECK(viewport(told) == whole);
  told = driver.told();
  driver.key("p");
  CHECK(viewport(told) == half);
  told = driver.told();
  driver.key("Escape");
  CHECK(viewport(told) == whole);
}

TEST_CASE("Window: trails appear with their slider, vanish with undo, and are saved") {
  // Few disks on a dark background: most of the light comes from trails, some diameters long.
  const GuiDriver driver(
      "equilibrium --set particles.area_fraction=0.03 --set view.overlay=false --set view.speed=5",
      "1280x1500");
  const json before = driver.wait_for("status");
  CHECK(before["flights"] == 0);
  std::size_t told = driver.told();
  driver.drag("view.trails", 0.02, 0.9);
  const json begun =
      driver.wait_for("status", told, [](const json& status) { return status["flights"] > 0; });
  const json with = driver.wait_for("status", told, [&](const json& status) {
    return status["time"].get<double>() > begun["time"].get<double>() + 5.0;
  });
  // Only the picture changes.
  CHECK(with["run"] == before["run"]);
  CHECK(with["changes"] == 0);
  driver.key("space");
  driver.wait_for("status", told, halted);
  const double bright = driver.brightness("viewport");
  // A drag is one undo step.
  told = driver.told();
  driver.key("ctrl+z");
  driver.wait_for("status", told, [](const json& status) { return status["flights"] == 0; });
  const double dark = driver.brightness("viewport");
  MESSAGE("brightness " << bright << " with trails, " << dark << " without");
  CHECK(dark < 0.8 * bright);
  driver.key("ctrl+y");
  told = driver.told();
  driver.key("ctrl+s");
  const std::string scene = driver.shell().read(driver.wait_for("saved", told)["file"]);
  CHECK(says(scene, "trails = "));
}

TEST_CASE("Window: the effect of a contact time is shown, and fields may come from snapshots") {
  const GuiDriver driver("--set view.speed=10", "1280x1500");
  std::size_t told = driver.told();
  driver.click("contact_time");
  const json few = driver.wait_for(
      "status", told, [](const json& status) { return status.contains("elasticised"); });
  CHECK(few["elasticised"] < 0.01);
  told = driver.told();
  driver.drag("collapse.contact_time", 0.5, 1.0);
  driver.wait_for("status", told, [](const json& status) {
    return status.contains("elasticised") && status["elasticised"] > 0.05;
  });
  driver.click("view.estimator");
  driver.click("view.estimator.snapshot  x1.1");
  told = driver.told();
  driver.key("ctrl+s");
  const std::string scene = driver.shell().read(driver.wait_for("saved", told)["file"]);
  CHECK(says(scene, "estimator = \"snapshot\"\ninterval = 0.1"));
}

TEST_CASE("Window: its film of a changed gas equals the film of the command that it shows") {
  const GuiDriver driver("--set view.speed=4", "1280x1700");
  driver.drag("particles.restitution", 0.88, 0.7);
  driver.drag("walls.left.drive_speed", 0.2, 0.4);
  driver.drag("walls.right.restitution", 0.9, 0.8);
  driver.key("space");
  // A short film with few pictures.
  for (int i = 0; i < 6; ++i) driver.key("plus");
  check_saved_scene(driver);
  const std::size_t told = driver.told();
  driver.click("film");
  const json film = driver.wait_for("film", told);
  CHECK(film["code"] == 0);
  driver.click("command");
  const std::string line = driver.wait_for("command", told)["line"];
  REQUIRE(driver.shell().run(line + " --quiet").code == 0);
  const auto pictures = [&](const std::string& file) {
    return driver.shell().run("ffmpeg -v error -i " + file + " -f md5 - </dev/null").out;
  };
  const std::string mine = pictures(film["file"]);
  CHECK(mine.starts_with("MD5="));
  CHECK(mine == pictures(line.substr(line.rfind(' ') + 1)));
}

TEST_CASE("Window: it halts at the time of --until") {
  const GuiDriver driver("--until 1.5");
  const json there = driver.wait_for("status", 0, halted);
  CHECK(there["time"] == 1.5);
  CHECK(hash_of_run(driver, "vibrated", there) == there["hash"]);
}

TEST_CASE("Window: if OpenGL is too old, it names an alternative") {
  const GuiDriver driver("");
  const Outcome old = driver.run("MESA_GL_VERSION_OVERRIDE=2.1 clatter view");
  CHECK(old.code == 1);
  CHECK(says(old.err, "OpenGL 3.3"));
  CHECK(says(old.err, "clatter render"));
  const Outcome off_screen = driver.run("clatter view --backend osmesa");
  CHECK(off_screen.code == 2);
  CHECK(says(off_screen.err, "clatter render"));
}

TEST_CASE("Window: if its OpenGL context is lost, it names an alternative") {
  const GuiDriver driver("");
  // The sanitizers require the first position in the preload order.
  const Outcome lost = driver.run("ASAN_OPTIONS=verify_asan_link_order=0 LD_PRELOAD=" +
                                  std::string(CLATTER_LOST_CONTEXT) + " clatter view");
  CHECK(lost.code == 1);
  CHECK(says(lost.err, "context is lost"));
  CHECK(says(lost.err, "clatter render"));
}

TEST_CASE("Window: it closes while it films, and the film plays as far as it got") {
  const GuiDriver driver("--set view.speed=0.5 --set particles.count=20", "1280x1700");
  driver.wait_for("status", 0, [](const json& status) { return status["time"] > 4.0; });
  driver.click("film");
  std::this_thread::sleep_for(std::chrono::seconds(2));
  driver.key("ctrl+q");
  driver.wait_for("quit");
  // The window is found by its name while it is visible.
  CHECK(driver.run("xdotool search --onlyvisible --name 'Vibrated box'").code != 0);
  CHECK(driver.exit_code() == 0);
  CHECK(driver.shell().run("ffmpeg -v error -i clatter-1.mp4 -f null - </dev/null").code == 0);
}

TEST_CASE("Window: the table of bench window has the cost of its pictures") {
  const GuiDriver driver("--set particles.count=1");
  const Outcome outcome = driver.run("clatter bench window --count 100 --json times");
  CAPTURE(outcome.err);
  REQUIRE(outcome.code == 0);
  const json row = json::parse(driver.shell().read("times"));
  CHECK(row["count"] == 100);
  CHECK(outcome.err.starts_with("window of 1280x720, "));
  const std::string printed = std::regex_replace(outcome.out, std::regex("[ \n]+"), " ");
  CHECK(printed == fmt::format(" N median ms 99 % ms 100 {:.2f} {:.2f} ",
                               row["median_milliseconds"].get<double>(),
                               row["percentile_99_milliseconds"].get<double>()));
  CHECK(row["median_milliseconds"] > 0.0);
  CHECK(row["percentile_99_milliseconds"] >= row["median_milliseconds"]);
}

TEST_CASE("Window: it quits amid a collapse") {
  const GuiDriver driver("collapse");
  driver.key("ctrl+q");
  driver.wait_for("quit");
  CHECK(driver.exit_code() == 0);
}

TEST_CASE("Window: without a display, it names an alternative") {
  const Shell shell;
  for (const char* line : {"DISPLAY= clatter view vibrated", "DISPLAY= clatter"}) {
    const Outcome outcome = shell.run(line);
    CHECK(outcome.code == 1);
    CHECK(says(outcome.err, "clatter render"));
  }
}

TEST_CASE("Window: the timeline goes back to any time, to the bit, and to the head again") {
  const GuiDriver driver("--set view.speed=20");
  driver.wait_for("status", 0, [](const json& status) { return status["time"] > 30.0; });
  std::size_t told = driver.told();
  driver.key("space");
  const json head = driver.wait_for("status", told, halted);
  told = driver.told();
  driver.point_at("timeline", 0.4);
  driver.tool("mousedown 1");
  const json jump = driver.wait_for("jump", told);
  driver.tool("mouseup 1");
  const json past = driver.wait_for("status", told, halted);
  CHECK(past["time"] == jump["to"]);
  CHECK(past["time"].get<double>() / head["time"].get<double>() ==
        doctest::Approx(0.4).epsilon(0.02));
  CHECK(past["head"].get<double>() == doctest::Approx(head["time"].get<double>()));
  CHECK(hash_of_run(driver, "vibrated", past) == past["hash"]);

  told = driver.told();
  driver.key("End");
  CHECK(driver.wait_for("status", told, halted)["hash"] == head["hash"]);
  told = driver.told();
  driver.key("Left");
  const json second = driver.wait_for("status", told, halted);
  CHECK(second["time"].get<double>() == doctest::Approx(head["time"].get<double>() - 20.0));
  CHECK(hash_of_run(driver, "vibrated", second) == second["hash"]);
  told = driver.told();
  driver.key("comma");
  CHECK(driver.wait_for("status", told, halted)["time"].get<double>() ==
        doctest::Approx(second["time"].get<double>() - 20.0 / 60.0));
  told = driver.told();
  driver.key("Home");
  CHECK(driver.wait_for("status", told, halted)["time"] == 0.0);
  told = driver.told();
  driver.click("head");
  CHECK(driver.wait_for("status", told, halted)["hash"] == head["hash"]);
}

TEST_CASE("Window: a moving gas plays on after a drag of the timeline") {
  const GuiDriver driver("--set view.speed=20");
  driver.wait_for("status", 0, [](const json& status) { return status["time"] > 20.0; });
  const std::size_t told = driver.told();
  driver.drag("timeline", 0.8, 0.2);
  driver.wait_for("jump", told);
  const json past = driver.wait_for("status", told, [](const json& status) {
    return status["plays"] && status["time"] < 0.6 * status["head"].get<double>();
  });
  driver.wait_for("status", told, [&](const json& status) {
    return status["plays"] && status["time"] > past["head"];
  });
}

TEST_CASE("Window: the gas plays backwards, halts to the bit, and plays forwards again") {
  const GuiDriver driver("--set view.speed=20");
  driver.wait_for("status", 0, [](const json& status) { return status["time"] > 100.0; });
  std::size_t told = driver.told();
  driver.key("b");
  const json back =
      driver.wait_for("status", told, [](const json& status) { return status["backwards"]; });
  driver.wait_for("status", told, [&](const json& status) {
    return status["backwards"] && status["time"] < back["head"].get<double>() - 10.0;
  });
  told = driver.told();
  driver.click("back");
  const json still = driver.wait_for("status", told, halted);
  CHECK(still["time"] < still["head"]);
  CHECK(hash_of_run(driver, "vibrated", still) == still["hash"]);
  told = driver.told();
  driver.key("b");
  const json start = driver.wait_for(
      "status", told, [](const json& status) { return halted(status) && status["time"] == 0.0; });
  CHECK(start["head"] == still["head"]);
  told = driver.told();
  driver.key("space");
  driver.wait_for("status", told, [](const json& status) {
    return status["plays"] && !status["backwards"] && status["time"] > 0.0;
  });
}

TEST_CASE("Window: a drag with Shift on the timeline repeats a stretch, a click ends that") {
  const GuiDriver driver("--set view.speed=20");
  driver.wait_for("status", 0, [](const json& status) { return status["time"] > 20.0; });
  std::size_t told = driver.told();
  driver.key("space");
  driver.wait_for("status", told, halted);
  told = driver.told();
  driver.tool("keydown shift");
  driver.drag("timeline", 0.2, 0.5);
  driver.tool("keyup shift");
  const json stretch = driver.wait_for("repeat", told);
  const auto turns = [&] {
    double before = 0.0;
    int count = 0;
    for (const json& status : driver.events("status")) {
      const double time = status["time"];
      if (status.contains("loop") && status["plays"]) count += time < before ? 1 : 0;
      before = time;
    }
    return count;
  };
  driver.wait_for("status", told, [&](const json&) { return turns() >= 3; });
  const json status = driver.wait_for("status", told);
  CHECK(status["time"] < stretch["to"]);
  CHECK(status["head"] > stretch["to"]);
  told = driver.told();
  driver.tool("keydown shift");
  driver.click("timeline");
  driver.tool("keyup shift");
  driver.wait_for("status", told, [&](const json& status) {
    return !status.contains("loop") && status["time"] > stretch["to"];
  });
}

TEST_CASE("Window: the mark of a change is dragged to another time, undo takes it back") {
  const GuiDriver driver("--set view.speed=20");
  driver.wait_for("status", 0, [](const json& status) { return status["time"] > 10.0; });
  driver.drag("particles.restitution", 0.88, 0.5);
  driver.wait_for("status", driver.told(),
                  [](const json& status) { return status["time"] > 40.0; });
  std::size_t told = driver.told();
  driver.key("space");
  const json head = driver.wait_for("status", told, halted);
  told = driver.told();
  driver.pull("timeline.change.0", -60, 0);
  const json move = driver.wait_for("move_change", told);
  CHECK(move["number"] == 0);
  const json now = driver.wait_for("status", told, halted);
  CHECK(now["time"].get<double>() == doctest::Approx(move["to"].get<double>()));
  CHECK(now["head"] == now["time"]);
  CHECK(now["changes"] == head["changes"]);
  told = driver.told();
  driver.key("period");
  driver.wait_for("status", told, halted);
  check_saved_scene(driver);
  told = driver.told();
  driver.key("ctrl+z");
  driver.wait_for("status", told,
                  [&](const json& status) { return status["head"] == head["time"]; });
  told = driver.told();
  driver.key("End");
  CHECK(driver.wait_for("status", told, [&](const json& status) {
    return halted(status) && status["time"] == head["time"];
  })["hash"] == head["hash"]);
}

TEST_CASE("Window: steps back pass the collisions of the steps forth") {
  const GuiDriver driver("");
  driver.wait_for("status", 0, [](const json& status) { return status["time"] > 1.0; });
  const auto step = [&](const char* key) {
    const std::size_t told = driver.told();
    driver.key(key);
    return driver.wait_for("status", told,
                           [](const json& status) { return status.contains("partners"); });
  };
  const json first = step("shift+period");
  const json second = step("shift+period");
  CHECK(second["collisions"].get<int>() == first["collisions"].get<int>() + 1);
  const json back = step("shift+comma");
  CHECK(back["hash"] == first["hash"]);
  CHECK(back["partners"] == first["partners"]);
  const std::size_t told = driver.told();
  driver.click("collision_back");
  CHECK(driver.wait_for("status", told, halted)["collisions"].get<int>() ==
        first["collisions"].get<int>() - 1);
}

TEST_CASE("Window: a change in the past begins another future, undo returns to the old one") {
  const GuiDriver driver("--set view.speed=20");
  driver.wait_for("status", 0, [](const json& status) { return status["time"] > 20.0; });
  std::size_t told = driver.told();
  driver.key("space");
  const json head = driver.wait_for("status", told, halted);
  told = driver.told();
  driver.click("timeline");
  driver.wait_for("jump", told);
  told = driver.told();
  driver.drag("particles.restitution", 0.88, 0.5);
  const auto forked = [](const json& status) {
    return halted(status) && status.contains("other_future");
  };
  json now = driver.wait_for("status", told, forked);
  CHECK(now["changes"] == 1);
  CHECK(now["head"] < head["head"]);
  CHECK(now["other_future"][1].get<double>() == doctest::Approx(head["time"].get<double>()));
  told = driver.told();
  driver.key("period");
  driver.wait_for("status", told, forked);
  check_saved_scene(driver);

  const auto at_old_head = [&](const json& status) {
    return halted(status) && status["head"] == head["time"];
  };
  told = driver.told();
  driver.key("ctrl+z");
  CHECK(driver.wait_for("status", told, at_old_head)["changes"] == 0);
  driver.key("End");
  CHECK(driver.wait_for("status", told, [&](const json& status) {
    return halted(status) && status["time"] == head["time"];
  })["hash"] == head["hash"]);
  told = driver.told();
  driver.key("ctrl+y");
  now = driver.wait_for("status", told, forked);
  CHECK(now["changes"] == 1);
  told = driver.told();
  driver.click("timeline.other_future");
  CHECK(driver.wait_for("status", told, at_old_head)["changes"] == 0);
  driver.key("ctrl+z");
  driver.wait_for("status", told, [](const json& status) { return status["changes"] == 1; });
}

TEST_SUITE_END();

}  // namespace clatter
