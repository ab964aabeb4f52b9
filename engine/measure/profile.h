#pragma once

#include <span>
#include <string>
#include <vector>

#include "engine/measure/cell_integrals.h"
#include "engine/scene/scene.h"
#include "engine/statistics/estimate.h"

namespace clatter {

/// Fields along one axis, averaged over the other axes and over time, with standard errors by
/// blocking. A field without a value (see field_value) has the mean NaN.
struct Profile {
  int dimension = 2;  ///< of the box
  Axis axis = Axis::X;
  std::vector<double> edges;                  ///< [columns + 1] along the axis
  std::vector<Field> fields;                  ///< the requested fields
  std::vector<std::vector<Estimate>> values;  ///< [fields][columns]
  /// [fields] names of the species; empty, all or some: of all particles.
  std::vector<std::string> species = {};

  /// The name of a field in files, by its index.
  std::string name(std::size_t field) const {
    return name_of(fields[field], species.empty() ? std::string() : species[field]);
  }

  /// The values of a requested field; throws std::out_of_range for another field.
  const std::vector<Estimate>& at(Field field) const;
};

/// A window's sums added over all cells of each column across an axis: `grid.cells()[axis]` rows.
template <int D>
CellSums columns_of(const CellSums& cells, const FieldGrid<D>& grid, Axis axis);

/// The profile from windows of time, each a result of columns_of().
template <int D>
Profile profile_of(std::span<const CellSums> windows, const FieldGrid<D>& grid,
                   const MomentLayout<D>& layout, std::span<const Field> fields, Axis axis);

extern template CellSums columns_of(const CellSums&, const FieldGrid<2>&, Axis);
extern template CellSums columns_of(const CellSums&, const FieldGrid<3>&, Axis);
extern template Profile profile_of(std::span<const CellSums>, const FieldGrid<2>&,
                                   const MomentLayout<2>&, std::span<const Field>, Axis);
extern template Profile profile_of(std::span<const CellSums>, const FieldGrid<3>&,
                                   const MomentLayout<3>&, std::span<const Field>, Axis);

}  // namespace clatter
