#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "engine/measure/cell_integrals.h"
#include "engine/measure/field_grid.h"
#include "engine/measure/field_map.h"
#include "engine/measure/moment_layout.h"
#include "engine/scene/scene.h"

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

/// A run's sums as a series of parts in time. The number of parts stays bounded for any length of
/// the run: when it reaches the maximum, neighbouring parts are merged in pairs, and later parts
/// are twice as long.
class PartSums {
 public:
  /// Maximum number of parts. If these took more than kMaxBytes, the maximum is lower, but at least
  /// 2.
  static constexpr std::size_t kMaxParts = 64;
  static constexpr std::size_t kMaxBytes = std::size_t{64} << 20;

  /// Maximum number of parts of `bytes` each. It is even, so that each part has a neighbour.
  static std::size_t max_parts(std::size_t bytes);

  /// Adds a window of time. All windows have the same length and grid.
  void add(CellSums window);

  /// The parts in order of time; the last may be shorter than the others.
  const std::vector<CellSums>& parts() const { return parts_; }
  /// The number of windows per part; the last part may have fewer.
  std::uint64_t windows_per_part() const { return windows_per_part_; }

  /// Visits all members, for checkpoints.
  template <class Archive>
  void visit(Archive& io) {
    auto& [parts, windows_per_part, windows] = *this;
    io(parts, windows_per_part, windows);
  }

 private:
  void join_neighbours();

  std::vector<CellSums> parts_;
  std::uint64_t windows_per_part_ = 1;
  std::uint64_t windows_ = 0;  // in all parts
};

extern template FieldMap field_map(Field, const CellSums&, const FieldGrid<2>&,
                                   const MomentLayout<2>&);
extern template FieldMap field_map(Field, const CellSums&, const FieldGrid<3>&,
                                   const MomentLayout<3>&);

}  // namespace clatter
