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
  observables_.add_timers(timers_, start_);
  // A sample at the end of a window belongs to it.
  timers_.every(start_ + window_, window_, [this](double) {
    observables_.close_window();
    ++windows_;
  });
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
