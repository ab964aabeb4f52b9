#pragma once

#include <cmath>
#include <nlohmann/json.hpp>
#include <string>
#include <vector>

#include "app/results/result_json.h"
#include "engine/measure/measurement.h"
#include "tests/app/witness.h"

// The scenes and runs of the tests of results.

namespace clatter::testing {

inline constexpr double kBurnIn = 0.76, kDuration = 12.0, kContactTime = 0.05;

/// The box and its cells, a different number along each axis.
template <int D>
struct Vessel {
  static const Vec<D> box;
  static const IntVec<D> cells;
  static const int count;  // particles
};
template <>
inline const Vec<2> Vessel<2>::box(9.0, 8.0);
template <>
inline const IntVec<2> Vessel<2>::cells(3, 5);
template <>
inline const int Vessel<2>::count = 14;
template <>
inline const Vec<3> Vessel<3>::box(6.0, 5.0, 4.4);
template <>
inline const IntVec<3> Vessel<3>::cells(3, 2, 4);
template <>
inline const int Vessel<3>::count = 24;

/// The sides of a cell.
template <int D>
Vec<D> cell_size() {
  return Vessel<D>::box.cwiseQuotient(Vessel<D>::cells.template cast<double>());
}

/// The index of a cell along an axis.
template <int D>
int index_along(int axis, int cell) {
  for (int k = 0; k < axis; ++k) cell /= Vessel<D>::cells[k];
  return cell % Vessel<D>::cells[axis];
}

/// A scene without symmetry: different walls, oblique gravity, and kicked rough particles that
/// start at one side and drift.
template <int D>
Scene uneven_scene() {
  Scene scene = default_scene(D);
  scene.box = Vessel<D>::box;
  scene.particles.count = Vessel<D>::count;
  scene.particles.restitution = 0.8;
  scene.particles.roughness = {.friction = 0.4, .tangential_restitution = 0.5};
  scene.particles.inertia = 0.45;
  scene.walls = {
      Wall{.kind = WallKind::Driven, .restitution = 0.9, .drive_speed = 1.5},
      Wall{.kind = WallKind::Static,
           .restitution = 0.7,
           .roughness = {.friction = 0.3, .tangential_restitution = 0.2}},
      Wall{.kind = WallKind::Thermal, .temperature = 0.5},
      Wall{.kind = WallKind::Sinusoidal, .restitution = 0.8, .stroke = 0.3, .frequency = 1.1}};
  if (D == 3) {
    scene.walls[kBack] =
        Wall{.kind = WallKind::Sawtooth, .restitution = 0.9, .stroke = 0.2, .frequency = 0.9};
    scene.walls[kFront] = Wall{.kind = WallKind::Thermal, .temperature = 1.3};
  }
  scene.gravity = Vec<3>(0.15, -0.4, 0.25).head<D>();
  scene.bulk_drive = BulkDrive{.interval = 0.7, .kick_speed = 0.2, .kick_spin = 0.3};
  scene.contact_time = kContactTime;
  Measure& measure = scene.measure;
  measure.burn_in = kBurnIn;
  measure.duration = kDuration;
  measure.series_interval = 0.47;
  measure.fields = all_fields(D);
  measure.cells.assign(Vessel<D>::cells.begin(), Vessel<D>::cells.end());
  return scene;
}

/// Particles that roll and collide in a periodic box.
template <int D>
Scene periodic_scene() {
  Scene scene = uneven_scene<D>();
  scene.walls = {};
  scene.gravity.reset();
  scene.measure.fields.clear();
  return scene;
}

/// Rows of four particles along x; of spheres, three rows in each of two layers.
template <int D>
State<D> uneven_start() {
  State<D> state;
  for (int k = 0; k < Vessel<D>::count; ++k) {
    const int row = D == 2 ? k / 4 : k / 4 % 3, layer = k / 12;
    state.positions.push_back(
        Vec<3>(0.9 + 1.3 * (k % 4) + 0.1 * (k / 4), 0.8 + 1.4 * row, 0.8 + 1.3 * layer).head<D>());
    state.velocities.push_back(Vec<3>(0.6 + 1.2 * std::sin(3.0 * k), 0.3 + 0.7 * std::cos(5.0 * k),
                                      0.4 + 0.6 * std::sin(11.0 * k))
                                   .head<D>());
    state.spins.push_back(
        Vec<3>(0.5 + std::sin(7.0 * k), 0.3 + std::cos(2.0 * k), std::sin(1.0 * k) - 0.4)
            .head<kSpinSize<D>>());
  }
  return state;
}

/// A run with its measurement and an independent witness.
template <int D>
class Witnessed {
 public:
  explicit Witnessed(const Scene& scene)
      : scene(scene),
        simulation(model_of<D>(scene, 11), uneven_start<D>()),
        witness(simulation),
        windows{scene.measure.burn_in, scene.measure.duration / 512.0, 512} {
    simulation.add_observer(witness);
    Measurement<D> measurement(simulation, scene.measure, windows.end());
    simulation.run_until(windows.end());
    measured = measurement.result();
    witness.finish();
  }

  nlohmann::json result(const Performance& performance = {}) const {
    return result_json(scene, 11, simulation, measured, performance);
  }

  std::vector<std::vector<Numbers>> cell_sums() const {
    return cell_sums_of<D>(witness, windows, Vessel<D>::box, Vessel<D>::cells);
  }

  Scene scene;
  Simulation<D> simulation;
  Witness<D> witness;
  Windows windows;
  Measured measured;
};

/// Artificial residuals, different for each equation and each cell.
template <int D>
Residuals made_up_residuals() {
  Residuals residuals;
  for (int equation = 0; equation < D + 2; ++equation) {
    std::vector<double>& cells = residuals.equations.emplace_back();
    for (int cell = 0; cell < Vessel<D>::cells.prod(); ++cell) {
      cells.push_back((cell % 2 ? -0.125 : 0.125) * (100 * (equation + 1) + cell));
    }
  }
  return residuals;
}

}  // namespace clatter::testing
