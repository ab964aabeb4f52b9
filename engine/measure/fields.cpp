#include "engine/measure/fields.h"

#include <algorithm>
#include <cmath>
#include <limits>

namespace clatter {

double field_value(Field field, const CellMoments<2>& moments, double measure) {
  if (field == Field::Density) return moments.count / measure;
  if (!(moments.count > 0.0)) return std::numeric_limits<double>::quiet_NaN();
  const Vec2 mean = moments.velocity / moments.count;
  const Vec2 temperature = moments.velocity_squared / moments.count - mean.cwiseAbs2();
  switch (field) {
    case Field::VelocityX:
      return mean.x();
    case Field::VelocityY:
      return mean.y();
    case Field::TemperatureX:
      return temperature.x();
    case Field::TemperatureY:
      return temperature.y();
    case Field::Temperature:
      return 0.5 * temperature.sum();
    case Field::Density:
      break;
  }
  return moments.count / measure;
}

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
    : simulation_(simulation),
      field_(*view.field),
      integrals_(simulation, cells_of_one_diameter(simulation.model())),
      open_(static_cast<std::size_t>(integrals_.cells().prod())),
      open_until_(simulation.time()) {
  simulation.add_observer(integrals_);
  const double part = view.window / kParts;
  simulation.every(simulation.time() + part, part, [this](double) {
    close_part();
    parts_.push_back(std::move(open_));
    spans_.push_back(open_span_);
    open_.assign(parts_.back().size(), {});
    open_span_ = 0.0;
    if (parts_.size() > kParts) {
      parts_.pop_front();
      spans_.pop_front();
    }
  });
}

void LiveField::close_part() {
  const Grid more = integrals_.close_window();
  for (std::size_t i = 0; i < open_.size(); ++i) open_[i] += more[i];
  open_span_ += simulation_.time() - open_until_;
  open_until_ = simulation_.time();
}

FieldMap LiveField::map() {
  close_part();
  Grid sum = open_;
  double span = open_span_;
  for (std::size_t k = 0; k < parts_.size(); ++k) {
    for (std::size_t i = 0; i < sum.size(); ++i) sum[i] += parts_[k][i];
    span += spans_[k];
  }
  const IntVec<2>& cells = integrals_.cells();
  const double area = simulation_.model().box.prod() / static_cast<double>(cells.prod());
  FieldMap map{field_, {cells.x(), cells.y()}, std::vector<double>(sum.size())};
  for (std::size_t i = 0; i < sum.size(); ++i) {
    map.values[i] = span > 0.0 ? field_value(field_, sum[i], span * area)
                               : std::numeric_limits<double>::quiet_NaN();
  }
  return map;
}

}  // namespace clatter
