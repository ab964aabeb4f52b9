// Changes of the window that no file has.

#include <doctest/doctest.h>

#include "tests/window/gui_driver.h"

namespace clatter {

using nlohmann::json;

TEST_SUITE_BEGIN("display");

namespace {

// A scene that is not of the gallery.
constexpr const char* kOwn = "vibrated --set particles.restitution=0.85";

bool answered(const GuiDriver& driver, std::size_t told) {
  return driver.wait_for("answer", told)["acts"];
}

bool has(const GuiDriver& driver, const std::string& event) {
  return !driver.events(event).empty();
}

}  // namespace

TEST_CASE("Window: it asks before it closes with changes, and Cancel keeps it open") {
  const GuiDriver driver(kOwn);
  driver.drag("particles.restitution", 0.83, 0.5);
  std::size_t told = driver.told();
  driver.key("ctrl+q");
  driver.click("unsaved.cancel");
  CHECK(!answered(driver, told));
  told = driver.told();
  driver.key("ctrl+q");
  driver.key("r");  // no shortcut meanwhile
  driver.key("Escape");
  CHECK(!answered(driver, told));
  CHECK(!has(driver, "reset"));
  // The gas moves on.
  told = driver.told();
  const double now = driver.wait_for("status", told)["time"];
  driver.wait_for("status", told, [&](const json& status) { return status["time"] > now; });
  driver.key("ctrl+q");
  driver.click("unsaved.discard");
  driver.wait_for("quit");
  CHECK(driver.exit_code() == 0);
  CHECK(!has(driver, "saved"));
}

TEST_CASE("Window: Save writes the changes before it closes") {
  const GuiDriver driver(kOwn);
  driver.drag("particles.restitution", 0.83, 0.5);
  driver.key("ctrl+q");
  driver.key("s");
  driver.wait_for("quit");
  CHECK(driver.exit_code() == 0);
  CHECK(says(driver.shell().read(driver.wait_for("saved")["file"]), "[[change]]"));
}

TEST_CASE("Window: with saved changes, and another picture, it closes at once") {
  const GuiDriver driver(kOwn);
  driver.drag("particles.restitution", 0.83, 0.5);
  const std::size_t told = driver.told();
  driver.key("ctrl+s");
  driver.wait_for("saved", told);
  driver.click("view.grid");  // of the picture, not of the gas
  driver.key("ctrl+q");
  driver.wait_for("quit");
  CHECK(driver.exit_code() == 0);
}

TEST_CASE("Window: it asks before another scene takes the place of a changed one") {
  const GuiDriver driver(kOwn);
  driver.drag("particles.restitution", 0.83, 0.5);
  std::size_t told = driver.told();
  driver.key("bracketright");
  driver.click("unsaved.cancel");
  CHECK(!answered(driver, told));
  CHECK(driver.events("open").size() == 1);
  driver.key("bracketright");
  driver.click("unsaved.save");
  driver.wait_for("open", told);
  CHECK(has(driver, "saved"));
  // Live changes of a gallery scene are an experiment.
  driver.drag("particles.restitution", 0.88, 0.5);
  told = driver.told();
  driver.key("bracketleft");
  driver.wait_for("open", told);
  // Changes that are given up come back with undo.
  driver.drag("particles.count", 0.6, 0.5);
  told = driver.told();
  driver.key("bracketright");
  driver.click("unsaved.discard");
  driver.wait_for("open", told);
  told = driver.told();
  driver.key("ctrl+z");
  driver.wait_for("open", told);
  driver.key("ctrl+q");
  driver.click("unsaved.discard");
  driver.wait_for("quit");
}

TEST_CASE("Window: the scene is restored as it was opened, and undo returns to the changes") {
  const GuiDriver driver("--set particles.restitution=0.85", "1280x1840");
  driver.drag("particles.restitution", 0.83, 0.5);
  const auto has = [](double low, double high) {
    return [=](const json& status) {
      return status["restitution"] >= low && status["restitution"] <= high;
    };
  };
  driver.wait_for("status", 0, has(0.45, 0.55));
  std::size_t told = driver.told();
  driver.click("restore");
  CHECK(driver.wait_for("status", told, has(0.85, 0.85))["changes"] == 0);
  told = driver.told();
  driver.key("ctrl+z");
  driver.wait_for("status", told, has(0.45, 0.55));
  driver.key("ctrl+y");
  driver.key("ctrl+q");
  driver.wait_for("quit");
}

TEST_SUITE_END();

}  // namespace clatter
