#include "engine/dynamics/cell_grid.h"

#include <algorithm>
#include <cmath>
#include <cstring>
#include <limits>
#include <numeric>

namespace clatter {

// Smallest width of a cell without the overhangs of both neighbours, in diameters. It exceeds a
// diameter by more than any rounding of positions.
static constexpr double kMinWidth = 1.01;
static constexpr double kInfinity = std::numeric_limits<double>::infinity();

// Numbers of cells along each axis, so that cells are nearly cubes. The shortest edge comes first:
// a narrow box then gets more cells along its long edges.
template <int D>
static IntVec<D> choose_counts(const Model<D>& model, double cells) {
  std::array<int, D> axes;
  std::iota(axes.begin(), axes.end(), 0);
  std::stable_sort(axes.begin(), axes.end(),
                   [&](int a, int b) { return model.box[a] < model.box[b]; });
  cells = std::max(1.0, cells);
  double volume = model.box.prod();
  IntVec<D> counts;
  for (int k = 0; k < D; ++k) {
    const double length = model.box[axes[k]];
    const double edge =
        std::max(std::pow(volume / cells, 1.0 / (D - k)), kMinWidth * model.diameter);
    const double count = std::max(1.0, std::floor(length / edge));
    counts[axes[k]] = static_cast<int>(count);
    cells = std::max(1.0, cells / count);
    volume /= length;
  }
  return counts;
}

template <int D>
CellGrid<D>::CellGrid(const Model<D>& model, double cells) : counts_(choose_counts(model, cells)) {
  int stride = 1;
  for (int axis = 0; axis < D; ++axis) {
    const int count = counts_[axis];
    widths_[axis] = model.box[axis] / count;
    overhangs_[axis] = 0.5 * std::max(0.0, widths_[axis] - kMinWidth * model.diameter);
    for (int cell = 0; cell < count; ++cell) {
      borders_[axis].push_back(cell * widths_[axis] - overhangs_[axis]);
      borders_[axis].push_back((cell + 1) * widths_[axis] + overhangs_[axis]);
    }
    strides_[axis] = stride;
    auto& places = places_[axis];
    places.resize(static_cast<std::size_t>(count) + 2);
    for (int cell = 0; cell < count; ++cell) {
      places[static_cast<std::size_t>(cell) + 1].index = static_cast<std::uint32_t>(cell * stride);
    }
    if (model.periodic(axis)) {
      // Seen from beyond the low border, the box is one length higher; from beyond the high border,
      // one length lower.
      const auto wrap = [&](unsigned bits) {
        return Neighbour{bits} << (kParticleBits + 2 * axis);
      };
      places.front() = {places[static_cast<std::size_t>(count)].index, wrap(0b01)};
      places.back() = {places[1].index, wrap(0b11)};
    } else {
      borders_[axis].front() = -kInfinity;
      borders_[axis].back() = kInfinity;
    }
    stride *= count;
  }
  // In a dilute gas about one list in 25 is continued. Room for these avoids a reallocation.
  lists_.reserve(static_cast<std::size_t>(stride) + static_cast<std::size_t>(stride) / 8);
  lists_.resize(static_cast<std::size_t>(stride));
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
void CellGrid<D>::insert(std::uint32_t particle, const IntVec<D>& cell) {
  visit_lists<D - 1>(about(cell), 0, 0,
                     [&](std::uint32_t list, Neighbour wrap) { put_on(list, particle | wrap); });
}

template <int D>
void CellGrid<D>::remove(std::uint32_t particle, const IntVec<D>& cell) {
  visit_lists<D - 1>(about(cell), 0, 0,
                     [&](std::uint32_t list, Neighbour wrap) { take_off(list, particle | wrap); });
}

template <int D>
void CellGrid<D>::move(std::uint32_t particle, const IntVec<D>& cell, int axis, int step) {
  const int next = cell[axis] + step;
  if (next < 0 || next == counts_[axis]) {
    // A particle that crosses a periodic border has another wrap in every list.
    remove(particle, cell);
    insert(particle, neighbour(cell, axis, step));
    return;
  }
  visit_lists<D - 1>(row(cell, axis, cell[axis] - step), 0, 0,
                     [&](std::uint32_t list, Neighbour wrap) { take_off(list, particle | wrap); });
  visit_lists<D - 1>(row(cell, axis, next + step), 0, 0,
                     [&](std::uint32_t list, Neighbour wrap) { put_on(list, particle | wrap); });
}

template <int D>
void CellGrid<D>::put_on(std::uint32_t at, Neighbour neighbour) {
  while (lists_[at].count == List::kCapacity) {
    if (lists_[at].next == kNone) {
      const std::uint32_t added = new_list();  // may move lists_
      lists_[at].next = added;
    }
    at = lists_[at].next;
  }
  List& list = lists_[at];
  list.neighbours[list.count++] = neighbour;
  list.wraps = list.wraps || neighbour != particle_of(neighbour);
}

// Index of a neighbour in a list; 0 if it is not there. Compares all entries at once, because a
// branch on the index would be unpredictable.
template <class List>
static std::uint32_t place_of(std::uint32_t neighbour, const List& list) {
  using Four = std::uint32_t __attribute__((vector_size(16)));
  // The last two words of a list hold no neighbours.
  constexpr std::uint32_t kCapacity = List::kCapacity;
  static_assert(kCapacity % 4 == 2 && sizeof(List) == (kCapacity + 2) * sizeof(std::uint32_t));
  Four found{};
  for (std::uint32_t k = 0; k < kCapacity; k += 4) {
    Four four;
    std::memcpy(&four, reinterpret_cast<const char*>(&list) + k * sizeof k, sizeof four);
    const bool last = k + 4 > kCapacity;
    const Four places = {k, k + 1, last ? 0 : k + 2, last ? 0 : k + 3};
    found |= (four == neighbour) & places;
  }
  return (found[0] | found[1]) | (found[2] | found[3]);
}

template <int D>
void CellGrid<D>::take_off(std::uint32_t at, Neighbour neighbour) {
  List& list = lists_[at];
  if (list.next != kNone) [[unlikely]]
    return take_off_chain(at, neighbour);
  Neighbour& last = list.neighbours[--list.count];
  list.neighbours[place_of(neighbour, list)] = last;
  last = kNobody;
}

// The last entry of the chain replaces the neighbour.
template <int D>
void CellGrid<D>::take_off_chain(std::uint32_t at, Neighbour neighbour) {
  Neighbour* place = nullptr;
  List* holder = nullptr;
  List* list = &lists_[at];
  List* before_last = nullptr;
  for (;; list = &lists_[list->next]) {
    Neighbour& found = list->neighbours[place_of(neighbour, *list)];
    if (found == neighbour) {
      place = &found;
      holder = list;
    }
    if (list->next == kNone) break;
    before_last = list;
  }
  Neighbour& last = list->neighbours[--list->count];
  *place = last;
  holder->wraps = holder->wraps || list->wraps;
  last = kNobody;
  if (list->count == 0) {
    spare_.push_back(before_last->next);
    before_last->next = kNone;
  }
}

template <int D>
std::uint32_t CellGrid<D>::new_list() {
  if (spare_.empty()) {
    lists_.emplace_back();
    return static_cast<std::uint32_t>(lists_.size() - 1);
  }
  const std::uint32_t list = spare_.back();
  spare_.pop_back();
  lists_[list] = List{};
  return list;
}

template class CellGrid<2>;
template class CellGrid<3>;

}  // namespace clatter
