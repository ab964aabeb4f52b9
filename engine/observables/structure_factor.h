#pragma once

#include <complex>
#include <vector>

#include "engine/dynamics/simulation.h"
#include "engine/observables/observable.h"
#include "engine/observables/species_groups.h"
#include "engine/scene/observable_settings.h"

namespace clatter {

/// Static structure factor S(k) (theory 11.10) at wave vectors of the box, averaged over shells of
/// equal width in |k|. Wave vectors have components along periodic axes only. Table
/// "structure_factor". In a mixture it has a column "S_small+large" for each two species (theory
/// 12.17).
template <int D>
class StructureFactor final : public Observable {
 public:
  StructureFactor(const Simulation<D>& simulation, const StructureFactorSettings& settings);

  std::size_t size() const override {
    const std::size_t species = groups_.count() - 1;
    return 1 + shells_.size() * (1 + species * (species + 1) / 2);
  }
  std::size_t mean_size() const override { return 0; }
  void sample() override;
  ObservableResult result(const ObservableParts& parts) const override;

 private:
  // Wave vectors of about the same length.
  struct Shell {
    std::vector<IntVec<D>> vectors;  // in units of 2 pi / L along each axis; of k and -k only one
    double wave_number = 0.0;        // mean of |k|
  };

  void add_shell(double low, double high, int most);
  struct Factors;
  std::vector<std::complex<double>> density_of(const std::vector<Vec<D>>& positions) const;
  [[gnu::always_inline]] inline void add_density(const std::vector<Vec<D>>& positions,
                                                 std::vector<std::complex<double>>& density) const;
#if defined(__x86_64__)
  void add_density_avx2(const std::vector<Vec<D>>& positions,
                        std::vector<std::complex<double>>& density) const;
#endif
  void add_products(const std::vector<std::complex<double>>& first,
                    const std::vector<std::complex<double>>& second, double factor,
                    std::size_t place);
  Vec<D> unit() const;

  const Simulation<D>& simulation_;
  SpeciesGroups<D> groups_;
  std::vector<Shell> shells_;
  IntVec<D> most_ = IntVec<D>::Zero();  // largest component along each axis
};

extern template class StructureFactor<2>;
extern template class StructureFactor<3>;

}  // namespace clatter
