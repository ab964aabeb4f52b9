#pragma once

#include <doctest/doctest.h>

#include <algorithm>
#include <cmath>
#include <memory>
#include <numeric>
#include <string>
#include <vector>

#include "engine/measure/measurement.h"
#include "engine/run/scheduled_run.h"
#include "tests/support/dimensions.h"
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

/// The shortest vector between the images of two positions, from any vector between them.
template <int D>
Vec<D> nearest_image(const Model<D>& model, Vec<D> apart) {
  for (int axis = 0; axis < D; ++axis) {
    if (model.periodic(axis)) {
      apart[axis] -= model.box[axis] * std::round(apart[axis] / model.box[axis]);
    }
  }
  return apart;
}

/// Checks a histogram between the columns low and high. Returns how many of the numbers are in it.
inline double check_density(const ResultTable& table, const std::string& column,
                            const std::vector<double>& numbers) {
  CAPTURE(table.name);
  CAPTURE(column);
  const TableColumn low = column_of(table, "low"), high = column_of(table, "high");
  const TableColumn density = column_of(table, column);
  double total = 0.0;
  for (std::size_t row = 0; row < low.values.size(); ++row) {
    const auto inside = static_cast<double>(std::ranges::count_if(numbers, [&](double number) {
      return number >= low.values[row] && number < high.values[row];
    }));
    const double width = high.values[row] - low.values[row];
    CHECK(density.values[row] ==
          doctest::Approx(inside / static_cast<double>(numbers.size()) / width).epsilon(1e-9));
    total += inside;
  }
  return total;
}

/// Checks the mean, the variance, if it has a name, and the histogram of numbers.
inline void check_numbers(const Measured& measured, const std::string& table,
                          const std::string& mean_name, const std::string& variance_name,
                          const std::vector<double>& numbers) {
  const auto count = static_cast<double>(numbers.size());
  const double mean = std::accumulate(numbers.begin(), numbers.end(), 0.0) / count;
  double variance = 0.0;
  for (const double number : numbers) variance += (number - mean) * (number - mean) / count;
  CHECK(mean_of(measured, mean_name).mean == doctest::Approx(mean).epsilon(1e-9));
  if (!variance_name.empty()) {
    CHECK(mean_of(measured, variance_name).mean == doctest::Approx(variance).epsilon(1e-9));
  }
  CHECK(check_density(table_of(measured, table), "density", numbers) == count);
}

}  // namespace clatter::testing
