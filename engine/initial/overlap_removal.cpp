#include "engine/initial/overlap_removal.h"

#include <algorithm>
#include <cmath>
#include <utility>

#include "engine/dynamics/cell_of.h"

namespace clatter {

template <int D>
OverlapRemoval<D>::Grid::Grid(const Vec<D>& box, double diameter) {
  std::size_t cells = 1;
  for (int axis = 0; axis < D; ++axis) {
    constexpr double kWider = 1.01;        // than the diameter
    constexpr double kMostCells = 1024.0;  // along an axis
    const double fit = std::floor(box[axis] / (kWider * diameter));
    counts[axis] = static_cast<int>(std::clamp(fit, 1.0, kMostCells / (D == 2 ? 1.0 : 8.0)));
    widths[axis] = box[axis] / counts[axis];
    cells *= static_cast<std::size_t>(counts[axis]);
  }
  first.resize(cells + 1);
}

// The grids end with that of the smallest particle. Few sizes make few grids.
template <int D>
OverlapRemoval<D>::OverlapRemoval(const Domain<D>& domain, std::vector<double> radii,
                                  Random& random)
    : domain_(domain), radii_(std::move(radii)) {
  const double largest = radii_.empty() ? 0.5 : *std::ranges::max_element(radii_);
  double smallest = largest;
  for (const double radius : radii_) smallest = std::min(smallest, radius);
  for (double radius = largest; grids_.empty() || radius >= smallest; radius *= 0.5) {
    grids_.emplace_back(domain.box, 2.0 * radius);
  }
  for (std::uint32_t i = 0; i < radii_.size(); ++i) {
    std::uint8_t level = 0;
    for (double radius = 0.5 * largest; radii_[i] <= radius && level + 1u < grids_.size();
         radius *= 0.5) {
      ++level;
    }
    levels_.push_back(level);
    Vec<D>& place = places_.emplace_back();
    for (int axis = 0; axis < D; ++axis) place[axis] = random.uniform() * domain.box[axis];
    keep_inside(i);
  }
}

template <int D>
bool OverlapRemoval<D>::advance(const StopRequest& pause) {
  constexpr int kMostSweeps = 20'000;
  while (overlaps_ && sweeps_ < kMostSweeps) {
    if (pause.made()) return false;
    sort_into_cells();
    overlaps_ = sweep();
    ++sweeps_;
  }
  return true;
}

template <int D>
std::vector<Vec<D>> OverlapRemoval<D>::take() {
  return overlaps_ ? std::vector<Vec<D>>() : std::exchange(places_, {});
}

// A counting sort of each grid.
template <int D>
void OverlapRemoval<D>::sort_into_cells() {
  std::vector<std::uint32_t> cells(places_.size());
  for (Grid& grid : grids_) std::ranges::fill(grid.first, 0);
  for (std::size_t i = 0; i < places_.size(); ++i) {
    Grid& grid = grids_[levels_[i]];
    const IntVec<D> cell = cell_of<D>(places_[i], grid.widths, grid.counts);
    std::uint32_t index = 0;
    for (int axis = D - 1; axis >= 0; --axis) {
      index = index * static_cast<std::uint32_t>(grid.counts[axis]) +
              static_cast<std::uint32_t>(cell[axis]);
    }
    cells[i] = index;
    ++grid.first[index + 1];
  }
  std::vector<std::vector<std::uint32_t>> next;
  for (Grid& grid : grids_) {
    for (std::size_t k = 1; k < grid.first.size(); ++k) grid.first[k] += grid.first[k - 1];
    grid.order.resize(grid.first.back());
    next.emplace_back(grid.first.begin(), grid.first.end() - 1);
  }
  for (std::uint32_t i = 0; i < places_.size(); ++i) {
    grids_[levels_[i]].order[next[levels_[i]][cells[i]]++] = i;
  }
}

// Parts all pairs once: each particle from those of its grid and of coarser ones. Returns whether
// any overlapped.
template <int D>
bool OverlapRemoval<D>::sweep() {
  bool any = false;
  for (std::uint32_t i = 0; i < places_.size(); ++i) {
    for (std::size_t level = 0; level <= levels_[i]; ++level) {
      const Grid& grid = grids_[level];
      const IntVec<D> own = cell_of<D>(places_[i], grid.widths, grid.counts);
      IntVec<D> step = IntVec<D>::Constant(-1);
      while (step[D - 1] <= 1) {
        any = part_from(i, grid, own + step, level == levels_[i]) || any;
        for (int axis = 0; ++step[axis] > 1 && axis < D - 1; ++axis) step[axis] = -1;
      }
    }
  }
  return any;
}

// Parts a particle from those of a cell, or from those of them that have higher numbers. The cell
// may be one beyond the box.
template <int D>
bool OverlapRemoval<D>::part_from(std::uint32_t particle, const Grid& grid, const IntVec<D>& cell,
                                  bool later_only) {
  std::size_t index = 0;
  for (int axis = D - 1; axis >= 0; --axis) {
    const int count = grid.counts[axis];
    int at = cell[axis];
    if (at < 0 || at >= count) {
      if (!domain_.periodic[axis] || count < 3) return false;
      at -= at < 0 ? -count : count;
    }
    index = index * static_cast<std::size_t>(count) + static_cast<std::size_t>(at);
  }
  bool any = false;
  for (std::uint32_t k = grid.first[index]; k < grid.first[index + 1]; ++k) {
    const std::uint32_t other = grid.order[k];
    if (!later_only || other > particle) any = part(particle, other) || any;
  }
  return any;
}

// Moves two particles apart if they overlap. Each moves by a share like the volume of the other.
template <int D>
bool OverlapRemoval<D>::part(std::uint32_t a, std::uint32_t b) {
  constexpr double kGap = 1e-3;  // that remains, as a share of the distance at contact
  const double distance = radii_[a] + radii_[b];
  Vec<D> way = domain_.shortest(places_[b] - places_[a]);
  const double square = way.squaredNorm();
  if (square >= distance * distance) return false;
  const double length = std::sqrt(square);
  way = length > 0.0 ? Vec<D>(way / length) : Vec<D>(Vec<D>::Unit(static_cast<int>(a % D)));
  const auto cube = [](double r) { return D == 2 ? r * r : r * r * r; };
  const double volume_a = cube(radii_[a]), volume_b = cube(radii_[b]);
  const double apart = (1.0 + kGap) * distance - length;
  places_[a] -= apart * volume_b / (volume_a + volume_b) * way;
  places_[b] += apart * volume_a / (volume_a + volume_b) * way;
  keep_inside(a);
  keep_inside(b);
  return true;
}

template <int D>
void OverlapRemoval<D>::keep_inside(std::uint32_t particle) {
  Vec<D>& place = places_[particle];
  place = domain_.wrapped(place);
  for (int axis = 0; axis < D; ++axis) {
    if (domain_.periodic[axis]) continue;
    const double radius = radii_[particle];
    place[axis] = std::clamp(place[axis], radius, domain_.box[axis] - radius);
  }
}

template class OverlapRemoval<2>;
template class OverlapRemoval<3>;

}  // namespace clatter
