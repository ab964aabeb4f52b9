#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "engine/measure/cell_integrals.h"
#include "engine/measure/field_grid.h"
#include "engine/measure/field_map.h"
#include "engine/measure/moment_layout.h"
#include "engine/scene/scene.h"

// Maps are stored as sums. The sums of a window go to the columns of the profile and to PartSums:
// at most 64 parts of the run. Parts are joined in pairs, and so become longer with the run. Memory
// and checkpoints stay bounded. All parts together give the average over the whole time. Its mean
// flow is removed as for any other average: field_value of the sums.

namespace clatter {

/// Fields on the cells of a grid over the whole box, averaged over a span of time.
struct FieldMaps {
  double begin = 0.0;  ///< simulation times
  double end = 0.0;
  std::vector<double> cell;    ///< [D] edges of a cell
  std::vector<FieldMap> maps;  ///< one per requested field
};

/// The map of a field from a grid's sums; NaN without a value (see field_value).
template <int D>
FieldMap field_map(Field field, const CellSums& sums, const FieldGrid<D>& grid,
                   const MomentLayout<D>& layout);

extern template FieldMap field_map(Field, const CellSums&, const FieldGrid<2>&,
                                   const MomentLayout<2>&);
extern template FieldMap field_map(Field, const CellSums&, const FieldGrid<3>&,
                                   const MomentLayout<3>&);

}  // namespace clatter
