#include "app/bench/parameter_sweeps.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <limits>

#include "app/bench/run_result.h"
#include "app/bench/time_stepped.h"
#include "engine/text.h"

namespace clatter {

namespace {

Setting plain(const std::string& name, const Scene& scene) {
  return {.name = name, .value = std::numeric_limits<double>::quiet_NaN(), .scene = scene};
}

Setting setting(double value, const Scene& scene) {
  return {.name = number_text(value), .value = value, .scene = scene};
}

ParameterSweep contact_times(const Scene& scene, double collision_time) {
  ParameterSweep sweep{"contact_time", "t_c / time between collisions", {plain("off", scene)}};
  for (const double share : {1e-6, 1e-5, 1e-4, 1e-3, 1e-2, 1e-1}) {
    Scene changed = scene;
    changed.contact_time = share * collision_time;
    sweep.settings.push_back(setting(share, changed));
  }
  return sweep;
}

ParameterSweep estimators(const Scene& scene) {
  ParameterSweep sweep{"estimator", "fields: time between snapshots", {plain("exact", scene)}};
  for (const double interval : {0.1, 0.3, 1.0, 3.0, 10.0}) {
    Scene changed = scene;
    changed.measure.estimator = Estimator::Snapshot;
    changed.measure.interval = interval;
    sweep.settings.push_back(setting(interval, changed));
  }
  return sweep;
}

// Numbers of cells along the axis of profiles. They divide the number of compared columns.
ParameterSweep cell_sizes(const Scene& scene) {
  const auto axis = static_cast<int>(compared_axis(scene));
  ParameterSweep sweep{"cells", "fields: width of cells", {}};
  for (const int cells : {60, 30, 20, 10, 5}) {
    Scene changed = scene;
    changed.measure.cells[axis] = cells;
    const double width = scene.box[axis] / cells;
    sweep.settings.push_back(
        {.name = fmt::format("{:.3g}", width), .value = width, .scene = changed});
  }
  return sweep;
}

ParameterSweep kernel_widths(const Scene& scene) {
  ParameterSweep sweep{"kernel", "fields: width of the Gaussian", {}};
  for (const double width : {0.25, 0.5, 1.0, 2.0}) {
    Scene changed = scene;
    changed.measure.estimator = Estimator::Snapshot;
    changed.measure.interval = 3.0;
    changed.measure.kernel = Kernel::Gaussian;
    changed.measure.width = width;
    sweep.settings.push_back(setting(width, changed));
  }
  return sweep;
}

bool is_driven(const std::optional<Wall>& wall) {
  return wall && wall->kind == WallKind::Driven && wall->drive_speed > 0.0;
}

// Saw-tooth motions with the limit of a driven wall: v_dr = (1 + alpha_w) stroke frequency.
ParameterSweep strokes(const Scene& scene) {
  ParameterSweep sweep{"stroke", "stroke of the shaking walls", {plain("limit", scene)}, true};
  for (const double stroke : {0.02, 0.05, 0.1, 0.2}) {
    Scene changed = scene;
    for (std::optional<Wall>& wall : changed.walls) {
      if (!is_driven(wall)) continue;
      wall->kind = WallKind::Sawtooth;
      wall->stroke = stroke;
      wall->frequency = wall->drive_speed / ((1.0 + wall->restitution) * stroke);
    }
    sweep.settings.push_back(setting(stroke, changed));
  }
  return sweep;
}

// Other numbers of disks at the same number per length of the walls.
ParameterSweep counts(const Scene& scene) {
  const int along = 1 - static_cast<int>(compared_axis(scene));
  ParameterSweep sweep{"count", "number of disks at equal line density", {}};
  for (const double factor : {4.0, 2.0, 1.0, 0.5, 0.25}) {
    Scene changed = scene;
    changed.particles.count = static_cast<int>(std::lround(factor * scene.particles.count));
    changed.box[along] *= static_cast<double>(changed.particles.count) / scene.particles.count;
    sweep.settings.push_back(setting(changed.particles.count, changed));
  }
  return sweep;
}

ParameterSweep time_steps(const Scene& scene) {
  ParameterSweep sweep{"time_step", "time-stepped engine: dt", {plain("exact", scene)}};
  for (const double step : {1e-3, 3e-3, 1e-2, 3e-2, 1e-1, 3e-1}) {
    Setting stepped = setting(step, scene);
    stepped.time_step = step;
    stepped.duration = std::min(1.0, step / 1e-2);  // fine steps are slow
    sweep.settings.push_back(stepped);
  }
  return sweep;
}

}  // namespace

std::vector<ParameterSweep> sweeps_of(const Scene& scene, double collision_time) {
  constexpr int kFewest = 8;
  constexpr double kShortest = 4.0;  // side of the smallest box, diameters
  const int along = 1 - static_cast<int>(compared_axis(scene));
  std::vector<ParameterSweep> sweeps;
  if (!scene.contact_time) sweeps.push_back(contact_times(scene, collision_time));
  if (scene.measure.estimator == Estimator::Exact) sweeps.push_back(estimators(scene));
  sweeps.push_back(cell_sizes(scene));
  sweeps.push_back(kernel_widths(scene));
  if (std::ranges::any_of(scene.walls, is_driven)) sweeps.push_back(strokes(scene));
  if (scene.periodic(along) && scene.particles.start.layout != Layout::File &&
      scene.particles.count >= 4 * kFewest && scene.box[along] >= 4.0 * kShortest) {
    sweeps.push_back(counts(scene));
  }
  if (TimeStepped::can_run(scene)) sweeps.push_back(time_steps(scene));
  return sweeps;
}

}  // namespace clatter
