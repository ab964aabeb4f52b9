#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "engine/measure/cell_integrals.h"
#include "engine/measure/field_grid.h"
#include "engine/measure/field_map.h"
#include "engine/measure/moment_layout.h"
#include "engine/scene/scene.h"
#include "engine/stop_request.h"

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

/// The maps of fields from a grid's sums, without names of species; NaN without a value (see
/// field_value). Throws Interrupted if the work must stop.
template <int D>
std::vector<FieldMap> field_maps(std::span<const Field> fields, const CellSums& sums,
                                 const FieldGrid<D>& grid, const MomentLayout<D>& layout,
                                 const StopRequest& stop = {});

extern template std::vector<FieldMap> field_maps(std::span<const Field>, const CellSums&,
                                                 const FieldGrid<2>&, const MomentLayout<2>&,
                                                 const StopRequest&);
extern template std::vector<FieldMap> field_maps(std::span<const Field>, const CellSums&,
                                                 const FieldGrid<3>&, const MomentLayout<3>&,
                                                 const StopRequest&);

}  // namespace clatter
