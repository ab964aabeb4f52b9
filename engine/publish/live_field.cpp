#include "engine/publish/live_field.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>

#include "engine/measure/field_maps.h"
#include "engine/measure/fields.h"
#include "engine/measure/residuals.h"

namespace clatter {

static IntVec<2> cells_of_one_diameter(const Model<2>& model) {
  constexpr double kMaxCells = 512.0;
  IntVec<2> cells;
  for (int axis = 0; axis < 2; ++axis) {
    cells[axis] =
        static_cast<int>(std::clamp(std::round(model.box[axis] / model.diameter), 1.0, kMaxCells));
  }
  return cells;
}

static std::vector<Field> averages_in(const View& view) {
  std::vector<Field> fields;
  if (view.field && !is_residual(*view.field)) fields.push_back(*view.field);
  if (view.arrows) {
    for (int axis = 0; axis < 2; ++axis) fields.emplace_back(*view.arrows, axis);
  }
  return fields;
}

std::optional<LiveField::Averages> LiveField::averages_for(const Simulation<2>& simulation,
                                                           const View& view) {
  const std::vector<Field> fields = averages_in(view);
  if (fields.empty()) return std::nullopt;
  const Model<2>& model = simulation.model();
  const MomentLayout<2> layout = moment_layout<2>(fields, model.spins);
  return Averages{
      CellIntegrals<2>(simulation, cells_of_one_diameter(model), layout, {view.estimator, {}}), {}};
}

std::optional<LiveField::Closure> LiveField::closure_for(const Simulation<2>& simulation,
                                                         const View& view) {
  if (!view.field || !is_residual(*view.field)) return std::nullopt;
  return Closure{Balance<2>(simulation, cells_of_one_diameter(simulation.model())), {}};
}

LiveField::LiveField(Simulation<2>& simulation, const View& view)
    : field_(view.field),
      arrows_(view.arrows),
      averages_(averages_for(simulation, view)),
      closure_(closure_for(simulation, view)),
      start_(simulation.time() + view.window / kWindowParts),
      sampled_from_(simulation.time()) {
  watch(simulation, view);
}

LiveField::LiveField(Simulation<2>& simulation, const View& view, LiveField&& before)
    : field_(view.field),
      arrows_(view.arrows),
      averages_(averages_for(simulation, view)),
      closure_(closure_for(simulation, view)),
      start_(before.start_),
      closed_(before.closed_),
      sampled_from_(before.sampled_from_),
      samples_(before.samples_) {
  before.look();
  if (averages_ && before.averages_ &&
      averages_->observer.layout().size == before.averages_->observer.layout().size) {
    averages_->sums = std::move(before.averages_->sums);
  }
  if (closure_ && before.closure_) closure_->sums = std::move(before.closure_->sums);
  watch(simulation, view);
}

LiveField::LiveField(Simulation<2>& simulation, const View& view, ArchiveReader saved)
    : field_(view.field),
      arrows_(view.arrows),
      averages_(averages_for(simulation, view)),
      closure_(closure_for(simulation, view)) {
  visit(saved);
  saved.finish();
  watch(simulation, view);
}

std::string LiveField::save() {
  ArchiveWriter writer;
  visit(writer);
  return writer.written();
}

template <class Archive>
void LiveField::visit(Archive& io) {
  auto& [field, arrows, averages, closure, start, closed, sampled_from, samples] = *this;
  if (averages) io(averages->observer, averages->sums);
  if (closure) io(closure->observer, closure->sums);
  io(start, closed, sampled_from, samples);
}

void LiveField::watch(Simulation<2>& simulation, const View& view) {
  if (averages_) simulation.add_observer(averages_->observer);
  if (closure_) simulation.add_observer(closure_->observer);
  // Before the parts, so that a sample at the end of one belongs to it.
  if (averages_ && view.estimator == Estimator::Snapshot) {
    const auto sample = [this](double) {
      ++samples_;
      averages_->observer.sample();
    };
    simulation.every(sampled_from_, view.interval, sample, samples_);
  }
  const auto close = [this](double) {
    ++closed_;
    look();
    if (averages_) averages_->sums.next_part();
    if (closure_) closure_->sums.next_part();
  };
  simulation.every(start_, view.window / kWindowParts, close, closed_);
}

void LiveField::look() {
  if (averages_) averages_->sums.add(averages_->observer.close_window());
  if (closure_) closure_->sums.add(closure_->observer.close_window().imbalances);
}

// Where nothing was booked nothing was tried.
FieldMap LiveField::Closure::map(Field field) const {
  const Imbalances<2> sum = sums.sum();
  FieldMap map{field, {observer.cells().x(), observer.cells().y()}, {}};
  map.values.assign(sum.gaps.size(), std::numeric_limits<double>::quiet_NaN());
  for (std::size_t i = 0; i < map.values.size(); ++i) {
    const Conserved<2> residual = sum.residual(i);
    if (!sum.sizes[i].isZero(0.0) || !residual.isZero(0.0))
      map.values[i] = residual[equation_of(field, 2)];
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
static ArrowMap arrow_map(Quantity arrows, const CellSums& sums, const FieldGrid<2>& grid,
                          const MomentLayout<2>& layout) {
  constexpr int kMaxArrows = 20;  // along an axis
  const IntVec<2>& cells = grid.cells();
  const int side = (cells.maxCoeff() + kMaxArrows - 1) / kMaxArrows;
  ArrowMap map{arrows, side * grid.widths(), {}};
  if (!(sums.time > 0.0)) return map;
  for (int y = 0; y < cells.y(); y += side) {
    for (int x = 0; x < cells.x(); x += side) {
      const IntVec<2> first(x, y), end = cells.cwiseMin(first + IntVec<2>::Constant(side));
      const double area = (end - first).prod() * grid.cell_measure();
      const auto averages = averages_of(layout, sum_of(sums, cells, first, end), 0, area);
      const Vec2 value(field_value(Field(arrows, 0), averages),
                       field_value(Field(arrows, 1), averages));
      if (value.hasNaN()) continue;
      const Vec2 middle = 0.5 * (first + end).cast<double>();
      map.arrows.push_back({middle.cwiseProduct(grid.widths()), value});
    }
  }
  return map;
}

void LiveField::publish(Snapshot& snapshot) {
  look();
  if (closure_) {
    snapshot.field = closure_->map(*field_);
    snapshot.field->whole_window = closure_->sums.whole();
  }
  if (!averages_) return;
  const CellSums sums = averages_->sums.sum();
  const FieldGrid<2>& grid = averages_->observer.grid();
  const MomentLayout<2>& layout = averages_->observer.layout();
  if (field_ && !closure_) {
    snapshot.field = field_map(*field_, sums, grid, layout);
    snapshot.field->whole_window = averages_->sums.whole();
  }
  if (arrows_) snapshot.arrows = arrow_map(*arrows_, sums, grid, layout);
}

}  // namespace clatter
