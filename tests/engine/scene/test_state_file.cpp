#include <doctest/doctest.h>

#include <bit>
#include <cmath>
#include <filesystem>
#include <limits>

#include "engine/scene/state_file.h"
#include "tests/engine/scene/refusal.h"
#include "tests/support/temporary_folder.h"

using namespace clatter;
using namespace clatter::testing;

namespace {

Scene smooth_scene() {
  Scene scene;
  scene.box = Vec2(10.0, 8.0);
  return scene;
}

Scene rough_scene() {
  Scene scene = smooth_scene();
  scene.particles.roughness.friction = 0.5;
  return scene;
}

/// Walls to the left and right; the left one moves in by 2, and has come by 1.5 at time 0.
Scene walled_scene() {
  Scene scene = smooth_scene();
  scene.walls[kLeft] =
      Wall{.kind = WallKind::Sawtooth, .stroke = 2.0, .frequency = 1.0, .phase = -0.25};
  scene.walls[kRight] = Wall{};
  return scene;
}

/// The message with which a text is refused; empty where it is not.
std::string state_refusal(const std::string& csv, const Scene& scene = smooth_scene()) {
  return refusal_of([&] { parse_state(csv, "a.csv", scene); });
}

const std::string kHeader = "x,y,vx,vy\n";

State<2> disks_of(std::string_view csv, const std::string& file, const Scene& scene) {
  return std::get<State<2>>(parse_state(csv, file, scene));
}

}  // namespace

TEST_CASE("State file: a state is read whatever the order of its columns") {
  const State<2> state = disks_of(
      "\xef\xbb\xbf# saved\r\n\r\nvy, x ,y,vx\r\n  # a comment\r\n4,1, 2\t,-3e-1\r\n\r\n"
      "8,5.5,6,7",
      "a.csv", smooth_scene());
  CHECK(state.positions == std::vector<Vec2>{{1.0, 2.0}, {5.5, 6.0}});
  CHECK(state.velocities == std::vector<Vec2>{{-0.3, 4.0}, {7.0, 8.0}});
  CHECK(state.spins.empty());
}

TEST_CASE(
    "State file: spins are read where the scene has them, and are zero where the file has none") {
  const State<2> spinning = disks_of("x,y,vx,vy,omega\n1,2,3,4,-5\n", "a.csv", rough_scene());
  REQUIRE(spinning.spins.size() == 1);
  CHECK(spinning.spins[0][0] == -5.0);
  const State<2> still = disks_of(kHeader + "1,2,3,4\n", "a.csv", rough_scene());
  REQUIRE(still.spins.size() == 1);
  CHECK(still.spins[0][0] == 0.0);
}

TEST_CASE("State file: a state may have no particles") {
  CHECK(disks_of(kHeader, "a.csv", smooth_scene()).positions.empty());
}

TEST_CASE("State file: a state that was written reads back to the same bits") {
  State<2> state;
  state.positions = {{0.1 + 0.2, 5e-324}, {10.0 - 1e-15, 8.0}, {3.0, 1.0 / 3.0}};
  state.velocities = {{-0.0, 1e15}, {-1e-300, 123456789.123456789}, {2.0 / 3.0, -1e-17}};
  for (const bool spins : {false, true}) {
    if (spins) state.spins = {Spin<2>(0.1), Spin<2>(-1e-310), Spin<2>(std::nextafter(1.0, 2.0))};
    Scene scene = spins ? rough_scene() : smooth_scene();
    scene.walls[kLeft] = scene.walls[kRight] = std::nullopt;
    scene.box = Vec2(20.0, 18.0);
    const State<2> read = disks_of(state_to_csv(state), "a.csv", scene);
    REQUIRE(read.positions.size() == 3);
    REQUIRE(read.spins.size() == state.spins.size());
    const auto same = [](double a, double b) {
      return std::bit_cast<std::uint64_t>(a) == std::bit_cast<std::uint64_t>(b);
    };
    for (std::size_t i = 0; i < 3; ++i) {
      for (int k = 0; k < 2; ++k) {
        CHECK(same(read.positions[i][k], state.positions[i][k]));
        CHECK(same(read.velocities[i][k], state.velocities[i][k]));
      }
      if (spins) CHECK(same(read.spins[i][0], state.spins[i][0]));
    }
  }
}

TEST_CASE("State file: mistakes are reported with their place and what to do") {
  struct Case {
    std::string csv;
    std::string message;
    Scene scene = smooth_scene();
  };
  const std::vector<Case> cases = {
      // the header
      {"", "a.csv: the file has no header line; begin the file with the line x,y,vx,vy"},
      {"# nothing\n\n", "a.csv: the file has no header line"},
      {"1,2,3,4\n", "a.csv:1:1: unknown column \"1\"; the columns are x, y, vx, vy and"},
      {"\nx,y,vx, vyy\n", "a.csv:2:9: unknown column \"vyy\"; did you mean \"vy\"?"},
      {"x,y,vx,vy,mass\n", "a.csv:1:11: unknown column \"mass\"; the columns are"},
      {"x,y,vx,vy,\n", "a.csv:1:11: unknown column \"\"; the columns are"},
      {"x,y,vx\n", "a.csv:1:1: the column \"vy\" is missing; begin the file with"},
      {"x,y,x,vx,vy\n", "a.csv:1:5: a second column \"x\"; remove one of them"},
      {"x,y,vx,vy,omega\n",
       "a.csv:1:11: the column \"omega\" has no meaning where nothing spins; remove the column, or "
       "make the particles"},
      // numbers
      {kHeader + "1,2,3\n", "a.csv:2:1: this line has 3 cells, the header has 4; give every"},
      {kHeader + "1,2,3,4,5\n", "a.csv:2:1: this line has 5 cells, the header has 4"},
      {kHeader + "\n1, 2e,3,4\n", "a.csv:3:4: \"2e\" is no finite number; write, say, -0.25"},
      {kHeader + "1,2,nan,4\n", "a.csv:2:5: \"nan\" is no finite number"},
      {kHeader + "1,2,3,-inf\n", "a.csv:2:7: \"-inf\" is no finite number"},
      {kHeader + "1,2,3,1e999\n", "a.csv:2:7: \"1e999\" is no finite number"},
      {kHeader + "+1,2,3,4\n", "a.csv:2:1: \"+1\" is no finite number"},
      {kHeader + "0x1,2,3,4\n", "a.csv:2:1: \"0x1\" is no finite number"},
      {kHeader + "1,,3,4\n", "a.csv:2:3: \"\" is no finite number"},
      {kHeader + "1,2,1e16,4\n", "a.csv:2:5: vx is 1e+16; give at most 1e+15 either way"},
      {"x,y,vx,vy,omega\n1,2,3,4,-1e16\n", "a.csv:2:9: omega is -1e+16; give", rough_scene()},
      // places
      {kHeader + "1,2,3,4\n10.5,2,3,4\n",
       "a.csv:3:1: x = 10.5 lies outside the box; give a number between 0 and 10"},
      {kHeader + "1,-1e-9,3,4\n", "a.csv:2:3: y = -1e-09 lies outside the box"},
      {kHeader + "9.6,2,3,4\n",
       "a.csv:2:1: at x = 9.6 the particle overlaps the right wall; give a number between 2 and "
       "9.5",
       walled_scene()},
      {kHeader + "1.9,2,3,4\n",
       "a.csv:2:1: at x = 1.9 the particle overlaps the left wall, as that is at time 0; give a "
       "number between 2 and 9.5, or the wall the phase that it had",
       walled_scene()},
      // overlaps
      {kHeader + "1,2,3,4\n\n5,5,0,0\n1.5,2,3,4\n",
       "a.csv:5:1: the particles of lines 2 and 5 overlap by 0.5 diameters; move them apart"},
      {kHeader + "9.75,2,3,4\n0.25,2,3,4\n",
       "a.csv:3:1: the particles of lines 2 and 3 overlap by 0.5"},
      {kHeader + "5,7.9,3,4\n5,0.1,3,4\n",
       "a.csv:3:1: the particles of lines 2 and 3 overlap by 0.8"},
      {kHeader + "5,2,0,0\n5,2,0,0\n",
       "a.csv:3:1: the particles of lines 2 and 3 overlap by 1 diam"},
      {kHeader + "5,2,0,0\n6,1.99999,0,0\n5,2.99999999999,0,0\n",
       "a.csv:4:1: the particles of lines 2 and 4 overlap by 1e-11 diameters"},
  };
  for (const Case& mistake : cases) {
    CAPTURE(mistake.csv);
    CAPTURE(mistake.message);
    const std::string what = state_refusal(mistake.csv, mistake.scene);
    CAPTURE(what);
    CHECK(what.starts_with(mistake.message));
  }
}

TEST_CASE("State file: particles may touch each other or a wall, up to rounding") {
  CHECK(state_refusal(kHeader + "5,2,0,0\n5,2.9999999999995,0,0\n6,2,0,0\n") == "");
  CHECK(state_refusal(kHeader + "1.9999999999995,2,0,0\n9.5,2,0,0\n", walled_scene()) == "");
  CHECK(state_refusal(kHeader + "9.75,2,3,4\n0.5,7,3,4\n0.75,2,0,0\n") == "");
  // Where walls are, nothing wraps.
  CHECK(state_refusal(kHeader + "9.5,2,3,4\n2.5,7,3,4\n2.5,0.5,3,4\n9.5,3,0,0\n", walled_scene()) ==
        "");
}

TEST_CASE(
    "State file: particles may lie wherever the walls are not at time 0, also outside the box") {
  CHECK(state_refusal(kHeader + "2.1,2,0,0\n", walled_scene()) == "");  // where the wall will come
  Scene scene = walled_scene();
  scene.walls[kRight] =
      Wall{.kind = WallKind::Sinusoidal, .stroke = 2.0, .frequency = 1.0, .phase = 0.75};
  CHECK(state_refusal(kHeader + "10.4,2,0,0\n10.4,3,0,0\n", scene) == "");
  CHECK(says(state_refusal(kHeader + "10.6,2,0,0\n", scene), "overlaps the right wall"));
  CHECK(says(state_refusal(kHeader + "10.4,2,0,0\n10.4,2.9,0,0\n", scene), "overlap by 0.1"));
}

TEST_CASE("State file: no overlap hides, in boxes of any shape") {
  for (const Vec2& box : {Vec2(1.2, 40.0), Vec2(2.5, 30.0), Vec2(3.1, 3.2), Vec2(1e6, 1e6)}) {
    CAPTURE(box.x());
    Scene scene;
    scene.box = box;
    for (int k = 0; k < 64; ++k) {
      // One particle at a corner of the box or inside, the other a little less than a diameter off.
      const double angle = 0.1 * k;
      const Vec2 a = 0.25 * (k % 4) * box;
      Vec2 b = a + 0.999 * Vec2(std::cos(angle), std::sin(angle));
      for (int axis = 0; axis < 2; ++axis) b[axis] -= box[axis] * std::floor(b[axis] / box[axis]);
      State<2> state;
      state.positions = {a, b};
      state.velocities.resize(2, Vec2::Zero());
      CAPTURE(k);
      CHECK(says(state_refusal(state_to_csv(state), scene),
                 "the particles of lines 2 and 3 overlap"));
    }
  }
}

// Every pair looked at would take hours.
TEST_CASE("State file: a million particles are read, each compared with its neighbours only") {
  Scene scene;
  scene.box = Vec2(1100.0, 1100.0);
  State<2> state;
  for (int i = 0; i < 1'000'000; ++i) {
    state.positions.emplace_back(0.5 + 1.0999 * (i % 1000), 0.5 + 1.0999 * (i / 1000));
    state.velocities.emplace_back(1.0 / (i + 1), 2.0 / 3.0);
  }
  const std::string csv = state_to_csv(state);
  CHECK(disks_of(csv, "a.csv", scene).positions == state.positions);
}

TEST_CASE("State file: a scene names its state relative to its own folder") {
  const TemporaryFolder folder;
  const std::string start = "[particles.start]\nlayout = \"file\"\nfile = \"a.csv\"\n";
  const std::string scene_path = folder.write("s.toml", start);
  const std::string csv_path = folder.write("a.csv", kHeader + "1,2,3,4\n5,6,7,8\n");
  const Scene scene = load_scene(scene_path);
  CHECK(scene.particles.count == 2);
  CHECK(scene.particles.start.file == csv_path);
  CHECK(std::get<State<2>>(scene.particles.start.state).positions[1] == Vec2(5.0, 6.0));

  // What is written is found from where one is, and reads back.
  const Scene again = parse_scene(scene_to_toml(scene), "s.toml");
  CHECK(again.particles.start.file == csv_path);
  CHECK(again.particles.start.state == scene.particles.start.state);
  CHECK(says(scene_to_json(scene), "\"layout\": \"file\", \"file\": "));

  // What is typed is relative to where one is.
  CHECK(load_scene("vibrated",
                   {{"particles.start", "{layout = \"file\", file = \"" + csv_path + "\"}"},
                    {"particles.count", "2"}})
            .particles.start.file == csv_path);
  CHECK(says(load_refusal(scene_path, {{"particles.start.file", "a.csv"}}),
             "--set particles.start.file: there is no file 'a.csv'; "));
}

TEST_CASE("State file: a count beside a state must be that of its particles") {
  const TemporaryFolder folder;
  const std::string start = "[particles.start]\nlayout = \"file\"\nfile = \"a.csv\"\n";
  folder.write("a.csv", kHeader + "1,2,3,4\n5,6,7,8\n");
  CHECK(load_scene(folder.write("s.toml", "[particles]\ncount = 2\n" + start)).particles.count ==
        2);
  CHECK(load_scene(folder.write("s.toml", "[particles]\narea_fraction = 0.003\n" + start))
            .particles.count == 2);
  const std::string path = folder.write("s.toml", "[particles]\ncount = 3\n" + start);
  CHECK(says(load_refusal(path), path + ":2:1: this asks for 3 particles, and "));
  CHECK(says(load_refusal(path), "a.csv has 2; remove the key, or choose the file that you mean"));
}

TEST_CASE("State file: a missing file gets a suggestion, and a mistake its own place") {
  const TemporaryFolder folder;
  const std::string path =
      folder.write("s.toml", "[particles.start]\nlayout = \"file\"\nfile = \"pol.csv\"\n");
  const std::string csv_path = folder.write("pool.csv", kHeader + "1,2,3,x\n");
  CHECK(says(load_refusal(path), path + ":3:1: there is no file '"));
  CHECK(says(load_refusal(path), "pol.csv'; did you mean 'pool.csv'?"));
  std::filesystem::rename(csv_path, folder / "pol.csv");
  CHECK(says(load_refusal(path), "pol.csv:2:7: \"x\" is no finite number"));
}
