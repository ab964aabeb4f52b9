#include "engine/measure/live_field.h"

#include <algorithm>
#include <cmath>
#include <utility>

#include "engine/measure/field_maps.h"

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
                 moment_layout<2>({&field_, 1}, simulation.model().spins)) {
  simulation.add_observer(integrals_);
  const double part = view.window / kParts;
  simulation.every(simulation.time() + part, part, [this](double) {
    open_ += integrals_.close_window();
    parts_.push_back(std::exchange(open_, {}));
    if (parts_.size() > kParts) parts_.pop_front();
  });
}

FieldMap LiveField::map() {
  open_ += integrals_.close_window();
  CellSums sum = open_;
  for (const CellSums& part : parts_) sum += part;
  return field_map(field_, sum, integrals_.grid(), integrals_.layout());
}

}  // namespace clatter
