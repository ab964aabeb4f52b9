#include "engine/measure/cell_path.h"

#include <algorithm>
#include <cmath>
#include <cstdlib>

#include "engine/physics/fall_time.h"

namespace clatter {

// Places this far outside of a cell, in box lengths, still lie in it: more than what long flights
// gather in rounding, less than any cell.
static constexpr double kRounding = 1e-9;

template <int D>
CellPath<D>::CellPath(const Model<D>& model, const IntVec<D>& cells)
    : model_(model),
      cells_(cells),
      widths_(model.box.cwiseQuotient(cells.template cast<double>())) {}

template <int D>
std::size_t CellPath<D>::index(const IntVec<D>& cell) const {
  std::size_t index = 0;
  for (int axis = D - 1; axis >= 0; --axis) {
    index = index * static_cast<std::size_t>(cells_[axis]) + static_cast<std::size_t>(cell[axis]);
  }
  return index;
}

template <int D>
IntVec<D> CellPath<D>::cell(std::size_t index) const {
  IntVec<D> cell;
  for (int axis = 0; axis < D; ++axis) {
    const auto count = static_cast<std::size_t>(cells_[axis]);
    cell[axis] = static_cast<int>(index % count);
    index /= count;
  }
  return cell;
}

template <int D>
IntVec<D> CellPath<D>::cell_at(const Vec<D>& place) const {
  IntVec<D> cell;
  for (int axis = 0; axis < D; ++axis) {
    double share = place[axis] / model_.box[axis];
    if (model_.periodic(axis)) share -= std::floor(share);
    const double count = cells_[axis];
    cell[axis] = static_cast<int>(std::clamp(std::floor(share * count), 0.0, count - 1.0));
  }
  return cell;
}

// Whole box lengths from a cell to the image of it that a place lies in.
template <int D>
double CellPath<D>::image_index(int axis, int cell, double place) const {
  if (!model_.periodic(axis)) return 0.0;
  return std::round((place - (cell + 0.5) * widths_[axis]) / model_.box[axis]);
}

// The image of a place that lies at a cell.
template <int D>
double CellPath<D>::near(int axis, int cell, double place) const {
  return place - model_.box[axis] * image_index(axis, cell, place);
}

template <int D>
double CellPath<D>::face(int axis, int cell, int step) const {
  return (cell + (step > 0)) * widths_[axis];
}

template <int D>
bool CellPath<D>::has_face(int axis, int cell, int step) const {
  if (model_.periodic(axis)) return cells_[axis] > 1;
  return cell + step >= 0 && cell + step < cells_[axis];
}

template <int D>
bool CellPath<D>::is_current(const IntVec<D>& cell, const Vec<D>& place) const {
  for (int axis = 0; axis < D; ++axis) {
    const double at = near(axis, cell[axis], place[axis]);
    for (const int step : {-1, 1}) {
      const double inside = step * (face(axis, cell[axis], step) - at);
      if (has_face(axis, cell[axis], step) && inside < -kRounding * model_.box[axis]) return false;
    }
  }
  return true;
}

template <int D>
IntVec<D> CellPath<D>::beyond(IntVec<D> cell, int axis, int step) const {
  cell[axis] = (cell[axis] + step + cells_[axis]) % cells_[axis];
  return cell;
}

// Along each axis a straight flight has one face ahead, a parabola may return to the one behind. A
// particle beyond a face by rounding crosses it at once if it flies outwards, and not if it flies
// back.
template <int D>
FaceCrossing CellPath<D>::next_crossing(const Flight<D>& flight, const IntVec<D>& cell,
                                        double time) const {
  const Vec<D>& gravity = model_.gravity;
  const Vec<D> r = flight.at(time, gravity);
  const Vec<D> v = flight.velocity_at(time, gravity);
  FaceCrossing next;
  for (int axis = 0; axis < D; ++axis) {
    const double at = near(axis, cell[axis], r[axis]);
    for (const int step : {-1, 1}) {
      if (!has_face(axis, cell[axis], step)) continue;
      const double gap = step * (face(axis, cell[axis], step) - at);
      const double crossing = time + fall_time(gap, -step * v[axis], -step * gravity[axis]);
      if (crossing < next.at) next = {crossing, axis, step};
    }
  }
  return next;
}

// How many faces lie between follows from the two cells, only their order from the places: so the
// path ends where it should though an end lies on a face.
template <int D>
std::vector<FaceCrossing> CellPath<D>::along(const Vec<D>& start, const Vec<D>& branch,
                                             const IntVec<D>& from, const IntVec<D>& to) const {
  std::vector<FaceCrossing> crossings;
  for (int axis = 0; axis < D; ++axis) {
    if (cells_[axis] == 1) continue;
    const double at = near(axis, from[axis], start[axis]);
    const double boxes = image_index(axis, to[axis], at + branch[axis]);
    const int steps = to[axis] + static_cast<int>(boxes) * cells_[axis] - from[axis];
    const int step = steps < 0 ? -1 : 1;
    for (int k = 0; k < std::abs(steps); ++k) {
      const double ahead = face(axis, from[axis] + k * step, step) - at;
      const double share = branch[axis] != 0.0 ? std::clamp(ahead / branch[axis], 0.0, 1.0) : 0.0;
      crossings.push_back({share, axis, step});
    }
  }
  std::stable_sort(crossings.begin(), crossings.end(),
                   [](const auto& a, const auto& b) { return a.at < b.at; });
  return crossings;
}

template class CellPath<2>;

}  // namespace clatter
