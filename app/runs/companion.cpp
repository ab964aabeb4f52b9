#include "app/runs/companion.h"

#include <optional>
#include <utility>

#include "app/runs/film_cell.h"
#include "app/system/interrupt.h"
#include "engine/checkpoint/archive.h"
#include "engine/dimension.h"
#include "engine/error.h"
#include "engine/publish/scheduled_run.h"
#include "engine/scene/scene_file.h"

namespace clatter {

namespace {

template <int D>
class CompanionRun final : public Companion {
 public:
  CompanionRun(const ComparedScene& compared, const View& view, double exposure, int threads)
      : compared_(compared), view_(view), exposure_(exposure) {
    run_.emplace(compared.scene, compared.seed, interrupted);
    start("", threads);
  }
  CompanionRun(const ComparedScene& compared, const View& view, double exposure, int threads,
               const std::string& saved, const std::string& file)
      : compared_(compared), view_(view), exposure_(exposure) {
    std::string scene, shown;
    std::uint64_t seed = 0;
    RunState<D> state;
    ArchiveReader reader(saved, file);
    reader(scene, seed);
    if (scene != scene_to_toml(compared.scene) || seed != compared.seed) {
      throw UserError({file}, "the film of the checkpoint compares other scenes or seeds",
                      "give the same scenes, or begin another film without --resume");
    }
    reader(state, shown);
    reader.finish();
    run_.emplace(compared.scene, seed, state, interrupted);
    start(shown, threads);
  }

  bool run_until(double time) override {
    return run_->run_until(time, kNoLimit, kNoLimit, interrupted);
  }
  Snapshot snapshot() override { return run_->snapshot(); }
  RangeEnds first_ranges(double last) const override {
    return clatter::first_ranges(*run_, compared_.scene, view_, exposure_, last);
  }
  std::uint64_t state_hash() const override { return run_->simulation().state_hash(); }
  std::string save() const override {
    std::string scene = scene_to_toml(compared_.scene), shown = run_->save_shown();
    std::uint64_t seed = compared_.seed;
    RunState<D> state = run_->simulation().save();
    ArchiveWriter writer;
    writer(scene, seed, state, shown);
    return writer.written();
  }

 private:
  void start(const std::string& shown, int threads) {
    run_->use_threads(threads);
    run_->show(view_, shown, exposure_);
  }

  ComparedScene compared_;
  View view_;
  double exposure_;
  std::optional<ScheduledRun<D>> run_;
};

}  // namespace

std::unique_ptr<Companion> companion_of(const ComparedScene& compared, const View& view,
                                        double exposure, int threads, const std::string& saved,
                                        const std::string& file) {
  return with_dimension(
      compared.scene.dimension(), [&](auto dimension) -> std::unique_ptr<Companion> {
        if (saved.empty()) {
          return std::make_unique<CompanionRun<dimension>>(compared, view, exposure, threads);
        }
        return std::make_unique<CompanionRun<dimension>>(compared, view, exposure, threads, saved,
                                                         file);
      });
}

}  // namespace clatter
