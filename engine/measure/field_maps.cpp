#include "engine/measure/field_maps.h"

#include <algorithm>
#include <limits>
#include <utility>

#include "engine/measure/fields.h"

namespace clatter {

template <int D>
FieldMap field_map(Field field, const CellSums& sums, const FieldGrid<D>& grid,
                   const MomentLayout<D>& layout) {
  FieldMap map{field, {grid.cells().begin(), grid.cells().end()}, std::vector<double>(grid.size())};
  for (std::size_t i = 0; i < map.values.size(); ++i) {
    map.values[i] = sums.time > 0.0
                        ? field_value(field, averages_of(layout, sums, i, grid.cell_measure()))
                        : std::numeric_limits<double>::quiet_NaN();
  }
  return map;
}

std::size_t PartSums::max_parts(std::size_t bytes) {
  const std::size_t parts = kMaxBytes / std::max<std::size_t>(1, bytes);
  return std::clamp<std::size_t>(parts, 2, kMaxParts) / 2 * 2;
}

void PartSums::add(CellSums window) {
  if (windows_ % windows_per_part_ != 0) {
    parts_.back() += window;
  } else {
    if (parts_.size() == max_parts(window.rows.size() * sizeof(double))) join_neighbours();
    parts_.push_back(std::move(window));
  }
  ++windows_;
}

void PartSums::join_neighbours() {
  for (std::size_t k = 0; 2 * k < parts_.size(); ++k) {
    CellSums joined = std::move(parts_[2 * k]);
    joined += parts_[2 * k + 1];
    parts_[k] = std::move(joined);
  }
  parts_.resize(parts_.size() / 2);
  windows_per_part_ *= 2;
}

template FieldMap field_map(Field, const CellSums&, const FieldGrid<2>&, const MomentLayout<2>&);
template FieldMap field_map(Field, const CellSums&, const FieldGrid<3>&, const MomentLayout<3>&);

}  // namespace clatter
