#pragma once

#include <memory>
#include <vector>

#include "app/film/frame_times.h"
#include "engine/run/scheduled_run.h"
#include "render/sound/synthesiser.h"

namespace clatter {

/// A copy of a gas that runs ahead for its clicks.
class SoundPreview {
 public:
  virtual ~SoundPreview() = default;

  /// Runs to a simulation time. Returns false at an interrupt. Throws PhysicalStop.
  virtual bool run_until(double time) = 0;
  /// The clicks since the last call, as ClickRecorder::take().
  virtual std::vector<Click> take_clicks() = 0;
};

/// A preview from the present time of a run of `scene`. The run stays where it is.
template <int D>
std::unique_ptr<SoundPreview> preview_of(const ScheduledRun<D>& run, const Scene& scene);

/// The scale of the first seconds of a film that have a click, over all of its gases. Ends early at
/// an interrupt and where a gas stops.
SoundScale sound_scale(const std::vector<std::unique_ptr<SoundPreview>>& gases,
                       const FrameTimes& times);

}  // namespace clatter
