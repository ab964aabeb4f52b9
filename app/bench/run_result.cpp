#include "app/bench/run_result.h"

#include <algorithm>
#include <cmath>
#include <memory>

#include "app/bench/time_stepped.h"
#include "engine/measure/measurement.h"
#include "engine/run/scheduled_run.h"
#include "engine/system/platform.h"
#include "engine/system/usage.h"

namespace clatter {

namespace {

// The compared fields along an axis.
std::vector<Field> fields_along(Axis axis) {
  const int along = static_cast<int>(axis);
  return {Quantity::Density, Field(Quantity::Stress, along, along),
          Field(Quantity::HeatFlux, along), Quantity::Dissipation};
}

double mean_of(const std::vector<Estimate>& columns) {
  double sum = 0.0;
  for (const Estimate& column : columns) sum += std::isnan(column.mean) ? 0.0 : column.mean;
  return sum / static_cast<double>(columns.size());
}

// Converts values of columns of equal width to the compared columns.
template <class Value>
ProfileValues compared(std::size_t columns, const Value& value) {
  ProfileValues profile{};
  for (std::size_t k = 0; k < profile.size(); ++k) {
    const double at = value((2 * k + 1) * columns / (2 * profile.size()));
    profile[k] = std::isnan(at) ? 0.0 : at;
  }
  return profile;
}

ProfileValues compared(const std::vector<Estimate>& columns) {
  return compared(columns.size(), [&](std::size_t column) { return columns[column].mean; });
}

}  // namespace

Axis compared_axis(const Scene& scene) {
  return scene.walls[kLeft] || !scene.walls[kBottom] ? Axis::X : Axis::Y;
}

RunResult observe(const Scene& scene, const Effort& effort, std::uint64_t seed) {
  const Axis axis = compared_axis(scene);
  const std::vector<Field> fields = fields_along(axis);
  Measure measure = scene.measure;
  measure.burn_in = effort.burn_in;
  measure.duration = effort.duration;
  measure.fields = fields;
  measure.profile_axis = axis;
  const double end = effort.burn_in + effort.duration;

  const double bytes_before = heap_bytes();
  const auto simulation = simulation_of<2>(scene, seed);
  Measurement measurement(*simulation, measure, end);
  simulation->run_until(effort.burn_in);
  const auto events = [&] {
    return static_cast<double>(simulation->counts().pair_collisions +
                               simulation->counts().wall_collisions);
  };
  const double events_before = events(), began = cpu_seconds();
  simulation->run_until(end);
  RunResult result{.time = effort.duration,
                   .cpu_seconds = cpu_seconds() - began,
                   .events = events() - events_before,
                   .bytes = heap_bytes() - bytes_before,
                   .deepest_overlap = simulation->checks().deepest_overlap};

  const Measured measured = measurement.result();
  result.collision_rate = measured.collision_rate.mean;
  if (scene.contact_time && measured.pair_collisions > 0) {
    result.elasticised_share =
        static_cast<double>(measured.elasticised) / static_cast<double>(measured.pair_collisions);
  }
  const auto& pressure = measured.pressure;
  const int near = 2 * static_cast<int>(axis);
  result.means[kTemperature] = measured.temperature.mean;
  result.means[kPressure] =
      pressure[near] ? 0.5 * (pressure[near]->mean + pressure[near + 1]->mean) : kNotANumber;
  result.means[kStress] = mean_of(measured.profile->at(fields[1]));
  result.means[kDissipation] = mean_of(measured.profile->at(Quantity::Dissipation));
  result.density = compared(measured.profile->at(Quantity::Density));
  result.heat_flux = compared(measured.profile->at(fields[2]));
  return result;
}

RunResult observe_stepped(const Scene& scene, double step, const Effort& effort,
                          std::uint64_t seed) {
  const auto axis = static_cast<int>(compared_axis(scene));
  const int columns = scene.measure.cells[axis];
  const auto exact = simulation_of<2>(scene, seed);
  exact->run_until(effort.burn_in);
  TimeStepped stepped(scene, exact->state(), step, columns);
  stepped.run(0.2 * effort.duration);  // relaxation to the stationary state of this engine
  stepped.restart_sums();
  const double began = cpu_seconds();
  stepped.run(effort.duration);
  const double cpu = cpu_seconds() - began;

  const SteppedSums& sums = stepped.sums();
  const double area = scene.box.prod(), count = scene.particles.count;
  const auto collisions = static_cast<double>(sums.collisions);
  RunResult result{.time = sums.time,
                   .cpu_seconds = cpu,
                   .events = collisions,
                   .bytes = stepped.bytes(),
                   .collision_rate = 2.0 * collisions / (count * sums.time),
                   .deepest_overlap = sums.deepest_overlap};
  result.means[kTemperature] = 0.5 * sums.squares / (count * sums.time);
  result.means[kPressure] = sums.wall_impulse / (2.0 * scene.box[1 - axis] * sums.time);
  result.means[kStress] = sums.stress / (area * sums.time);
  result.means[kDissipation] = -sums.dissipated / (area * sums.time);
  const double column_time = area / columns * sums.time;
  const auto profile = [&](const std::vector<double>& values) {
    return compared(values.size(), [&](std::size_t c) { return values[c] / column_time; });
  };
  result.density = profile(sums.particles);
  result.heat_flux = profile(sums.heat_carried);
  return result;
}

}  // namespace clatter
