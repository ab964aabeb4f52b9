// Steps, the timeline and other futures of the window, by mouse and keys on a virtual display.

#include <doctest/doctest.h>

#include "tests/window/gui_driver.h"

namespace clatter {

using nlohmann::json;

TEST_SUITE_BEGIN("display");

TEST_CASE("Window: a gas plays, halts, steps to a frame and to collisions, plays on and back") {
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

  const auto step = [&](const char* key) {
    told = driver.told();
    driver.key(key);
    return driver.wait_for("status", told,
                           [](const json& status) { return status.contains("partners"); });
  };
  step("shift+period");
  step("shift+period");
  const json hit = step("shift+comma");
  CHECK(hit["collisions"].get<int>() == frame["collisions"].get<int>() + 1);

  // The same run without a window has the same hash.
  CHECK(hash_of_run(driver, "vibrated", hit) == hit["hash"]);

  told = driver.told();
  driver.key("space");
  driver.wait_for("status", told, [](const json& status) { return status["plays"]; });
  told = driver.told();
  driver.key("b");
  driver.wait_for("status", told, [](const json& status) { return status["backwards"]; });
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
  const auto at_old_head = [&](const json& status) {
    return halted(status) && status["head"] == head["time"];
  };
  told = driver.told();
  driver.key("ctrl+z");
  CHECK(driver.wait_for("status", told, at_old_head)["changes"] == 0);
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
