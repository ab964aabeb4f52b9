#pragma once

#include <vector>

#include "engine/dynamics/observer.h"
#include "engine/dynamics/simulation.h"

namespace clatter {

/// By how much the particles have turned since it watches. A spin changes in the particle's own
/// events only, so that the angle is exact: the sum of spin times duration over its flights.
class SpinAngles : public Observer<2> {
 public:
  /// Watches a simulation that carries spins from now on.
  explicit SpinAngles(Simulation<2>& simulation);
  /// Goes on where that of the simulation before ended: this one has its particles at its time.
  SpinAngles(Simulation<2>& simulation, SpinAngles&& before);

  void on_collision(const PairCollision<2>& collision) override;
  void on_wall(const WallCollision<2>& collision) override;
  void on_kick(const Kick<2>& kick) override;
  void on_base_moved(double shift) override;

  /// [N] angles at the simulation's time, counterclockwise, without whole turns: -pi..pi.
  std::vector<double> angles() const;

  /// What a checkpoint keeps, of a simulation that goes on at the same time.
  template <class Archive>
  void visit(Archive& io) {
    io(turned_);
  }

 private:
  struct Turned {
    double angle = 0.0;
    double time = 0.0;  // at which it was that, on the moving base

    template <class Archive>
    void visit(Archive& io) {
      io(angle, time);
    }
  };

  void turn(const ParticleChange<2>& change, double time);

  const Simulation<2>& simulation_;
  std::vector<Turned> turned_;  // [N]
};

}  // namespace clatter
