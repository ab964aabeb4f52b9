#pragma once

#include <memory>

#include "engine/dynamics/simulation.h"
#include "engine/initial/start_state.h"
#include "engine/run/scheduled_run.h"
#include "tests/engine/support/gas.h"
#include "tests/engine/support/models.h"
#include "tests/support/scenes.h"

namespace clatter::testing {

/// Many features in one scene: inelastic particles, a driven and an inelastic wall along x, thermal
/// walls of two temperatures along y.
inline Scene rough_mixture(int count) {
  Scene scene = gas(9.0, 8.0, count, 0.8);
  scene.walls[kLeft] = {.kind = WallKind::Driven, .restitution = 0.9, .drive_speed = 1.5};
  scene.walls[kRight] = {.kind = WallKind::Static, .restitution = 0.7};
  scene.walls[kBottom] = {.kind = WallKind::Thermal, .temperature = 0.5};
  scene.walls[kTop] = {.kind = WallKind::Thermal, .temperature = 2.0};
  return scene;
}

/// The same with spins, gravity, kicks, a moving wall and a contact time.
inline Scene everything_in_motion(int count) {
  Scene scene = rough_mixture(count);
  scene.particles.roughness = {.friction = 0.5, .tangential_restitution = 0.5};
  scene.walls[kRight] = {
      .kind = WallKind::Sinusoidal, .restitution = 0.7, .stroke = 0.3, .frequency = 1.3};
  scene.gravity = Vec2(0.1, -0.2);
  scene.bulk_drive = BulkDrive{.interval = 0.3, .kick_speed = 0.2, .kick_spin = 0.1};
  scene.contact_time = 1e-3;
  return scene;
}

/// A single particle in a box. Its motion is known at any time.
inline std::unique_ptr<Simulation<2>> lone_particle(const Scene& scene, const Vec2& r,
                                                    const Vec2& v) {
  return std::make_unique<Simulation<2>>(model_of<2>(scene, 1), State<2>{{r}, {v}});
}

/// The run of a scene, or of three species in its place.
inline std::unique_ptr<Simulation<2>> run_of(const Scene& scene, std::uint64_t seed, bool mixes) {
  const Model<2> model = model_of<2>(scene, seed);
  const State<2> start = start_state<2>(scene, seed);
  return mixes ? std::make_unique<Simulation<2>>(with_species(model), mixed(model, start, 1.5))
               : std::make_unique<Simulation<2>>(model, start);
}

/// Total momentum.
inline Vec2 momentum(const Simulation<2>& simulation) {
  Vec2 sum = Vec2::Zero();
  for (const Particle<2>& particle : simulation.particles()) sum += particle.flight.v;
  return sum;
}

/// Sum of m v_k^2 over the particles.
inline Vec2 squares(const Simulation<2>& simulation) {
  Vec2 sum = Vec2::Zero();
  for (std::uint32_t i = 0; i < simulation.particles().size(); ++i) {
    sum += simulation.grain(i).mass * simulation.particles()[i].flight.v.cwiseAbs2();
  }
  return sum;
}

/// Records the simulation time of every event.
class EventTimes : public Observer<2> {
 public:
  std::vector<double> times;
  int base_moves = 0;

  void on_collision(const PairCollision<2>& collision) override { note(collision.time); }
  void on_wall(const WallCollision<2>& collision) override { note(collision.time); }
  void on_base_moved(double shift) override {
    base_ += shift;
    ++base_moves;
  }

 private:
  void note(double time) { times.push_back(base_ + time); }

  double base_ = 0.0;
};

}  // namespace clatter::testing
