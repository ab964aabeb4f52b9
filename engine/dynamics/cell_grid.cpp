#include "engine/dynamics/cell_grid.h"

#include <algorithm>
#include <cmath>
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
static IntVec<D> choose_counts(const Vec<D>& box, double diameter, double cells) {
  std::array<int, D> axes;
  std::iota(axes.begin(), axes.end(), 0);
  std::stable_sort(axes.begin(), axes.end(), [&](int a, int b) { return box[a] < box[b]; });
  cells = std::max(1.0, cells);
  double volume = box.prod();
  IntVec<D> counts;
  for (int k = 0; k < D; ++k) {
    const double length = box[axes[k]];
    const double edge = std::max(std::pow(volume / cells, 1.0 / (D - k)), kMinWidth * diameter);
    const double count = std::max(1.0, std::floor(length / edge));
    counts[axes[k]] = static_cast<int>(count);
    cells = std::max(1.0, cells / count);
    volume /= length;
  }
  return counts;
}

template <int D>
CellGrid<D>::CellGrid(const Subdomain<D>& subdomain, double diameter, double cells)
    : diameter_(diameter) {
  reset(subdomain, cells);
}

template <int D>
void CellGrid<D>::reset(const Subdomain<D>& subdomain, double cells) {
  subdomain_ = subdomain;
  open_ = subdomain.open();
  cells_ = cells;
  const Vec<D> extent = subdomain.upper - subdomain.lower;
  counts_ = choose_counts<D>(extent, diameter_, cells);
  int stride = 1;
  for (int axis = 0; axis < D; ++axis) {
    const int count = counts_[axis];
    widths_[axis] = extent[axis] / count;
    overhangs_[axis] = 0.5 * std::max(0.0, widths_[axis] - kMinWidth * diameter_);
    auto& borders = borders_[axis];
    borders.clear();
    for (int cell = 0; cell < count; ++cell) {
      borders.push_back(subdomain.lower[axis] + (cell * widths_[axis] - overhangs_[axis]));
      borders.push_back(subdomain.lower[axis] + ((cell + 1) * widths_[axis] + overhangs_[axis]));
    }
    strides_[axis] = stride;
    auto& places = places_[axis];
    places.assign(static_cast<std::size_t>(count) + 2, Place{});
    for (int cell = 0; cell < count; ++cell) {
      places[static_cast<std::size_t>(cell) + 1].index = static_cast<std::uint32_t>(cell * stride);
    }
    const auto end = [&](int upper) {
      return subdomain.ends[static_cast<std::size_t>(2 * axis + upper)];
    };
    if (end(0) == End::Periodic) {
      // Seen from beyond the low border, the box is one length higher; from beyond the high border,
      // one length lower.
      const auto wrap = [&](unsigned bits) {
        return Neighbour{bits} << (kParticleBits<D> + 2 * axis);
      };
      places.front() = {places[static_cast<std::size_t>(count)].index, wrap(0b01)};
      places.back() = {places[1].index, wrap(0b11)};
    }
    if (end(0) == End::Wall) borders.front() = -kInfinity;
    if (end(1) == End::Wall) borders.back() = kInfinity;
    stride *= count;
  }
  lists_.assign(static_cast<std::size_t>(stride), List{});
  continuations_ = {};
}

template <int D>
IntVec<D> CellGrid<D>::cell_at(const Vec<D>& position) const {
  return cell_of<D>(position - subdomain_.lower, widths_, counts_);
}

template <int D>
void CellGrid<D>::insert(std::uint32_t particle, const IntVec<D>& cell) {
  visit_lists<D - 1>(about(cell), 0, 0, [&](std::uint32_t list, Neighbour wrap) {
    continuations_.put_on(lists_[list], particle | wrap);
  });
}

template <int D>
void CellGrid<D>::fill(const std::vector<IntVec<D>>& cells, std::vector<std::uint32_t>& order) {
  // The particles of a cell have the numbers from starts[index] on, up to those of the next cell.
  std::vector<std::uint32_t> starts(lists_.size() + 1);
  for (const IntVec<D>& cell : cells) ++starts[index(cell) + 1];
  for (std::size_t k = 1; k < starts.size(); ++k) starts[k] += starts[k - 1];
  order.resize(cells.size());
  std::vector<std::uint32_t> places(starts.begin(), starts.end() - 1);
  for (std::uint32_t k = 0; k < cells.size(); ++k) order[places[index(cells[k])]++] = k;
  IntVec<D> cell = IntVec<D>::Zero();
  for (List& list : lists_) {
    if (!fill_by_rows(list, cell, starts)) fill_by_cells(list, cell, starts);
    for (int axis = 0; axis < D && ++cell[axis] == counts_[axis]; ++axis) cell[axis] = 0;
  }
}

// Fills the list of a cell that has all its neighbours without a wrap. Three cells in a row hold
// successive numbers. A row is written in one piece of constant length, because the number of its
// particles is unpredictable. Returns false, and changes nothing, for other cells, and for lists or
// rows that are too long.
template <int D>
bool CellGrid<D>::fill_by_rows(List& list, const IntVec<D>& cell,
                               const std::vector<std::uint32_t>& starts) const {
  constexpr std::uint32_t kPiece = 8;
  for (int axis = 0; axis < D; ++axis) {
    if (cell[axis] == 0 || cell[axis] == counts_[axis] - 1) return false;
  }
  std::array<Neighbour, kCapacity + kPiece> neighbours;
  std::uint32_t count = 0;
  bool fits = true;
  visit_lists<D - 1>(row(cell, 0, cell[0] - 1), 0, 0, [&](std::uint32_t first, Neighbour) {
    const std::uint32_t start = starts[first], size = starts[first + 3] - start;
    for (std::uint32_t k = 0; k < kPiece; ++k) neighbours[count + k] = start + k;
    fits = fits && size <= kPiece && count + size <= kCapacity;
    count += fits ? size : 0;
  });
  if (!fits) return false;
  for (std::uint32_t k = 0; k < kCapacity; ++k) {
    list.neighbours[k] = k < count ? neighbours[k] : kNobody;
  }
  list.count = static_cast<std::uint16_t>(count);
  return true;
}

// Fills the list of any cell.
template <int D>
void CellGrid<D>::fill_by_cells(List& list, const IntVec<D>& cell,
                                const std::vector<std::uint32_t>& starts) {
  visit_lists<D - 1>(about(cell), 0, 0, [&](std::uint32_t near, Neighbour wrap) {
    // The wrap of this cell seen from there is the negative of that of there seen from here.
    constexpr Neighbour kOnes =
        D == 2 ? 0b0101u << kParticleBits<2> : 0b010101u << kParticleBits<3>;
    const Neighbour opposite = wrap ^ ((wrap & kOnes) << 1);
    for (std::uint32_t particle = starts[near]; particle < starts[near + 1]; ++particle) {
      continuations_.put_on(list, particle | opposite);
    }
  });
}

template <int D>
void CellGrid<D>::remove(std::uint32_t particle, const IntVec<D>& cell) {
  visit_lists<D - 1>(about(cell), 0, 0, [&](std::uint32_t list, Neighbour wrap) {
    continuations_.take_off(lists_[list], particle | wrap);
  });
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
                     [&](std::uint32_t list, Neighbour wrap) {
                       continuations_.take_off(lists_[list], particle | wrap);
                     });
  visit_lists<D - 1>(row(cell, axis, next + step), 0, 0, [&](std::uint32_t list, Neighbour wrap) {
    continuations_.put_on(lists_[list], particle | wrap);
  });
}

template <int D>
Vec<D> CellGrid<D>::leave(std::uint32_t particle, IntVec<D>& cell, std::uint32_t border) {
  const auto [axis, step] = crossing_of(border);
  const IntVec<D> next = neighbour(cell, axis, step);
  Vec<D> boxes = Vec<D>::Zero();
  if (next[axis] != cell[axis] + step) boxes[axis] = step;
  move(particle, cell, axis, step);
  cell = next;
  return boxes;
}

template <int D>
bool CellGrid<D>::fit(double particles, double near) {
  // Thresholds of the crowding: other particles near a particle per neighbouring cell, in cells for
  // the mean density. It is 1 for evenly spread points. Between kEven and kCrowded the cells stay
  // as they are (hysteresis).
  constexpr double kCellsAbout = D == 2 ? 9.0 : 27.0;
  constexpr double kEven = 9.5 / 9.0, kCrowded = 10.5 / 9.0, kWanted = 5.5 / 9.0;
  constexpr double kMax = 4.0;          // cells for each particle
  constexpr double kWorthwhile = 1.25;  // ratio of numbers of cells
  if (particles == 0.0) return false;
  const double others = near - particles;  // a particle is near itself
  const double cells = counts_.template cast<double>().prod();
  const double crowding = others * cells / (particles * particles * kCellsAbout);
  const double even = kCellsPerParticle * particles;
  const bool fine = crowding > (cells_ > even ? kEven : kCrowded);
  const double wanted = fine ? particles * std::min(crowding / kWanted, kMax) : even;
  if (std::max(wanted, cells_) < kWorthwhile * std::min(wanted, cells_)) return false;
  *this = CellGrid(subdomain_, diameter_, wanted);
  return true;
}

template class CellGrid<2>;
template class CellGrid<3>;

}  // namespace clatter
