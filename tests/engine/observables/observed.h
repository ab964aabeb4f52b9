#pragma once

#include <cmath>
#include <memory>
#include <string>
#include <vector>

#include "engine/measure/measurement.h"
#include "engine/run/scheduled_run.h"
#include "tests/support/scenes.h"

namespace clatter::testing {

/// Measures one observable of a scene over `duration`, from the time 0.
template <int D>
Measured observed(const Scene& scene, Measure measure, ObservableKind kind, double duration,
                  std::uint64_t seed) {
  measure.burn_in = 0.0;
  measure.cells.resize(D, 1);
  measure.observables = {kind};
  const auto simulation = simulation_of<D>(scene, seed);
  Measurement<D> measurement(*simulation, measure, duration);
  simulation->run_until(duration);
  return measurement.result();
}

/// A gas between walls of two temperatures along x, periodic along the other axes, with sides
/// without symmetry.
template <int D>
Scene heated_gas() {
  Scene scene = gas(D == 2 ? VecX(Vec2(11.0, 7.0)) : VecX(Vec<3>(7.0, 5.0, 6.0)), 30, 0.9);
  scene.walls[kLeft] = {.kind = WallKind::Thermal, .temperature = 0.5};
  scene.walls[kRight] = {.kind = WallKind::Thermal, .temperature = 4.0};
  return scene;
}

/// A table by name. Throws if it is absent.
inline ResultTable table_of(const Measured& measured, const std::string& name) {
  for (const ResultTable& table : measured.tables()) {
    if (table.name == name) return table;
  }
  throw std::out_of_range(name);
}

/// A column of a table by name. Throws if it is absent.
inline TableColumn column_of(const ResultTable& table, const std::string& name) {
  for (const TableColumn& column : table.columns) {
    if (column.name == name) return column;
  }
  throw std::out_of_range(name);
}

/// A mean by its dotted name. Throws if it is absent.
inline Estimate mean_of(const Measured& measured, const std::string& name) {
  for (const ObservableResult& observable : measured.observables) {
    for (const auto& [other, estimate] : observable.means) {
      if (other == name) return estimate;
    }
  }
  throw std::out_of_range(name);
}

/// Distance of an estimate from its expected value, in standard errors.
inline double errors_off(const Estimate& estimate, double expected) {
  return std::fabs(estimate.mean - expected) / estimate.standard_error;
}

}  // namespace clatter::testing
