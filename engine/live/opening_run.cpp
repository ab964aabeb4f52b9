#include "engine/live/opening_run.h"

#include <utility>

#include "engine/initial/memory.h"

namespace clatter {

static const Scene& fitting(const Scene& scene) {
  require_memory(scene);
  return scene;
}

OpeningRun::OpeningRun(const Scene& scene, std::uint64_t seed, std::size_t record_bytes)
    : scene_(fitting(scene)), seed_(seed), record_bytes_(record_bytes), maker_(scene_, seed) {}

bool OpeningRun::advance(const StopRequest& pause) {
  if (!made_) {
    made_ = maker_.advance(pause);
    if (!made_ || pause.made()) return false;
  }
  if (!start_) {
    start_ = maker_.take();
    if (pause.made()) return false;
  }
  if (!run_) {
    run_ = watched_run(scene_, seed_, std::move(*start_), record_bytes_);
    if (pause.made()) return false;
  }
  return run_->prepare(pause);
}

}  // namespace clatter
