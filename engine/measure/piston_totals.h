#pragma once

#include <array>
#include <optional>
#include <span>

#include "engine/dynamics/observer.h"
#include "engine/dynamics/simulation.h"
#include "engine/statistics/estimate.h"

namespace clatter {

/// Integrals over the flights of the free piston in one window of time, and sums over its hits.
/// Lengths are displacements from its position at the start of the run.
struct PistonWindow {
  double duration = 0.0;                ///< of the window
  double displacement = 0.0;            ///< integral over time
  double squared_displacement = 0.0;    ///< the same of its square
  double squared_velocity = 0.0;        ///< the same of the square of the velocity
  std::array<double, 2> impulses = {};  ///< given to it by particles below and above, both > 0
  std::array<double, 2> hits = {};      ///< by particles below and above
  double to_gas = 0.0;                  ///< energy that its hits give to the gas
  double dissipated = 0.0;              ///< energy lost in its hits

  /// Visits all members, for checkpoints.
  template <class Archive>
  void visit(Archive& io) {
    auto& [duration, displacement, squared_displacement, squared_velocity, impulses, hits, to_gas,
           dissipated] = *this;
    io(duration, displacement, squared_displacement, squared_velocity, impulses, hits, to_gas,
       dissipated);
  }
};

/// Sums what the free piston does and what it exchanges with the gas.
template <int D>
class PistonTotals : public Observer<D> {
 public:
  /// Watches a simulation with a free piston from now on.
  explicit PistonTotals(const Simulation<D>& simulation);

  void on_wall(const WallCollision<D>& collision) override;
  void on_piston(const PistonChange& change) override;
  void on_base_moved(double shift) override;

  /// The sums since the last call, or since the start.
  PistonWindow close_window();

  /// Visits the members that a checkpoint keeps. The continued simulation must be at the same time.
  template <class Archive>
  void visit(Archive& io) {
    auto& [simulation, window_start, integrated_to, gained, window] = *this;
    io(window_start, integrated_to, gained, window);
  }

 private:
  void integrate(const PistonFlight& flight, double time);

  const Simulation<D>& simulation_;
  double window_start_;
  double integrated_to_;
  double gained_ = 0.0;  // energy of the gas in the present hit
  PistonWindow window_;
};

/// Results of the free piston, averaged over time.
struct PistonMeans {
  Estimate position;     ///< of its middle
  Estimate variance;     ///< of this position
  Estimate temperature;  ///< M U^2
  Estimate force_left;   ///< by the gas below it along the axis, > 0
  Estimate force_right;  ///< by the gas above it, in the opposite direction, > 0
  Estimate hits_left;    ///< per time, by particles below it
  Estimate hits_right;   ///< the same above it
  Estimate power;        ///< energy per time given to the gas
  Estimate dissipated;   ///< energy per time lost in its hits
};

/// The means from windows of equal duration.
PistonMeans piston_means(std::span<const PistonWindow> windows, const FreePiston& piston);

extern template class PistonTotals<2>;
extern template class PistonTotals<3>;

}  // namespace clatter
