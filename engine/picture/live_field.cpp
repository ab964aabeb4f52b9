#include "engine/picture/live_field.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>

#include "engine/measure/field_maps.h"
#include "engine/measure/fields.h"
#include "engine/measure/mean_diameter.h"
#include "engine/measure/residuals.h"

namespace clatter {

template <int D>
static IntVec<D> cells_of_one_diameter(const Simulation<D>& simulation) {
  constexpr double kMaxCells = D == 2 ? 512.0 : 64.0;
  const double diameter = mean_diameter(simulation);
  IntVec<D> cells;
  for (int axis = 0; axis < D; ++axis) {
    const double along = std::round(simulation.model().box[axis] / diameter);
    cells[axis] = static_cast<int>(std::clamp(along, 1.0, kMaxCells));
  }
  return cells;
}

static std::vector<Field> averages_in(const View& view, int dimension) {
  std::vector<Field> fields;
  if (view.field && !is_residual(*view.field)) fields.push_back(*view.field);
  if (view.arrows) {
    for (int axis = 0; axis < dimension; ++axis) fields.emplace_back(*view.arrows, axis);
  }
  return fields;
}

template <int D>
std::string LiveField<D>::species_of(const Simulation<D>& simulation, const View& view) {
  if (!view.field || view.field->species == Field::kNone) return {};
  return simulation.model().species->name(static_cast<std::size_t>(view.field->species));
}

template <int D>
std::optional<typename LiveField<D>::Averages> LiveField<D>::averages_for(
    const Simulation<D>& simulation, const View& view) {
  const std::vector<Field> fields = averages_in(view, D);
  if (fields.empty()) return std::nullopt;
  const Model<D>& model = simulation.model();
  const MomentLayout<D> layout = moment_layout<D>(fields, model.spins, simulation.is_mixture());
  return Averages{
      CellIntegrals<D>(simulation, cells_of_one_diameter(simulation), layout, {view.estimator, {}}),
      {}};
}

template <int D>
std::optional<typename LiveField<D>::Closure> LiveField<D>::closure_for(
    const Simulation<D>& simulation, const View& view) {
  if (!view.field || !is_residual(*view.field)) return std::nullopt;
  return Closure{Balance<D>(simulation, cells_of_one_diameter(simulation)), {}};
}

template <int D>
LiveField<D>::LiveField(Simulation<D>& simulation, const View& view)
    : simulation_(simulation),
      field_(view.field),
      species_(species_of(simulation, view)),
      arrows_(view.arrows),
      averages_(averages_for(simulation, view)),
      closure_(closure_for(simulation, view)),
      start_(simulation.time() + view.window / kWindowParts),
      sampled_from_(simulation.time()),
      timers_(simulation) {
  watch(simulation, view);
}

template <int D>
LiveField<D>::LiveField(Simulation<D>& simulation, const View& view, LiveField&& before)
    : simulation_(simulation),
      field_(view.field),
      species_(species_of(simulation, view)),
      arrows_(view.arrows),
      averages_(averages_for(simulation, view)),
      closure_(closure_for(simulation, view)),
      start_(before.start_),
      closed_(before.closed_),
      sampled_from_(before.sampled_from_),
      samples_(before.samples_),
      timers_(simulation) {
  before.look();
  if (averages_ && before.averages_ &&
      averages_->observer.layout().size == before.averages_->observer.layout().size) {
    averages_->sums = std::move(before.averages_->sums);
  }
  if (closure_ && before.closure_) closure_->sums = std::move(before.closure_->sums);
  watch(simulation, view);
}

template <int D>
LiveField<D>::LiveField(Simulation<D>& simulation, const View& view, ArchiveReader saved)
    : simulation_(simulation),
      field_(view.field),
      species_(species_of(simulation, view)),
      arrows_(view.arrows),
      averages_(averages_for(simulation, view)),
      closure_(closure_for(simulation, view)),
      timers_(simulation) {
  visit(saved);
  saved.finish();
  saved.require(!simulation.is_overdue(start_, view.window / kWindowParts, closed_) &&
                !(samples(view) && simulation.is_overdue(sampled_from_, view.interval, samples_)));
  watch(simulation, view);
}

template <int D>
std::string LiveField<D>::save() {
  ArchiveWriter writer;
  visit(writer);
  return writer.written();
}

template <int D>
template <class Archive>
void LiveField<D>::visit(Archive& io) {
  auto& [simulation, field, species, arrows, averages, closure, start, closed, sampled_from,
         samples, of_averages, of_closure, timers] = *this;
  if (averages) io(averages->observer, averages->sums);
  if (closure) io(closure->observer, closure->sums);
  io(start, closed, sampled_from, samples);
}

// Whether averages come from samples.
template <int D>
bool LiveField<D>::samples(const View& view) const {
  return averages_ && view.estimator == Estimator::Snapshot;
}

template <int D>
void LiveField<D>::watch(Simulation<D>& simulation, const View& view) {
  if (averages_) of_averages_.emplace(simulation, averages_->observer);
  if (closure_) of_closure_.emplace(simulation, closure_->observer);
  // Timers of samples come before timers of parts, so that a sample at a part's end belongs to it.
  if (samples(view)) {
    const auto sample = [this](double) {
      ++samples_;
      averages_->observer.sample();
    };
    timers_.every(sampled_from_, view.interval, sample, samples_);
  }
  const auto close = [this](double) {
    ++closed_;
    look();
    if (averages_) averages_->sums.next_part();
    if (closure_) closure_->sums.next_part();
  };
  timers_.every(start_, view.window / kWindowParts, close, closed_);
}

template <int D>
void LiveField<D>::look() {
  if (averages_) averages_->sums.add(averages_->observer.close_window());
  if (closure_) closure_->sums.add(closure_->observer.close_window().imbalances);
}

// NaN in cells without bookings: no balance was tested there.
template <int D>
FieldMap LiveField<D>::Closure::map(Field field) const {
  const Imbalances<D> sum = sums.sum();
  const IntVec<D>& cells = observer.cells();
  FieldMap map{field, {cells.begin(), cells.end()}, {}};
  map.values.assign(sum.gaps.size(), std::numeric_limits<double>::quiet_NaN());
  for (std::size_t i = 0; i < map.values.size(); ++i) {
    const Conserved<D> residual = sum.residual(i);
    if (!sum.sizes[i].isZero(0.0) || !residual.isZero(0.0))
      map.values[i] = residual[equation_of(field, D)];
  }
  return map;
}

// One arrow per block of cells, so that arrows remain distinguishable. Sums are additive over
// cells, so an arrow is the field of its block as one large cell. Arrows of the velocity include
// the flow of a sheared box.
template <int D>
static ArrowMap arrow_map(Quantity arrows, const CellSums& sums, const FieldGrid<D>& grid,
                          const MomentLayout<D>& layout, const Domain<D>& domain) {
  constexpr int kMaxArrows = 20;  // along an axis
  const IntVec<D>& cells = grid.cells();
  const int edge = (cells.maxCoeff() + kMaxArrows - 1) / kMaxArrows;
  ArrowMap map{arrows, edge * grid.widths(), {}};
  if (!(sums.time > 0.0)) return map;
  const IntVec<D> block = IntVec<D>::Constant(edge);
  const IntVec<D> counts = block_counts(grid, block);
  const CellSums blocks = block_sums(sums, grid, block);
  for (int number = 0; number < counts.prod(); ++number) {
    IntVec<D> first;
    for (int axis = 0, rest = number; axis < D; rest /= counts[axis++]) {
      first[axis] = rest % counts[axis] * edge;
    }
    const IntVec<D> end = cells.cwiseMin(first + block);
    const double measure = (end - first).prod() * grid.cell_measure();
    const auto averages = averages_of(layout, blocks, static_cast<std::size_t>(number), measure);
    Vec<D> value;
    for (int axis = 0; axis < D; ++axis) value[axis] = field_value(Field(arrows, axis), averages);
    if (value.hasNaN()) continue;
    const Vec<D> middle = (0.5 * (first + end).template cast<double>()).cwiseProduct(grid.widths());
    if (arrows == Quantity::Velocity) value += domain.flow(middle);
    map.arrows.push_back({middle, value});
  }
  return map;
}

template <int D>
void LiveField<D>::publish(Snapshot& snapshot) {
  look();
  if (closure_) {
    snapshot.field = closure_->map(*field_);
    snapshot.field->whole_window = closure_->sums.whole();
  }
  if (!averages_) return;
  const CellSums sums = averages_->sums.sum();
  const FieldGrid<D>& grid = averages_->observer.grid();
  const MomentLayout<D>& layout = averages_->observer.layout();
  if (field_ && !closure_) {
    snapshot.field = field_maps<D>({&*field_, 1}, sums, grid, layout).front();
    snapshot.field->species = species_;
    snapshot.field->whole_window = averages_->sums.whole();
  }
  if (arrows_)
    snapshot.arrows = arrow_map(*arrows_, sums, grid, layout, simulation_.model().domain());
}

template class LiveField<2>;
template class LiveField<3>;

}  // namespace clatter
