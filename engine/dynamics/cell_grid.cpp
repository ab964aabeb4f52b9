#include "engine/dynamics/cell_grid.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numeric>

namespace clatter {

// Cells hold this many disks on average: measured best from phi = 0.1 to 0.7.
static constexpr double kDisksPerCell = 1.08;
// Cells are wider than a diameter by more than any rounding of positions.
static constexpr double kLeastWidth = 1.05;
static constexpr double kInfinity = std::numeric_limits<double>::infinity();

// Cells along each axis: as near to cubes as the box allows, shortest edge first, so that a narrow
// box has the more cells along it.
template <int D>
static IntVec<D> choose_counts(const Model<D>& model, std::size_t disks) {
  std::array<int, D> axes;
  std::iota(axes.begin(), axes.end(), 0);
  std::sort(axes.begin(), axes.end(), [&](int a, int b) { return model.box[a] < model.box[b]; });
  double cells = std::max(1.0, static_cast<double>(disks) / kDisksPerCell);
  double volume = model.box.prod();
  IntVec<D> counts;
  for (int k = 0; k < D; ++k) {
    const double length = model.box[axes[k]];
    const double edge =
        std::max(std::pow(volume / cells, 1.0 / (D - k)), kLeastWidth * model.diameter);
    const double count = std::max(1.0, std::floor(length / edge));
    counts[axes[k]] = static_cast<int>(count);
    cells = std::max(1.0, cells / count);
    volume /= length;
  }
  return counts;
}

template <int D>
CellGrid<D>::CellGrid(const Model<D>& model, std::size_t disks)
    : counts_(choose_counts(model, disks)), box_(model.box) {
  int stride = 1;
  for (int axis = 0; axis < D; ++axis) {
    periodic_[axis] = model.periodic(axis);
    widths_[axis] = box_[axis] / counts_[axis];
    for (int cell = 0; cell < counts_[axis]; ++cell) borders_[axis].push_back(cell * widths_[axis]);
    borders_[axis].push_back(box_[axis]);
    if (!periodic_[axis]) {
      borders_[axis].front() = -kInfinity;
      borders_[axis].back() = kInfinity;
    }
    strides_[axis] = stride;
    stride *= counts_[axis];
  }
  lines_.resize(static_cast<std::size_t>(stride));
}

template <int D>
double CellGrid<D>::crowding() const {
  double disks = 0.0, pairs = 0.0;
  for (int cell = 0; cell < counts_.prod(); ++cell) {
    double count = 0.0;
    for (const Line* line = &lines_[static_cast<std::size_t>(cell)];; line = &lines_[line->next]) {
      count += line->count;
      if (line->next == kNone) break;
    }
    disks += count;
    pairs += count * count;
  }
  return disks > 0.0 ? pairs / disks : 0.0;
}

template <int D>
std::size_t CellGrid<D>::index(const IntVec<D>& cell) const {
  return static_cast<std::size_t>(cell.dot(strides_));
}

template <int D>
IntVec<D> CellGrid<D>::cell_at(const Vec<D>& position) const {
  IntVec<D> cell;
  for (int axis = 0; axis < D; ++axis) {
    const int at = static_cast<int>(std::floor(position[axis] / widths_[axis]));
    cell[axis] = std::clamp(at, 0, counts_[axis] - 1);
  }
  return cell;
}

template <int D>
std::uint32_t CellGrid<D>::new_line() {
  if (spare_.empty()) {
    lines_.emplace_back();
    return static_cast<std::uint32_t>(lines_.size() - 1);
  }
  const std::uint32_t line = spare_.back();
  spare_.pop_back();
  lines_[line] = Line{};
  return line;
}

template <int D>
void CellGrid<D>::insert(std::uint32_t disk, const IntVec<D>& cell) {
  std::size_t at = index(cell);
  while (lines_[at].count == Line::kCapacity) {
    if (lines_[at].next == kNone) {
      const std::uint32_t added = new_line();  // may move lines_
      lines_[at].next = added;
    }
    at = lines_[at].next;
  }
  Line& line = lines_[at];
  line.disks[line.count++] = disk;
}

template <int D>
void CellGrid<D>::remove(std::uint32_t disk, const IntVec<D>& cell) {
  Line* line = &lines_[index(cell)];
  std::uint32_t* place = nullptr;
  Line* last = line;
  Line* before_last = nullptr;
  for (;; line = &lines_[line->next]) {
    const auto end = line->disks.begin() + line->count;
    const auto found = std::find(line->disks.begin(), end, disk);
    if (found != end) place = &*found;
    last = line;
    if (line->next == kNone) break;
    before_last = line;
  }
  *place = last->disks[--last->count];
  if (last->count == 0 && before_last) {
    spare_.push_back(before_last->next);
    before_last->next = kNone;
  }
}

template class CellGrid<2>;

}  // namespace clatter
