#include "engine/measure/live_field.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include "engine/measure/field_maps.h"
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

LiveField::Watch LiveField::watch_of(const Simulation<2>& simulation, Field field) {
  const Model<2>& model = simulation.model();
  const IntVec<2> cells = cells_of_one_diameter(model);
  if (is_residual(field)) return Closure{Balance<2>(simulation, cells), {}};
  const MomentLayout<2> layout = moment_layout<2>({&field, 1}, model.spins);
  return Average{CellIntegrals<2>(simulation, cells, layout), {}};
}

LiveField::LiveField(Simulation<2>& simulation, const View& view)
    : field_(*view.field), watch_(watch_of(simulation, field_)) {
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
  return std::visit(
      [&](auto& watch) {
        watch.look();
        return watch.map(field_);
      },
      watch_);
}

FieldMap LiveField::Average::map(Field field) const {
  return field_map(field, sums.sum(), observer.grid(), observer.layout());
}

// Where nothing was booked nothing was tried.
FieldMap LiveField::Closure::map(Field field) const {
  const Imbalances<2> sum = sums.sum();
  FieldMap map{field, {observer.cells().x(), observer.cells().y()}, {}};
  map.values.assign(sum.gaps.size(), std::numeric_limits<double>::quiet_NaN());
  for (std::size_t i = 0; i < map.values.size(); ++i) {
    const Conserved<2> residual = sum.residual(i);
    if (!sum.sizes[i].isZero(0.0) || !residual.isZero(0.0))
      map.values[i] = residual[equation_of(field)];
  }
  return map;
}

}  // namespace clatter
