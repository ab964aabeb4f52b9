#include "engine/measure/fixture_totals.h"

namespace clatter {

template <int D>
FixtureTotals<D>::FixtureTotals(const Simulation<D>& simulation)
    : simulation_(simulation), window_start_(simulation.base_time()) {
  clear();
}

template <int D>
void FixtureTotals<D>::clear() {
  const Model<D>& model = simulation_.model();
  FixtureWindow<D> none;
  none.hits.resize(model.species ? model.species->count() : 1);
  window_.fixtures.assign(model.fixtures.size(), none);
}

template <int D>
void FixtureTotals<D>::on_wall(const WallCollision<D>& collision) {
  if (collision.at_wall() || collision.at_piston()) return;
  const ParticleChange<D>& particle = collision.particle;
  FixtureWindow<D>& sums = window_.fixtures[collision.fixture];
  const Vec<D> impulse = -particle.gain.momentum;
  sums.impulse += impulse;
  sums.energy += particle.energy();
  sums.hits[sums.hits.size() > 1 ? particle.grain.species : 0] += 1.0;
  const Model<D>& model = simulation_.model();
  const auto& centre = model.fixtures[collision.fixture].centre;
  if (!centre) return;
  sums.angular_impulse += cross<D>(collision.point - *centre, impulse);
}

template <int D>
void FixtureTotals<D>::on_base_moved(double shift) {
  window_start_ -= shift;
}

template <int D>
FixtureTotalsWindow<D> FixtureTotals<D>::close_window() {
  const double now = simulation_.base_time();
  window_.duration = now - window_start_;
  FixtureTotalsWindow<D> closed = window_;
  clear();
  window_start_ = now;
  return closed;
}

template <int D>
std::vector<FixtureMeans> fixture_means(std::span<const FixtureTotalsWindow<D>> windows,
                                        const Model<D>& model) {
  std::vector<FixtureMeans> all;
  for (std::size_t k = 0; k < model.fixtures.size(); ++k) {
    const auto rate = [&](const auto& sum) {
      std::vector<double> series;
      for (const auto& window : windows)
        series.push_back(sum(window.fixtures[k]) / window.duration);
      return mean_estimate(series);
    };
    FixtureMeans& means = all.emplace_back();
    means.name = model.fixtures[k].name;
    for (int axis = 0; axis < D; ++axis) {
      means.force.push_back(rate([&](const auto& sums) { return sums.impulse[axis]; }));
    }
    for (int i = 0; model.fixtures[k].centre && i < kSpinSize<D>; ++i) {
      means.torque.push_back(rate([&](const auto& sums) { return sums.angular_impulse[i]; }));
    }
    means.power = rate([](const auto& sums) { return sums.energy; });
    for (std::size_t s = 0; s < (model.species ? model.species->count() : 1); ++s) {
      means.hits.emplace_back(model.species ? model.species->name(s) : "",
                              rate([&](const auto& sums) { return sums.hits[s]; }));
    }
  }
  return all;
}

template class FixtureTotals<2>;
template class FixtureTotals<3>;
template std::vector<FixtureMeans> fixture_means(std::span<const FixtureTotalsWindow<2>>,
                                                 const Model<2>&);
template std::vector<FixtureMeans> fixture_means(std::span<const FixtureTotalsWindow<3>>,
                                                 const Model<3>&);

}  // namespace clatter
