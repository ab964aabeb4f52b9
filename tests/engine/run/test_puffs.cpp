// Puffs: particles that enter the gas by [[change]].

#include <doctest/doctest.h>

#include <cmath>

#include "engine/error.h"
#include "engine/live/watched_run.h"
#include "engine/run/scheduled_run.h"
#include "engine/scene/change_dimension.h"
#include "engine/scene/scene_file.h"
#include "engine/text.h"
#include "tests/engine/scene/refusal.h"

using namespace clatter;
using namespace clatter::testing;

namespace {

constexpr std::uint64_t kPuffSeed = 31;

// At t = 2 a kick of the bulk drive comes before the change of laws, and both before the puff.
const std::string kPuffed =
    "box.size = [16, 12]\nparticles = { count = 30, restitution = 0.9, friction = 0.5 }\n"
    "walls.left = { kind = 'driven', drive_speed = 0.3 }\nwalls.right = { kind = 'static' }\n"
    "walls.bottom = { kind = 'sinusoidal', stroke = 0.4, frequency = 1.5 }\n"
    "walls.top = { kind = 'thermal', temperature = 1.0 }\ncollapse.contact_time = 1e-4\n"
    "gravity.acceleration = [0.0, -0.1]\nbulk_drive = { interval = 0.5, kick_speed = 0.05 }\n"
    "[[change]]\ntime = 1.5\npiston = 13.0\nuntil = 2.5\n"
    "[[change]]\ntime = 2.0\nset = { 'particles.restitution' = 0.8 }\n"
    "[[change]]\ntime = 2.0\npuff = { count = 9, centre = [16, 0], radius = 7, temperature = 2 }\n"
    "[[change]]\ntime = 3.3\npuff = { count = 5, centre = [2, 8], radius = 4, velocity = [1, 0] }\n"
    "[[change]]\ntime = 3.3\nnudge = { particle = 43, set = [-3.0, 1.0] }\n";

Scene puffed() {
  return parse_scene(kPuffed, "s.toml");
}

// A dilute periodic gas, just before and after a puff of 900 particles at t = 1.
template <int D>
struct Puffs {
  static constexpr double kBox = D == 2 ? 400.0 : 90.0, kRadius = D == 2 ? 150.0 : 40.0;
  State<D> before, after;

  Puffs() {
    const std::string sides = number_text(kBox) + ", " + number_text(kBox);
    const std::string gas = "box.size = [" + sides + (D == 2 ? "" : ", " + number_text(kBox)) +
                            "]\nparticles.count = 20\n";
    const std::string rest = D == 2 ? "" : ", 45";
    ScheduledRun<D> plain(parse_scene(gas, ""), kPuffSeed);
    ScheduledRun<D> run(
        parse_scene(gas + "[[change]]\ntime = 1\npuff = { count = 900, centre = [5, 45" + rest +
                        "], radius = " + number_text(kRadius) +
                        ", temperature = 3, velocity = [-2, 0.5" + (D == 2 ? "" : ", 4") + "] }\n",
                    ""),
        kPuffSeed);
    plain.run_until(1.0);
    run.run_until(1.0);
    before = plain.simulation().state();
    after = run.simulation().state();
  }
};

// Of 900 particles, with relative standard errors of 2 to 3 %. The widths are 5 standard errors.
template <int D>
void check_places_and_velocities() {
  const Puffs<D> puff;
  REQUIRE(puff.after.positions.size() == 920);
  for (std::size_t i = 0; i < 20; ++i) {
    CHECK(puff.after.positions[i] == puff.before.positions[i]);
    CHECK(puff.after.velocities[i] == puff.before.velocities[i]);
  }
  Vec<D> centre = Vec<D>::Constant(45.0), drift = Vec<D>::Constant(4.0);
  centre[0] = 5.0;
  drift[0] = -2.0;
  drift[1] = 0.5;
  double share = 0.0, squares = 0.0;
  Vec<D> sum = Vec<D>::Zero(), side = Vec<D>::Zero();
  for (std::size_t i = 20; i < 920; ++i) {
    Vec<D> way = puff.after.positions[i] - centre;
    for (double& x : way) x -= Puffs<D>::kBox * std::round(x / Puffs<D>::kBox);
    CHECK(way.norm() <= Puffs<D>::kRadius * (1.0 + 1e-12));
    share += std::pow(way.norm() / Puffs<D>::kRadius, D) / 900.0;
    side += way / (Puffs<D>::kRadius * 900.0);
    sum += (puff.after.velocities[i] - drift) / 900.0;
    squares += (puff.after.velocities[i] - drift).squaredNorm() / (900.0 * D * 3.0);
  }
  CHECK(std::fabs(share - 0.5) < 5.0 * std::sqrt(1.0 / 12.0 / 900.0));
  CHECK(std::fabs(squares - 1.0) < 5.0 * std::sqrt(2.0 / (900.0 * D)));
  for (int axis = 0; axis < D; ++axis) {
    CHECK(std::fabs(sum[axis]) < 5.0 * std::sqrt(3.0 / 900.0));
    CHECK(std::fabs(side[axis]) < 5.0 * std::sqrt(1.0 / (D + 2) / 900.0));
  }
}

Frame puffed_frame(WatchedRun& run) {
  Frame frame;
  run.fill(frame, true);
  return frame;
}

// The hash at a time of a run of the scene that a frame would save.
std::uint64_t hash_of_recorded(const Frame& frame, double time) {
  Scene scene = *frame.started;
  scene.changes = frame.scene->changes;
  ScheduledRun<2> alone(parse_scene(scene_to_toml(scene), "saved.toml"), kPuffSeed);
  alone.run_until(time);
  return alone.simulation().state_hash();
}

}  // namespace

TEST_CASE("Puff: places are uniform in the region, velocities Gaussian, and other particles stay") {
  SUBCASE("disks") {
    check_places_and_velocities<2>();
  }
  SUBCASE("spheres") {
    check_places_and_velocities<3>();
  }
}

TEST_CASE("Puff: two puffs of a run have different places and velocities") {
  const auto puff = [](const char* x) {
    return std::string("[[change]]\ntime = 1\npuff = { count = 3, centre = [") + x +
           ", 20], radius = 20 }\n";
  };
  ScheduledRun<2> run(
      parse_scene("box.size = [80, 40]\nparticles.count = 0\n" + puff("20") + puff("60"), ""),
      kPuffSeed);
  run.run_until(1.0);
  const State<2> state = run.simulation().state();
  REQUIRE(state.positions.size() == 6);
  for (std::size_t i = 0; i < 3; ++i) {
    CHECK((state.positions[i + 3] - state.positions[i] - Vec2(40.0, 0.0)).norm() > 1e-3);
    CHECK(state.velocities[i + 3] != state.velocities[i]);
  }
}

TEST_CASE("Puff: no particle overlaps another, a moving wall or the piston") {
  ScheduledRun<2> run(puffed(), kPuffSeed);
  for (const double time : {2.0, 3.3, 9.0}) {
    run.run_until(time);
    CHECK(run.simulation().deepest_overlap() < 1e-12);
    CHECK(run.simulation().checks().deepest_overlap < 1e-12);
  }
  CHECK(run.simulation().particles().size() == 44);
  CHECK(run.laws().particles.count == 30);
  CHECK(run.present_scene().particles.count == 44);

  // The wall moves by 1.25 to either side of y = 0. A disk there would be hit.
  const Scene above = parse_scene(
      "box.size = [40, 10]\nparticles.count = 1\nwalls.top = { kind = 'static' }\n"
      "walls.bottom = { kind = 'sinusoidal', stroke = 2.5, frequency = 0.1 }\n"
      "[[change]]\ntime = 0.1\n"
      "puff = { count = 15, centre = [20, 0], radius = 5, temperature = 0 }\n",
      "");
  ScheduledRun<2> waiting(above, kPuffSeed);
  waiting.run_until(0.1);
  for (const Vec2& place : waiting.simulation().positions()) CHECK(place.y() >= 1.75);
}

TEST_CASE("Puff: its energy has its own sum, and the ledger stays closed") {
  const auto run = watched_run(puffed(), kPuffSeed);
  run->run_until(std::nextafter(2.0, 0.0), kNoLimit, kNoLimit);
  const double before = puffed_frame(*run).tally.nudges_in;
  run->run_until(2.0, kNoLimit, kNoLimit);
  const Frame after = puffed_frame(*run);
  double energy = 0.0;
  const State<2> state = std::get<State<2>>(run->state());
  for (std::size_t i = 30; i < 39; ++i) energy += 0.5 * state.velocities[i].squaredNorm();
  CHECK(before == 0.0);
  CHECK(energy > 5.0);
  CHECK(after.tally.nudges_in == doctest::Approx(energy).epsilon(1e-12));
  run->run_until(6.0, kNoLimit, kNoLimit);
  CHECK(puffed_frame(*run).ledger_residual < 1e-12);
}

TEST_CASE("Puff: halts, a saved scene and a run continued at any event change no bit") {
  const Scene scene = puffed();
  ScheduledRun<2> whole(scene, kPuffSeed);
  whole.run_until(5.0);
  REQUIRE(whole.simulation().counts().puffs == 2);
  ScheduledRun<2> again(parse_scene(scene_to_toml(scene), "again.toml"), kPuffSeed);
  again.show(scene.view);
  bool arrived = false;
  while (!arrived) {
    arrived = again.run_until(5.0, kNoLimit, again.simulation().counts().steps() + 1);
    if (again.simulation().counts().steps() % 7 != 0) continue;
    ScheduledRun<2> rest(scene, kPuffSeed, again.simulation().save());
    rest.run_until(5.0);
    CHECK(rest.simulation().state_hash() == whole.simulation().state_hash());
  }
  CHECK(again.simulation().state_hash() == whole.simulation().state_hash());
}

TEST_CASE("Puff: a run saved just before or after the puff of its time makes it once") {
  const Scene scene = puffed();
  Scene first_part = scene;
  std::erase_if(first_part.changes,
                [](const Change& change) { return change.time > 2.0 || change.puff; });
  ScheduledRun<2> before(first_part, kPuffSeed);
  before.run_until(2.0);
  ScheduledRun<2> rest(scene, kPuffSeed, before.simulation().save()), whole(scene, kPuffSeed);
  rest.run_until(6.0);
  whole.run_until(6.0);
  CHECK(rest.simulation().state_hash() == whole.simulation().state_hash());

  for (const double time : {2.0, 3.3}) {
    ScheduledRun<2> halted(scene, kPuffSeed);
    halted.run_until(time);
    ScheduledRun<2> after(scene, kPuffSeed, halted.simulation().save());
    after.run_until(6.0);
    CHECK(after.simulation().state_hash() == whole.simulation().state_hash());
  }
}

TEST_CASE("Puff: time travel returns to the bits and the particles before and after it") {
  const Scene scene = puffed();
  const auto run = watched_run(scene, kPuffSeed);
  run->run_until(6.0, kNoLimit, kNoLimit);
  for (const double time : {5.0, 1.9, 2.0, 3.3, 3.2, 0.5, 4.4}) {
    ScheduledRun<2> fresh(scene, kPuffSeed);
    fresh.run_until(time);
    run->go_back(time);
    while (run->time() < time) run->run_until(time, kNoLimit, run->counts().steps() + 100);
    const Frame frame = puffed_frame(*run);
    CHECK(*frame.state_hash == fresh.simulation().state_hash());
    CHECK(frame.snapshot.angles.size() == frame.snapshot.count());
    CHECK(frame.scene->particles.count == static_cast<int>(frame.snapshot.count()));
    CHECK(frame.started->particles.count == 30);
  }
}

TEST_CASE("Puff: tiles change no bit") {
  const Scene scene = parse_scene(
      "box.size = [60, 60]\nparticles.count = 900\n"
      "[[change]]\ntime = 0.4\npuff = { count = 60, centre = [30, 30], radius = 25 }\n",
      "");
  ScheduledRun<2> one(scene, kPuffSeed), two(scene, kPuffSeed);
  const TileSizes sizes{.particles = 100, .collisions = 1.0, .halo = 4.0};
  two.simulation().use_threads(2, sizes);
  one.run_until(1.5);
  two.run_until(0.4);
  two.simulation().use_threads(2, sizes);
  two.run_until(1.5);
  CHECK(two.simulation().tiles() > 1);
  CHECK(two.simulation().foresight()->work().windows > 0);
  CHECK(one.simulation().state_hash() == two.simulation().state_hash());
}

TEST_CASE("Puff: trails and rotations of the new particles begin at it") {
  Scene scene = puffed();
  scene.view.trails = 0.5;
  ScheduledRun<2> run(scene, kPuffSeed);
  run.show(scene.view);
  run.run_until(2.1);
  const Snapshot gas = run.snapshot();
  CHECK(gas.angles.size() == 39);
  double earliest_old = 0.0, earliest_new = 0.0;
  for (const FlightPiece& piece : gas.flights) {
    double& earliest = piece.particle < 30 ? earliest_old : earliest_new;
    earliest = std::min(earliest, piece.from);
  }
  CHECK(earliest_old == doctest::Approx(-0.5));
  CHECK(earliest_new == doctest::Approx(-0.1));
}

TEST_CASE("Puff: without room, or too fast, it stops the run, and the state remains") {
  const std::string gas = "box.size = [12, 10]\nparticles.count = 40\n[[change]]\ntime = 1\n";
  ScheduledRun<2> full(
      parse_scene(gas + "puff = { count = 80, centre = [3, 3], radius = 3 }\n", ""), kPuffSeed);
  CHECK_THROWS_AS(full.run_until(2.0), PhysicalStop);
  CHECK(full.simulation().particles().size() == 40);
  CHECK(full.simulation().counts().puffs == 0);
  CHECK(full.simulation().time() == 1.0);

  ScheduledRun<2> fast(
      parse_scene(
          gas + "puff = { count = 2, centre = [3, 3], radius = 4, velocity = [1e15, 1e15] }\n", ""),
      kPuffSeed);
  CHECK_THROWS_WITH_AS(fast.run_until(2.0),
                       "a puff gives particle 40 a speed above 1e+15; make it colder",
                       PhysicalStop);
}

TEST_CASE("Puff: by hand it is recorded at its time, and a run of its scene has the same bits") {
  const Scene scene =
      parse_scene("box.size = [12, 10]\nparticles = { count = 30, restitution = 0.9 }\n", "");
  for (const double at : {0.0, 1.7}) {
    CAPTURE(at);
    const auto run = watched_run(scene, kPuffSeed);
    run->run_until(at, kNoLimit, kNoLimit);
    const Puff puff{.count = 7, .centre = Vec2(6.0, 5.0), .radius = 4.0, .temperature = 2.0};
    run->puff(puff, 0.01);
    // A particle of the puff can be thrown.
    run->nudge({.particle = 36, .add = Vec2(0.0, 2.0)}, 0.0);
    Frame frame = puffed_frame(*run);
    REQUIRE(frame.scene->changes.size() == 2);
    CHECK(frame.scene->changes[0].puff == puff);
    CHECK(frame.scene->changes[0].time > 0.0);
    CHECK(frame.scene->changes[0].time >= at);
    CHECK(frame.scene->changes[0].time <= at + 0.01);
    CHECK(hash_of_recorded(frame, run->time()) == *frame.state_hash);
    run->run_until(6.0, kNoLimit, kNoLimit);
    CHECK(hash_of_recorded(puffed_frame(*run), 6.0) == *puffed_frame(*run).state_hash);
    CHECK_THROWS_AS(run->puff({.count = 1, .centre = Vec2(13.0, 5.0), .radius = 2.0}, 0.0),
                    UserError);
    CHECK(puffed_frame(*run).scene->changes.size() == 2);
    // As many enter as find room.
    run->puff({.count = 200, .centre = Vec2(6.0, 5.0), .radius = 4.0}, 0.0);
    const std::size_t full = std::get<State<2>>(run->state()).positions.size();
    CHECK(full > 38);
    CHECK(full < 100);
    CHECK(puffed_frame(*run).scene->changes[2].puff->count == static_cast<int>(full) - 37);
    CHECK(hash_of_recorded(puffed_frame(*run), run->time()) == *puffed_frame(*run).state_hash);
    CHECK_THROWS_AS(run->puff({.count = 200, .centre = Vec2(6.0, 5.0), .radius = 1.0}, 0.0),
                    UserError);
    // The throw would come before the particle.
    CHECK_THROWS_AS(run->move_change(0, 5.0), UserError);
  }
}

TEST_CASE("Puff: impossible ones are refused with their place") {
  const std::string gas = "box.size = [12, 10]\nparticles.count = 30\n[[change]]\ntime = 1\n";
  const std::vector<std::pair<std::string, std::vector<const char*>>> wrong = {
      {"puff = { centre = [1, 1], radius = 2 }\n", {"s.toml:5:", "'change.puff.count' is missing"}},
      {"puff = { count = 3, radius = 2 }\n", {"s.toml:5:", "'change.puff.centre' is missing"}},
      {"puff = { count = 3, centre = [1, 1] }\n", {"s.toml:5:", "'change.puff.radius' is missing"}},
      {"puff = { count = 0, centre = [1, 1], radius = 2 }\n", {"s.toml:5:10", "between 1"}},
      {"puff = { count = 3, centre = [1, 1, 1], radius = 2 }\n",
       {"s.toml:5:21", "'centre' of the puff has 3 numbers"}},
      {"puff = { count = 3, centre = [1, 1], radius = 2, velocity = [1, 1, 1] }\n",
       {"s.toml:5:50", "'velocity' of the puff has 3 numbers"}},
      {"puff = { count = 3, centre = [1, 11], radius = 2 }\n",
       {"s.toml:5:21", "the centre of the puff is outside of the box, at 11 along y"}},
      {"puff = { count = 3, centre = [1, 1], radius = 2 }\nset = { 'particles.restitution' = 0.5 "
       "}\n",
       {"s.toml:5:8", "a puff has no other key beside time"}},
      {"puff = { count = 3, centre = [1, 1], radius = 2 }\n[[change]]\ntime = 0.9\n"
       "nudge = { particle = 30, set = [1, 0] }\n",
       {"s.toml:8:11", "there is no particle 30"}},
  };
  for (const auto& [text, parts] : wrong) {
    CAPTURE(text);
    const std::string message = refusal(gas + text);
    CAPTURE(message);
    for (const char* part : parts) CHECK(says(message, part));
  }
  CHECK_NOTHROW(parse_scene(gas + "puff = { count = 3, centre = [1, 1], radius = 2 }\n[[change]]\n"
                                  "time = 1\nnudge = { particle = 32, set = [1, 0] }\n",
                            "s.toml"));
}

TEST_CASE("Puff: another dimension removes it") {
  CHECK(change_dimension(puffed(), 3).scene.changes.size() == 1);
}
