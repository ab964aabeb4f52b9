#pragma once

#include <array>
#include <functional>
#include <vector>

#include "engine/dynamics/observer.h"
#include "engine/dynamics/simulation.h"

namespace clatter::testing {

/// A disk's free flight between two of its events, in simulation time.
struct WitnessedFlight {
  std::size_t disk = 0;
  double from = 0.0, to = 0.0;
  Vec2 position, velocity;  ///< at `from`
  double spin = 0.0;
};

/// A collision of two disks, or of a disk with a wall.
struct WitnessedTouch {
  double time = 0.0;
  int side = -1;       ///< of the wall; -1: two disks
  Vec2 first, second;  ///< disk centres at the touching image, or the contact point of a wall
  Vec2 impulse;        ///< received by the first disk
  std::array<double, 2> gains{};  ///< energy received by the disks
  double loss_by_law = 0.0;       ///< energy loss of two disks by Eqs. (2.4)-(2.8) without a t_c
  bool within_contact_time = false;
};

/// Energy that one disk receives from a kick, or from gravity during a flight that ends.
struct WitnessedGain {
  double time = 0.0;
  double energy = 0.0;
};

/// The complete history of a run. From the engine it takes the energy gains of disks in events and
/// the state at the start. It computes positions, velocities and energies itself.
class Witness : public Observer<2> {
 public:
  explicit Witness(const Simulation<2>& simulation);

  void on_collision(const PairCollision<2>& collision) override;
  void on_wall(const WallCollision<2>& collision) override;
  void on_kick(const Kick<2>& kick) override;
  void on_base_moved(double shift) override { base_ += shift; }
  /// Ends all flights at the time of the run, and checks the positions of the disks.
  void finish();

  const std::vector<WitnessedFlight>& flights() const { return flights_; }
  const std::vector<WitnessedTouch>& touches() const { return touches_; }
  const std::vector<WitnessedGain>& kicks() const { return kicks_; }
  const std::vector<WitnessedGain>& falls() const { return falls_; }

  Vec2 position(const WitnessedFlight& flight, double time) const;
  Vec2 velocity(const WitnessedFlight& flight, double time) const;
  /// Calls visit(velocity, spin) for each disk at a time without an event.
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
  std::vector<WitnessedFlight> now_;  // [disks] current flights
  std::vector<double> last_touch_;    // [disks]
  std::vector<WitnessedFlight> flights_;
  std::vector<WitnessedTouch> touches_;
  std::vector<WitnessedGain> kicks_, falls_;
};

/// Time windows of equal length.
struct Windows {
  double begin = 0.0;
  double length = 0.0;
  int count = 0;

  double end() const { return begin + length * count; }
  /// The window of a time; -1: none.
  int of(double time) const;
};

/// Sums over all disks in one window.
enum Total {
  kSquaresX,  // time integral of the sum of v_x^2
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
  kSecondX,  // means over the disks at the end of the window
  kSecondY,
  kFourthX,
  kFourthY,
  kTotals
};

/// Sums in one cell: time integrals of sums over disks, and sums over contacts.
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

/// [windows][cells] of CellSums for a box between four walls. Cell (i, j) is at i + j cells.x().
std::vector<std::vector<Numbers>> cell_sums_of(const Witness& witness, const Windows& windows,
                                               const Vec2& box, const IntVec<2>& cells);

/// A mean, its standard error by blocking, the rise of this error and the drift of the mean.
struct WitnessedMean {
  double mean = 0.0, standard_error = 0.0, rise = 1.0, drift = 0.0;
};

/// A function of window means. Its error comes from the change by each window (delta method).
WitnessedMean mean_of(const std::vector<Numbers>& windows,
                      const std::function<double(const Numbers&)>& function);

}  // namespace clatter::testing
