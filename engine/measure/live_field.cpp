#include "engine/measure/live_field.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include "engine/measure/fields.h"
#include "engine/measure/residuals.h"

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

LiveField::Watch LiveField::watch_of(const Simulation<2>& simulation, Field field,
                                     const IntVec<2>& cells) {
  if (is_residual(field)) return Closure{Balance<2>(simulation, cells), {}};
  const MomentLayout<2> layout = moment_layout<2>({&field, 1}, simulation.model().spins);
  return Average{CellIntegrals<2>(simulation, cells, layout), {}};
}

LiveField::LiveField(Simulation<2>& simulation, const View& view)
    : field_(*view.field),
      cells_(cells_of_one_diameter(simulation.model())),
      watch_(watch_of(simulation, field_, cells_)) {
  std::visit([&](auto& watch) { simulation.add_observer(watch.observer); }, watch_);
  const double part = view.window / kWindowParts;
  simulation.every(simulation.time() + part, part, [this](double) {
    std::visit(
        [](auto& watch) {
          watch.look();
          watch.sums.next_part();
        },
        watch_);
  });
}

FieldMap LiveField::map() {
  FieldMap map{field_, {cells_.x(), cells_.y()}, {}};
  std::visit(
      [&](auto& watch) {
        watch.look();
        map.values = watch.values(field_);
      },
      watch_);
  return map;
}

std::vector<double> LiveField::Average::values(Field field) const {
  const CellSums sum = sums.sum();
  const FieldGrid<2>& grid = observer.grid();
  std::vector<double> values(grid.size(), std::numeric_limits<double>::quiet_NaN());
  if (!(sum.time > 0.0)) return values;
  for (std::size_t i = 0; i < values.size(); ++i) {
    values[i] = field_value(field, averages_of(observer.layout(), sum, i, grid.cell_measure()));
  }
  return values;
}

// Where nothing was booked nothing was tried.
std::vector<double> LiveField::Closure::values(Field field) const {
  const Imbalances<2> sum = sums.sum();
  std::vector<double> values(sum.gaps.size(), std::numeric_limits<double>::quiet_NaN());
  for (std::size_t i = 0; i < values.size(); ++i) {
    const Conserved<2> residual = sum.residual(i);
    if (!sum.sizes[i].isZero(0.0) || !residual.isZero(0.0))
      values[i] = residual[equation_of(field)];
  }
  return values;
}

}  // namespace clatter
