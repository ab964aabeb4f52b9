#pragma once

#include <cstddef>
#include <span>
#include <string>
#include <utility>
#include <vector>

#include "engine/dynamics/observer.h"
#include "engine/dynamics/simulation.h"
#include "engine/physics/spin.h"
#include "engine/statistics/estimate.h"
#include "engine/vec.h"

namespace clatter {

/// Sums over the hits on one fixture in one window of time.
template <int D>
struct FixtureWindow {
  Vec<D> impulse = Vec<D>::Zero();            ///< momentum given to the fixture
  Spin<D> angular_impulse = Spin<D>::Zero();  ///< the same about its centre; 0 without one
  double energy = 0.0;                        ///< energy given to the gas
  std::vector<double> hits;                   ///< [S] of each species; one number without species

  template <class Archive>
  void visit(Archive& io) {
    auto& [impulse, angular_impulse, energy, hits] = *this;
    io(impulse, angular_impulse, energy, hits);
  }
};

/// The same for all fixtures.
template <int D>
struct FixtureTotalsWindow {
  double duration = 0.0;
  std::vector<FixtureWindow<D>> fixtures;  ///< by their numbers in the model

  template <class Archive>
  void visit(Archive& io) {
    auto& [duration, fixtures] = *this;
    io(duration, fixtures);
  }
};

/// Sums what each fixture exchanges with the gas.
template <int D>
class FixtureTotals : public Observer<D> {
 public:
  /// Watches a simulation with fixtures from now on.
  explicit FixtureTotals(const Simulation<D>& simulation);

  void on_wall(const WallCollision<D>& collision) override;
  void on_base_moved(double shift) override;

  /// The sums since the last call, or since the start.
  FixtureTotalsWindow<D> close_window();

  /// Visits the members that a checkpoint keeps. The continued simulation must be at the same time.
  template <class Archive>
  void visit(Archive& io) {
    auto& [simulation, window_start, window] = *this;
    io(window_start, window);
    io.require(window.fixtures.size() == simulation.model().fixtures.size());
  }

 private:
  void clear();

  const Simulation<D>& simulation_;
  double window_start_;
  FixtureTotalsWindow<D> window_;
};

/// Results of one fixture, averaged over time.
struct FixtureMeans {
  std::string name;
  std::vector<Estimate> force;   ///< [D] by the gas on the fixture
  std::vector<Estimate> torque;  ///< about its centre, one in 2D; empty without a centre
  Estimate power;                ///< energy per time given to the gas
  /// Hits per time of each species, by name; without species one without a name.
  std::vector<std::pair<std::string, Estimate>> hits;
};

/// The means of each fixture from windows of equal duration.
template <int D>
std::vector<FixtureMeans> fixture_means(std::span<const FixtureTotalsWindow<D>> windows,
                                        const Model<D>& model);

extern template class FixtureTotals<2>;
extern template class FixtureTotals<3>;
extern template std::vector<FixtureMeans> fixture_means(std::span<const FixtureTotalsWindow<2>>,
                                                        const Model<2>&);
extern template std::vector<FixtureMeans> fixture_means(std::span<const FixtureTotalsWindow<3>>,
                                                        const Model<3>&);

}  // namespace clatter
