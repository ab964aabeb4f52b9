#include "engine/observables/probe.h"

#include <limits>
#include <string>

namespace clatter {

namespace {

// Layout of the sums over samples.
struct ProbeSums {
  static constexpr std::size_t kSamples = 0;
  static constexpr std::size_t kNumber = 1;
  static constexpr std::size_t kSquare = 2;    // of the number
  static constexpr std::size_t kFreedoms = 3;  // degrees of freedom of the temperature
  static constexpr std::size_t kEnergy = 4;    // twice the energy in them
  static constexpr std::size_t kTime = 5;
  static constexpr std::size_t kMass = 6;
  static constexpr std::size_t kMomentum = 7;  // along each axis
};

}  // namespace

template <int D>
Probe<D>::Probe(const Simulation<D>& simulation, const ProbeSettings& settings)
    : simulation_(simulation), region_(simulation.model(), settings.region, 0.25, 0.75) {}

template <int D>
std::size_t Probe<D>::size() const {
  return ProbeSums::kMomentum + D;
}

template <int D>
std::size_t Probe<D>::mean_size() const {
  return size();
}

template <int D>
void Probe<D>::start() {
  Observable::start();
  rows_ = {};
}

template <int D>
void Probe<D>::save(ArchiveWriter& io) {
  Observable::save(io);
  io(rows_);
}

template <int D>
void Probe<D>::restore(ArchiveReader& io) {
  Observable::restore(io);
  io(rows_);
  for (const ObservableSums& row : rows_.parts()) io.require(row.values.size() == size());
}

template <int D>
void Probe<D>::sample() {
  State<D> state = simulation_.state();
  add_flow(state, simulation_.domain(), -1.0);
  double number = 0.0, mass = 0.0, squares = 0.0;
  Vec<D> momentum = Vec<D>::Zero();
  for (std::size_t i = 0; i < state.positions.size(); ++i) {
    if (!region_.contains(state.positions[i])) continue;
    const double m = simulation_.grain(static_cast<std::uint32_t>(i)).mass;
    number += 1.0;
    mass += m;
    momentum += m * state.velocities[i];
  }
  for (std::size_t i = 0; i < state.positions.size(); ++i) {
    if (!region_.contains(state.positions[i])) continue;
    const double m = simulation_.grain(static_cast<std::uint32_t>(i)).mass;
    squares += m * (state.velocities[i] - momentum / mass).squaredNorm();
  }
  ObservableSums row{std::vector<double>(size(), 0.0)};
  row.values[ProbeSums::kSamples] = 1.0;
  row.values[ProbeSums::kNumber] = number;
  row.values[ProbeSums::kSquare] = number * number;
  if (number > 1.0) row.values[ProbeSums::kFreedoms] = D * (number - 1.0);
  row.values[ProbeSums::kEnergy] = squares;
  row.values[ProbeSums::kTime] = simulation_.time();
  row.values[ProbeSums::kMass] = mass;
  for (std::size_t axis = 0; axis < D; ++axis) {
    row.values[ProbeSums::kMomentum + axis] = momentum[static_cast<int>(axis)];
  }
  sums_ += row;
  rows_.add(std::move(row));
}

static std::string velocity_name(std::size_t axis) {
  return "velocity_" + axis_name(axis);
}

// A row is the average over its samples. Without two particles it has no temperature.
template <int D>
ResultTable Probe<D>::series() const {
  ResultTable table{"probe.series",
                    {{"time", "t", {}},
                     {"density", D == 2 ? "1/a^2" : "1/a^3", {}},
                     {"temperature", "m a^2/t^2", {}}}};
  for (std::size_t axis = 0; axis < D; ++axis) {
    table.columns.push_back({velocity_name(axis), "a/t", {}});
  }
  const auto ratio = [](double numerator, double denominator) {
    return denominator > 0.0 ? numerator / denominator : std::numeric_limits<double>::quiet_NaN();
  };
  for (const ObservableSums& row : rows_.parts()) {
    const std::vector<double>& sums = row.values;
    const double samples = sums[ProbeSums::kSamples], number = sums[ProbeSums::kNumber];
    table.columns[0].values.push_back(sums[ProbeSums::kTime] / samples);
    table.columns[1].values.push_back(number / samples / region_.volume());
    table.columns[2].values.push_back(ratio(sums[ProbeSums::kEnergy], sums[ProbeSums::kFreedoms]));
    for (std::size_t axis = 0; axis < D; ++axis) {
      table.columns[3 + axis].values.push_back(
          ratio(sums[ProbeSums::kMomentum + axis], sums[ProbeSums::kMass]));
    }
  }
  return table;
}

template <int D>
ObservableResult Probe<D>::result(const ObservableParts& parts) const {
  ObservableResult result{
      {series()},
      {{"probe.density",
        ratio_of(parts.fine, ProbeSums::kNumber, ProbeSums::kSamples, region_.volume())},
       {"probe.number_variance", variance_of(parts.fine, ProbeSums::kSamples)},
       {"probe.temperature", ratio_of(parts.fine, ProbeSums::kEnergy, ProbeSums::kFreedoms)}}};
  for (std::size_t axis = 0; axis < D; ++axis) {
    result.means.emplace_back("probe." + velocity_name(axis),
                              ratio_of(parts.fine, ProbeSums::kMomentum + axis, ProbeSums::kMass));
  }
  return result;
}

template class Probe<2>;
template class Probe<3>;

}  // namespace clatter
