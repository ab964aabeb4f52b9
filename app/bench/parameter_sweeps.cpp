#include "app/bench/parameter_sweeps.h"

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <limits>

#include "app/bench/run_result.h"
#include "app/bench/time_stepped.h"
#include "engine/scene/text.h"

namespace clatter {

namespace {

Setting plain(const std::string& name, const Scene& scene) {
  return {.name = name, .value = std::numeric_limits<double>::quiet_NaN(), .scene = scene};
}

Setting setting(double value, const Scene& scene) {
  return {.name = number_text(value), .value = value, .scene = scene};
}

Dial contact_times(const Scene& scene, double collision_time) {
  Dial dial{"contact_time", "t_c / time between collisions", {plain("off", scene)}};
  for (const double share : {1e-6, 1e-5, 1e-4, 1e-3, 1e-2, 1e-1}) {
    Scene changed = scene;
    changed.contact_time = share * collision_time;
    dial.settings.push_back(setting(share, changed));
  }
  return dial;
}

Dial estimators(const Scene& scene) {
  Dial dial{"estimator", "fields: time between snapshots", {plain("exact", scene)}};
  for (const double interval : {0.1, 0.3, 1.0, 3.0, 10.0}) {
    Scene changed = scene;
    changed.measure.estimator = Estimator::Snapshot;
    changed.measure.interval = interval;
    dial.settings.push_back(setting(interval, changed));
  }
  return dial;
}

// Cells along the axis of profiles, as many as divide the columns that are compared.
Dial cell_sizes(const Scene& scene) {
  const auto axis = static_cast<int>(compared_axis(scene));
  Dial dial{"cells", "fields: width of cells", {}};
  for (const int cells : {60, 30, 20, 10, 5}) {
    Scene changed = scene;
    changed.measure.cells[axis] = cells;
    const double width = scene.box[axis] / cells;
    char name[32];
    std::snprintf(name, sizeof name, "%.3g", width);
    dial.settings.push_back({.name = name, .value = width, .scene = changed});
  }
  return dial;
}

Dial kernel_widths(const Scene& scene) {
  Dial dial{"kernel", "fields: width of the Gaussian", {}};
  for (const double width : {0.25, 0.5, 1.0, 2.0}) {
    Scene changed = scene;
    changed.measure.estimator = Estimator::Snapshot;
    changed.measure.interval = 3.0;
    changed.measure.kernel = Kernel::Gaussian;
    changed.measure.width = width;
    dial.settings.push_back(setting(width, changed));
  }
  return dial;
}

bool is_driven(const std::optional<Wall>& wall) {
  return wall && wall->kind == WallKind::Driven && wall->drive_speed > 0.0;
}

// Saw-teeth of the speed whose limit a driven wall is: v_dr = (1 + alpha_w) stroke frequency.
Dial strokes(const Scene& scene) {
  Dial dial{"stroke", "stroke of the shaking walls", {plain("limit", scene)}, true};
  for (const double stroke : {0.02, 0.05, 0.1, 0.2}) {
    Scene changed = scene;
    for (std::optional<Wall>& wall : changed.walls) {
      if (!is_driven(wall)) continue;
      wall->kind = WallKind::Sawtooth;
      wall->stroke = stroke;
      wall->frequency = wall->drive_speed / ((1.0 + wall->restitution) * stroke);
    }
    dial.settings.push_back(setting(stroke, changed));
  }
  return dial;
}

// More or fewer disks at the same number per length of the walls.
Dial counts(const Scene& scene) {
  const int along = 1 - static_cast<int>(compared_axis(scene));
  Dial dial{"count", "number of disks at equal line density", {}};
  for (const double factor : {4.0, 2.0, 1.0, 0.5, 0.25}) {
    Scene changed = scene;
    changed.disks.count = static_cast<int>(std::lround(factor * scene.disks.count));
    changed.box[along] *= static_cast<double>(changed.disks.count) / scene.disks.count;
    dial.settings.push_back(setting(changed.disks.count, changed));
  }
  return dial;
}

Dial time_steps(const Scene& scene) {
  Dial dial{"time_step", "time-stepped engine: dt", {plain("exact", scene)}};
  for (const double step : {1e-3, 3e-3, 1e-2, 3e-2, 1e-1, 3e-1}) {
    Setting stepped = setting(step, scene);
    stepped.time_step = step;
    stepped.duration = std::min(1.0, step / 1e-2);  // fine steps take their time
    dial.settings.push_back(stepped);
  }
  return dial;
}

}  // namespace

std::vector<Dial> dials_of(const Scene& scene, double collision_time) {
  constexpr int kFewest = 8;
  constexpr double kShortest = 4.0;  // side of the smallest box, diameters
  const int along = 1 - static_cast<int>(compared_axis(scene));
  std::vector<Dial> dials;
  if (!scene.contact_time) dials.push_back(contact_times(scene, collision_time));
  if (scene.measure.estimator == Estimator::Exact) dials.push_back(estimators(scene));
  dials.push_back(cell_sizes(scene));
  dials.push_back(kernel_widths(scene));
  if (std::ranges::any_of(scene.walls, is_driven)) dials.push_back(strokes(scene));
  if (scene.periodic(along) && scene.disks.start.layout != Layout::File &&
      scene.disks.count >= 4 * kFewest && scene.box[along] >= 4.0 * kShortest) {
    dials.push_back(counts(scene));
  }
  if (TimeStepped::can_run(scene)) dials.push_back(time_steps(scene));
  return dials;
}

}  // namespace clatter
