#include "app/film/film_ranges.h"

#include <algorithm>
#include <cmath>

#include "engine/error.h"
#include "engine/picture/moving_sum.h"
#include "engine/system/signals.h"

namespace clatter {

template <int D>
RangeEnds first_extents(const ScheduledRun<D>& run, const Scene& scene, const View& view,
                        double exposure, double last) {
  ScheduledRun<D> ahead(scene, run.seed(), run.simulation().save());
  ahead.show(view, run.save_shown(), exposure);
  const double start = run.simulation().time();
  const double window = std::min(view.window, last - start);
  RangeEnds extents;
  try {
    for (int part = 0; part <= kWindowParts; ++part) {
      const double time = start + window * part / kWindowParts;
      if (!ahead.run_until(time, kNoLimit, kNoLimit, interrupted)) return extents;
      const double disks = extents.disks;
      extents = extents_of(ahead.snapshot(), view);
      extents.disks = std::max(extents.disks, disks);
    }
  } catch (const PhysicalStop&) {
    // The film itself runs into the same stop later.
  }
  return extents;
}

template RangeEnds first_extents<2>(const ScheduledRun<2>&, const Scene&, const View&, double,
                                    double);
template RangeEnds first_extents<3>(const ScheduledRun<3>&, const Scene&, const View&, double,
                                    double);

std::vector<RangeEnds> shared_extents(const std::vector<RangeEnds>& extents,
                                      const std::vector<View>& views) {
  std::vector<RangeEnds> shared = extents;
  for (std::size_t i = 0; i < extents.size(); ++i) {
    for (std::size_t k = 0; k < extents.size(); ++k) {
      const auto share = [](bool same, double& extent, double other) {
        if (same) extent = std::max(extent, other);
      };
      share(views[i].colour_by == views[k].colour_by, shared[i].disks, extents[k].disks);
      share(views[i].field == views[k].field, shared[i].field, extents[k].field);
      share(views[i].arrows == views[k].arrows, shared[i].arrows, extents[k].arrows);
    }
  }
  return shared;
}

FilmRanges first_ranges(const RangeEnds& extents) {
  const RangeEnds ends = {steady_end(0.0, extents.disks), steady_end(0.0, extents.field),
                          steady_end(0.0, extents.arrows)};
  return {ends, ends};
}

RangeEnds settled_extents(const Snapshot& snapshot, const View& view) {
  RangeEnds extents = extents_of(snapshot, view);
  if (!snapshot.field || !snapshot.field->whole_window) extents.field = 0.0;
  return extents;
}

FilmRanges moved(FilmRanges ranges, const RangeEnds& extents, const View& view, double fps) {
  const double most = std::exp2(2.0 / fps);
  const auto move = [most](double& shown, double& target, double extent, ColourRange::Kind kind) {
    if (kind != ColourRange::Auto) return;
    target = steady_end(target, extent);
    shown = shown > 0.0 ? std::clamp(target, shown / most, shown * most) : target;
  };
  move(ranges.shown.disks, ranges.targets.disks, extents.disks, view.range.kind);
  move(ranges.shown.field, ranges.targets.field, extents.field, view.field_range.kind);
  return ranges;
}

}  // namespace clatter
