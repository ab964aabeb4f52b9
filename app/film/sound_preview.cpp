#include "app/film/sound_preview.h"

#include "engine/error.h"
#include "engine/live/click_recorder.h"
#include "engine/system/signals.h"

namespace clatter {

namespace {

template <int D>
class PreviewRun final : public SoundPreview {
 public:
  PreviewRun(const ScheduledRun<D>& run, const Scene& scene)
      : ahead_(scene, run.seed(), run.simulation().save()), clicks_(ahead_.simulation()) {}

  bool run_until(double time) override {
    return ahead_.run_until(time, kNoLimit, kNoLimit, interrupted);
  }
  std::vector<Click> take_clicks() override { return clicks_.take(); }

 private:
  ScheduledRun<D> ahead_;
  ClickRecorder<D> clicks_;
};

}  // namespace

template <int D>
std::unique_ptr<SoundPreview> preview_of(const ScheduledRun<D>& run, const Scene& scene) {
  return std::make_unique<PreviewRun<D>>(run, scene);
}

template std::unique_ptr<SoundPreview> preview_of<2>(const ScheduledRun<2>&, const Scene&);
template std::unique_ptr<SoundPreview> preview_of<3>(const ScheduledRun<3>&, const Scene&);

SoundScale sound_scale(const std::vector<std::unique_ptr<SoundPreview>>& gases,
                       const FrameTimes& times) {
  constexpr double kSeconds = 2.0;
  constexpr long kManyClicks = 100'000;  // a dense gas has them within a frame
  ClickSums sums;
  double seconds = 0.0;
  try {
    for (long frame = 1; frame < times.count; ++frame) {
      for (const auto& gas : gases) {
        if (!gas->run_until(times.of(frame))) return sums.scale(seconds);
        sums.add(gas->take_clicks());
      }
      seconds = static_cast<double>(frame) / times.fps;
      if (sums.count() >= kManyClicks || (sums.count() > 0 && seconds >= kSeconds)) break;
    }
  } catch (const PhysicalStop&) {
    // The film itself runs into the same stop later.
  }
  return sums.scale(seconds);
}

}  // namespace clatter
