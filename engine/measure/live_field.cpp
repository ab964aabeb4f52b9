#include "engine/measure/live_field.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <utility>

#include "engine/measure/fields.h"

namespace clatter {

static IntVec<2> cells_of_one_diameter(const Model<2>& model) {
  constexpr double kMostCells = 512.0;
  IntVec<2> cells;
  for (int axis = 0; axis < 2; ++axis) {
    cells[axis] =
        static_cast<int>(std::clamp(std::round(model.box[axis] / model.diameter), 1.0, kMostCells));
  }
  return cells;
}

// The components along x and y.
static std::array<Field, 2> components_of(Arrows arrows) {
  switch (arrows) {
    case Arrows::Velocity:
      return {Field::VelocityX, Field::VelocityY};
    case Arrows::HeatFlux:
      return {Field::HeatFluxX, Field::HeatFluxY};
  }
  return {};
}

static std::vector<Field> fields_of(const View& view) {
  std::vector<Field> fields;
  if (view.field) fields.push_back(*view.field);
  if (view.arrows) {
    for (const Field component : components_of(*view.arrows)) fields.push_back(component);
  }
  return fields;
}

LiveField::LiveField(Simulation<2>& simulation, const View& view)
    : field_(view.field),
      arrows_(view.arrows),
      integrals_(simulation, cells_of_one_diameter(simulation.model()),
                 moment_layout<2>(fields_of(view), simulation.model().spins)) {
  simulation.add_observer(integrals_);
  const double part = view.window / kParts;
  simulation.every(simulation.time() + part, part, [this](double) {
    open_ += integrals_.close_window();
    parts_.push_back(std::exchange(open_, {}));
    if (parts_.size() > kParts) parts_.pop_front();
  });
}

void LiveField::publish(Snapshot& snapshot) {
  const CellSums sums = last_window();
  if (field_) snapshot.field = map_of(sums);
  if (arrows_) snapshot.arrows = arrows_of(sums);
}

CellSums LiveField::last_window() {
  open_ += integrals_.close_window();
  CellSums sums = open_;
  for (const CellSums& part : parts_) sums += part;
  return sums;
}

FieldMap LiveField::map_of(const CellSums& sums) const {
  const FieldGrid<2>& grid = integrals_.grid();
  FieldMap map{*field_,
               {grid.cells().x(), grid.cells().y()},
               std::vector<double>(grid.size()),
               parts_.size() == kParts};
  for (std::size_t i = 0; i < map.values.size(); ++i) {
    map.values[i] =
        sums.time > 0.0
            ? field_value(*field_, averages_of(integrals_.layout(), sums, i, grid.cell_measure()))
            : std::numeric_limits<double>::quiet_NaN();
  }
  return map;
}

// The sums of the cells from `first` on and before `end`, as those of one cell.
static CellSums sum_of(const CellSums& sums, const IntVec<2>& cells, const IntVec<2>& first,
                       const IntVec<2>& end) {
  const std::size_t size = sums.rows.size() / static_cast<std::size_t>(cells.prod());
  CellSums block{sums.time, sums.kinetic_weight, std::vector<double>(size)};
  for (int y = first.y(); y < end.y(); ++y) {
    for (int x = first.x(); x < end.x(); ++x) {
      const std::size_t row = size * static_cast<std::size_t>(x + y * cells.x());
      for (std::size_t k = 0; k < size; ++k) block.rows[k] += sums.rows[row + k];
    }
  }
  return block;
}

// Blocks of cells have an arrow each, so that few enough are left to be told apart. Sums add up
// over cells: an arrow is the field of its block as if that were one cell.
ArrowMap LiveField::arrows_of(const CellSums& sums) const {
  constexpr int kMostArrows = 20;  // along an axis
  const FieldGrid<2>& grid = integrals_.grid();
  const IntVec<2>& cells = grid.cells();
  const int side = (cells.maxCoeff() + kMostArrows - 1) / kMostArrows;
  const auto components = components_of(*arrows_);
  ArrowMap map{*arrows_, side * grid.widths(), {}};
  if (!(sums.time > 0.0)) return map;
  for (int y = 0; y < cells.y(); y += side) {
    for (int x = 0; x < cells.x(); x += side) {
      const IntVec<2> first(x, y), end = cells.cwiseMin(first + IntVec<2>::Constant(side));
      const double area = (end - first).prod() * grid.cell_measure();
      const auto averages =
          averages_of(integrals_.layout(), sum_of(sums, cells, first, end), 0, area);
      const Vec2 value(field_value(components[0], averages), field_value(components[1], averages));
      if (value.hasNaN()) continue;
      const Vec2 middle = 0.5 * (first + end).cast<double>();
      map.arrows.push_back({middle.cwiseProduct(grid.widths()), value});
    }
  }
  return map;
}

}  // namespace clatter
