#include "engine/live/opening_run.h"

#include <algorithm>
#include <utility>

#include "engine/initial/adapt_to_scene.h"
#include "engine/initial/memory.h"
#include "engine/physics/state.h"

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

// Makes a gas, moved by a shift, the start state of another scene.
template <int D>
static void start_from(State<D>& state, const VecX& shift, std::uint64_t seed, Scene& scene) {
  if (scene.dimension() != D) return;
  if (shift.size() > 0) {
    for (Vec<D>& position : state.positions) position += shift;
  }
  state = adapt_to_scene(state, scene, seed);
  const double temperature = temperature_of(state);
  add_flow(state, model_of<D>(scene, seed).domain(), 1.0);
  scene.particles.start = {
      .layout = Layout::File, .file = "", .state = std::move(state), .temperature = temperature};
  scene.particles.count_left.reset();
  for (Species& species : scene.species) species.count_left.reset();
}

OpeningGases::OpeningGases(const command::Open& asked, const GasesInStep* present,
                           std::size_t record_bytes)
    : asked_(asked) {
  std::vector<command::GasToOpen> gases = asked.others;
  const std::size_t place = std::min(asked.gas, gases.size());
  gases.insert(gases.begin() + static_cast<std::ptrdiff_t>(place), {asked.scene, asked.seed});
  for (std::size_t k = 0; k < gases.size(); ++k) {
    command::GasToOpen& gas = gases[k];
    if (asked.keeps_gas && present && k < present->count()) {
      const VecX shift = k == place ? asked.shift : VecX();
      AnyState state = present->state_of(k);
      std::visit([&](auto& particles) { start_from(particles, shift, gas.seed, gas.scene); },
                 state);
    }
    runs_.push_back(std::make_unique<OpeningRun>(gas.scene, gas.seed, record_bytes));
  }
}

void OpeningGases::advance(const StopRequest& pause) {
  complete_ = std::ranges::all_of(runs_, [&](auto& run) { return run->advance(pause); });
}

double OpeningGases::progress() const {
  double sum = 0.0;
  for (const auto& run : runs_) sum += run->progress();
  return sum / static_cast<double>(runs_.size());
}

std::vector<std::unique_ptr<WatchedRun>> OpeningGases::take() {
  std::vector<std::unique_ptr<WatchedRun>> runs;
  for (const auto& run : runs_) runs.push_back(run->take());
  return runs;
}

}  // namespace clatter
