#pragma once

#include <array>
#include <functional>
#include <vector>

#include "engine/dynamics/observer.h"
#include "engine/dynamics/simulation.h"

namespace clatter::testing {

/// A disk's flight between two of its events, in simulation time.
struct WitnessedFlight {
  std::size_t disk = 0;
  double from = 0.0, to = 0.0;
  Vec2 position, velocity;  ///< at `from`
  double spin = 0.0;
};

/// A collision of two disks, or of a disk and a wall.
struct WitnessedTouch {
  double time = 0.0;
  int side = -1;       ///< of the wall; -1: of two disks
  Vec2 first, second;  ///< centres of the disks at the image that touches; a wall's contact point
  Vec2 impulse;        ///< that the first disk gains
  std::array<double, 2> gains{};  ///< energy that the disks gain
  double loss_by_law = 0.0;       ///< energy that two disks lose by Eqs. (2.4)-(2.8) without a t_c
  bool within_contact_time = false;
};

/// Energy that one disk gains in a kick, or that gravity gave it in a flight that ends.
struct WitnessedGain {
  double time = 0.0;
  double energy = 0.0;
};

/// The course of a run, kept from its start to its end. Of the engine's events it takes what disks
/// gain, of its state only that at the start: positions, velocities and energies are its own.
class Witness : public Observer<2> {
 public:
  explicit Witness(const Simulation<2>& simulation);

  void on_collision(const PairCollision<2>& collision) override;
  void on_wall(const WallCollision<2>& collision) override;
  void on_kick(const Kick<2>& kick) override;
  void on_base_moved(double shift) override { base_ += shift; }
  /// Ends all flights where the run has come to, and checks that the disks are there.
  void finish();

  const std::vector<WitnessedFlight>& flights() const { return flights_; }
  const std::vector<WitnessedTouch>& touches() const { return touches_; }
  const std::vector<WitnessedGain>& kicks() const { return kicks_; }
  const std::vector<WitnessedGain>& falls() const { return falls_; }

  Vec2 position(const WitnessedFlight& flight, double time) const;
  Vec2 velocity(const WitnessedFlight& flight, double time) const;
  /// Calls visit(velocity, spin) for each disk at a time that is not one of an event.
  void at(double time, const std::function<void(const Vec2&, double)>& visit) const;
  std::size_t count() const { return now_.size(); }
  const Vec2& gravity() const { return model_.gravity; }
  double moment_of_inertia() const { return 0.25 * model_.inertia; }

 private:
  double gain(const ParticleChange<2>& change, double time);
  double loss_by_law(const WitnessedFlight& a, const WitnessedFlight& b, double time,
                     const Vec2& separation) const;

  const Simulation<2>& simulation_;
  const Model<2>& model_;
  double base_ = 0.0;
  std::vector<WitnessedFlight> now_;  // [disks] under way
  std::vector<double> last_touch_;    // [disks]
  std::vector<WitnessedFlight> flights_;
  std::vector<WitnessedTouch> touches_;
  std::vector<WitnessedGain> kicks_, falls_;
};

/// Equal windows of time.
struct Windows {
  double begin = 0.0;
  double length = 0.0;
  int count = 0;

  double end() const { return begin + length * count; }
  /// The one that a time lies in; -1: none.
  int of(double time) const;
};

/// Sums over all disks in one window.
enum Total {
  kSquaresX,  // integral over time of the sum of v_x^2
  kSquaresY,
  kSpinSquares,
  kCollisions,
  kWallsIn,
  kBulkIn,
  kGravityIn,
  kDissipated,
  kVirial,
  kLeftImpulse,
  kRightImpulse,
  kBottomImpulse,
  kTopImpulse,
  kSecondX,  // means over the disks at the window's end
  kSecondY,
  kFourthX,
  kFourthY,
  kTotals
};

/// Sums in one cell: integrals over time of sums over disks, and sums over touches.
enum CellSum {
  kCount,
  kVx,
  kVy,
  kVxVx,
  kVyVy,
  kVxVy,
  kEnergyVx,
  kEnergyVy,
  kSpin,
  kSpinEnergy,
  kTransferXX,  // branch along x, momentum along x
  kTransferXY,
  kTransferYX,
  kTransferYY,
  kEnergyX,
  kEnergyY,
  kSources,
  kCellSums
};

using Numbers = Eigen::ArrayXd;

/// [windows] of Totals.
std::vector<Numbers> totals_of(const Witness& witness, const Windows& windows);

/// [windows][cells] of CellSums, cell (i, j) at i + j cells.x(), of a box between four walls.
std::vector<std::vector<Numbers>> cell_sums_of(const Witness& witness, const Windows& windows,
                                               const Vec2& box, const IntVec<2>& cells);

/// A mean, its standard error by blocking, and how both rise and drift.
struct WitnessedMean {
  double mean = 0.0, standard_error = 0.0, rise = 1.0, drift = 0.0;
};

/// Of a function of the windows' means; its error from the change that each window makes to it.
WitnessedMean mean_of(const std::vector<Numbers>& windows,
                      const std::function<double(const Numbers&)>& function);

}  // namespace clatter::testing
