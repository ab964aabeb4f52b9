#include "app/plots/plot_recorder.h"

#include <algorithm>
#include <cmath>
#include <memory>

#include "engine/checkpoint/archive.h"
#include "engine/picture/snapshot.h"
#include "engine/scene/scene_file.h"

namespace clatter {

// What a film measures for its plots: of the observables those that it shows.
static Measure plotted_part(Measure measure, const std::vector<FilmPlot>& plots) {
  measure.observables.clear();
  for (const FilmPlot plot : plots) {
    const auto kind = observable_of(plot);
    if (kind && !measure.observes(*kind)) measure.observables.push_back(*kind);
  }
  return measure;
}

template <int D>
PlotRecorder<D>::PlotRecorder(ScheduledRun<D>& run, const FilmPlots& film, const std::string& saved)
    : run_(run),
      axis_(static_cast<int>(film.axis) < D ? film.axis : Axis::X),
      has_profile_(std::ranges::any_of(film.plots, is_profile)),
      plotted_(plotted_part(run.laws().measure, film.plots)),
      spacing_(film.speed / History::kPerSecond),
      totals_(run.simulation()),
      own_(run.simulation(), *this),
      of_totals_(run.simulation(), totals_) {
  frame_.run = 1;
  frame_.speed = film.speed;
  if (!saved.empty() && resume(saved)) return;
  next_ = static_cast<std::uint64_t>(run.simulation().time() / spacing_) + 1;
  begin_averages();
}

// The laws that samples belong to. Profiles also depend on the view and on the axis.
template <int D>
std::string PlotRecorder<D>::laws() const {
  return scene_to_toml(run_.laws()) + static_cast<char>('x' + static_cast<int>(axis_));
}

template <int D>
void PlotRecorder<D>::begin_averages() {
  profile_.reset();
  observables_.reset();
  if (has_profile_) profile_.emplace(run_.simulation(), window(), axis_);
  if (!plotted_.observables.empty()) observables_.emplace(run_.simulation(), plotted_, window());
}

// Returns false if the saved samples belong to other laws or plots.
template <int D>
bool PlotRecorder<D>::resume(const std::string& saved) {
  constexpr const char* kFile = "--resume";
  std::string saved_laws, samples, profile, observables;
  ArchiveReader reader(saved, kFile);
  reader(saved_laws, samples, profile, observables);
  reader.finish();
  if (saved_laws != laws() || profile.empty() == has_profile_ ||
      observables.empty() != plotted_.observables.empty()) {
    return false;
  }
  Simulation<D>& simulation = run_.simulation();
  ArchiveReader of_samples(samples, kFile);
  visit(of_samples);
  of_samples.finish();
  of_samples.require(!simulation.is_overdue(0.0, spacing_, next_));
  if (has_profile_) {
    ArchiveReader of_profile(profile, kFile);
    profile_.emplace(simulation, window(), axis_, of_profile);
    of_profile.finish();
  }
  if (!observables.empty()) {
    ArchiveReader of_observables(observables, kFile);
    observables_.emplace(simulation, plotted_, window(), of_observables);
    of_observables.finish();
  }
  frame_.snapshot = snapshot_of(simulation);
  return true;
}

template <int D>
void PlotRecorder<D>::before_laws(const Model<D>&) {
  add(tally_, totals_.close_window());
}

template <int D>
void PlotRecorder<D>::on_laws() {
  begin_averages();
  frame_.scene.reset();
}

// The spacing grows with that of the history, which keeps a bounded number of samples.
template <int D>
bool PlotRecorder<D>::run_until(double time, const std::function<bool(double time)>& run) {
  while (next_time() <= time) {
    if (!run(next_time())) return false;
    take_sample();
    next_ += static_cast<std::uint64_t>(std::max(1.0, std::round(history_.spacing() / spacing_)));
  }
  return run(time);
}

template <int D>
void PlotRecorder<D>::take_sample() {
  add(tally_, totals_.close_window());
  frame_.snapshot = snapshot_of(run_.simulation());
  frame_.head = frame_.snapshot.time;
  frame_.tally = tally_;
  frame_.scene = scene();
  history_.add(frame_);
}

template <int D>
std::shared_ptr<const Scene> PlotRecorder<D>::scene() const {
  return frame_.scene ? frame_.scene : std::make_shared<const Scene>(run_.present_scene());
}

template <int D>
PlottedGas PlotRecorder<D>::gas() {
  frame_.scene = scene();
  history_.predict(frame_.scene);
  if (profile_) frame_.profile = profile_->profile();
  if (observables_) frame_.observables = observables_->tables(true);
  return {&history_, &frame_, ""};
}

template <int D>
std::string PlotRecorder<D>::save() {
  ArchiveWriter samples, profile, observables, all;
  visit(samples);
  if (profile_) profile(*profile_);
  if (observables_) observables_->save(observables);
  std::string of_laws = laws(), of_samples = samples.written(), of_profile = profile.written();
  std::string of_observables = observables.written();
  all(of_laws, of_samples, of_profile, of_observables);
  return all.written();
}

template class PlotRecorder<2>;
template class PlotRecorder<3>;

}  // namespace clatter
