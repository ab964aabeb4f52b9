#pragma once

#include <vector>

#include "engine/run/scheduled_run.h"
#include "render/layers/auto_ranges.h"

namespace clatter {

/// The ends of the automatic colour ranges of a gas in a film.
struct FilmRanges {
  RangeEnds shown;    ///< of the present picture
  RangeEnds targets;  ///< round ends, to which the shown ones move
};

/// Passes over all members, in order, for checkpoints.
template <class Archive>
void visit(Archive& io, FilmRanges& ranges) {
  auto& [shown, targets] = ranges;
  io(shown, targets);
}

/// Extents from the first averaging window of a film, that begins at the present time of the run:
/// the largest values at its start and at the ends of its parts, and those of its average. The run
/// stays where it is. `last` is the time of the last frame. Ends early at an interrupt.
template <int D>
RangeEnds first_extents(const ScheduledRun<D>& run, const Scene& scene, const View& view,
                        double exposure, double last);

/// The same extents for all views of the same quantities: the largest ones.
std::vector<RangeEnds> shared_extents(const std::vector<RangeEnds>& extents,
                                      const std::vector<View>& views);

/// The ranges of the first picture of a film with these extents.
FilmRanges first_ranges(const RangeEnds& extents);

/// The extents to which the ranges of a film may move: those of a snapshot, 0 for a heatmap before
/// the end of its averaging window.
RangeEnds settled_extents(const Snapshot& snapshot, const View& view);

/// The ranges of the next frame. The target of an automatic range follows the extent, as
/// steady_end(). Its shown end moves to the target by at most a factor of 2 in half a second. The
/// scale of arrows stays.
FilmRanges moved(FilmRanges ranges, const RangeEnds& extents, const View& view, double fps);

}  // namespace clatter
