#include "engine/measure/profile.h"

#include <algorithm>
#include <cmath>
#include <stdexcept>

#include "engine/measure/dual.h"
#include "engine/measure/fields.h"

namespace clatter {

namespace {

// The windows' sums in one column, and the estimates of fields from them.
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
  std::vector<Estimate> estimates(std::span<const Field> fields) const {
    std::vector<std::vector<double>> parts(fields.size(), std::vector<double>(windows_.size()));
    std::vector<Estimate> estimates(fields.size());
    std::vector<Dual> averages;  // per area; the slope of the variable is 1
    for (int k = 0; k < layout_.size; ++k) {
      averages.emplace_back(totals_[k] / (total_weight(k) * measure_));
    }
    for (int k = 0; k < layout_.size; ++k) {
      averages[k].slope = 1.0;
      CellAverages<D, Dual> cell = averages_of<D, Dual>(layout_, averages.data());
      for (std::size_t f = 0; f < fields.size(); ++f) {
        if (fields[f].species != Field::kNone) {
          cell = averages_of<D, Dual>(layout_, averages.data(), fields[f].species);
        }
        const Dual value = field_value(fields[f], cell);
        estimates[f].mean = value.value;
        add_contributions(parts[f], k, value.slope);
      }
      averages[k].slope = 0.0;
    }
    for (std::size_t f = 0; f < fields.size(); ++f) {
      if (!std::isnan(estimates[f].mean)) estimates[f].standard_error = blocked_error(parts[f]);
    }
    return estimates;
  }

 private:
  // The contribution of sum k to a field with this slope, in each window.
  void add_contributions(std::vector<double>& parts, int k, double slope) const {
    if (slope == 0.0) return;
    const double average = totals_[k] / total_weight(k);
    const double scale = slope * static_cast<double>(parts.size()) / (total_weight(k) * measure_);
    for (std::size_t w = 0; w < parts.size(); ++w) {
      const CellSums& window = windows_[w];
      parts[w] += scale * (row(window)[k] - average * weight(k, window));
    }
  }

  const double* row(const CellSums& window) const { return window.rows.data() + begin_; }
  double weight(int k, const CellSums& window) const {
    return k < layout_.kinetic ? window.kinetic_weight : window.time;
  }
  double total_weight(int k) const { return k < layout_.kinetic ? kinetic_weight_ : time_; }

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
    const std::vector<Estimate> estimates = column.estimates(fields);
    for (std::size_t f = 0; f < fields.size(); ++f) profile.values[f].push_back(estimates[f]);
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
