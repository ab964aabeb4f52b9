#include "engine/measure/live_field.h"

#include <algorithm>
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

LiveField::LiveField(Simulation<2>& simulation, const View& view)
    : field_(*view.field),
      integrals_(simulation, cells_of_one_diameter(simulation.model()),
                 moment_layout<2>({&field_, 1}, simulation.model().spins)),
      start_(simulation.time() + view.window / kParts) {
  close_parts(simulation, view.window / kParts);
}

LiveField::LiveField(Simulation<2>& simulation, const View& view, LiveField&& before)
    : field_(*view.field),
      integrals_(simulation, cells_of_one_diameter(simulation.model()),
                 moment_layout<2>({&field_, 1}, simulation.model().spins)),
      start_(before.start_),
      closed_(before.closed_) {
  before.open_ += before.integrals_.close_window();
  if (before.integrals_.layout().size == integrals_.layout().size) {
    parts_ = std::move(before.parts_);
    open_ = std::move(before.open_);
  }
  close_parts(simulation, view.window / kParts);
}

void LiveField::close_parts(Simulation<2>& simulation, double part) {
  simulation.add_observer(integrals_);
  const auto close = [this](double) {
    ++closed_;
    open_ += integrals_.close_window();
    parts_.push_back(std::exchange(open_, {}));
    if (parts_.size() > kParts) parts_.pop_front();
  };
  simulation.every(start_, part, close, closed_);
}

FieldMap LiveField::map() {
  open_ += integrals_.close_window();
  CellSums sum = open_;
  for (const CellSums& part : parts_) sum += part;
  const FieldGrid<2>& grid = integrals_.grid();
  FieldMap map{field_, {grid.cells().x(), grid.cells().y()}, std::vector<double>(grid.size())};
  for (std::size_t i = 0; i < map.values.size(); ++i) {
    map.values[i] =
        sum.time > 0.0
            ? field_value(field_, averages_of(integrals_.layout(), sum, i, grid.cell_measure()))
            : std::numeric_limits<double>::quiet_NaN();
  }
  return map;
}

}  // namespace clatter
