// Steps, the timeline and other futures of the window, by mouse and keys on a virtual display.

#include <doctest/doctest.h>

#include "tests/window/gui_driver.h"

namespace clatter {

using nlohmann::json;

TEST_SUITE_BEGIN("display");

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
