// The simulation in the window without its widgets: commands, undo, and the script log.

#include <doctest/doctest.h>

#include <chrono>
#include <functional>
#include <thread>

#include "app/view/session.h"
#include "engine/scene/scene_file.h"
#include "tests/window/logged_widgets.h"

namespace clatter {

using nlohmann::json;

namespace {

// A session with the engine, and its script log.
class SessionDriver {
 public:
  explicit SessionDriver(std::uint64_t seed = 7) {
    session.open(parse_scene(kScene, "gas"), seed, false);
    answer();
  }

  // Takes frames until the condition holds.
  void wait_for(const std::function<bool()>& holds) {
    for (int look = 0; look < 2000 && !holds(); ++look) {
      session.update();
      std::this_thread::sleep_for(std::chrono::milliseconds(5));
    }
    REQUIRE(holds());
  }

  // Takes frames until the engine has answered all commands and the gas is halted.
  void answer() {
    wait_for([&] { return session.is_answered() && !session.frame().plays; });
  }

  // Plays up to a simulation time.
  void go_to(double time) {
    session.play_until(time);
    answer();
    REQUIRE(session.frame().snapshot.time == time);
  }

  // The newest event of a name in the script log.
  json logged(const std::string& name) const { return newest_event(folder_ / "log", name); }

  // Number of commands before those of the test.
  static constexpr int kOpened = 1;
  static constexpr const char* kScene = R"(
      title = "Ring"
      box.size = [16.0, 12.0]
      particles = { count = 30, restitution = 0.95 }
      walls.left = { kind = "static" }
      walls.right = { kind = "static" }
      view.speed = 100.0)";

 private:
  testing::TemporaryFolder folder_;
  ScriptLog log_{folder_ / "log"};
  Worker worker_{60.0};

 public:
  Session session{worker_, log_};
};

Change heated(double scale) {
  return {.nudge = Nudge{.centre = VecX(Vec2(8.0, 6.0)), .radius = 5.0, .scale = scale}};
}

// Nudges the gas now, as a tool of the mouse does.
void act(SessionDriver& driver, const std::vector<Change>& acts) {
  for (const Change& change : acts) driver.session.nudge(*change.nudge);
  driver.session.remember({.acts = acts});
  driver.answer();
}

std::vector<double> scales(const Session& session) {
  std::vector<double> scales;
  for (const Change& change : session.frame().scene->changes)
    scales.push_back(*change.nudge->scale);
  return scales;
}

// Another future begins at an act at t = 1.5. At its head, t = 2.5, is another act.
void fork_and_act(SessionDriver& driver) {
  driver.go_to(2.0);
  driver.session.jump(1.5);
  driver.answer();
  act(driver, {heated(1.5)});
  driver.go_to(2.5);
  act(driver, {heated(1.25)});
}

}  // namespace

TEST_CASE("Session: undo removes the last acts that are alike, and redo brings them back") {
  SessionDriver driver;
  Session& session = driver.session;
  act(driver, {heated(1.5)});
  driver.go_to(2.0);
  act(driver, {heated(1.25), heated(1.5)});
  CHECK(scales(session) == std::vector{1.5, 1.25, 1.5});
  const std::uint64_t heated_twice = *session.frame().state_hash;
  session.undo();
  driver.answer();
  CHECK(scales(session) == std::vector{1.5});
  CHECK(session.frame().scene->changes[0].time < 2.0);
  CHECK(session.frame().snapshot.time == 2.0);
  const json undone = driver.logged("replace_changes");
  CHECK(undone["changes"] == 1);
  CHECK(undone["from"] == 2.0);
  CHECK(undone["command"] == SessionDriver::kOpened + 5);
  session.redo();
  driver.answer();
  CHECK(scales(session) == std::vector{1.5, 1.25, 1.5});
  CHECK(session.frame().scene->changes[1].time == 2.0);
  CHECK(session.frame().state_hash == heated_twice);
}

TEST_CASE("Session: undo finds an act before later changes of laws") {
  SessionDriver driver;
  Session& session = driver.session;
  driver.go_to(1.0);
  act(driver, {heated(1.5)});
  const std::vector<Override> usual = {{"particles.restitution", "0.95"}},
                              less = {{"particles.restitution", "0.8"}};
  session.set(less);
  session.remember({.before = usual, .after = less});
  driver.answer();
  for (const std::size_t changes : {3u, 2u}) {
    session.undo();
    driver.answer();
    CHECK(session.frame().scene->changes.size() == changes);
  }
  for (const Change& change : session.frame().scene->changes) CHECK_FALSE(change.nudge);
}

TEST_CASE("Session: undo of an act at the head is no part of an earlier fork") {
  SessionDriver driver;
  Session& session = driver.session;
  fork_and_act(driver);
  CHECK(scales(session) == std::vector{1.5, 1.25});
  for (const auto& left : {std::vector{1.5}, std::vector<double>{}}) {
    session.undo();
    driver.answer();
    CHECK(scales(session) == left);
  }
}

TEST_CASE("Session: redo of an act after an earlier fork exchanges the futures") {
  SessionDriver driver;
  Session& session = driver.session;
  fork_and_act(driver);
  driver.go_to(3.0);
  session.undo();
  driver.answer();
  CHECK(scales(session) == std::vector{1.5});
  session.redo();
  driver.answer();
  CHECK(scales(session) == std::vector{1.5, 1.25});
  CHECK(session.frame().head == 3.0);
  CHECK(driver.logged("exchange_futures")["command"] > driver.logged("replace_changes")["command"]);
}

TEST_CASE("Session: undo of a second fork exchanges its own futures") {
  SessionDriver driver;
  Session& session = driver.session;
  driver.go_to(2.0);
  for (const double time : {1.5, 1.0}) {
    session.jump(time);
    driver.answer();
    act(driver, {heated(1.5)});
  }
  session.undo();
  driver.answer();
  CHECK(scales(session) == std::vector{1.5});
  session.redo();
  driver.answer();
  CHECK(scales(session) == std::vector{1.5});
  CHECK(session.frame().scene->changes[0].time == 1.0);
  session.undo();
  driver.answer();
  CHECK(session.frame().scene->changes[0].time == 1.5);
}

TEST_CASE("Session: undo of a dragged left wall moves the particles back") {
  SessionDriver driver;
  Session& session = driver.session;
  const Eigen::MatrixXd start = session.frame().snapshot.positions;
  const std::vector<Override> now = {{"box.size", "[16.0, 12.0]"}},
                              wider = {{"box.size", "[20.0, 12.0]"}};
  const VecX shift = Vec2(4.0, 0.0);
  session.set(wider, shift);
  session.remember({.before = now, .after = wider, .shift = shift});
  driver.answer();
  Eigen::MatrixXd moved = start;
  moved.row(0).array() += 4.0;
  CHECK(session.frame().snapshot.positions == moved);
  session.undo();
  driver.answer();
  // The sums up to 20 are rounded by 1.8e-15 at most, twice.
  CHECK((session.frame().snapshot.positions - start).cwiseAbs().maxCoeff() < 1e-14);
}

TEST_CASE("Session: undo after another scene was opened restores seed and saved state") {
  SessionDriver driver(7);
  Session& session = driver.session;
  session.open(parse_scene(SessionDriver::kScene, "gas"), 9, false);
  driver.answer();
  CHECK(session.frame().seed == 9);
  CHECK(driver.logged("open")["gases"] == 1);
  CHECK(driver.logged("open")["command"] == SessionDriver::kOpened + 1);
  session.undo();
  driver.answer();
  CHECK(session.frame().seed == 7);
  CHECK_FALSE(session.unsaved());
}

TEST_CASE("Session: after the first gas is removed the first one is selected") {
  SessionDriver driver;
  Session& session = driver.session;
  session.add_copy();
  driver.answer();
  CHECK(driver.logged("add_copy")["of"] == 0);
  CHECK(driver.logged("add_copy")["command"] == SessionDriver::kOpened + 1);
  CHECK(driver.logged("select")["gas"] == 1);
  CHECK(driver.logged("select")["command"] == SessionDriver::kOpened + 2);
  session.select(0);
  session.remove_gas();
  CHECK(session.gas() == 0);
  driver.answer();
  CHECK(session.gases() == 1);
  CHECK(driver.logged("remove_gas")["gas"] == 0);
  CHECK(driver.logged("remove_gas")["command"] == SessionDriver::kOpened + 4);
}

TEST_CASE("Session: a picked particle has a next collision") {
  SessionDriver driver;
  driver.session.pick(3);
  driver.wait_for([&] { return driver.session.frame().next_collision.has_value(); });
  driver.session.pick({});
  driver.answer();
  CHECK_FALSE(driver.session.frame().next_collision);
}

TEST_CASE("Session: the script log has each value under its name") {
  SessionDriver driver(7);
  Session& session = driver.session;
  const json opened = driver.logged("open");
  CHECK(opened["title"] == "Ring");
  CHECK(opened["seed"] == 7);
  CHECK(opened["dimension"] == 2);
  CHECK(opened["gases"] == 1);
  CHECK(opened["command"] == 1);
  driver.go_to(2.5);
  CHECK(driver.logged("play")["until"] == 2.5);
  CHECK(driver.logged("play")["command"] == 2);
  session.jump(1.5);
  driver.answer();
  CHECK(driver.logged("jump")["to"] == 1.5);
  CHECK(driver.logged("jump")["command"] == 3);
  session.set({{"particles.restitution", "0.85"}});
  driver.answer();
  CHECK(driver.logged("set")["keys"] == json{{"particles.restitution", "0.85"}});
  CHECK(driver.logged("set")["command"] == 4);
  session.move_piston(15.0, 3.0);
  driver.answer();
  const json piston = driver.logged("piston");
  CHECK(piston["position"] == 15.0);
  CHECK(piston["duration"] == 3.0);
  CHECK(piston["command"] == 5);
  const json status = driver.logged("status");
  CHECK(status["time"] == 1.5);
  CHECK(status["handled"] == 5);
  CHECK(status["plays"] == false);
  CHECK(status["backwards"] == false);
  CHECK(status["held"] == session.frame().held);
  CHECK(status["changes"] == 2);
  CHECK(status["head"] == session.frame().head);
  CHECK(status["particles"] == 30);
  CHECK(status["flights"] == 0);
  CHECK(status["restitution"] == 0.85);
  CHECK(status["collisions"] == session.frame().snapshot.collisions);
  View view = session.view();
  view.azimuth = 30.0;
  view.elevation = 10.0;
  session.set_view(view);
  CHECK(driver.logged("turn")["azimuth"] == 30.0);
  CHECK(driver.logged("turn")["elevation"] == 10.0);
  session.restart_with_new_seed();
  driver.answer();
  CHECK(driver.logged("reset")["seed"] == 8);
  CHECK(driver.logged("reset")["command"] == 6);
  session.play(true);
  CHECK(driver.logged("play")["command"] == 7);
  session.play(false);
  CHECK(driver.logged("pause")["command"] == 8);
}

}  // namespace clatter
