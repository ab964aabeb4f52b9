#pragma once

#include <cstdint>
#include <functional>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "app/plots/history.h"
#include "app/plots/plots.h"
#include "engine/live/live_observables.h"
#include "engine/live/live_profile.h"
#include "engine/measure/totals.h"
#include "engine/run/scheduled_run.h"

namespace clatter {

/// The plots of a film.
struct FilmPlots {
  std::vector<FilmPlot> plots;
  Axis axis = Axis::X;  ///< of profiles, those of disks along z are along x
  double speed = 1.0;   ///< simulation time per second of film
};

/// Samples a run for the plots of its film.
template <int D>
class PlotRecorder final : private Observer<D> {
 public:
  /// Samples from the present time of the run on. The samples continue the result of save(), unless
  /// it is empty or belongs to other laws or plots. `run` must outlive the recorder.
  PlotRecorder(ScheduledRun<D>& run, const FilmPlots& film, const std::string& saved);
  PlotRecorder(const PlotRecorder&) = delete;
  PlotRecorder& operator=(const PlotRecorder&) = delete;

  /// Runs to a time by `run`, which returns false at an early end, and takes samples on the way.
  /// Returns false at an early end.
  bool run_until(double time, const std::function<bool(double time)>& run);
  /// The gas at the present time, without a name. Valid until the next call.
  PlottedGas gas();
  /// The samples and all sums, for a checkpoint.
  std::string save();

 private:
  double next_time() const { return static_cast<double>(next_) * spacing_; }
  double window() const { return run_.laws().view.window / kWindowParts; }
  std::string laws() const;
  std::shared_ptr<const Scene> scene() const;
  void before_laws(const Model<D>& next) override;
  void on_laws() override;
  void begin_averages();
  bool resume(const std::string& saved);
  void take_sample();
  template <class Archive>
  void visit(Archive& io) {
    io(next_, tally_, history_, totals_);
  }

  ScheduledRun<D>& run_;
  Axis axis_;
  bool has_profile_;
  Measure plotted_;         // has the observables that are plotted
  double spacing_;          // shortest time between samples
  std::uint64_t next_ = 1;  // number of the next sample; sample 0 is at time 0
  Tally tally_ = empty_tally(D);
  History history_;
  Totals<D> totals_;
  std::optional<LiveProfile<D>> profile_;          // absent: no plot needs it
  std::optional<LiveObservables<D>> observables_;  // absent: no plot needs them
  Frame frame_;                            // of the last sample
  Observation<D> own_, of_totals_;
};

extern template class PlotRecorder<2>;
extern template class PlotRecorder<3>;

}  // namespace clatter
