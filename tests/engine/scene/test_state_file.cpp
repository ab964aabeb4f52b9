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

Scene smooth_scene(int dimension = 2) {
  Scene scene = default_scene(dimension);
  scene.box = Vec<3>(10.0, 8.0, 6.0).head(dimension);
  return scene;
}

Scene rough_scene(int dimension = 2) {
  Scene scene = smooth_scene(dimension);
  scene.particles.roughness.friction = 0.5;
  return scene;
}

/// Walls at both ends of the axis. The near wall has a stroke of 2 and a displacement of 1.5 at
/// time 0.
Scene walled(Scene scene, int axis) {
  scene.walls[2 * axis] =
      Wall{.kind = WallKind::Sawtooth, .stroke = 2.0, .frequency = 1.0, .phase = -0.25};
  scene.walls[2 * axis + 1] = Wall{};
  return scene;
}

/// Walls to the left and right.
Scene walled_scene() {
  return walled(smooth_scene(), 0);
}

/// Walls at the back and front.
Scene deep_state_scene() {
  return walled(smooth_scene(3), 2);
}

/// The error message for a text; empty if it is valid.
std::string state_refusal(const std::string& csv, const Scene& scene = smooth_scene()) {
  return refusal_of([&] { parse_state(csv, "a.csv", scene); });
}

const std::string kHeader = "x,y,vx,vy\n";
const std::string kSphereHeader = "x,y,z,vx,vy,vz\n";

template <int D>
State<D> read(std::string_view csv, const Scene& scene) {
  return std::get<State<D>>(parse_state(csv, "a.csv", scene));
}

/// Whether two vectors have the same bits.
template <class Vector>
bool same(const Vector& a, const Vector& b) {
  for (int k = 0; k < a.size(); ++k) {
    if (std::bit_cast<std::uint64_t>(a[k]) != std::bit_cast<std::uint64_t>(b[k])) return false;
  }
  return true;
}

template <int D>
void check_bits() {
  const Vec<3> positions[] = {
      {0.1 + 0.2, 5e-324, 2.0 / 3.0}, {10.0 - 1e-15, 8.0, 5e-310}, {3.0, 1.0 / 3.0, 12.0 - 2e-15}};
  const Vec<3> velocities[] = {{-0.0, 1e15, -1e15},
                               {-1e-300, 123456789.123456789, -0.0},
                               {2.0 / 3.0, -1e-17, std::nextafter(1.0, 2.0)}};
  const Vec<3> spins[] = {
      {0.1, -0.0, 7.0 / 9.0}, {-1e-310, 1e15, 1e-17}, {std::nextafter(1.0, 2.0), -0.3, 5e-324}};
  State<D> state;
  for (int i = 0; i < 3; ++i) {
    state.positions.emplace_back(positions[i].head<D>());
    state.velocities.emplace_back(velocities[i].head<D>());
  }
  for (const bool spinning : {false, true}) {
    Scene scene = spinning ? rough_scene(D) : smooth_scene(D);
    scene.box = Vec<3>(20.0, 18.0, 16.0).head<D>();
    for (int i = 0; spinning && i < 3; ++i) {
      state.spins.emplace_back(spins[i].head<kSpinSize<D>>());
    }
    const State<D> again = read<D>(state_to_csv(state), scene);
    REQUIRE(again.positions.size() == 3);
    REQUIRE(again.spins.size() == state.spins.size());
    for (std::size_t i = 0; i < 3; ++i) {
      CHECK(same(again.positions[i], state.positions[i]));
      CHECK(same(again.velocities[i], state.velocities[i]));
      if (spinning) CHECK(same(again.spins[i], state.spins[i]));
    }
  }
}

/// Two particles at almost one diameter, one of them at a corner of the box or inside it.
template <int D>
void check_no_overlap_hides(const std::vector<Vec<D>>& boxes) {
  for (const Vec<D>& box : boxes) {
    CAPTURE(box.transpose());
    Scene scene = default_scene(D);
    scene.box = box;
    for (int k = 0; k < 64; ++k) {
      const double angle = 0.1 * k, height = D == 2 ? 0.0 : std::sin(0.37 * k);
      const double across = std::sqrt(1.0 - height * height);
      const Vec<3> off(across * std::cos(angle), across * std::sin(angle), height);
      const Vec<D> a = 0.25 * (k % 4) * box;
      Vec<D> b = a + 0.999 * off.head<D>();
      for (int axis = 0; axis < D; ++axis) b[axis] -= box[axis] * std::floor(b[axis] / box[axis]);
      State<D> state;
      state.positions = {a, b};
      state.velocities.resize(2, Vec<D>::Zero());
      CAPTURE(k);
      CHECK(says(state_refusal(state_to_csv(state), scene),
                 "the particles of lines 2 and 3 overlap"));
    }
  }
}

}  // namespace

TEST_CASE("State file: a state is read whatever the order of its columns") {
  const auto disks = read<2>(
      "\xef\xbb\xbf# saved\r\n\r\nvy, x ,y,vx\r\n  # a comment\r\n4,1, 2\t,-3e-1\r\n\r\n"
      "8,5.5,6,7",
      smooth_scene());
  CHECK(disks.positions == std::vector<Vec2>{{1.0, 2.0}, {5.5, 6.0}});
  CHECK(disks.velocities == std::vector<Vec2>{{-0.3, 4.0}, {7.0, 8.0}});
  CHECK(disks.spins.empty());

  const auto spheres = read<3>("vz,z,y,vx,x,vy\n6,3,2,4,1,5\n-6,5.5,5,-4,7,-5\n", smooth_scene(3));
  CHECK(spheres.positions == std::vector<Vec<3>>{{1.0, 2.0, 3.0}, {7.0, 5.0, 5.5}});
  CHECK(spheres.velocities == std::vector<Vec<3>>{{4.0, 5.0, 6.0}, {-4.0, -5.0, -6.0}});
  CHECK(spheres.spins.empty());
}

TEST_CASE(
    "State file: spins are read where the scene has them, and are zero where the file has none") {
  const auto disks = [](const std::string& csv) { return read<2>(csv, rough_scene()).spins; };
  CHECK(disks("x,y,vx,vy,omega\n1,2,3,4,-5\n") == std::vector{Spin<2>(-5.0)});
  CHECK(disks(kHeader + "1,2,3,4\n") == std::vector{Spin<2>(0.0)});

  const auto spheres = [](const std::string& csv) { return read<3>(csv, rough_scene(3)).spins; };
  CHECK(spheres("omega_z,x,y,z,vx,omega_y,vy,vz,omega_x\n9,1,2,3,4,8,5,6,7\n") ==
        std::vector{Spin<3>(7.0, 8.0, 9.0)});
  CHECK(spheres("x,y,z,vx,vy,vz,omega_y\n1,2,3,4,5,6,-7\n") ==
        std::vector{Spin<3>(0.0, -7.0, 0.0)});
  CHECK(spheres(kSphereHeader + "1,2,3,4,5,6\n") == std::vector{Spin<3>(0.0, 0.0, 0.0)});
}

TEST_CASE("State file: a state may have no particles") {
  CHECK(read<2>(kHeader, smooth_scene()).positions.empty());
  CHECK(read<3>(kSphereHeader, smooth_scene(3)).positions.empty());
}

TEST_CASE("State file: a state that was written reads back to the same bits") {
  check_bits<2>();
  check_bits<3>();
}

TEST_CASE("State file: mistakes are reported with their place and a fix") {
  struct Case {
    std::string csv, place, word;
    Scene scene = smooth_scene();
  };
  const std::vector<Case> cases = {
      // the header
      {"# nothing\n\n", "", "begin the file with the line x,y,vx,vy"},
      {"1,2,3,4\n", "1:1:", "unknown column \"1\""},
      {"\nx,y,vx, vyy\n", "2:9:", "did you mean \"vy\"?"},
      {"x,y,vx,vy,\n", "1:11:", "unknown column \"\""},
      {"x,y,vx\n", "1:1:", "\"vy\" is missing"},
      {"x,y,x,vx,vy\n", "1:5:", "second column \"x\""},
      {"x,y,vx,vy,omega\n", "1:11:", "nothing spins"},
      {kSphereHeader, "1:5:", "unknown column \"z\""},
      {"", "", "x,y,z,vx,vy,vz", smooth_scene(3)},
      {kHeader, "1:1:", "\"z\" is missing", smooth_scene(3)},
      {"x,y,z,vx,vy,vz,charge\n", "1:16:", "omega_x, omega_y, omega_z", smooth_scene(3)},
      {"x,y,z,vx,vy,vz,omega\n", "1:16:", "did you mean \"omega_", rough_scene(3)},
      {"x,y,z,vx,vy,vz,omega_z\n", "1:16:", "nothing spins", smooth_scene(3)},
      // numbers
      {kHeader + "1,2,3\n", "2:1:", "3 cells, the header has 4"},
      {kHeader + "1,2,3,4,5\n", "2:1:", "5 cells, the header has 4"},
      {kHeader + "\n1, 2e,3,4\n", "3:4:", "\"2e\""},
      {kHeader + "1,2,nan,4\n", "2:5:", "\"nan\""},
      {kHeader + "1,2,3,-inf\n", "2:7:", "\"-inf\""},
      {kHeader + "1,2,3,1e999\n", "2:7:", "\"1e999\""},
      {kHeader + "+-1,2,3,4\n", "2:1:", "\"+-1\""},
      {kHeader + "0x1,2,3,4\n", "2:1:", "\"0x1\""},
      {kHeader + "1,,3,4\n", "2:3:", "\"\""},
      {kHeader + "1,2,1e16,4\n", "2:5:", "1e+15"},
      {"x,y,vx,vy,omega\n1,2,3,4,-1e16\n", "2:9:", "omega is -1e+16", rough_scene()},
      {kSphereHeader + "1,2,3z,4,5,6\n", "2:5:", "\"3z\"", smooth_scene(3)},
      {kSphereHeader + "1,2,3,4,5,-1e16\n", "2:11:", "vz is -1e+16", smooth_scene(3)},
      {"x,y,z,vx,vy,vz,omega_x,omega_y,omega_z\n1,2,3,4,5,6,7,8,1e16\n",
       "2:17:", "omega_z is 1e+16", rough_scene(3)},
      // places
      {kHeader + "1,2,3,4\n10.5,2,3,4\n", "3:1:", "give a number between 0 and 10"},
      {kHeader + "1,-1e-9,3,4\n", "2:3:", "y = -1e-09 lies outside the box"},
      {kHeader + "9.6,2,3,4\n", "2:1:", "right wall; give a number between 2 and 9.5",
       walled_scene()},
      {kHeader + "1.9,2,3,4\n", "2:1:", "the phase of the wall", walled_scene()},
      {kSphereHeader + "1,2,6.5,3,4,5\n", "2:5:", "give a number between 0 and 6", smooth_scene(3)},
      {kSphereHeader + "1,2,5.6,3,4,5\n", "2:5:", "front wall", deep_state_scene()},
      {kSphereHeader + "1,2,1.9,3,4,5\n", "2:5:", "back wall", deep_state_scene()},
      // overlaps
      {kHeader + "1,2,3,4\n\n5,5,0,0\n1.5,2,3,4\n", "5:1:", "lines 2 and 5 overlap by 0.5"},
      {kHeader + "9.75,2,3,4\n0.25,2,3,4\n", "3:1:", "lines 2 and 3 overlap by 0.5"},
      {kHeader + "5,7.9,3,4\n5,0.1,3,4\n", "3:1:", "lines 2 and 3 overlap by 0.8"},
      {kHeader + "5,2,0,0\n5,2,0,0\n", "3:1:", "lines 2 and 3 overlap by 1 diam"},
      {kHeader + "5,2,0,0\n6,1.99999,0,0\n5,2.99999999999,0,0\n",
       "4:1:", "lines 2 and 4 overlap by 1e-11"},
      {kSphereHeader + "1,2,3,0,0,0\n\n5,5,3,0,0,0\n1,2,3.75,0,0,0\n",
       "5:1:", "lines 2 and 5 overlap by 0.25", smooth_scene(3)},
      {kSphereHeader + "9.75,7.75,5.75,0,0,0\n0.25,0.25,0.25,0,0,0\n",
       "3:1:", "lines 2 and 3 overlap by 0.134", smooth_scene(3)},
  };
  for (const Case& mistake : cases) {
    CAPTURE(mistake.csv);
    const std::string what = state_refusal(mistake.csv, mistake.scene);
    CAPTURE(what);
    CHECK(what.starts_with("a.csv:" + mistake.place + " "));
    CHECK(says(what, mistake.word));
  }
}

TEST_CASE("State file: particles may touch each other or a wall, up to rounding") {
  CHECK(state_refusal(kHeader + "5,2,0,0\n5,2.9999999999995,0,0\n6,2,0,0\n") == "");
  CHECK(state_refusal(kHeader + "1.9999999999995,2,0,0\n9.5,2,0,0\n", walled_scene()) == "");
  CHECK(state_refusal(kHeader + "9.75,2,3,4\n0.5,7,3,4\n0.75,2,0,0\n") == "");
  // Positions do not wrap at walls.
  CHECK(state_refusal(kHeader + "9.5,2,3,4\n2.5,7,3,4\n2.5,0.5,3,4\n9.5,3,0,0\n", walled_scene()) ==
        "");

  const auto of_spheres = [](const std::string& csv, const Scene& scene) {
    return state_refusal(kSphereHeader + csv, scene);
  };
  // Across a periodic border these would overlap.
  Scene flat = smooth_scene(3);
  flat.box[2] = 2.0;
  flat.walls[kBack] = flat.walls[kFront] =
      Wall{.kind = WallKind::Sinusoidal, .stroke = 0.5, .frequency = 1.0, .phase = 0.75};
  CHECK(of_spheres("5,2,1.75,0,0,0\n5,2,0.25,0,0,0\n", flat) == "");
}

TEST_CASE(
    "State file: particles may be anywhere outside the walls at time 0, also outside the box") {
  CHECK(state_refusal(kHeader + "2.1,2,0,0\n", walled_scene()) == "");  // in the range of the wall
  Scene scene = walled_scene();
  scene.walls[kRight] =
      Wall{.kind = WallKind::Sinusoidal, .stroke = 2.0, .frequency = 1.0, .phase = 0.75};
  CHECK(state_refusal(kHeader + "10.4,2,0,0\n10.4,3,0,0\n", scene) == "");
  CHECK(says(state_refusal(kHeader + "10.6,2,0,0\n", scene), "overlaps the right wall"));
  CHECK(says(state_refusal(kHeader + "10.4,2,0,0\n10.4,2.9,0,0\n", scene), "overlap by 0.1"));
}

TEST_CASE("State file: no overlap hides, in boxes of any shape") {
  check_no_overlap_hides<2>({{1.2, 40.0}, {2.5, 30.0}, {3.1, 3.2}, {1e6, 1e6}});
  check_no_overlap_hides<3>(
      {{1.2, 40.0, 2.5}, {2.5, 1.1, 30.0}, {30.0, 2.3, 1.2}, {3.1, 3.2, 3.3}, {1e6, 1e6, 1e6}});
}

// A comparison of all pairs would take hours.
TEST_CASE("State file: a million particles are read, each compared with its neighbours only") {
  Scene scene = default_scene(2);
  scene.box = Vec2(1100.0, 1100.0);
  State<2> state;
  for (int i = 0; i < 1'000'000; ++i) {
    state.positions.emplace_back(1.0999 * (i % 1000) + 0.5, 1.0999 * (i / 1000) + 0.5);
    state.velocities.emplace_back(1.0 / (i + 1), 2.0 / 3.0);
  }
  CHECK(read<2>(state_to_csv(state), scene).positions == state.positions);
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

  // The path in a written scene is relative to the working folder, and the scene can be read again.
  const Scene again = parse_scene(scene_to_toml(scene), "s.toml");
  CHECK(again.particles.start.file == csv_path);
  CHECK(again.particles.start.state == scene.particles.start.state);
  CHECK(says(scene_to_json(scene), "\"layout\": \"file\", \"file\": "));

  // A path on the command line is relative to the working folder.
  CHECK(load_scene("vibrated",
                   {{"particles.start", "{layout = \"file\", file = \"" + csv_path + "\"}"},
                    {"particles.count", "2"}})
            .particles.start.file == csv_path);
  CHECK(says(load_refusal(scene_path, {{"particles.start.file", "a.csv"}}),
             "--set particles.start.file: there is no file 'a.csv'; "));
}

TEST_CASE("State file: a count must equal the number of particles in the state") {
  const TemporaryFolder folder;
  const std::string start = "[particles.start]\nlayout = \"file\"\nfile = \"a.csv\"\n";
  folder.write("a.csv", kHeader + "1,2,3,4\n5,6,7,8\n");
  CHECK(load_scene(folder.write("s.toml", "[particles]\ncount = 2\n" + start)).particles.count ==
        2);
  const std::string path = folder.write("s.toml", "[particles]\ncount = 3\n" + start);
  CHECK(says(load_refusal(path), path + ":2:1: this asks for 3 particles, and "));
}

TEST_CASE("State file: a missing file gets a suggestion, and a mistake its own place") {
  const TemporaryFolder folder;
  const std::string path =
      folder.write("s.toml", "[particles.start]\nlayout = \"file\"\nfile = \"pol.csv\"\n");
  const std::string csv_path = folder.write("pool.csv", kHeader + "1,2,3,x\n");
  CHECK(says(load_refusal(path), path + ":3:1: "));
  CHECK(says(load_refusal(path), "did you mean 'pool.csv'?"));
  std::filesystem::rename(csv_path, folder / "pol.csv");
  CHECK(says(load_refusal(path), "pol.csv:2:7: \"x\""));
}
