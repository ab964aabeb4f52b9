// Gases that are compared in the window, by mouse and keys on a virtual display.

#include <doctest/doctest.h>

#include <set>

#include "tests/window/gui_driver.h"

namespace clatter {

using nlohmann::json;

namespace {

// Whether all of so many gases are halted, at the same time.
bool halts_in_step(const json& status, std::size_t gases) {
  if (!halted(status) || status.value("beside", json::array()).size() + 1 != gases) return false;
  for (const json& beside : status["beside"]) {
    CHECK(beside["time"].get<double>() ==
          doctest::Approx(status["time"].get<double>()).epsilon(1e-15));
    CHECK(beside.contains("hash"));
  }
  return true;
}

// The status of the gas with this number in that of the selected one.
json status_of(const json& status, std::size_t gas) {
  if (status["gas"] == gas) return status;
  for (const json& beside : status["beside"]) {
    if (beside["gas"] == gas) return beside;
  }
  FAIL("no gas " << gas);
  return {};
}

}  // namespace

TEST_SUITE_BEGIN("display");

TEST_CASE("Compare window: a changed law of a copy changes the copy alone, and both are saved") {
  const GuiDriver driver("--set view.speed=5");
  driver.wait_for("status", 0, [](const json& status) { return status["time"] > 2.0; });
  std::size_t told = driver.told();
  driver.key("space");
  const json alone = driver.wait_for("status", told, halted);
  told = driver.told();
  driver.key("c");
  const auto two = [](const json& status) { return halts_in_step(status, 2); };
  const json copied = driver.wait_for("status", told, two);
  CHECK(copied["gas"] == 1);
  CHECK(copied["hash"] == alone["hash"]);
  CHECK(status_of(copied, 0)["hash"] == alone["hash"]);

  told = driver.told();
  driver.drag("particles.restitution", 0.9, 0.2);
  driver.wait_for("status", told, [](const json& status) { return status["restitution"] < 0.5; });
  driver.key("space");
  driver.wait_for("status", told, [&](const json& status) {
    return status["time"] > alone["time"].get<double>() + 5.0;
  });
  told = driver.told();
  driver.key("space");
  const json still = driver.wait_for("status", told, two);
  CHECK(status_of(still, 0)["restitution"] == alone["restitution"]);
  CHECK(status_of(still, 0)["changes"] == 0);
  CHECK(status_of(still, 1)["changes"].get<int>() > 0);
  CHECK(status_of(still, 0)["hash"] != status_of(still, 1)["hash"]);
  CHECK(hash_of_run(driver, "vibrated", still) == status_of(still, 0)["hash"]);

  told = driver.told();
  driver.key("ctrl+s");
  driver.wait_for("saved", told,
                  [](const json& saved) { return saved["file"] != "clatter-1.toml"; });
  CHECK(hash_of_run(driver, "clatter-1.toml", still) == status_of(still, 0)["hash"]);
  CHECK(hash_of_run(driver, "clatter-2.toml", still) == status_of(still, 1)["hash"]);
}

TEST_CASE("Compare window: a click or N selects a gas, and each has the state of a run alone") {
  const GuiDriver driver("--until 1 --compare particles.restitution=0.5");
  const auto gas = [](int number) {
    return [number](const json& status) {
      return halts_in_step(status, 2) && status["gas"] == number;
    };
  };
  const json first = driver.wait_for("status", 0, gas(0));
  CHECK(first["restitution"] == 0.9);
  CHECK(status_of(first, 1)["restitution"] == 0.5);
  CHECK(hash_of_run(driver, "vibrated", first) == first["hash"]);
  CHECK(hash_of_run(driver, "vibrated --set particles.restitution=0.5", first) ==
        status_of(first, 1)["hash"]);
  std::size_t told = driver.told();
  driver.click("cell.b");
  CHECK(driver.wait_for("status", told, gas(1))["restitution"] == 0.5);
  told = driver.told();
  driver.key("n");
  CHECK(driver.wait_for("status", told, gas(0))["restitution"] == 0.9);
}

TEST_CASE("Compare window: at most four gases; after a removal undo returns to the changed one") {
  const GuiDriver driver("--until 1");
  driver.wait_for("status", 0, halted);
  for (std::size_t gases = 2; gases <= 4; ++gases) {
    const std::size_t told = driver.told();
    driver.key("c");
    driver.wait_for("status", told,
                    [&](const json& status) { return halts_in_step(status, gases); });
  }
  std::size_t told = driver.told();
  driver.key("c");
  CHECK(says(driver.wait_for("message", told)["text"], "4 gases"));
  const std::vector<double> first = driver.place("cell.a"), last = driver.place("cell.d");
  CHECK(first[0] < last[0]);
  CHECK(first[1] < last[1]);

  // The third of four is made different, then the second is removed.
  driver.click("cell.c");
  told = driver.told();
  driver.drag("particles.restitution", 0.9, 0.2);
  driver.wait_for("status", told, [](const json& status) { return status["restitution"] < 0.5; });
  driver.click("cell.b");
  told = driver.told();
  driver.click("compare.remove");
  const json left =
      driver.wait_for("status", told, [](const json& status) { return halts_in_step(status, 3); });
  CHECK(left["gas"] == 0);
  CHECK(status_of(left, 0)["restitution"] == 0.9);
  CHECK(status_of(left, 1)["restitution"].get<double>() < 0.5);
  CHECK(status_of(left, 2)["restitution"] == 0.9);
  // The change belongs to the second gas now.
  told = driver.told();
  driver.key("ctrl+z");
  const json undone = driver.wait_for("status", told, [](const json& status) {
    return halts_in_step(status, 3) && status["gas"] == 1 && status["restitution"] == 0.9;
  });
  CHECK(status_of(undone, 0)["hash"] == undone["hash"]);
}

TEST_CASE("Compare window: a screenshot has all scenes, and the film command films them") {
  const GuiDriver driver("--until 1 --compare particles.restitution=0.5", "1280x1840");
  const json still =
      driver.wait_for("status", 0, [](const json& status) { return halts_in_step(status, 2); });
  std::size_t told = driver.told();
  driver.key("F2");
  driver.wait_for("screenshot", told);
  const std::string picture = driver.shell().read("clatter-1.png");
  CHECK(picture.find("Scene B") != std::string::npos);
  told = driver.told();
  driver.click("film");
  driver.click("film.command");
  const std::string line = driver.wait_for("command", told)["line"];
  CHECK(
      line ==
      "clatter render clatter-2.toml clatter-3.toml --seed 1 --to 1 --speed 2 --out clatter-2.mp4");
  const Outcome film = driver.shell().run(
      "clatter render clatter-2.toml clatter-3.toml --seed 1 --to 1 --size 96x48 --quiet "
      "--out last.png && grep -ac 'State hash B' last.png");
  CAPTURE(film.err);
  CHECK(film.code == 0);
  CHECK(driver.shell().read("last.png").find(status_of(still, 1)["hash"].get<std::string>()) !=
        std::string::npos);
}

TEST_SUITE_END();

}  // namespace clatter
