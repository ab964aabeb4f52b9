#include "engine/measure/field_maps.h"

#include <limits>

#include "engine/measure/fields.h"

namespace clatter {

template <int D>
std::vector<FieldMap> field_maps(std::span<const Field> fields, const CellSums& sums,
                                 const FieldGrid<D>& grid, const MomentLayout<D>& layout,
                                 const StopRequest& stop) {
  std::vector<FieldMap> maps;
  for (const Field field : fields) {
    maps.push_back({field,
                    {grid.cells().begin(), grid.cells().end()},
                    std::vector<double>(grid.size(), std::numeric_limits<double>::quiet_NaN())});
  }
  if (!(sums.time > 0.0)) return maps;
  std::vector<double> row;
  for (std::size_t cell = 0; cell < grid.size(); ++cell) {
    if (cell % kStepsPerQuestion == 0) stop.check();
    averages_row(layout, sums, cell, grid.cell_measure(), row);
    auto averages = averages_of(layout, row.data());
    for (std::size_t f = 0; f < fields.size(); ++f) {
      const int species = fields[f].species;
      if (species != Field::kNone) averages = averages_of(layout, row.data(), species);
      maps[f].values[cell] = field_value(fields[f], averages);
    }
  }
  return maps;
}

template std::vector<FieldMap> field_maps(std::span<const Field>, const CellSums&,
                                          const FieldGrid<2>&, const MomentLayout<2>&,
                                          const StopRequest&);
template std::vector<FieldMap> field_maps(std::span<const Field>, const CellSums&,
                                          const FieldGrid<3>&, const MomentLayout<3>&,
                                          const StopRequest&);

}  // namespace clatter
