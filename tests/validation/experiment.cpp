#include "tests/validation/experiment.h"

#include <doctest/doctest.h>

#include <numbers>
#include <utility>

#include "engine/dimension.h"
#include "engine/initial/start_state.h"

namespace clatter::testing {

Scene gas_of_fraction(double packing_fraction, int count, double restitution, int dimension) {
  constexpr double pi = std::numbers::pi;
  const double side = dimension == 2 ? std::sqrt(count * pi / (4.0 * packing_fraction))
                                     : std::cbrt(count * pi / (6.0 * packing_fraction));
  return gas(VecX::Constant(dimension, side), count, restitution);
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
  return with_dimension(scene.dimension(), [&]<int D>(std::integral_constant<int, D>) {
    Simulation<D> simulation(model_of<D>(scene, seed), start_state<D>(scene, seed));
    Measurement<D> measurement(simulation, scene.measure, end);
    simulation.run_until(end);
    CHECK(simulation.checks().deepest_overlap < 1e-9);
    const Measured measured = measurement.result();
    CHECK(measured.ledger_residual <= 1e-10);
    return measured;
  });
}

void check_energy_balance(const Measured& measured, int count) {
  double sum = -measured.dissipated.mean;
  double error = measured.dissipated.standard_error;
  for (const auto* gain :
       {&measured.walls_in, &measured.bulk_in, &measured.gravity_in, &measured.shear_in}) {
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
  const auto dimension = static_cast<double>(measured.axis_temperatures.size());
  const double energy_per_particle =
      0.5 * dimension * (measured.temperature.mean + 0.5 * (dimension - 1.0) * spin_temperature);
  CHECK(std::fabs(sum) * measured.duration < (count + 10.0) * energy_per_particle);
}

double sphere_compressibility(double packing_fraction) {
  constexpr std::pair<int, double> kTerms[] = {
      {0, 1.0},         {1, 4.0},          {2, 6.0},         {3, 2.3647684},
      {4, -0.8698551},  {5, 1.1062803},    {6, -1.1014221},  {7, 0.66605866},
      {8, -0.03633431}, {10, -0.20965164}, {14, 0.10555569}, {22, -0.00872380}};
  const double x = packing_fraction / (1.0 - packing_fraction);
  double z = 0.0;
  for (const auto& [power, coefficient] : kTerms) z += coefficient * std::pow(x, power);
  return z;
}

}  // namespace clatter::testing
