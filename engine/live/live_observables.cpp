#include "engine/live/live_observables.h"

#include <algorithm>

namespace clatter {

template <int D>
LiveObservables<D>::LiveObservables(Simulation<D>& simulation, const Measure& measure,
                                    double window)
    : measure_(measure),
      start_(simulation.time()),
      window_(window),
      observables_(simulation, measure_),
      timers_(simulation) {
  observables_.start();
  watch();
}

template <int D>
LiveObservables<D>::LiveObservables(Simulation<D>& simulation, const Measure& measure,
                                    double window, ArchiveReader& saved)
    : measure_(measure),
      start_(0.0),
      window_(window),
      observables_(simulation, measure_),
      timers_(simulation) {
  saved(start_, windows_);
  saved.require(!simulation.is_overdue(start_ + window_, window_, windows_));
  observables_.restore(saved, start_);
  watch();
}

template <int D>
void LiveObservables<D>::watch() {
  observables_.add_timers(timers_, start_);
  // A sample at the end of a window belongs to it.
  const auto close = [this](double) {
    observables_.close_window();
    ++windows_;
  };
  timers_.every(start_ + window_, window_, close, windows_);
}

template <int D>
void LiveObservables<D>::save(ArchiveWriter& io) {
  io(start_, windows_);
  observables_.save(io);
}

template <int D>
std::shared_ptr<const std::vector<ResultTable>> LiveObservables<D>::tables(bool now) {
  constexpr std::uint64_t kShare = 20, kMost = 32;
  const std::uint64_t wanted = now ? 1 : std::clamp<std::uint64_t>(told_ / kShare, 1, kMost);
  if (windows_ < told_ + wanted) return tables_;
  told_ = windows_;
  std::vector<ResultTable> tables;
  for (ObservableResult& result : observables_.results()) {
    std::ranges::move(result.tables, std::back_inserter(tables));
  }
  tables_ = std::make_shared<const std::vector<ResultTable>>(std::move(tables));
  return tables_;
}

template class LiveObservables<2>;
template class LiveObservables<3>;

}  // namespace clatter
