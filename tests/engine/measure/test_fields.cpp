#include <doctest/doctest.h>

#include <cmath>
#include <deque>
#include <vector>

#include "engine/measure/fields.h"
#include "tests/engine/measure/scenes.h"
#include "tests/engine/measure/sums.h"

using namespace clatter;
using namespace clatter::testing;

namespace {

/// Particles in one cell, with the collisional transfer in it.
struct Content {
  std::vector<Vec2> velocities = {{1.0, 2.0}, {3.0, -2.5}, {-0.5, 0.25}};
  std::vector<double> spin_energies = {0.5, 0.125, 2.0};
  std::vector<double> spins = {2.0, -1.0, 4.0};  // I = 1/4
  Eigen::Matrix2d transfer{{0.7, -0.2}, {0.3, 1.1}};
  Vec2 energy_transfer = {0.4, -0.6};
  double dissipation = -0.9;
};

/// Its averages over an area.
CellAverages<2, double> averages(const Content& content, double area) {
  CellAverages<2, double> cell;
  for (std::size_t i = 0; i < content.velocities.size(); ++i) {
    const Vec2& v = content.velocities[i];
    const double energy = 0.5 * v.squaredNorm() + content.spin_energies[i];
    cell.density += 1.0 / area;
    cell.spin[0] += content.spins[i] / area;
    cell.spin_energy += content.spin_energies[i] / area;
    for (int k = 0; k < 2; ++k) {
      cell.momentum[k] += v[k] / area;
      cell.energy_flux[k] += energy * v[k] / area;
      for (int l = 0; l < 2; ++l) cell.momentum_flux[k][l] += v[k] * v[l] / area;
    }
  }
  for (int k = 0; k < 2; ++k) {
    cell.energy_transfer[k] = content.energy_transfer[k] / area;
    for (int l = 0; l < 2; ++l) cell.transfer[k][l] = content.transfer(k, l) / area;
  }
  cell.dissipation = content.dissipation / area;
  cell.mass_density = cell.density;
  return cell;
}

bool needs_visitors(Field field) {
  const bool of_events = field.quantity == Quantity::Dissipation || field.part == Part::Collisional;
  return field.quantity != Quantity::Density && !of_events;
}

}  // namespace

TEST_CASE("Field value: every field follows from its definition, particle by particle") {
  const Content content;
  const double area = 0.5;
  const CellAverages<2, double> cell = averages(content, area);
  const auto value = [&](Field field) { return field_value(field, cell); };
  Vec2 mean = Vec2::Zero();
  for (const Vec2& v : content.velocities) mean += v / 3.0;
  Eigen::Matrix2d kinetic = Eigen::Matrix2d::Zero();  // (theory 8.3)
  Vec2 heat = Vec2::Zero();                           // (theory 8.8), with spins
  for (std::size_t i = 0; i < 3; ++i) {
    const Vec2 own = content.velocities[i] - mean;
    kinetic -= own * own.transpose() / area;
    heat += (0.5 * own.squaredNorm() + content.spin_energies[i]) * own / area;
  }
  const Eigen::Matrix2d collisional = -content.transfer / area;
  const Vec2 heat_collisional = content.energy_transfer / area + collisional * mean;

  const auto check = [&](Field field, double expected) {
    CAPTURE(name_of(field));
    CHECK(value(field) == doctest::Approx(expected).epsilon(1e-13));
  };
  check(Quantity::Density, 6.0);
  check(Quantity::Temperature, -0.5 * kinetic.trace() / 6.0);
  for (int k = 0; k < 2; ++k) {
    check(Field(Quantity::Velocity, k), mean[k]);
    check(Field(Quantity::Temperature, k), -kinetic(k, k) / 6.0);
    check(Field(Quantity::HeatFlux, k, Part::Kinetic), heat[k]);
    check(Field(Quantity::HeatFlux, k, Part::Collisional), heat_collisional[k]);
    check(Field(Quantity::HeatFlux, k), heat[k] + heat_collisional[k]);
  }
  for (const auto& [k, l] : {std::pair(0, 0), std::pair(1, 1), std::pair(0, 1)}) {
    check(Field(Quantity::Stress, k, l, Part::Kinetic), kinetic(k, l));
    check(Field(Quantity::Stress, k, l, Part::Collisional), collisional(k, l));
    check(Field(Quantity::Stress, k, l), kinetic(k, l) + collisional(k, l));
  }
  check(Quantity::Dissipation, -1.8);
  check(Quantity::Spin, 5.0 / 3.0);
  check(Quantity::SpinTemperature, 2.0 * 2.625 / 3.0);
}

TEST_CASE("Field value: cells without particles have only densities and collisional parts") {
  const CellAverages<2, double> nothing{};
  for (const Field field : average_fields()) {
    CAPTURE(name_of(field));
    const double value = field_value(field, nothing);
    CHECK((needs_visitors(field) ? std::isnan(value) : value == 0.0));
  }
  // Between a wall and the centres of touching particles, all transfer is collisional.
  Content content;
  content.velocities.clear();
  const CellAverages<2, double> wall_layer = averages(content, 0.5);
  CHECK(field_value(Field(Quantity::Stress, 0, 0), wall_layer) == doctest::Approx(-1.4));
  CHECK(field_value(Field(Quantity::Stress, 0, 1), wall_layer) == doctest::Approx(0.4));
  CHECK(field_value(Field(Quantity::HeatFlux, 1), wall_layer) == doctest::Approx(-1.2));
  CHECK(std::isnan(field_value(Field(Quantity::Stress, 0, 0, Part::Kinetic), wall_layer)));
  CHECK(std::isnan(field_value(Field(Quantity::HeatFlux, 1, Part::Kinetic), wall_layer)));
  // Also if rounding errors move centres into it.
  CellAverages<2, double> entered = wall_layer;
  entered.density = entered.mass_density = 1e-16;
  entered.momentum[1] = 2e-16;
  CHECK(field_value(Quantity::Density, entered) == 0.0);
  CHECK(field_value(Field(Quantity::HeatFlux, 1), entered) == doctest::Approx(-1.2));
}

TEST_CASE("Dual: derivatives of all fields as finite differences have them") {
  const auto row_of = [](const CellAverages<2, double>& a) {
    const MomentLayout<2> layout = full_layout();
    std::vector<double> row(static_cast<std::size_t>(layout.size));
    row[0] = a.density;
    row[layout.spin] = a.spin[0];
    row[layout.spin_energy] = a.spin_energy;
    row[layout.shears] = a.momentum_flux[0][1];
    row[layout.dissipation] = a.dissipation;
    for (int k = 0; k < 2; ++k) {
      row[layout.momentum + k] = a.momentum[k];
      row[layout.squares + k] = a.momentum_flux[k][k];
      row[layout.energy_flux + k] = a.energy_flux[k];
      row[layout.energy_transfer + k] = a.energy_transfer[k];
      for (int l = 0; l < 2; ++l) row[layout.transfer + 2 * k + l] = a.transfer[k][l];
    }
    return row;
  };
  const MomentLayout<2> layout = full_layout();
  const std::vector<double> row = row_of(averages(Content{}, 0.5));
  for (const Field field : average_fields()) {
    for (int k = 0; k < layout.size; ++k) {
      CAPTURE(name_of(field));
      CAPTURE(k);
      std::vector<Dual> dual(row.begin(), row.end());
      dual[k].slope = 1.0;
      const double slope = field_value(field, averages_of(layout, dual.data())).slope;
      const double step = 1e-5;
      std::vector<double> up = row, down = row;
      up[k] += step;
      down[k] -= step;
      const double expected = (field_value(field, averages_of(layout, up.data())) -
                               field_value(field, averages_of(layout, down.data()))) /
                              (2.0 * step);
      CHECK(std::fabs(slope - expected) < 1e-7);
    }
  }
}

TEST_CASE("Moment layout: every field has the sums it needs, and no field needs all") {
  Scene scene = rough_mixture(20);
  scene.particles.roughness.friction = 0.4;
  scene.particles.start.spin_temperature = 1.0;
  const auto simulation = simulation_of<2>(scene, 61);
  CellIntegrals<2> all(*simulation, {6, 5}, full_layout());
  std::deque<CellIntegrals<2>> singles;
  for (const Field field : average_fields()) {
    singles.emplace_back(*simulation, IntVec<2>(6, 5), moment_layout<2>({&field, 1}, true, false));
    simulation->add_observer(singles.back());
  }
  simulation->add_observer(all);
  simulation->run_until(10.0);
  const CellSums expected = all.close_window();
  for (std::size_t f = 0; f < singles.size(); ++f) {
    const Field field = average_fields()[f];
    const MomentLayout<2>& layout = singles[f].layout();
    const CellSums sums = singles[f].close_window();
    CHECK(layout.size < all.layout().size);
    for (std::size_t i = 0; i < 30; ++i) {
      CAPTURE(f);
      CAPTURE(i);
      const double value = field_value(field, averages_of(layout, sums, i, 2.4));
      const double full = field_value(field, averages_of(all.layout(), expected, i, 2.4));
      CHECK(value == full);
    }
  }
}
