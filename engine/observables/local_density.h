#pragma once

#include "engine/dynamics/simulation.h"
#include "engine/observables/counted_cells.h"
#include "engine/observables/observable.h"

namespace clatter {

/// Number of centres in the cells of a grid over the box (theory 11.15). Table
/// "local_density.number", means "local_density.mean_number" and "..number_variance".
template <int D>
class LocalDensity final : public Observable {
 public:
  LocalDensity(const Simulation<D>& simulation, const CellSettings& settings);

  std::size_t size() const override;
  std::size_t mean_size() const override;
  void sample() override;
  ObservableResult result(const ObservableParts& parts) const override;

 private:
  const Simulation<D>& simulation_;
  CountedCells cells_;
  std::vector<std::uint32_t> numbers_;  // [cells] of a sample
};

extern template class LocalDensity<2>;
extern template class LocalDensity<3>;

}  // namespace clatter
