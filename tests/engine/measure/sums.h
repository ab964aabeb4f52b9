#pragma once

#include <vector>

#include "engine/measure/cell_integrals.h"
#include "engine/scene/field.h"

namespace clatter::testing {

/// All fields that are averages.
inline std::vector<Field> average_fields() {
  std::vector<Field> fields = all_fields(2);
  std::erase_if(fields, [](Field field) { return is_residual(field); });
  return fields;
}

/// A layout with all sums.
inline MomentLayout<2> full_layout() {
  return moment_layout<2>(average_fields(), true, false);
}

/// The sums of a cell by name.
struct Sums {
  double count = 0.0;
  Vec2 velocity = Vec2::Zero();
  Eigen::Matrix2d products = Eigen::Matrix2d::Zero();
  Vec2 energy_flux = Vec2::Zero();
  double spin = 0.0;
  double spin_energy = 0.0;
  Eigen::Matrix2d transfer = Eigen::Matrix2d::Zero();
  Vec2 energy_transfer = Vec2::Zero();
  double dissipation = 0.0;

  Sums& operator+=(const Sums& other) {
    count += other.count;
    velocity += other.velocity;
    products += other.products;
    energy_flux += other.energy_flux;
    spin += other.spin;
    spin_energy += other.spin_energy;
    transfer += other.transfer;
    energy_transfer += other.energy_transfer;
    dissipation += other.dissipation;
    return *this;
  }
  Vec2 squares() const { return products.diagonal(); }
};

/// The largest difference between equal sums of two cells.
inline double difference(const Sums& a, const Sums& b) {
  double largest = 0.0;
  const auto compare = [&](const auto& x, const auto& y) {
    largest = std::max(largest, (x - y).cwiseAbs().maxCoeff());
  };
  const auto numbers = [](const Sums& s) {
    return Eigen::Vector4d(s.count, s.spin, s.spin_energy, s.dissipation);
  };
  compare(numbers(a), numbers(b));
  compare(a.velocity, b.velocity);
  compare(a.products, b.products);
  compare(a.energy_flux, b.energy_flux);
  compare(a.transfer, b.transfer);
  compare(a.energy_transfer, b.energy_transfer);
  return largest;
}

using Grid = std::vector<Sums>;

/// The cells of a window with a full layout.
inline Grid grid_of(const CellSums& sums, const MomentLayout<2>& layout) {
  Grid grid(sums.rows.size() / static_cast<std::size_t>(layout.size));
  const double* row = sums.rows.data();
  for (Sums& cell : grid) {
    const auto read = [&](int place, int k) { return place < 0 ? 0.0 : row[place + k]; };
    cell.count = row[layout.count];
    cell.spin = read(layout.spin, 0);
    cell.spin_energy = read(layout.spin_energy, 0);
    cell.dissipation = read(layout.dissipation, 0);
    for (int k = 0; k < 2; ++k) {
      cell.velocity[k] = read(layout.momentum, k);
      cell.energy_flux[k] = read(layout.energy_flux, k);
      cell.energy_transfer[k] = read(layout.energy_transfer, k);
      for (int l = 0; l < 2; ++l) {
        cell.products(k, l) = k == l ? read(layout.squares, k) : read(layout.shears, 0);
        cell.transfer(k, l) = read(layout.transfer, 2 * k + l);
      }
    }
    row += layout.size;
  }
  return grid;
}

/// The sums of a CellIntegrals with a full layout since the last call.
inline Grid close(CellIntegrals<2>& integrals) {
  return grid_of(integrals.close_window(), integrals.layout());
}

inline double difference(const Grid& a, const Grid& b) {
  REQUIRE(a.size() == b.size());
  double largest = 0.0;
  for (std::size_t i = 0; i < a.size(); ++i) largest = std::max(largest, difference(a[i], b[i]));
  return largest;
}

inline Sums total(const Grid& grid) {
  Sums sum;
  for (const Sums& cell : grid) sum += cell;
  return sum;
}

}  // namespace clatter::testing
