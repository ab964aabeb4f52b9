#include "engine/measure/field_maps.h"

#include <limits>

#include "engine/measure/fields.h"

namespace clatter {

template <int D>
FieldMap field_map(Field field, const CellSums& sums, const FieldGrid<D>& grid,
                   const MomentLayout<D>& layout) {
  FieldMap map{field, {grid.cells().begin(), grid.cells().end()}, std::vector<double>(grid.size())};
  for (std::size_t i = 0; i < map.values.size(); ++i) {
    map.values[i] =
        sums.time > 0.0
            ? field_value(field, averages_of(layout, sums, i, grid.cell_measure(), field.species))
            : std::numeric_limits<double>::quiet_NaN();
  }
  return map;
}

template FieldMap field_map(Field, const CellSums&, const FieldGrid<2>&, const MomentLayout<2>&);
template FieldMap field_map(Field, const CellSums&, const FieldGrid<3>&, const MomentLayout<3>&);

}  // namespace clatter
