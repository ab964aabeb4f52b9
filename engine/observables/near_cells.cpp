#include "engine/observables/near_cells.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numeric>

namespace clatter {

template <int D>
NearCells<D>::NearCells(const Model<D>& model, std::size_t particles, double range)
    : box_(model.box), range_(range) {
  for (int axis = 0; axis < D; ++axis) {
    if (model.periodic(axis)) range_ = std::min(range_, 0.5 * box_[axis]);
  }
  choose_cells(particles);
  list_columns(model.periodic(0));
  find_near_rows(model);
}

// A dilute gas has about one particle in four cells.
template <int D>
void NearCells<D>::choose_cells(std::size_t particles) {
  IntVec<D> per_range = IntVec<D>::Constant(kAcross);
  per_range[0] = kAlongX;
  const Vec<D> finest = per_range.template cast<double>() / range_;
  Vec<D> cells = box_.cwiseProduct(finest).array().floor().max(1.0);
  const double most = 4.0 * static_cast<double>(particles) + 1.0;
  while (cells.prod() > most) {
    double& largest = *std::max_element(cells.begin(), cells.end());
    const double others = cells.prod() / largest;
    largest = std::max(std::floor(0.5 * largest), std::floor(most / others));
  }
  cells_ = cells.template cast<int>();
  cells_per_length_ = cells.cwiseQuotient(box_);
  for (int axis = 0; axis < D; ++axis) {
    reach_[axis] =
        std::min(per_range[axis], static_cast<int>(range_ * cells_per_length_[axis]) + 1);
  }
}

template <int D>
void NearCells<D>::list_columns(bool periodic) {
  const int images = periodic ? reach_[0] : 0, count = cells_[0];
  images_ = static_cast<std::size_t>(images);
  for (int column = -images; column < count + images; ++column) {
    const int cell = (column % count + count) % count;
    columns_.push_back({static_cast<std::size_t>(cell), box_[0] * ((column - cell) / count)});
  }
}

// Half of the rows near each row, so that each pair of rows is visited once.
template <int D>
void NearCells<D>::find_near_rows(const Model<D>& model) {
  IntVec<D> at = IntVec<D>::Zero();  // in cells; along x always 0
  const auto add = [&](const IntVec<D>& offset, std::vector<NearRow>& near) {
    NearRow next{0, Vec<D>::Zero()};
    for (int axis = D - 1; axis > 0; --axis) {
      const int count = cells_[axis], cell = at[axis] + offset[axis];
      const int wrapped = (cell % count + count) % count;
      if (wrapped != cell && !model.periodic(axis)) return;
      next.row = next.row * static_cast<std::size_t>(count) + static_cast<std::size_t>(wrapped);
      next.shift[axis] = box_[axis] * ((cell - wrapped) / count);
    }
    near.push_back(next);
  };
  const int rows = cells_.prod() / cells_[0];
  for (int row = 0; row < rows; ++row) {
    std::vector<NearRow>& near = near_rows_.emplace_back();
    at[1] = row % cells_[1];
    if constexpr (D == 3) at[2] = row / cells_[1];
    IntVec<D> offset = IntVec<D>::Zero();
    for (offset[1] = 1; offset[1] <= reach_[1]; ++offset[1]) add(offset, near);
    if constexpr (D == 3) {
      for (offset[2] = 1; offset[2] <= reach_[2]; ++offset[2]) {
        for (offset[1] = -reach_[1]; offset[1] <= reach_[1]; ++offset[1]) add(offset, near);
      }
    }
  }
}

template <int D>
std::size_t NearCells<D>::cell_of(const Vec<D>& position) const {
  std::size_t cell = 0;
  for (int axis = D - 1; axis >= 0; --axis) {
    const int along = static_cast<int>(position[axis] * cells_per_length_[axis]);
    cell = cell * static_cast<std::size_t>(cells_[axis]) +
           static_cast<std::size_t>(std::clamp(along, 0, cells_[axis] - 1));
  }
  return cell;
}

// The entries of a row near a position, if the images of the row above or below have slid.
template <int D>
typename NearCells<D>::Run NearCells<D>::sheared_run(Vec<D> from, bool above,
                                                     const std::size_t* row) const {
  from[0] -= above ? offset_ : -offset_;
  from[0] -= box_[0] * std::floor(from[0] / box_[0]);
  const int along = static_cast<int>(from[0] * cells_per_length_[0]);
  const std::size_t column = images_ + static_cast<std::size_t>(std::min(along, cells_[0] - 1));
  const auto reach = static_cast<std::size_t>(reach_[0]);
  return {row[column - reach], row[column + reach + 1], from};
}

template <int D>
void NearCells<D>::sort(const std::vector<Vec<D>>& positions, const Domain<D>& domain) {
  offset_ = domain.offset;
  const std::size_t count = positions.size();
  cell_of_particle_.resize(count);
  first_in_cell_.assign(cells() + 1, 0);
  for (std::size_t i = 0; i < count; ++i) {
    cell_of_particle_[i] = cell_of(positions[i]);
    ++first_in_cell_[cell_of_particle_[i]];
  }
  std::partial_sum(first_in_cell_.begin(), first_in_cell_.end(), first_in_cell_.begin());
  sorted_.resize(count);
  for (std::size_t i = count; i-- > 0;) {
    sorted_[--first_in_cell_[cell_of_particle_[i]]] = static_cast<std::uint32_t>(i);
  }

  const auto along = static_cast<std::size_t>(cells_[0]);
  const std::size_t rows = near_rows_.size();
  const std::size_t copies = (columns_.size() + along - 1) / along;
  const std::size_t entries = copies * count + rows * kPadding;
  for (std::vector<double>& each : coordinates_) each.resize(entries);
  particles_.resize(entries);
  first_.resize(rows * (columns_.size() + 1));
  std::size_t entry = 0;
  for (std::size_t row = 0; row < rows; ++row) entry = fill_row(row, positions, entry);
}

// The particles of a row, between their images beyond the ends, and padding. Returns the next
// entry.
template <int D>
std::size_t NearCells<D>::fill_row(std::size_t row, const std::vector<Vec<D>>& positions,
                                   std::size_t entry) {
  const std::size_t* const sorted = &first_in_cell_[row * static_cast<std::size_t>(cells_[0])];
  std::size_t* first = &first_[row * (columns_.size() + 1)];
  for (const auto& [cell, shift] : columns_) {
    *first++ = entry;
    for (std::size_t k = sorted[cell]; k < sorted[cell + 1]; ++k) {
      const Vec<D>& position = positions[sorted_[k]];
      coordinates_[0][entry] = position[0] + shift;
      for (int axis = 1; axis < D; ++axis) coordinates_[axis][entry] = position[axis];
      particles_[entry++] = sorted_[k];
    }
  }
  *first = entry;
  for (std::vector<double>& each : coordinates_) {
    std::fill_n(each.begin() + static_cast<std::ptrdiff_t>(entry), kPadding,
                std::numeric_limits<double>::infinity());
  }
  return entry + kPadding;
}

template class NearCells<2>;
template class NearCells<3>;

}  // namespace clatter
