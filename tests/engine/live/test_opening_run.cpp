#include <doctest/doctest.h>

#include "engine/error.h"
#include "engine/live/opening_run.h"
#include "engine/scene/scene_file.h"

using namespace clatter;

static const char* const kOpenedScenes[] = {
    R"(
title = "Shaken, rough, under gravity"
box.size = [30.0, 40.0]
particles = { count = 300, restitution = 0.9, friction = 0.3, tangential_restitution = 0.5 }
walls.bottom = { kind = "sinusoidal", stroke = 0.5, frequency = 1.0 }
walls.top = { kind = "thermal", temperature = 2.0 }
gravity.acceleration = [0.1, -1.0]
)",
    R"(
title = "A lattice that melts"
box.size = [20.0, 20.0]
particles = { area_fraction = 0.6, restitution = 0.9 }
)",
    R"(
title = "Dense spheres, with lists of near particles"
box.size = [10.0, 10.0, 10.0]
particles = { volume_fraction = 0.5, restitution = 0.9 }
)",
};

static std::uint64_t hash_at(WatchedRun& run, double time) {
  REQUIRE(run.run_until(time, kNoLimit, kNoLimit));
  Frame frame;
  run.fill(frame, true);
  return frame.state_hash.value();
}

TEST_CASE("OpeningRun: pauses do not change the run") {
  for (const char* text : kOpenedScenes) {
    const Scene scene = parse_scene(text, "pauses.toml");
    CAPTURE(scene.title);
    OpeningRun opening(scene, 3);
    int questions = 0, pauses = 0;
    while (!opening.advance([&] { return ++questions % 2 == 0; })) {
      ++pauses;
      REQUIRE(pauses < 1'000'000);
    }
    // Places, overlaps and plans are questions of their own.
    CHECK(pauses >= 3 * scene.particles.count / (2 * static_cast<int>(kStepsPerQuestion)));
    CHECK(hash_at(*opening.take(), 2.0) == hash_at(*watched_run(scene, 3), 2.0));
  }
}

TEST_CASE("OpeningRun: an impossible start is an error after pauses too") {
  Scene scene = parse_scene(kOpenedScenes[1], "overlap.toml");
  State<2> state;
  for (int i = 0; i < 100; ++i) {
    state.positions.push_back({1.0 + i % 10 * 1.9, 1.0 + i / 10 * 1.9});
    state.velocities.push_back({0.0, 0.0});
  }
  state.positions.back() = state.positions.front() + Vec<2>(0.95, 0.0);
  scene.particles.count = 100;
  scene.particles.start.layout = Layout::File;
  scene.particles.start.state = state;
  OpeningRun opening(scene, 3);
  int questions = 0;
  const auto open = [&] {
    while (!opening.advance([&] { return ++questions % 2 == 0; })) {
    }
  };
  CHECK_THROWS_WITH_AS(open(), doctest::Contains("by 0.05 diameters"), PhysicalStop);
}
