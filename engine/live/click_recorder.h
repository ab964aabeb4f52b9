#pragma once

#include <cstddef>
#include <limits>
#include <vector>

#include "engine/dynamics/observer.h"
#include "engine/dynamics/simulation.h"

namespace clatter {

/// The sound of a collision.
struct Click {
  double time = 0.0;   ///< simulation time
  double place = 0.5;  ///< x of the contact as a share of the box, 0..1
  /// Relative frequency J / M^(1 + 1/D), with the magnitude J of the impulse. M is the mass at a
  /// wall, and twice the reduced mass mu of two particles; all masses 1: J. It is the speed J/M
  /// over the size M^(1/D), because bodies of one material and shape vibrate with the inverse of
  /// their sizes.
  double frequency = 0.0;
  /// J^2 / 8 mu, with the reduced mass mu of both partners. In an elastic collision it is the
  /// energy of the relative motion along the impulse.
  double energy = 0.0;

  /// Visits the members that a checkpoint keeps.
  template <class Archive>
  void visit(Archive& io) {
    io(time, place, frequency, energy);
  }
};

/// Observer that lists the collisions of a run as clicks, between particles and with walls.
template <int D>
class ClickRecorder final : private Observer<D> {
 public:
  /// Keeps all clicks, or at most `most` >= 2 until take(). Of more clicks it keeps every second
  /// one with twice its energy, every fourth, and so on. The sum of the energies is about the same.
  explicit ClickRecorder(Simulation<D>& simulation,
                         std::size_t most = std::numeric_limits<std::size_t>::max())
      : simulation_(simulation), most_(most), observation_(simulation, *this) {}

  /// The clicks since the last call, in the order of the events.
  std::vector<Click> take();

 private:
  void on_collision(const PairCollision<D>& collision) override;
  void on_wall(const WallCollision<D>& collision) override;
  void add(const Vec<D>& contact, const Vec<D>& momentum, double mass, double reduced_mass);
  void thin_out();

  const Simulation<D>& simulation_;
  std::size_t most_;
  std::vector<Click> clicks_;
  std::size_t stride_ = 1;   // collisions per click
  std::size_t skipped_ = 0;  // collisions since the last click
  Observation<D> observation_;
};

extern template class ClickRecorder<2>;
extern template class ClickRecorder<3>;

}  // namespace clatter
