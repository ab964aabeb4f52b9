#include "engine/measure/profile.h"

#include <algorithm>
#include <cmath>
#include <stdexcept>

#include "engine/measure/dual.h"
#include "engine/measure/fields.h"

namespace clatter {

namespace {

// The windows' sums in one column, and the estimate of a field from them.
template <int D>
class Column {
 public:
  Column(std::span<const CellSums> windows, const MomentLayout<D>& layout, std::size_t column,
         double measure)
      : windows_(windows),
        layout_(layout),
        begin_(column * static_cast<std::size_t>(layout.size)),
        measure_(measure),
        totals_(static_cast<std::size_t>(layout.size)) {
    for (const CellSums& window : windows) {
      time_ += window.time;
      kinetic_weight_ += window.kinetic_weight;
      for (int k = 0; k < layout.size; ++k) totals_[k] += row(window)[k];
    }
  }

  // The mean is the field of the windows' totals. The error comes from blocking of the windows'
  // contributions, linearised in their sums: a window's sum k minus the average times its length.
  Estimate estimate(Field field) const {
    const double mean =
        field_value(field, averages_of<D, Dual>(layout_, along(-1).data(), field.species)).value;
    if (std::isnan(mean)) return {mean, 0.0};
    std::vector<double> parts(windows_.size());
    const auto count = static_cast<double>(windows_.size());
    for (int k = 0; k < layout_.size; ++k) {
      const double slope =
          field_value(field, averages_of<D, Dual>(layout_, along(k).data(), field.species)).slope;
      if (slope == 0.0) continue;
      const double average = totals_[k] / total_weight(k);
      const double scale = slope * count / (total_weight(k) * measure_);
      for (std::size_t w = 0; w < parts.size(); ++w) {
        const CellSums& window = windows_[w];
        parts[w] += scale * (row(window)[k] - average * weight(k, window));
      }
    }
    return {mean, blocked_error(parts)};
  }

 private:
  const double* row(const CellSums& window) const { return window.rows.data() + begin_; }
  double weight(int k, const CellSums& window) const {
    return k < layout_.kinetic ? window.kinetic_weight : window.time;
  }
  double total_weight(int k) const { return k < layout_.kinetic ? kinetic_weight_ : time_; }

  // The averages per area, with number k as the variable.
  std::vector<Dual> along(int variable) const {
    std::vector<Dual> averages;
    for (int k = 0; k < layout_.size; ++k) {
      averages.emplace_back(totals_[k] / (total_weight(k) * measure_), k == variable ? 1.0 : 0.0);
    }
    return averages;
  }

  std::span<const CellSums> windows_;
  const MomentLayout<D>& layout_;
  std::size_t begin_;  // index of the column's row
  double measure_;     // area of the column, in 3D its volume
  double time_ = 0.0;
  double kinetic_weight_ = 0.0;
  std::vector<double> totals_;
};

}  // namespace

const std::vector<Estimate>& Profile::at(Field field) const {
  const auto found = std::ranges::find(fields, field);
  if (found == fields.end()) throw std::out_of_range("no profile of this field");
  return values[static_cast<std::size_t>(found - fields.begin())];
}

template <int D>
CellSums columns_of(const CellSums& cells, const FieldGrid<D>& grid, Axis axis) {
  IntVec<D> column = grid.cells();
  column[static_cast<int>(axis)] = 1;
  return block_sums(cells, grid, column);
}

template <int D>
Profile profile_of(std::span<const CellSums> windows, const FieldGrid<D>& grid,
                   const MomentLayout<D>& layout, std::span<const Field> fields, Axis axis) {
  const int along = static_cast<int>(axis);
  const int columns = grid.cells()[along];
  const double measure = grid.cell_measure() * static_cast<double>(grid.size() / columns);
  Profile profile;
  profile.dimension = D;
  profile.axis = axis;
  profile.fields.assign(fields.begin(), fields.end());
  profile.values.resize(fields.size());
  const double length = columns * grid.widths()[along];
  for (int i = 0; i <= columns; ++i) profile.edges.push_back(length * i / columns);
  for (int i = 0; i < columns; ++i) {
    const Column<D> column(windows, layout, static_cast<std::size_t>(i), measure);
    for (std::size_t f = 0; f < fields.size(); ++f) {
      profile.values[f].push_back(column.estimate(fields[f]));
    }
  }
  return profile;
}

template CellSums columns_of(const CellSums&, const FieldGrid<2>&, Axis);
template CellSums columns_of(const CellSums&, const FieldGrid<3>&, Axis);
template Profile profile_of(std::span<const CellSums>, const FieldGrid<2>&, const MomentLayout<2>&,
                            std::span<const Field>, Axis);
template Profile profile_of(std::span<const CellSums>, const FieldGrid<3>&, const MomentLayout<3>&,
                            std::span<const Field>, Axis);

}  // namespace clatter
