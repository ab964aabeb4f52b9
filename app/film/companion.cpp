#include "app/film/companion.h"

#include <optional>
#include <utility>

#include "app/film/film_ranges.h"
#include "app/plots/plot_recorder.h"
#include "engine/checkpoint/archive.h"
#include "engine/dimension.h"
#include "engine/error.h"
#include "engine/live/click_recorder.h"
#include "engine/run/scheduled_run.h"
#include "engine/scene/scene_file.h"
#include "engine/system/signals.h"
#include "render/camera_path.h"

namespace clatter {

// A run that goes ahead of another one.
template <int D>
struct RunAhead {
  RunAhead(const ScheduledRun<D>& run, const Scene& scene)
      : run(scene, run.seed(), run.simulation().save()), clicks(this->run.simulation()) {}

  ScheduledRun<D> run;
  ClickRecorder<D> clicks;
};

template <int D>
SoundPreview preview_of(const ScheduledRun<D>& run, const Scene& scene) {
  return [ahead = std::make_shared<RunAhead<D>>(run, scene)](double time, ClickSums& sums) {
    if (!ahead->run.run_until(time, kNoLimit, kNoLimit, interrupted)) return false;
    sums.add(ahead->clicks.take());
    return true;
  };
}

template SoundPreview preview_of<2>(const ScheduledRun<2>&, const Scene&);
template SoundPreview preview_of<3>(const ScheduledRun<3>&, const Scene&);

SoundScale sound_scale(const std::vector<SoundPreview>& gases, const FrameTimes& times) {
  constexpr double kSeconds = 2.0;
  constexpr long kManyClicks = 100'000;  // a dense gas has them within a frame
  ClickSums sums;
  double seconds = 0.0;
  try {
    for (long frame = 1; frame < times.count; ++frame) {
      for (const SoundPreview& gas : gases) {
        if (!gas(times.of(frame), sums)) return sums.scale(seconds);
      }
      seconds = static_cast<double>(frame) / times.fps;
      if (sums.count() >= kManyClicks || (sums.count() > 0 && seconds >= kSeconds)) break;
    }
  } catch (const PhysicalStop&) {
    // The film itself runs into the same stop later.
  }
  return sums.scale(seconds);
}

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

namespace {

template <int D>
class CompanionRun final : public Companion {
 public:
  CompanionRun(const ComparedScene& compared, const View& view, const FilmPlots& plots,
               double exposure)
      : compared_(compared), view_(view), film_(plots), exposure_(exposure) {}

  // Starts the run from time 0.
  void begin(int threads) {
    run_.emplace(compared_.scene, compared_.seed, interrupted);
    start("", "", threads);
  }
  // Continues the result of save(). `file` is the name of the checkpoint.
  void resume(const std::string& saved, const std::string& file, int threads) {
    std::string scene, shown, plots;
    std::uint64_t seed = 0;
    RunState<D> state;
    ArchiveReader reader(saved, file);
    reader(scene, seed);
    if (scene != scene_to_toml(compared_.scene) || seed != compared_.seed) {
      throw UserError({file}, "the film of the checkpoint compares other scenes or seeds",
                      "give the same scenes, or begin another film without --resume");
    }
    reader(state, shown, plots);
    reader.finish();
    run_.emplace(compared_.scene, seed, state, interrupted);
    start(shown, plots, threads);
  }

  bool run_until(double time) override {
    const auto run = [this](double end) {
      return run_->run_until(end, kNoLimit, kNoLimit, interrupted);
    };
    return plots_ ? plots_->run_until(time, run) : run(time);
  }
  PlottedGas plotted() override { return plots_->gas(); }
  Snapshot snapshot() override { return run_->snapshot(); }
  void listen() override { clicks_.emplace(run_->simulation()); }
  std::vector<Click> take_clicks() override { return clicks_->take(); }
  SoundPreview preview() const override { return preview_of(*run_, compared_.scene); }
  RangeEnds first_extents(double last) const override {
    return clatter::first_extents(*run_, compared_.scene, view_, exposure_, last);
  }
  std::uint64_t state_hash() const override { return run_->simulation().state_hash(); }
  std::string save() override {
    std::string scene = scene_to_toml(compared_.scene), shown = run_->save_shown();
    std::string plots = plots_ ? plots_->save() : "";
    std::uint64_t seed = compared_.seed;
    RunState<D> state = run_->simulation().save();
    ArchiveWriter writer;
    writer(scene, seed, state, shown, plots);
    return writer.written();
  }

 private:
  void start(const std::string& shown, const std::string& plots, int threads) {
    run_->use_threads(threads);
    run_->show(view_, shown, exposure_);
    if (!film_.plots.empty()) plots_.emplace(*run_, film_, plots);
  }

  ComparedScene compared_;
  View view_;
  FilmPlots film_;
  double exposure_;
  std::optional<ScheduledRun<D>> run_;
  std::optional<PlotRecorder<D>> plots_;    // absent: no plots
  std::optional<ClickRecorder<D>> clicks_;  // absent: nobody listens
};

}  // namespace

std::unique_ptr<Companion> companion_of(const ComparedScene& compared, const View& view,
                                        const FilmPlots& plots, double exposure, int threads,
                                        const std::string& saved, const std::string& file) {
  return with_dimension(
      compared.scene.dimension(), [&](auto dimension) -> std::unique_ptr<Companion> {
        auto companion = std::make_unique<CompanionRun<dimension>>(compared, view, plots, exposure);
        if (saved.empty()) {
          companion->begin(threads);
        } else {
          companion->resume(saved, file, threads);
        }
        return companion;
      });
}

}  // namespace clatter
