#include "app/plots/plot_recorder.h"

#include <algorithm>
#include <cmath>
#include <memory>

#include "engine/checkpoint/archive.h"
#include "engine/publish/publish.h"

namespace clatter {

template <int D>
PlotRecorder<D>::PlotRecorder(ScheduledRun<D>& run, const View& view, double speed,
                              const std::string& saved)
    : run_(run), view_(view), spacing_(speed / History::kPerSecond) {
  frame_.run = 1;
  frame_.speed = speed;
  Simulation<D>& simulation = run.simulation();
  if (saved.empty()) {
    next_ = static_cast<std::uint64_t>(simulation.time() / spacing_) + 1;
    watch(simulation);
    return;
  }
  simulation.add_observer(totals_.emplace(simulation));
  ArchiveReader reader(saved, "--resume");
  visit(reader);
  if (has_profile()) profile_.emplace(simulation, profile_window(), profile_axis(), reader);
  reader.finish();
}

template <int D>
bool PlotRecorder<D>::has_profile() const {
  return std::ranges::any_of(view_.plots,
                             [](FilmPlot plot) { return plot >= FilmPlot::DensityProfile; });
}

template <int D>
void PlotRecorder<D>::watch(Simulation<D>& simulation) {
  simulation.add_observer(totals_.emplace(simulation));
  profile_.reset();
  if (has_profile()) profile_.emplace(simulation, profile_window(), profile_axis());
}

template <int D>
void PlotRecorder<D>::follow(Simulation<D>& next) {
  add(tally_, totals_->close_window());
  watch(next);
  frame_.scene.reset();
}

template <int D>
bool PlotRecorder<D>::run_until(double time, const std::function<bool(double time)>& run) {
  for (; next_time() <= time; ++next_) {
    if (!run(next_time())) return false;
    take_sample();
  }
  return run(time);
}

template <int D>
void PlotRecorder<D>::take_sample() {
  add(tally_, totals_->close_window());
  frame_.snapshot = snapshot_of(run_.simulation());
  frame_.head = frame_.snapshot.time;
  frame_.tally = tally_;
  history_.add(frame_);
}

template <int D>
PlottedGas PlotRecorder<D>::gas() {
  if (!frame_.scene) frame_.scene = std::make_shared<const Scene>(run_.scene());
  if (profile_) frame_.profile = profile_->profile();
  return {&history_, &frame_, ""};
}

template <int D>
std::string PlotRecorder<D>::save() {
  ArchiveWriter writer;
  visit(writer);
  if (profile_) writer(*profile_);
  return writer.written();
}

template class PlotRecorder<2>;
template class PlotRecorder<3>;

}  // namespace clatter
