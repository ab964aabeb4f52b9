#include "app/runs/film_cell.h"

#include <algorithm>
#include <utility>

#include "app/system/interrupt.h"
#include "engine/error.h"
#include "engine/publish/moving_sum.h"
#include "render/camera_path.h"

namespace clatter {

FilmCell::FilmCell(const Gl& gl, Size size, int samples, bool transparent, const View& view,
                   OverlayText text)
    : view_(view),
      text_(std::move(text)),
      canvas_(gl, size),
      renderer_(gl, samples, transparent, interrupted) {}

void FilmCell::show_card(double seconds) {
  if (view_.card) text_.card = card_opacity(*view_.card, seconds);
}

Image FilmCell::draw(const Snapshot& snapshot, const Camera& whole) {
  canvas_.bind();
  renderer_.draw(snapshot, camera_at(view_.camera, snapshot, whole), canvas_.size(), view_, text_,
                 ranges_.legends(snapshot, view_));
  return canvas_.read();
}

template <int D>
RangeEnds first_ranges(const ScheduledRun<D>& run, const Scene& scene, const View& view,
                       double exposure, double last) {
  ScheduledRun<D> ahead(scene, run.seed(), run.simulation().save());
  ahead.show(view, run.save_shown(), exposure);
  const double start = run.simulation().time();
  const double window = std::min(view.window, last - start);
  RangeEnds ends;
  try {
    for (int part = 1; part <= kWindowParts; ++part) {
      const double time = start + window * part / kWindowParts;
      if (!ahead.run_until(time, kNoLimit, kNoLimit, interrupted)) return ends;
      const double disks = ends.disks;
      ends = range_ends(ahead.snapshot(), view);
      ends.disks = std::max(ends.disks, disks);
    }
  } catch (const PhysicalStop&) {
    // The film itself runs into the same stop later.
  }
  return ends;
}

template RangeEnds first_ranges<2>(const ScheduledRun<2>&, const Scene&, const View&, double,
                                   double);
template RangeEnds first_ranges<3>(const ScheduledRun<3>&, const Scene&, const View&, double,
                                   double);

std::vector<RangeEnds> shared_ranges(const std::vector<RangeEnds>& ranges,
                                     const std::vector<View>& views) {
  std::vector<RangeEnds> shared = ranges;
  for (std::size_t i = 0; i < ranges.size(); ++i) {
    for (std::size_t k = 0; k < ranges.size(); ++k) {
      const auto share = [](bool same, double& end, double other) {
        if (same) end = std::max(end, other);
      };
      share(views[i].colour_by == views[k].colour_by, shared[i].disks, ranges[k].disks);
      share(views[i].field == views[k].field, shared[i].field, ranges[k].field);
      share(views[i].arrows == views[k].arrows, shared[i].arrows, ranges[k].arrows);
    }
  }
  return shared;
}

}  // namespace clatter
