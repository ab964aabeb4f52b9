#include "engine/observables/near_cells.h"

#include <limits>

namespace clatter {

template <int D>
NearCells<D>::NearCells(const Model<D>& model, std::size_t particles, double range)
    : box_(model.box), range_(range) {
  for (int axis = 0; axis < D; ++axis) {
    const bool periodic = model.periodic(axis);
    period_[axis] = periodic ? box_[axis] : std::numeric_limits<double>::infinity();
    range_ = std::min(range_, 0.5 * period_[axis]);
  }
  choose_cells(model, particles);
}

// A pair within the range is in cells whose numbers differ by at most 2. A dilute gas has about one
// particle in four cells.
template <int D>
void NearCells<D>::choose_cells(const Model<D>& model, std::size_t particles) {
  Vec<D> cells = (2.0 / range_ * box_).array().floor().max(1.0);
  const double most = 4.0 * static_cast<double>(particles) + 1.0;
  while (cells.prod() > most) {
    double& largest = *std::max_element(cells.begin(), cells.end());
    const double others = cells.prod() / largest;
    largest = std::max(std::floor(0.5 * largest), std::floor(most / others));
  }
  cells_ = cells.template cast<int>();
  for (int axis = 0; axis < D; ++axis) {
    const int count = cells_[axis];
    for (int cell = 0; cell < count; ++cell) {
      std::vector<int> near;
      for (int other = cell - 2; other <= cell + 2; ++other) {
        if (!model.periodic(axis) && (other < 0 || other >= count)) continue;
        const int wrapped = (other % count + count) % count;
        if (std::ranges::find(near, wrapped) == near.end()) near.push_back(wrapped);
      }
      std::ranges::sort(near);
      std::vector<Range>& spans = near_[axis].emplace_back();
      for (const int number : near) {
        const auto next = static_cast<std::size_t>(number);
        if (!spans.empty() && spans.back().end + 1 == next) {
          spans.back().end = next;
        } else {
          spans.push_back({next, next});
        }
      }
    }
  }
}

template <int D>
void NearCells<D>::sort(const std::vector<Vec<D>>& positions) {
  const std::size_t count = positions.size();
  const Vec<D> per_length = cells_.template cast<double>().cwiseQuotient(box_);
  std::vector<std::size_t> cell_of(count);
  first_.assign(static_cast<std::size_t>(cells_.prod()) + 1, 0);
  for (std::size_t i = 0; i < count; ++i) {
    std::size_t cell = 0;
    for (int axis = D - 1; axis >= 0; --axis) {
      const int along = static_cast<int>(positions[i][axis] * per_length[axis]);
      cell = cell * static_cast<std::size_t>(cells_[axis]) +
             static_cast<std::size_t>(std::clamp(along, 0, cells_[axis] - 1));
    }
    cell_of[i] = cell;
    ++first_[cell + 1];
  }
  for (std::size_t cell = 1; cell < first_.size(); ++cell) first_[cell] += first_[cell - 1];
  std::vector<std::size_t> next(first_.begin(), first_.end() - 1);
  particles_.resize(count);
  for (std::vector<double>& along : coordinates_) along.resize(count);
  for (std::size_t i = 0; i < count; ++i) {
    const std::size_t place = next[cell_of[i]]++;
    particles_[place] = static_cast<std::uint32_t>(i);
    for (int axis = 0; axis < D; ++axis) coordinates_[axis][place] = positions[i][axis];
  }
}

// In each near row, the cells that are consecutive along x.
template <int D>
const std::vector<typename NearCells<D>::Range>& NearCells<D>::near(std::size_t cell) {
  ranges_.clear();
  std::array<std::size_t, D> at;
  for (int axis = 0; axis < D; ++axis) {
    const auto along = static_cast<std::size_t>(cells_[axis]);
    at[axis] = cell % along;
    cell /= along;
  }
  const auto add_row = [&](std::size_t row) {
    const std::size_t start = row * static_cast<std::size_t>(cells_[0]);
    for (const auto& [first, last] : near_[0][at[0]]) {
      ranges_.push_back({first_[start + first], first_[start + last + 1]});
    }
  };
  const auto each_near = [&](int axis, const auto& visit) {
    for (const auto& [first, last] : near_[axis][at[axis]]) {
      for (std::size_t next = first; next <= last; ++next) visit(next);
    }
  };
  if constexpr (D == 2) {
    each_near(1, add_row);
  } else {
    each_near(2, [&](std::size_t z) {
      each_near(1, [&](std::size_t y) { add_row(z * static_cast<std::size_t>(cells_[1]) + y); });
    });
  }
  return ranges_;
}

template class NearCells<2>;
template class NearCells<3>;

}  // namespace clatter
