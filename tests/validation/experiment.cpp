#include "tests/validation/experiment.h"

#include <doctest/doctest.h>

#include <numbers>

#include "engine/initial/start_state.h"

namespace clatter::testing {

Scene gas_of_fraction(double area_fraction, int count, double restitution) {
  const double side = std::sqrt(count * std::numbers::pi / (4.0 * area_fraction));
  return gas(side, side, count, restitution);
}

Scene vibrated_gas(double restitution, double wall_restitution) {
  Scene scene = gas(20.0, 25.0, 100, restitution);
  wall_in(scene, 0,
          {.kind = WallKind::Driven, .restitution = wall_restitution, .drive_speed = 1.0});
  return scene;
}

Measured run(Scene scene, double burn_in, double duration, std::uint64_t seed) {
  scene.measure.burn_in = burn_in;
  scene.measure.duration = duration;
  const double end = burn_in + duration;
  Simulation<2> simulation(model_of<2>(scene, seed), start_state<2>(scene, seed));
  Measurement measurement(simulation, scene.measure, end);
  simulation.run_until(end);
  CHECK(simulation.checks().deepest_overlap < 1e-9);
  const Measured measured = measurement.result();
  CHECK(measured.ledger_residual <= 1e-10);
  return measured;
}

void check_energy_balance(const Measured& measured, int count) {
  double sum = -measured.dissipated.mean;
  double error = measured.dissipated.standard_error;
  for (const auto* gain : {&measured.walls_in, &measured.bulk_in, &measured.gravity_in}) {
    if (!*gain) continue;
    sum += (*gain)->mean;
    error = std::hypot(error, (*gain)->standard_error);
  }
  MESSAGE("energy in - dissipated = ", sum, " +- ", error, ", dissipated ",
          measured.dissipated.mean);
  CHECK(std::fabs(sum) < 5.0 * error);
  // The energy of few particles may be many times its mean, with a probability that falls off as
  // exp(-E/T).
  const double spin_temperature = measured.spin_temperature ? measured.spin_temperature->mean : 0.0;
  const double energy_per_particle = measured.temperature.mean + 0.5 * spin_temperature;
  CHECK(std::fabs(sum) * measured.duration < (count + 10.0) * energy_per_particle);
}

}  // namespace clatter::testing
