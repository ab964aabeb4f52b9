#include <doctest/doctest.h>

#include <algorithm>
#include <cstdint>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "engine/dynamics/prediction.h"
#include "engine/dynamics/simulation.h"
#include "engine/physics/contact.h"
#include "engine/physics/random.h"
#include "engine/run/scheduled_run.h"
#include "tests/engine/support/gas.h"
#include "tests/support/scenes.h"

using namespace clatter;
using namespace clatter::testing;

namespace {

Scene falling(Scene scene, const Vec2& gravity) {
  scene.gravity = gravity;
  return scene;
}

Scene walled(Scene scene) {
  for (auto& wall : scene.walls) wall = Wall{};
  return scene;
}

std::vector<std::pair<std::string, Scene>> scenes() {
  const Scene dense = gas(20.0, 20.0, 300, 1.0);
  return {{"periodic", gas(25.0, 25.0, 400, 1.0)},
          {"dilute", gas(70.0, 70.0, 400, 1.0)},
          {"round a narrow box", gas(2.3, 40.0, 60, 1.0)},
          {"falling round the box", falling(dense, {0.2, -0.5})},
          {"falling between walls", falling(walled(dense), {0.0, -0.5})}};
}

// A gas after some collisions, with the plans of all its particles.
struct Planned {
  explicit Planned(const Scene& scene) : model(model_of<2>(scene, 1)) {
    const auto simulation = simulation_of<2>(scene, 1);
    simulation->run_until(1e9, 20 * static_cast<std::uint64_t>(scene.particles.count));
    now = simulation->base_time();
    clock.emplace(simulation->time() - now);
    particles = simulation->particles();
    plans.resize(particles.size());
    near.emplace(model, kAlike, static_cast<double>(particles.size()));
    for (std::uint32_t i = 0; i < particles.size(); ++i) {
      const Vec2 r = particles[i].flight.at(now, model.gravity);
      const Vec2 image = model.domain().image_at(r);
      particles.set_image(i, image);
      plans[i].cell = near->place(i, r - image.cwiseProduct(model.box));
    }
    boundary.emplace(model, *clock);
    prediction.emplace(model, *boundary, particles, kAlike, *near);
    for (std::uint32_t i = 0; i < particles.size(); ++i) prediction->plan({i, &plans[i]}, now);
  }

  Model<2> model;
  double now;
  std::optional<Clock> clock;
  ParticleArray<2> particles;
  std::vector<Plan<2>> plans;
  std::optional<Neighbourhood<2>> near;
  std::optional<Boundary<2>> boundary;
  std::optional<Prediction<2>> prediction;
};

}  // namespace

TEST_CASE("Prediction: no two particles touch before the plan of one of them, by brute force") {
  for (const auto& [name, scene] : scenes()) {
    CAPTURE(name);
    const Planned gas(scene);
    int contacts = 0;
    for (std::uint32_t i = 0; i < gas.particles.size(); ++i) {
      for (std::uint32_t j = i + 1; j < gas.particles.size(); ++j) {
        const double planned = std::min(gas.plans[i].time, gas.plans[j].time);
        for (int image = 0; image < 9; ++image) {
          const Vec2 wrap(image % 3 - 1, image / 3 - 1);
          const bool there = (wrap.x() == 0.0 || gas.model.periodic(0)) &&
                             (wrap.y() == 0.0 || gas.model.periodic(1));
          if (!there) continue;
          const Vec2 boxes = gas.particles.image(j) - gas.particles.image(i) - wrap;
          const double time =
              contact_time<2>(gas.particles[i].flight, gas.particles[j].flight,
                              boxes.cwiseProduct(gas.model.box), 1.0, gas.model.gravity);
          REQUIRE(time >= planned);
          contacts += time == planned;
        }
      }
    }
    CHECK(contacts > 10);
  }
}

TEST_CASE("Prediction: two particles planned together have the plans of each alone, to the bit") {
  for (const auto& [name, scene] : scenes()) {
    CAPTURE(name);
    const Planned gas(scene);
    Random random(5, Stream::Placement, 0, 0);
    int contacts = 0, round_borders = 0;
    for (int k = 0; k < 4000; ++k) {
      const auto a = static_cast<std::uint32_t>(random.below(gas.particles.size()));
      const auto b = static_cast<std::uint32_t>(random.below(gas.particles.size()));
      if (a == b) continue;
      Plan<2> of_a, of_b;
      of_a.cell = gas.plans[a].cell;
      of_b.cell = gas.plans[b].cell;
      gas.prediction->plan({a, &of_a}, {b, &of_b}, gas.now);
      for (const auto& [alone, at_once] :
           {std::pair(&gas.plans[a], &of_a), std::pair(&gas.plans[b], &of_b)}) {
        REQUIRE(alone->time == at_once->time);
        REQUIRE(alone->partner == at_once->partner);
        if (alone->partner >= kWall) continue;
        REQUIRE(alone->partner_flight == at_once->partner_flight);
        REQUIRE(alone->image == at_once->image);
        ++contacts;
        round_borders += alone->image != IntVec<2>::Zero();
      }
    }
    CHECK(contacts > 1000);
    if (scene.walls[0]) continue;
    CHECK(round_borders > 20);
  }
}
