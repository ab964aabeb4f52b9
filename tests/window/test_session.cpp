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

TEST_CASE("Session: a heatmap of a species leaves with the gas that has it") {
  SessionDriver driver;
  Session& session = driver.session;
  const Scene mixture = parse_scene(R"(
      box.size = [16.0, 12.0]
      [[species]]
      name = "light"
      count = 20
      [[species]]
      name = "heavy"
      count = 5
      mass = 4.0
      [view]
      field = "temperature_heavy")",
                                    "mixture");
  session.open(mixture, 7, false, {parse_scene(SessionDriver::kScene, "gas")});
  driver.answer();
  REQUIRE(session.gases() == 2);
  CHECK(session.view().field == Field(Quantity::Temperature).of(1));
  driver.go_to(0.5);
  REQUIRE(session.frame().snapshot.field);
  CHECK(session.frame().snapshot.field->species == "heavy");
  CHECK_FALSE(session.frame().others[0].snapshot.field);
  session.select(1);
  driver.answer();
  CHECK_FALSE(session.view().field);
  driver.go_to(1.0);
  CHECK_FALSE(session.frame().snapshot.field);
  CHECK_FALSE(session.recorded(session.frame()).view.field);
}

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

TEST_CASE("Session: a tracer has its path from its choice on, without a restart") {
  SessionDriver driver;
  Session& session = driver.session;
  driver.go_to(1.0);
  View view = session.view();
  view.tracer = Tracer{3, 5.0};
  session.set_view(view);
  driver.go_to(2.0);
  CHECK_FALSE(session.frame().snapshot.traced.empty());
  CHECK(session.frame().run == 1);
}

TEST_CASE("Session: undo removes added particles, also where fewer than asked found room") {
  SessionDriver driver;
  Session& session = driver.session;
  driver.go_to(1.0);
  const Puff crowd{.count = 200, .centre = VecX(Vec2(8.0, 6.0)), .radius = 3.0, .temperature = 1.0};
  session.add(crowd);
  session.remember({.acts = {{.puff = crowd}}});
  driver.answer();
  const std::size_t crowded = session.frame().snapshot.count();
  CHECK(crowded > 30);
  CHECK(crowded < 230);
  session.undo();
  driver.answer();
  CHECK(session.frame().snapshot.count() == 30);
  session.redo();
  driver.answer();
  CHECK(session.frame().snapshot.count() == crowded);
}

TEST_CASE("Session: a refused change leaves nothing to undo") {
  SessionDriver driver;
  Session& session = driver.session;
  driver.go_to(1.0);
  act(driver, {heated(1.5)});
  driver.go_to(2.0);
  const auto refuse = [&](const std::function<void()>& change) {
    const std::uint64_t messages = session.messages();
    change();
    driver.answer();
    CHECK(session.messages() > messages);
    CHECK(session.frame().run == 1);
    CHECK(session.frame().snapshot.time == 2.0);
  };
  const std::vector<Override> at_rest = {{"walls.left.kind", "\"static\""}},
                              far_in = {{"walls.left.kind", "\"sawtooth\""},
                                        {"walls.left.stroke", "10.0"},
                                        {"walls.left.frequency", "1.0"},
                                        {"walls.left.phase", "0.9"}};
  refuse([&] {
    session.set(far_in);
    session.remember({.before = at_rest, .after = far_in});
  });
  const Puff none{.count = 5,
                  .centre = VecX(session.frame().snapshot.positions.col(0)),
                  .radius = 1e-3,
                  .temperature = 1.0};
  refuse([&] {
    session.add(none);
    session.remember({.acts = {{.puff = none}}});
  });
  Scene full = parse_scene(SessionDriver::kScene, "gas");
  State<2> overlapping;
  overlapping.positions = {Vec2(5.0, 5.0), Vec2(5.5, 5.0)};
  overlapping.velocities.assign(2, Vec2(0.0, 0.0));
  full.particles.count = 2;
  full.particles.start.layout = Layout::File;
  full.particles.start.state = overlapping;
  refuse([&] { session.open(full, 7, false); });
  // Undo then reaches the last change that was made.
  session.undo();
  driver.answer();
  CHECK(session.frame().run == 1);
  CHECK(session.frame().scene->changes.empty());
}

TEST_CASE("Session: a stroke of a wall changes at any phase, also with grains at the wall") {
  SessionDriver driver;
  Session& session = driver.session;
  for (int eighth = 0; eighth < 8; ++eighth) {
    CAPTURE(eighth);
    session.open(load_scene("shaker"), 1, false);
    session.set_speed(1e4);
    driver.answer();
    driver.go_to(30.0 + eighth / 8.0);
    session.set_speed(2.0);
    const std::uint64_t messages = session.messages();
    session.set({{"walls.bottom.stroke", "1.0"}});
    driver.answer();
    CHECK(session.messages() == messages);
    CHECK(session.frame().scene->walls[2]->stroke == 1.0);
    CHECK(session.frame().snapshot.time < 31.0 + eighth / 8.0);
  }
}

TEST_CASE("Session: experiments with a scene of the gallery need no saving") {
  SessionDriver driver;
  Session& session = driver.session;
  CHECK_FALSE(session.unsaved());
  session.set({{"particles.restitution", "0.8"}});
  CHECK(session.unsaved());  // of a scene that is not in the gallery
  session.open(load_scene("vibrated"), 1, false);
  driver.answer();
  session.set({{"particles.restitution", "0.8"}});
  session.nudge(Nudge{.centre = VecX(Vec2(8.0, 6.0)), .radius = 5.0, .scale = 1.1});
  CHECK_FALSE(session.unsaved());
  session.set({{"box.size", "[30.0, 25.0]"}});
  CHECK(session.unsaved());
  driver.answer();
}

TEST_CASE("Session: a saved scene opens at the time of its picture, with its changes") {
  SessionDriver driver;
  Session& session = driver.session;
  driver.go_to(2.0);
  session.set({{"particles.restitution", "0.7"}});
  driver.answer();
  driver.go_to(3.0);
  const Scene saved = parse_scene(scene_to_toml(session.recorded(session.frame())), "saved");
  const auto hash = session.frame().state_hash;
  session.open(saved, 7, false);
  driver.answer();
  driver.wait_for([&] { return session.frame().snapshot.time == 3.0; });
  driver.answer();
  CHECK(session.frame().state_hash == hash);
  CHECK(session.frame().scene->particles.restitution == 0.7);
  session.restart();
  driver.answer();
  CHECK(session.frame().snapshot.time == 0.0);
  CHECK(session.frame().scene->particles.restitution == 0.95);
}

TEST_CASE("Session: the way to the time of a saved scene ends by a cancel, where it is") {
  SessionDriver driver;
  Session& session = driver.session;
  Scene scene = parse_scene(SessionDriver::kScene, "gas");
  scene.particles.restitution = 1.0;
  scene.view.open_at = 1e6;
  session.open(scene, 7, false);
  driver.wait_for([&] { return session.frame().bound_for == 1e6; });
  session.cancel_open();
  driver.wait_for([&] { return !session.frame().bound_for; });
  driver.answer();
  CHECK(session.frame().snapshot.time > 0.0);
  CHECK(session.frame().snapshot.time < 1e6);
}

TEST_CASE("Session: a gas that heats without bound has a message before its speeds diverge") {
  SessionDriver driver;
  Session& session = driver.session;
  session.open(load_scene("heating_walls"), 1, false);
  session.set_speed(1e4);
  driver.answer();
  const std::uint64_t messages = session.messages();
  session.play(true);
  driver.wait_for([&] { return session.messages() > messages; });
  CHECK(session.message().find("100 times") != std::string::npos);
  CHECK(session.frame().snapshot.temperature >= 100.0);
  session.play(false);
  driver.answer();
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

TEST_CASE("Session: the script log has each value under its name") {
  SessionDriver driver(7);
  Session& session = driver.session;
  const auto check = [&](const char* event, const json& values) {
    CAPTURE(event);
    const json logged = driver.logged(event);
    for (const auto& [key, value] : values.items()) {
      CAPTURE(key);
      CHECK(logged[key] == value);
    }
  };
  check("open", {{"title", "Ring"}, {"seed", 7}, {"dimension", 2}, {"gases", 1}, {"command", 1}});
  driver.go_to(2.5);
  check("play", {{"until", 2.5}, {"command", 2}});
  session.jump(1.5);
  driver.answer();
  check("jump", {{"to", 1.5}, {"command", 3}});
  session.set({{"particles.restitution", "0.85"}});
  driver.answer();
  check("set", {{"keys", json{{"particles.restitution", "0.85"}}}, {"command", 4}});
  session.move_piston(15.0, 3.0);
  driver.answer();
  check("piston", {{"position", 15.0}, {"duration", 3.0}, {"command", 5}});
  check("status", {{"time", 1.5},
                   {"handled", 5},
                   {"plays", false},
                   {"backwards", false},
                   {"held", session.frame().held},
                   {"changes", 2},
                   {"head", session.frame().head},
                   {"particles", 30},
                   {"flights", 0},
                   {"restitution", 0.85},
                   {"collisions", session.frame().snapshot.collisions}});
  View view = session.view();
  view.azimuth = 30.0;
  view.elevation = 10.0;
  session.set_view(view);
  check("turn", {{"azimuth", 30.0}, {"elevation", 10.0}});
  session.restart_with_new_seed();
  driver.answer();
  check("reset", {{"seed", 8}, {"command", 6}});
  session.play(true);
  check("play", {{"command", 7}});
  session.play(false);
  check("pause", {{"command", 8}});
}

}  // namespace clatter
