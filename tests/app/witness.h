#pragma once

#include <array>
#include <functional>
#include <vector>

#include "engine/dynamics/observer.h"
#include "engine/dynamics/simulation.h"

namespace clatter::testing {

/// A particle's free flight between two of its events, in simulation time.
template <int D>
struct WitnessedFlight {
  std::size_t particle = 0;
  double from = 0.0, to = 0.0;
  Vec<D> position, velocity;  ///< at `from`
  Spin<D> spin = Spin<D>::Zero();
};

/// A collision of two particles, or of a particle with a wall.
template <int D>
struct WitnessedTouch {
  double time = 0.0;
  int side = -1;                  ///< of the wall; -1: two particles
  Vec<D> first, second;           ///< centres at the touching image, or the contact point of a wall
  Vec<D> impulse;                 ///< received by the first particle
  std::array<double, 2> gains{};  ///< energy received by the particles
  double loss_by_law = 0.0;       ///< energy loss of two particles (theory 3.6) without a t_c
  bool within_contact_time = false;
};

/// Energy that one particle receives from a kick, or from gravity during a flight that ends.
struct WitnessedGain {
  double time = 0.0;
  double energy = 0.0;
};

/// The complete history of a run. From the engine it takes the energy gains of particles in events
/// and the state at the start. It computes positions, velocities and energies itself.
template <int D>
class Witness : public Observer<D> {
 public:
  explicit Witness(const Simulation<D>& simulation);

  void on_collision(const PairCollision<D>& collision) override;
  void on_wall(const WallCollision<D>& collision) override;
  void on_kick(const Kick<D>& kick) override;
  void on_base_moved(double shift) override { base_ += shift; }
  /// Ends all flights at the time of the run, and checks the velocities of the particles.
  void finish();

  const std::vector<WitnessedFlight<D>>& flights() const { return flights_; }
  const std::vector<WitnessedTouch<D>>& touches() const { return touches_; }
  const std::vector<WitnessedGain>& kicks() const { return kicks_; }
  const std::vector<WitnessedGain>& falls() const { return falls_; }

  Vec<D> position(const WitnessedFlight<D>& flight, double time) const;
  Vec<D> velocity(const WitnessedFlight<D>& flight, double time) const;
  /// Calls visit(velocity, spin) for each particle at a time without an event.
  void at(double time, const std::function<void(const Vec<D>&, const Spin<D>&)>& visit) const;
  std::size_t count() const { return now_.size(); }
  const Vec<D>& gravity() const { return model_.gravity; }
  double moment_of_inertia() const { return 0.25 * model_.inertia; }

 private:
  double gain(const ParticleChange<D>& change, double time);
  double loss_by_law(const WitnessedFlight<D>& a, const WitnessedFlight<D>& b, double time,
                     const Vec<D>& separation) const;

  const Simulation<D>& simulation_;
  const Model<D>& model_;
  double base_ = 0.0;
  std::vector<WitnessedFlight<D>> now_;  // [particles] current flights
  std::vector<double> last_touch_;       // [particles]
  std::vector<WitnessedFlight<D>> flights_;
  std::vector<WitnessedTouch<D>> touches_;
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

using Numbers = Eigen::ArrayXd;

/// Places of sums over all particles in one window. Vectors and tensors begin at their place.
template <int D>
struct TotalsOf {
  enum : int {
    kSquares = 0,  // [D] time integrals of the sum of v_k^2
    kSpinSquares = D,
    kCollisions,
    kWallsIn,
    kBulkIn,
    kGravityIn,
    kDissipated,
    kVirial,
    kImpulse,                    // [2 D] of each wall
    kSecond = kImpulse + 2 * D,  // [D] means over the particles at the end of the window
    kFourth = kSecond + D,       // [D]
    kSize = kFourth + D
  };
};

/// Places of sums in one cell: time integrals of sums over particles, and sums over contacts.
template <int D>
struct CellOf {
  enum : int {
    kCount = 0,
    kVelocity = 1,                   // [D]
    kSquares = kVelocity + D,        // [D][D] v_k v_l
    kEnergyFlow = kSquares + D * D,  // [D] energy times v_k
    kSpin = kEnergyFlow + D,         // [spin components]
    kSpinEnergy = kSpin + kSpinSize<D>,
    kTransfer,                            // [D][D] branch along k, momentum along l
    kEnergyTransfer = kTransfer + D * D,  // [D]
    kSources = kEnergyTransfer + D,
    kSize
  };
};

/// [windows] of TotalsOf.
template <int D>
std::vector<Numbers> totals_of(const Witness<D>& witness, const Windows& windows);

/// [windows][cells] of CellOf for a box between walls at all sides. The first axis changes first.
template <int D>
std::vector<std::vector<Numbers>> cell_sums_of(const Witness<D>& witness, const Windows& windows,
                                               const Vec<D>& box, const IntVec<D>& cells);

/// A mean, its standard error by blocking, the rise of this error and the drift of the mean.
struct WitnessedMean {
  double mean = 0.0, standard_error = 0.0, rise = 1.0, drift = 0.0;
};

/// A function of window means. Its error comes from the change by each window (delta method).
WitnessedMean mean_of(const std::vector<Numbers>& windows,
                      const std::function<double(const Numbers&)>& function);

}  // namespace clatter::testing
