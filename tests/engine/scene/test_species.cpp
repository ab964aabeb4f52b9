// Species of a scene: their keys, laws, diameters, starts, files and changes.

#include <doctest/doctest.h>

#include <algorithm>
#include <chrono>
#include <cmath>
#include <numbers>
#include <string>
#include <vector>

#include "engine/initial/mixture_state.h"
#include "engine/initial/start_state.h"
#include "engine/physics/elementary.h"
#include "engine/run/scheduled_run.h"
#include "engine/scene/state_file.h"
#include "tests/engine/scene/refusal.h"
#include "tests/engine/support/gas.h"
#include "tests/engine/support/models.h"

using namespace clatter;
using namespace clatter::testing;

namespace {

constexpr std::uint64_t kSpeciesSeed = 17;

// Two species with every key, between walls of each kind that a species can differ at.
const std::string kMixture = R"(box.size = [30, 20]
[particles]
restitution = 0.9
friction = 0.25
inertia = 0.4
[particles.start]
temperature = 2.0
spin_temperature = 0.5
[[species]]
name = "small"
count = 100
[[species]]
name = "large-2"
area_fraction = 0.2
diameter = 2.0
density = 0.5
inertia = 0.3
polydispersity = { kind = "gaussian", width = 0.1 }
colour = "#c03030"
[[species]]
name = "heavy"
count = 7
diameter = 1.5
mass = 40.0
[[pair]]
species = ["large-2", "small"]
restitution = 0.8
tangential_restitution = 0.1
[[pair]]
species = ["heavy", "heavy"]
friction = 0.0
[walls.left]
kind = "thermal"
temperature = 3.0
[walls.left.species.heavy]
temperature = 0.5
[walls.right]
kind = "static"
restitution = 0.95
[walls.right.species.small]
restitution = 0.7
friction = 0.1
[walls.bottom]
kind = "driven"
drive_speed = 1.0
[walls.bottom.species.large-2]
drive_speed = 2.0
[walls.top]
kind = "sawtooth"
stroke = 0.2
frequency = 3.0
[bulk_drive]
interval = 0.1
kick_speed = 0.05
law = "energy"
[measure]
observables = ["mixing"]
mixing = { interval = 0.75, cell = 2.5 }
)";

const std::string kPlain = R"(box.size = [10, 10]
[[species]]
name = "a"
count = 3
[[species]]
name = "b"
count = 4
diameter = 0.5
)";

Scene mixture(const std::vector<Override>& overrides = {}) {
  return parse_scene(kMixture, "s.toml", overrides);
}

}  // namespace

// The values are those of Python's statistics.NormalDist, cut at 3.
TEST_CASE("Quantiles: a normal variable that is cut at 3 has those of another program") {
  for (const auto& [share, wanted] : {std::pair{0.5, 0.0},
                                      {0.6, 0.25264835601647306},
                                      {0.9, 1.2754222234675783},
                                      {0.01, -2.279357877103891},
                                      {0.999, 2.827288835871114},
                                      {0.0, -3.0},
                                      {1.0, 3.0}}) {
    CAPTURE(share);
    CHECK(cut_normal_quantile(share) == doctest::Approx(wanted).epsilon(1e-12));
  }
  for (const double x : {-20.0, -3.7, -1e-3, 0.0, 0.4, 12.0, 20.0}) {
    CHECK(exponential(x) == doctest::Approx(std::exp(x)).epsilon(1e-12));
  }
}

TEST_CASE("Species: the keys reach the laws of the run") {
  const Scene scene = mixture();
  REQUIRE(scene.species.size() == 3);
  const Model<2> model = model_of<2>(scene, kSpeciesSeed);
  REQUIRE(model.species);
  CHECK(model.pair(0, 0).restitution == 0.9);
  CHECK(model.pair(0, 1).restitution == 0.8);
  CHECK(model.pair(1, 0).restitution == 0.8);
  CHECK(model.pair(2, 2).restitution == 0.9);
  CHECK(model.pair(0, 1).roughness.friction == 0.25);
  CHECK(model.pair(1, 0).roughness.tangential_restitution == 0.1);
  CHECK_FALSE(model.pair(2, 2).roughness.any());
  CHECK(model.wall(kLeft, 0).temperature == 3.0);
  CHECK(model.wall(kLeft, 2).temperature == 0.5);
  CHECK(model.wall(kRight, 0).restitution == 0.7);
  CHECK(model.wall(kRight, 0).roughness.friction == 0.1);
  CHECK(model.wall(kRight, 1).restitution == 0.95);
  CHECK_FALSE(model.wall(kRight, 1).roughness.any());
  CHECK(model.wall(kBottom, 1).drive_speed == 2.0);
  CHECK(model.wall(kBottom, 2).drive_speed == 1.0);
  CHECK(model.wall(kTop, 2).frequency == 3.0);
  CHECK(model.bulk_drive->law == KickLaw::Energy);
  CHECK(model.diameter == doctest::Approx(2.6));  // 2 (1 + 3 * 0.1)
}

// An area fraction of .2 of 600 are 120; a disk has pi/4 <d^2> = pi (1 + s^2), where the variance
// s^2 = .01 is reduced by the cut at 3 to .97334 of it.
TEST_CASE("Species: counts, diameters and masses are those of the keys") {
  const Scene scene = mixture();
  const int of_second =
      static_cast<int>(std::lround(120.0 / (std::numbers::pi * (1.0 + 0.01 * 0.97334))));
  CHECK(scene.species[1].count == of_second);
  CHECK(scene.particles.count == 107 + of_second);
  const std::vector<Grain> grains = grains_of(scene);
  REQUIRE(static_cast<int>(grains.size()) == scene.particles.count);
  double first = 0.0, second = 0.0, area = 0.0;
  for (const Grain& grain : grains) {
    const double diameter = 2.0 * grain.radius;
    area += 0.25 * std::numbers::pi * diameter * diameter;
    if (grain.species == 0) CHECK(grain == Grain{.radius = 0.5, .mass = 1.0, .inertia = 0.4});
    if (grain.species == 2) {
      CHECK(grain == Grain{.radius = 0.75, .mass = 40.0, .inertia = 0.4, .species = 2});
    }
    if (grain.species != 1) continue;
    CHECK(grain.inertia == 0.3);
    CHECK(grain.mass == doctest::Approx(0.5 * diameter * diameter).epsilon(1e-14));
    first += diameter / of_second;
    second += diameter * diameter / of_second;
  }
  CHECK(first == doctest::Approx(2.0).epsilon(1e-12));
  CHECK(second - first * first == doctest::Approx(0.04 * 0.97334).epsilon(0.02));
  CHECK(scene.packing_fraction() == doctest::Approx(area / 600.0).epsilon(1e-12));
}

TEST_CASE("Species: uniform and lognormal diameters have their mean and width") {
  Species species;
  species.count = 1000;
  species.diameter = 3.0;
  species.polydispersity = Polydispersity{Spread::Uniform, 0.4};
  CHECK(species.mean_power(1) == doctest::Approx(3.0).epsilon(1e-12));
  CHECK(species.mean_power(2) == doctest::Approx(9.0 * (1.0 + 0.16 / 3.0)).epsilon(1e-6));
  CHECK(species.smallest_diameter() == doctest::Approx(1.8));
  CHECK(species.largest_diameter() == doctest::Approx(4.2));
  // The cut removes the tails: 1e-3 of the mean, and some percent of the variance.
  species.polydispersity = Polydispersity{Spread::Lognormal, 0.4};
  const double mean = species.mean_power(1);
  CHECK(mean == doctest::Approx(3.0).epsilon(3e-3));
  CHECK(std::sqrt(species.mean_power(2) - mean * mean) == doctest::Approx(1.2).epsilon(0.04));
}

TEST_CASE("Species: a scene is written and read back, also with new settings") {
  const Scene scene = mixture();
  const std::string text = scene_to_toml(scene);
  const Scene again = parse_scene(text, "again.toml");
  CHECK(again.species == scene.species);
  CHECK(again.pairs == scene.pairs);
  CHECK(again.species_walls == scene.species_walls);
  CHECK(again.measure.mixing.interval == 0.75);
  CHECK(again.measure.mixing.cell == 2.5);
  CHECK(scene_to_toml(again) == text);
  const Scene set = with_settings(
      scene, {{"pair.small.large-2.restitution", "0.5"}, {"pair.small.heavy.friction", "0.75"}});
  CHECK(set.pair_law(1, 0).restitution == 0.5);
  CHECK(set.pair_law(2, 0).roughness.friction == 0.75);
  CHECK(set.pair_law(2, 0).restitution == 0.9);
}

TEST_CASE("Species: overrides address species and pairs by their names") {
  const Scene scene = mixture({{"species.heavy.density", "3"},
                               {"species.large-2.count", "5"},
                               {"species.small.diameter", "0.5"},
                               {"walls.right.species.heavy.restitution", "0.2"},
                               {"pair.heavy.heavy.restitution", "0.6"}});
  CHECK(scene.species[2].mass_in(2) == doctest::Approx(3.0 * 1.5 * 1.5));
  CHECK(scene.species[1].count == 5);
  CHECK(scene.species[0].mass_in(2) == 0.25);
  CHECK(scene.wall(kRight, 2).restitution == 0.2);
  CHECK(scene.pair_law(2, 2).restitution == 0.6);
  CHECK_FALSE(scene.pair_law(2, 2).roughness.any());
}

// The lists of fields contain the names of all species, so they must not be made first.
TEST_CASE("Species: too many are refused at once") {
  const auto refusal = [](int count) {
    std::string text;
    for (int k = 0; k < count; ++k) {
      text += "[[species]]\nname = \"s" + std::to_string(k) + "\"\ncount = 1\n";
    }
    return refusal_of([&] { parse_scene(text, "s.toml"); });
  };
  CHECK_FALSE(says(refusal(100), "species; give at most"));
  const auto began = std::chrono::steady_clock::now();
  const std::string message = refusal(20000);
  CHECK(std::chrono::steady_clock::now() - began < std::chrono::seconds(10));
  CHECK(message.starts_with("s.toml:302:"));
  CHECK(says(message, "give at most 100"));
}

TEST_CASE("Species: mistakes are reported with their place and a fix") {
  struct Case {
    std::string text, place, word;
  };
  const auto with = [](const std::string& more) { return kPlain + more; };
  const std::string pair = "[[pair]]\nspecies = ";
  for (const auto& [text, place, word] : std::vector<Case>{
           {"[[species]]\ncount = 1\n", "1:1", "'species.name' is missing"},
           {"[[species]]\nname = \"a b\"\ncount = 1\n", "2:1", "letters, digits, _ and -"},
           {"[[species]]\nname = \"error\"\ncount = 1\n", "2:1", "\"error\" as the last word"},
           {"[[species]]\nname = \"a_error\"\ncount = 1\n", "2:1", "cannot be the name"},
           {with("[[species]]\nname = \"a\"\ncount = 1\n"), "10:1", "a name of its own"},
           {with("[[species]]\nname = \"c\"\n"), "10:1", "exactly one of 'count'"},
           {with("[[species]]\nname = \"c\"\ncount = 1\narea_fraction = 0.1\n"), "12:1",
            "exactly one of 'count'"},
           {with("mass = 0\n"), "9:1", "between 1e-09 and 1e+09"},
           {with("mass = 2\ndensity = 1\n"), "10:1", "has no meaning beside mass"},
           {with("polydispersity = { kind = \"gaussian\", width = 0.4 }\n"), "9:39",
            "at most 0.33"},
           {with("polydispersity = { kind = \"uniform\" }\n"), "9:18", "'species.polydispersity"},
           {with("[particles]\ncount = 3\n"), "10:1", "each species its own number"},
           {with(pair + "[\"a\", \"bb\"]\n"), "10:1", "the species are a, b"},
           {with(pair + "[\"a\"]\n"), "10:1", "a list of 2 texts"},
           {with(pair + "[\"a\", \"b\"]\n" + pair + "[\"b\", \"a\"]\n"), "12:1", "one [[pair]]"},
           {with("[walls.left]\nkind = \"static\"\n[walls.left.species.c]\nrestitution = 0\n"),
            "11:1", "unknown key 'c'"},
           {"particles.count = 1\n[walls.left]\nkind = \"static\"\n[walls.right]\nkind = "
            "\"static\"\n[walls.left.species.a]\nfriction = 1\n",
            "6:1", "there is no species \"a\"; add [[species]]"},
           {with("[[change]]\ntime = 1\nset = { \"pair.a.b.species\" = [\"a\", \"a\"] }\n"), "9:1",
            "the species of a pair cannot change"},
           {with("[walls.left]\nkind = \"static\"\n[walls.left.species.a]\ntemperature = 1\n"),
            "12:1", "this kind of wall"},
           {"box.size = [10, 2]\n[[species]]\nname = \"a\"\ncount = 1\ndiameter = 3\n", "1:5",
            "longer than the largest diameter, 3"},
           {"box.size = [10, 10]\n[[species]]\nname = \"a\"\ncount = 100\ndiameter = 1.1\n", "4:1",
            "the species \"a\" at most 95"},
           {with("[particles.start]\nlayout = \"lattice\"\n[[species]]\nname = \"c\"\ncount = 20\n"
                 "diameter = 2.0\n"),
            "10:1", "a lattice of the largest particles has"},
           {"box.size = [9, 9]\nparticles.count = 3\nmeasure.observables = [\"mixing\"]\n", "3:9",
            "fewer than two species"},
           {with("[measure]\nobservables = [\"mixing\"]\nmixing.cell = 1e-3\n"), "11:8",
            "more than 1e7 cells"},
           {with("[[change]]\ntime = 1\nset = { \"species.a.mass\" = 2 }\n"), "9:1",
            "would change the energy"},
           {with("[[change]]\ntime = 1\npuff = { count = 1, centre = [5, 5], radius = 1, species = "
                 "\"c\" }\n"),
            "11:50", "no species \"c\""}}) {
    CAPTURE(text);
    const std::string message = refusal(text);
    CAPTURE(message);
    CHECK(says(message, "s.toml:" + place));
    CHECK(says(message, word));
  }
  std::string many = "box.size = [10, 10]\n";
  for (int k = 0; k < 101; ++k) {
    many += "[[species]]\nname = \"s" + std::to_string(k) + "\"\ncount = 0\n";
  }
  CHECK(says(refusal(many), "at most 100"));
  CHECK(says(refusal(kPlain, {{"species.c.mass", "1"}}), "--set species.c.mass: there is no"));
  CHECK(says(refusal(kPlain, {{"species.a", "1"}}), "species.NAME.KEY"));
  CHECK(says(refusal(kPlain, {{"pair.a.c.friction", "1"}}), "there is no species \"c\""));
}

TEST_CASE("Species: a start has the temperatures of the scene, and no overlap") {
  for (const char* const layout : {"random", "lattice"}) {
    CAPTURE(layout);
    const Scene scene = mixture({{"particles.start.layout", layout},
                                 {"species.heavy.count", "1"},
                                 {"species.small.count", "20"},
                                 {"species.large-2.count", "20"}});
    const State<2> state = start_state<2>(scene, kSpeciesSeed);
    REQUIRE(state.grains.size() == 41);
    CHECK(brute_force_overlap(model_of<2>(scene, kSpeciesSeed), state) == 0.0);
    CHECK(finite_and_inside(model_of<2>(scene, kSpeciesSeed), state));
    double energy = 0.0, of_spins = 0.0;
    Vec2 momentum = Vec2::Zero();
    for (std::size_t i = 0; i < state.grains.size(); ++i) {
      const Grain& grain = state.grains[i];
      energy += grain.mass * state.velocities[i].squaredNorm();
      momentum += grain.mass * state.velocities[i];
      of_spins += grain.moment_of_inertia() * state.spins[i].squaredNorm();
    }
    CHECK(energy / (2.0 * 41.0) == doctest::Approx(2.0).epsilon(1e-12));
    CHECK(of_spins / 41.0 == doctest::Approx(0.5).epsilon(1e-12));
    CHECK(momentum.norm() < 1e-10);
  }
}

TEST_CASE("Species: without room for all particles the start names a way out") {
  const std::string crowded = refusal_of([] {
    start_state<2>(parse_scene(kPlain, "s.toml", {{"species.a.count", "110"}}), kSpeciesSeed);
  });
  CHECK(says(crowded, "found no places"));
}

TEST_CASE("Species: a start state is written to a file and read back with the same bits") {
  Scene scene = mixture({{"particles.start.layout", "random"}});
  const State<2> state = start_state<2>(scene, kSpeciesSeed);
  const std::string csv = state_to_csv(state, scene.species);
  const auto again = std::get<State<2>>(parse_state(csv, "a.csv", scene));
  CHECK(again == state);
  const auto refused = [&](const std::string& text) {
    return refusal_of([&] { parse_state(text, "a.csv", parse_scene(kPlain, "s.toml")); });
  };
  const std::string header = "x,y,vx,vy,species,diameter\n";
  CHECK(refused(header + "2,2,0,0,a,1\n3.5,2,0,0,b,0.5\n").empty());
  CHECK(says(refused("x,y,vx,vy\n2,2,0,0\n"), "a.csv:1:1: the column \"species\" is missing"));
  CHECK(says(refused(header + "2,2,0,0,c,1\n"), "a.csv:2:9: there is no species \"c\""));
  CHECK(says(refused(header + "2,2,0,0,b,0.6\n"), "a.csv:2:11"));
  CHECK(says(refused(header + "2,2,0,0,a,1\n2.7,2,0,0,b,0.5\n"), "overlap by 0.05"));
  CHECK(says(
      refusal_of([&] { parse_state("x,y,vx,vy,mass\n1,1,0,0,2\n", "a.csv", default_scene(2)); }),
      "has no meaning without species"));
}

TEST_CASE("Species: a run changes the law of a pair, and ramps it from the default") {
  const std::string changes = R"(
[[change]]
time = 1.0
set = { "pair.small.heavy.restitution" = 0.5, "walls.left.species.heavy.temperature" = 9.0 }
[[change]]
time = 2.0
set = { "pair.heavy.heavy.restitution" = 0.1 }
ramp = "linear"
until = 4.0
)";
  ScheduledRun<2> run(parse_scene(kMixture + changes, "s.toml"), kSpeciesSeed);
  run.run_until(1.5);
  CHECK(run.simulation().model().pair(0, 2).restitution == 0.5);
  CHECK(run.simulation().model().wall(kLeft, 2).temperature == 9.0);
  CHECK(run.simulation().model().pair(2, 2).restitution == 0.9);
  run.run_until(3.01);
  CHECK(run.simulation().model().pair(2, 2).restitution == doctest::Approx(0.5).epsilon(0.02));
  run.run_until(4.1);
  CHECK(run.simulation().model().pair(2, 2).restitution == 0.1);
}

TEST_CASE("Species: a puff into an empty box makes particles of its species") {
  const std::string puffs = R"(
[[change]]
time = 1.0
puff = { count = 4, centre = [5, 5], radius = 4, species = "a" }
[[change]]
time = 2.0
puff = { count = 5, centre = [5, 5], radius = 4, species = "b" }
)";
  ScheduledRun<2> run(
      parse_scene(kPlain + puffs, "s.toml", {{"species.a.count", "0"}, {"species.b.count", "0"}}),
      kSpeciesSeed);
  run.run_until(3.0);
  const State<2> state = run.simulation().state();
  REQUIRE(state.grains.size() == 9);
  CHECK(state.grains[3].radius == 0.5);
  CHECK(state.grains[4] == Grain{.radius = 0.25, .mass = 0.25, .inertia = 0.5, .species = 1});
}

TEST_CASE("Species: particles of a puff are of its species") {
  const std::string puff =
      "[[change]]\ntime = 1.0\npuff = { count = 5, centre = [15, 10], radius = 9, species = "
      "\"heavy\", temperature = 8 }\n";
  ScheduledRun<2> run(parse_scene(kMixture + puff, "s.toml", {{"species.large-2.count", "3"}}),
                      kSpeciesSeed);
  run.run_until(0.99);
  const std::size_t before = run.simulation().particles().size();
  run.run_until(1.01);
  const State<2> state = run.simulation().state();
  REQUIRE(state.grains.size() == before + 5);
  for (std::size_t i = before; i < state.grains.size(); ++i) {
    CHECK(state.grains[i] == Grain{.radius = 0.75, .mass = 40.0, .inertia = 0.4, .species = 2});
  }
  CHECK(run.present_scene().species[2].count == 12);
  run.run_until(3.0);
  CHECK(run.simulation().deepest_overlap() < 1e-12);
}

// A scene of one species with diameter 1 and mass 1 is the gas of [particles].
TEST_CASE("Species: a gas of one species has the laws and numbers of the same gas without") {
  const std::string walls =
      "box.size = [12, 9]\nwalls = { left = { kind = 'thermal', temperature = 2.0 }, right = { "
      "kind = 'static' } }\n";
  const Scene plain = parse_scene(walls + "particles = { count = 40, restitution = 0.9 }\n", "");
  const Scene one = parse_scene(
      walls + "particles.restitution = 0.9\nspecies = [{ name = 'a', count = 40 }]\n", "");
  const State<2> start = start_state<2>(plain, kSpeciesSeed);
  State<2> of_one = start;
  of_one.grains.assign(40, Grain{});
  Simulation<2> first(model_of<2>(plain, kSpeciesSeed), start);
  Simulation<2> second(model_of<2>(one, kSpeciesSeed), of_one);
  first.run_until(50.0);
  second.run_until(50.0);
  CHECK(first.state_hash() == second.state_hash());
}
