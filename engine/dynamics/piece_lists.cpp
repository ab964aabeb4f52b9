#include "engine/dynamics/piece_lists.h"

#include <algorithm>
#include <cmath>
#include <utility>

namespace clatter {

// Slightly more than half a diameter, so that rounding at a cell's border does not matter.
static constexpr double kReach = 0.51;

template <int D>
PieceLists<D>::PieceLists(const Model<D>& model)
    : domain_(model.domain()), reach_(kReach * model.diameter) {
  for (std::uint32_t fixture = 0; fixture < model.fixtures.size(); ++fixture) {
    for (const Piece<D>& piece : model.fixtures[fixture].pieces) {
      pieces_.push_back({piece, fixture});
    }
  }
  for (std::uint32_t fixture = 0; fixture < model.fixtures.size(); ++fixture) {
    const std::vector<Valve<D>>& valves = model.fixtures[fixture].valves;
    for (std::uint32_t k = 0; k < valves.size(); ++k) {
      pieces_.push_back({valves[k].opening, fixture, k});
    }
  }
}

// Whether a cell comes within a distance of the line or plane of a plate.
template <int D>
static bool is_near(const Piece<D>& plate, const Vec<D>& shift, const CellGrid<D>& grid,
                    const IntVec<D>& cell, double distance) {
  double middle = -plate.normal.dot(plate.corner + shift), half = 0.0;
  for (int axis = 0; axis < D; ++axis) {
    if (plate.normal[axis] == 0.0) continue;
    const double low = grid.border(axis, cell[axis], false);
    const double high = grid.border(axis, cell[axis], true);
    middle += 0.5 * (low + high) * plate.normal[axis];
    half += 0.5 * (high - low) * std::fabs(plate.normal[axis]);
  }
  // Outer cells are infinite, and then the comparison with NaN is false.
  return !(std::fabs(middle) > half + distance);
}

template <int D>
void PieceLists<D>::lay(const CellGrid<D>& grid) {
  if (!any()) return;
  std::vector<std::pair<std::size_t, Entry>> found;
  const IntVec<D> counts = grid.counts();
  for (std::uint32_t number = 0; number < pieces_.size(); ++number) {
    const Piece<D>& piece = pieces_[number].piece;
    const std::pair<Vec<D>, Vec<D>> bounds = piece.bounds();
    const Vec<D>&low = bounds.first, &high = bounds.second;
    // The images that reach the cells.
    IntVec<D> from = IntVec<D>::Zero(), to = IntVec<D>::Zero();
    for (int axis = 0; axis < D; ++axis) {
      if (!domain_.periodic[axis]) continue;
      const double first = grid.border(axis, 0, false) - reach_ - high[axis];
      const double last = grid.border(axis, counts[axis] - 1, true) + reach_ - low[axis];
      from[axis] = static_cast<int>(std::ceil(first / domain_.box[axis]));
      to[axis] = static_cast<int>(std::floor(last / domain_.box[axis]));
    }
    const auto for_each = [](const IntVec<D>& first, const IntVec<D>& last, const auto& visit) {
      if ((last.array() < first.array()).any()) return;
      IntVec<D> at = first;
      while (at[D - 1] <= last[D - 1]) {
        visit(at);
        for (int k = 0; ++at[k] > last[k] && k < D - 1; ++k) at[k] = first[k];
      }
    };
    for_each(from, to, [&](const IntVec<D>& image) {
      const Vec<D> shift = domain_.shift(image.template cast<double>());
      IntVec<D> first, last;
      for (int axis = 0; axis < D; ++axis) {
        first[axis] = counts[axis];
        last[axis] = -1;
        for (int cell = 0; cell < counts[axis]; ++cell) {
          if (grid.border(axis, cell, true) < low[axis] + shift[axis] - reach_) continue;
          if (grid.border(axis, cell, false) > high[axis] + shift[axis] + reach_) continue;
          first[axis] = std::min(first[axis], cell);
          last[axis] = cell;
        }
      }
      for_each(first, last, [&](const IntVec<D>& cell) {
        if (piece.is_plate() && !is_near(piece, shift, grid, cell, reach_)) return;
        found.push_back({grid.number_of(cell), {number, image}});
      });
    });
  }
  std::ranges::stable_sort(found, {}, &std::pair<std::size_t, Entry>::first);
  entries_.clear();
  first_.assign(static_cast<std::size_t>(counts.prod()) + 1, 0);
  for (const auto& [cell, entry] : found) {
    entries_.push_back(entry);
    ++first_[cell + 1];
  }
  for (std::size_t k = 1; k < first_.size(); ++k) first_[k] += first_[k - 1];
}

template class PieceLists<2>;
template class PieceLists<3>;

}  // namespace clatter
