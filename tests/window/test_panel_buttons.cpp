// The buttons of the window: each has its own action. The tooltip of the timeline.

#include <doctest/doctest.h>
#include <fmt/format.h>
#include <imgui.h>
#include <imgui_internal.h>

#include <cmath>

#include "app/view/panels.h"
#include "app/view/timeline.h"
#include "app/view/top_bar.h"
#include "tests/support/messages.h"
#include "tests/window/panel_actions.h"

namespace clatter {

using testing::says;

TEST_CASE("Buttons: those of the record panel ask for what they are named after") {
  Films films = Films::OfRun;
  std::optional<double> filmed;
  Recording asked = Recording::None;
  PanelDriver driver(Scene{}, [&](Session&, Controls& controls) {
    const Recording now = record_panel(controls, films, filmed);
    if (now != Recording::None) asked = now;
  });
  const auto asks = [&](const char* button) {
    asked = Recording::None;
    tick(driver, button);
    return asked;
  };
  CHECK(asks("screenshot") == Recording::Screenshot);
  CHECK(asks("save") == Recording::SaveScene);
  CHECK(asks("restore") == Recording::RestoreScene);
  CHECK(asks("film") == Recording::Film);
  filmed = 0.45;
  CHECK(says(text_of(driver), "Stop film, 45 %"));
  CHECK(asks("film") == Recording::StopFilm);

  films = Films::OfScreen;
  filmed.reset();
  CHECK(asks("film") == Recording::FilmScreen);
  CHECK(asks("link") == Recording::CopyLink);
  filmed = 12.0;
  CHECK(says(text_of(driver), "Stop film, 12 s"));
  CHECK(asks("film") == Recording::StopScreen);

  films = Films::None;
  filmed.reset();
  driver.point_at(0.0f, 3000.0f);
  CHECK_FALSE(says(text_of(driver), "Film"));
}

TEST_CASE("Buttons: the speed has steps of 1, 2, 5") {
  const auto check_steps = [](double speed, const char* button, std::vector<double> steps) {
    Scene scene = uneven_disks();
    scene.view.speed = speed;
    PanelVisibility shown;
    PanelDriver driver(scene, [&](Session& session, Controls& controls) {
      top_bar(session, controls, shown, true);
    });
    driver.wait_for([&](const Frame& now) { return now.run == 1 && now.speed == speed; });
    for (const double next : steps) {
      CAPTURE(next);
      tick(driver, button);
      driver.wait_for([&](const Frame& now) { return std::fabs(now.speed - next) < 1e-9 * next; });
    }
  };
  check_steps(0.03, "faster", {0.05, 0.1, 0.2, 0.5, 1.0, 2.0, 5.0, 10.0});
  check_steps(20.0, "slower", {10.0, 5.0, 2.0, 1.0, 0.5, 0.2, 0.1});
  check_steps(3.0, "slower", {2.0});
}

TEST_CASE("Buttons: those of the top bar move the gas, change its speed and open their parts") {
  PanelVisibility shown;
  bool lectures = false, sounds = false, has_sound = true;
  PanelDriver driver(uneven_disks(), [&](Session& session, Controls& controls) {
    const BarButton pressed = top_bar(session, controls, shown, has_sound);
    lectures |= pressed == BarButton::Lecture;
    sounds |= pressed == BarButton::Sound;
  });
  const auto frame = [&]() -> const Frame& { return driver.session().frame(); };
  const double speed = frame().speed;

  tick(driver, "frame");
  driver.wait_for([](const Frame& now) { return now.snapshot.time > 0.0; });
  CHECK(frame().snapshot.time == doctest::Approx(speed / 60.0));
  CHECK_FALSE(frame().partners);
  driver.point_at(0.0f, 3000.0f);  // away from buttons, whose help would be the last text
  CHECK(says(text_of(driver), fmt::format("t = {:.2f}", frame().snapshot.time)));
  const std::uint64_t collisions = frame().snapshot.collisions;
  tick(driver, "collision");
  driver.wait_for([](const Frame& now) { return now.partners.has_value(); });
  CHECK(frame().snapshot.collisions == collisions + 1);
  CHECK_FALSE(frame().plays);
  tick(driver, "play");
  driver.wait_for([](const Frame& now) { return now.plays; });
  tick(driver, "play");
  driver.wait_for([](const Frame& now) { return !now.plays; });
  CHECK(frame().run == 1);
  tick(driver, "reset");
  driver.wait_for([](const Frame& now) { return now.run == 2; });
  CHECK(frame().seed == 1);

  const auto parts = [&] {
    return std::array{shown.plots, shown.lesson, shown.help, shown.gallery, lectures};
  };
  const std::array usual = parts();
  CHECK(usual == std::array{false, true, false, false, false});
  tick(driver, "plots");
  CHECK(parts() == std::array{true, true, false, false, false});
  tick(driver, "lesson");
  CHECK(parts() == std::array{true, false, false, false, false});
  tick(driver, "help");
  CHECK(parts() == std::array{true, false, true, false, false});
  tick(driver, "gallery");
  CHECK(parts() == std::array{true, false, false, true, false});
  tick(driver, "lecture");
  CHECK(parts() == std::array{true, false, false, true, true});

  CHECK_FALSE(sounds);
  tick(driver, "sound");
  CHECK(sounds);
  CHECK(says(text_of(driver), "[ Sound ]"));
  has_sound = false;
  CHECK_FALSE(says(text_of(driver), "[ Sound ]"));
}

TEST_CASE("Buttons: those of a comparison add, select and remove a gas") {
  PanelDriver driver(uneven_disks(), [](Session& session, Controls& controls) {
    const std::vector<std::string> all = {"A: first", "B: second"};
    compare_panel(session, controls, session.gases() > 1 ? all : std::vector<std::string>());
  });
  driver.wait_for([](const Frame& now) { return now.run == 1; });
  CHECK_FALSE(says(text_of(driver), "Remove"));
  tick(driver, "compare.add");
  driver.wait_for([](const Frame& now) { return now.others.size() == 1 && now.gas == 1; });
  CHECK(says(text_of(driver), "Gas { B: second }"));
  choose(driver, "compare.gas", "A: first");
  driver.wait_for([](const Frame& now) { return now.gas == 0; });
  CHECK(driver.session().gas() == 0);
  const std::uint64_t second = driver.session().frame().others[0].id;
  tick(driver, "compare.remove");
  driver.wait_for([](const Frame& now) { return now.others.empty(); });
  CHECK(driver.session().frame().id == second);
  CHECK(driver.session().gases() == 1);
}

TEST_CASE("Buttons: the tooltip of a mark at the end of the timeline is within the window") {
  Scene scene = uneven_disks();
  scene.changes = {{.time = 0.5,
                    .set = {{"walls.left.drive_speed", "0.125"},
                            {"walls.bottom.temperature", "3.75"},
                            {"particles.restitution", "0.875"},
                            {"bulk_drive.kick_speed", "0.375"}}}};
  const testing::TemporaryFolder folder;
  ScriptLog log(folder / "timeline");
  Timeline timeline;
  ImVec2 low, high;
  PanelDriver driver(scene, [&](Session& session, Controls& controls) {
    if (!session.frame().scene) return;
    timeline.draw(session, controls, log, {{0.0f, 0.0f}, {900.0f, 3000.0f}});
    ImGui::BringWindowToDisplayFront(ImGui::FindWindowByName("timeline"));
    if (const ImGuiWindow* tip = ImGui::FindWindowByName("##Tooltip_00")) {
      low = tip->Pos;
      high = {tip->Pos.x + tip->Size.x, tip->Pos.y + tip->Size.y};
    }
  });
  driver.session().play_until(0.5001);
  driver.wait_for([](const Frame& now) { return !now.plays && now.head > 0.5; });
  driver.lines();
  const auto [x, y, width, height] = driver.place("head");
  // The mark is left of the button by some pixels.
  for (float back = 0.0f; back < 60.0f && !says(text_of(driver), "0.125"); back += 2.0f) {
    driver.point_at(x - back, y + 0.5f * height);
  }
  CHECK(says(text_of(driver), "walls.left.drive_speed"));
  CHECK(high.x - low.x > 200.0f);
  CHECK(low.x >= 0.0f);
  CHECK(high.x <= 900.0f);
}

TEST_CASE("Buttons: a button for a group opens it and scrolls to it") {
  PanelDriver driver(uneven_disks(), [](Session&, Controls& controls) {
    controls.group_row({"Gas", "Box and walls", "Record"});
    ImGui::BeginChild("groups", ImVec2(0.0f, 200.0f));
    if (controls.group("Gas")) ImGui::Dummy(ImVec2(1.0f, 500.0f));
    if (controls.group("Box and walls")) controls.button("walls", "Walls", "");
    ImGui::Dummy(ImVec2(1.0f, 500.0f));
    if (controls.group("Record")) controls.button("film", "Film", "");
    ImGui::Dummy(ImVec2(1.0f, 500.0f));
    ImGui::EndChild();
  });
  const auto top_of = [&](const char* widget) { return driver.place(widget)[1]; };
  const float row = top_of("group.Gas");
  tick(driver, "group.Record");
  driver.lines();
  CHECK(top_of("film") > row);
  CHECK(top_of("film") < row + 100.0f);
  CHECK(top_of("walls") < row);
  tick(driver, "group.Box and walls");
  driver.lines();
  CHECK(top_of("walls") > row);
  CHECK(top_of("walls") < row + 100.0f);
}

}  // namespace clatter
