#include "engine/observables/species_mixing.h"

#include <cmath>

#include "engine/physics/mixing.h"

namespace clatter {

namespace {

// Layout of the sums over samples.
struct MixingSums {
  static constexpr std::size_t kSamples = 0;
  static constexpr std::size_t kTime = 1;
  static constexpr std::size_t kLacey = 2;
  static constexpr std::size_t kEntropy = 3;
  static constexpr std::size_t kRandomEntropy = 4;
  static constexpr std::size_t kSize = 5;
};

}  // namespace

template <int D>
SpeciesMixing<D>::SpeciesMixing(const Simulation<D>& simulation, const CellSettings& settings)
    : simulation_(simulation), cells_(simulation.model().box, settings) {}

template <int D>
std::size_t SpeciesMixing<D>::size() const {
  return MixingSums::kSize;
}

template <int D>
std::size_t SpeciesMixing<D>::mean_size() const {
  return MixingSums::kSize;
}

template <int D>
void SpeciesMixing<D>::sample() {
  const Model<D>& model = simulation_.model();
  const std::size_t species = model.species->count();
  const auto positions = simulation_.positions();
  numbers_.assign(cells_.size() * species, 0);
  for (std::uint32_t i = 0; i < positions.size(); ++i) {
    const std::size_t cell = cells_.of(positions[i], model.box);
    ++numbers_[cell * species + simulation_.grain(i).species];
  }
  const Mixing mixing = mixing_of(numbers_, species);
  if (std::isnan(mixing.lacey)) return;
  sums_ += {{1.0, simulation_.time(), mixing.lacey, mixing.entropy, mixing.random_entropy}};
}

// A row is the average over the samples of a part of the run.
template <int D>
ObservableResult SpeciesMixing<D>::result(const ObservableParts& parts) const {
  ResultTable series{
      "mixing.series",
      {{"time", "t", {}}, {"lacey", "1", {}}, {"entropy", "1", {}}, {"random_entropy", "1", {}}}};
  for (const ObservableSums& part : parts.coarse) {
    const double samples = part.values[MixingSums::kSamples];
    if (samples == 0.0) continue;
    for (std::size_t column = 0; column < series.columns.size(); ++column) {
      series.columns[column].values.push_back(part.values[MixingSums::kTime + column] / samples);
    }
  }
  const auto mean = [&](std::size_t sum) {
    return ratio_of(parts.fine, sum, MixingSums::kSamples);
  };
  return {{std::move(series)},
          {{"mixing.lacey", mean(MixingSums::kLacey)},
           {"mixing.entropy", mean(MixingSums::kEntropy)},
           {"mixing.random_entropy", mean(MixingSums::kRandomEntropy)}}};
}

template class SpeciesMixing<2>;
template class SpeciesMixing<3>;

}  // namespace clatter
