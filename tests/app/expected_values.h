#pragma once

#include <functional>
#include <limits>
#include <map>
#include <nlohmann/json.hpp>
#include <string>
#include <vector>

#include "tests/app/witnessed_run.h"

// Fields, profiles and series that follow from the events of a run, by their definitions.

namespace clatter::testing {

using nlohmann::json;

/// The gas in a cell, or in a row of cells (theory 8). In a cell without particles, the transfer by
/// collisions refers to a gas at rest, and the kinetic parts are not numbers.
template <int D>
struct CellGas {
  using Matrix = Eigen::Matrix<double, D, D>;

  CellGas(const Numbers& sums, double volume_and_time) {
    using C = CellOf<D>;
    const Numbers s = sums / volume_and_time;
    const auto vector = [&](int place) { return Vec<D>(s.segment<D>(place)); };
    const auto matrix = [&](int place) {
      Matrix m;
      for (int k = 0; k < D; ++k) m.row(k) = vector(place + D * k);
      return m;
    };
    density = s[C::kCount];
    collisional = -matrix(C::kTransfer);
    collisional_heat = vector(C::kEnergyTransfer);
    dissipation = s[C::kSources];
    if (density == 0.0) return;
    velocity = vector(C::kVelocity) / density;
    const Matrix squares = matrix(C::kSquares);
    kinetic = density * velocity * velocity.transpose() - squares;
    const double energy = 0.5 * squares.trace() + s[C::kSpinEnergy];
    kinetic_heat = vector(C::kEnergyFlow) - energy * velocity + kinetic * velocity;
    collisional_heat += collisional * velocity;
    spin = s.segment<kSpinSize<D>>(C::kSpin) / density;
    spin_temperature = 2.0 * s[C::kSpinEnergy] / kSpinSize<D> / density;
  }

  double temperature(int axis) const { return -kinetic(axis, axis) / density; }
  double temperature() const { return -kinetic.trace() / D / density; }
  double stress(int k, int l) const { return whole(kinetic(k, l), collisional(k, l)); }
  double heat(int k) const { return whole(kinetic_heat[k], collisional_heat[k]); }
  double whole(double by_particles, double by_collisions) const {
    if (density > 0.0) return by_particles + by_collisions;
    return by_collisions == 0.0 ? kNone : by_collisions;
  }

  static constexpr double kNone = std::numeric_limits<double>::quiet_NaN();
  double density;
  Vec<D> velocity = Vec<D>::Constant(kNone);
  Matrix kinetic = Matrix::Constant(kNone), collisional;  // stress
  Vec<D> kinetic_heat = Vec<D>::Constant(kNone), collisional_heat;
  double dissipation;
  Spin<D> spin = Spin<D>::Constant(kNone);
  double spin_temperature = kNone;
};

/// A field of a result: its unit, and its value in a gas.
template <int D>
struct FieldMeaning {
  const char* unit;
  std::function<double(const CellGas<D>&)> value;
  /// Array and component in VTK, if these are not the field itself.
  std::string array = "";
  std::size_t component = 0;
};

inline constexpr const char* kAxisNames[] = {"x", "y", "z"};

/// All fields by name.
template <int D>
const std::map<std::string, FieldMeaning<D>>& fields() {
  using Gas = const CellGas<D>&;
  constexpr bool kDisks = D == 2;
  static const auto all = [] {
    std::map<std::string, FieldMeaning<D>> all = {
        {"density", {kDisks ? "1/a^2" : "1/a^3", [](Gas g) { return g.density; }}},
        {"temperature", {"m a^2/t^2", [](Gas g) { return g.temperature(); }}},
        {"dissipation", {kDisks ? "m/t^3" : "m/(a t^3)", [](Gas g) { return g.dissipation; }}},
        {"spin_temperature", {"m a^2/t^2", [](Gas g) { return g.spin_temperature; }}}};
    const char* const stress_unit = kDisks ? "m/t^2" : "m/(a t^2)";
    const char* const heat_unit = kDisks ? "m a/t^3" : "m/t^3";
    for (int k = 0; k < D; ++k) {
      const std::string axis = kAxisNames[k];
      const auto place = static_cast<std::size_t>(k);
      all["velocity_" + axis] = {"a/t", [k](Gas g) { return g.velocity[k]; }, "velocity", place};
      all["temperature_" + axis] = {"m a^2/t^2", [k](Gas g) { return g.temperature(k); }};
      all["heat_flux_" + axis] = {heat_unit, [k](Gas g) { return g.heat(k); }, "heat_flux", place};
      all["heat_flux_" + axis + "_kinetic"] = {heat_unit, [k](Gas g) { return g.kinetic_heat[k]; },
                                               "heat_flux_kinetic", place};
      all["heat_flux_" + axis + "_collisional"] = {
          heat_unit, [k](Gas g) { return g.collisional_heat[k]; }, "heat_flux_collisional", place};
      for (int l = k; l < D; ++l) {
        const std::string name = "stress_" + axis + kAxisNames[l];
        const std::size_t tensor_place = k == l ? place : l - k == 2 ? 5 : 3 + place;
        all[name] = {stress_unit, [=](Gas g) { return g.stress(k, l); }, "stress", tensor_place};
        all[name + "_kinetic"] = {stress_unit, [=](Gas g) { return g.kinetic(k, l); },
                                  "stress_kinetic", tensor_place};
        all[name + "_collisional"] = {stress_unit, [=](Gas g) { return g.collisional(k, l); },
                                      "stress_collisional", tensor_place};
      }
    }
    if (kDisks) all["spin"] = {"1/t", [](Gas g) { return g.spin[0]; }};
    for (int k = 0; k < kSpinSize<D> && !kDisks; ++k) {
      all[std::string("spin_") + kAxisNames[k]] = {"1/t", [k](Gas g) { return g.spin[k]; }, "spin",
                                                   static_cast<std::size_t>(k)};
    }
    return all;
  }();
  return all;
}

/// The sums of the cells in `chosen`, in every window.
inline std::vector<Numbers> joined(const std::vector<std::vector<Numbers>>& sums,
                                   const std::vector<int>& chosen) {
  std::vector<Numbers> joined;
  for (const auto& window : sums) {
    Numbers& sum = joined.emplace_back(Numbers::Zero(window.front().size()));
    for (const int cell : chosen) sum += window[static_cast<std::size_t>(cell)];
  }
  return joined;
}

/// A profile as in the result file.
template <int D>
json profile_of(const std::vector<std::vector<Numbers>>& sums, const Windows& windows, int axis) {
  const int places = Vessel<D>::cells[axis];
  json profile = {{"axis", kAxisNames[axis]}};
  for (int i = 0; i <= places; ++i) profile["edges"].push_back(Vessel<D>::box[axis] * i / places);
  for (int i = 0; i < places; ++i) {
    std::vector<int> cells;
    for (int cell = 0; cell < Vessel<D>::cells.prod(); ++cell) {
      if (index_along<D>(axis, cell) == i) cells.push_back(cell);
    }
    const std::vector<Numbers> series = joined(sums, cells);
    const double volume = Vessel<D>::box.prod() / places;
    for (const auto& [name, field] : fields<D>()) {
      const WitnessedMean mean = mean_of(series, [&](const Numbers& window) {
        return field.value(CellGas<D>(window, volume * windows.length));
      });
      profile[name].push_back(mean.mean);
      profile["standard_error"][name].push_back(mean.standard_error);
    }
  }
  return profile;
}

/// The series of temperatures as in the result file, at multiples of `interval` before `end`.
template <int D>
json time_series(const Witness<D>& witness, double end, double interval) {
  json series;
  for (int k = 0; k * interval < end; ++k) {
    double squares = 0.0, spin_squares = 0.0;
    witness.at(k * interval, [&](const Vec<D>& v, const Spin<D>& spin) {
      squares += v.squaredNorm();
      spin_squares += spin.squaredNorm();
    });
    const auto count = static_cast<double>(witness.count());
    series["time"].push_back(k * interval);
    series["translational"].push_back(squares / (D * count));
    series["spin"].push_back(witness.moment_of_inertia() * spin_squares / (kSpinSize<D> * count));
  }
  return series;
}

}  // namespace clatter::testing
