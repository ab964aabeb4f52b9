#pragma once

#include <functional>
#include <vector>

#include "engine/picture/snapshot.h"
#include "render/colour_range.h"
#include "render/layers/legend.h"

namespace clatter {

/// The ends of automatic colour ranges, or the extents of their values; 0: no data for the range.
struct RangeEnds {
  double disks = 0.0;
  double field = 0.0;
  double arrows = 0.0;
};

/// The robust extents of the values that a snapshot shows.
RangeEnds extents_of(const Snapshot& snapshot, const View& view);

/// Passes over all members, in order, for checkpoints.
template <class Archive>
void visit(Archive& io, RangeEnds& range) {
  auto& [disks, field, arrows] = range;
  io(disks, field, arrows);
}

/// The legends of a sequence of snapshots. Automatic ranges follow the sequence unless they are
/// fixed, so each window needs its own ranges.
class AutoRanges {
 public:
  /// Fixes the ends of the automatic and locked ranges, until the next call.
  void fix(const RangeEnds& ends);

  /// The legends of the next picture. Automatic ranges follow the snapshot.
  Legends legends(const Snapshot& snapshot, const View& view) { return legends({&snapshot}, view); }
  /// The legends of the next pictures of several gases, of the same dimension. Automatic ranges
  /// contain the values of all of them.
  Legends legends(const std::vector<const Snapshot*>& snapshots, const View& view);

 private:
  /// Automatic colour range of one quantity.
  struct Followed {
    Label label;
    SteadyExtent followed;
    double fixed = 0.0;  ///< fixed end; 0: the end follows the snapshots

    /// End of the range. Another label restarts it. `extent` returns the robust extent of the data,
    /// and is called only if needed.
    double end(const Label& shown, const std::function<double()>& extent, bool hold = false);

    /// Legend for `range`. A locked range is held only if `lockable`.
    Legend legend(const Label& shown, const ColourRange& range, ColourMap map,
                  const std::function<double()>& extent, bool lockable);
  };

  Followed disks_;
  Followed field_;
  Followed arrows_;
};

}  // namespace clatter
