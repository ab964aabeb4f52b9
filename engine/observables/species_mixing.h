#pragma once

#include <vector>

#include "engine/dynamics/simulation.h"
#include "engine/observables/counted_cells.h"
#include "engine/observables/observable.h"

namespace clatter {

/// Mixing of the species of a mixture in the cells of a grid over the box (theory 12.18-12.20).
/// Table "mixing.series", means "mixing.lacey", "mixing.entropy" and "mixing.random_entropy".
/// States without two species, or without two particles in a cell, are not counted.
template <int D>
class SpeciesMixing final : public Observable {
 public:
  SpeciesMixing(const Simulation<D>& simulation, const CellSettings& settings);

  std::size_t size() const override;
  std::size_t mean_size() const override;
  void sample() override;
  ObservableResult result(const ObservableParts& parts) const override;

 private:
  const Simulation<D>& simulation_;
  CountedCells cells_;
  std::vector<std::uint32_t> numbers_;  // [cells][species] of a sample
};

extern template class SpeciesMixing<2>;
extern template class SpeciesMixing<3>;

}  // namespace clatter
