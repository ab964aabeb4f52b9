#pragma once

#include <vector>

#include "engine/dynamics/observer.h"
#include "engine/dynamics/simulation.h"

namespace clatter {

/// Periodic images of the particles: the whole box lengths that each has moved along periodic axes
/// since this observer was made. Position + image * box is the unwrapped position.
template <int D>
class PeriodicImages : public Observer<D> {
 public:
  /// Watches a simulation from now on. All images are 0.
  explicit PeriodicImages(Simulation<D>& simulation);
  void on_collision(const PairCollision<D>& collision) override;
  void on_wall(const WallCollision<D>& collision) override;
  void on_kick(const Kick<D>& kick) override;
  void on_laws() override;

  /// [N] images of the positions in Simulation::state(), at the simulation's time.
  std::vector<IntVec<D>> images() const;

  /// Visits the members that a checkpoint keeps. The continued simulation must be at the same time.
  template <class Archive>
  void visit(Archive& io) {
    io(of_flights_);
  }

 private:
  IntVec<D> image_in_flight(std::size_t particle) const;
  void move(const ParticleChange<D>& change);

  const Simulation<D>& simulation_;
  std::vector<IntVec<D>> of_flights_;  // [N] image of the box in which the current flight began
  Observation<D> observation_;
};

extern template class PeriodicImages<2>;
extern template class PeriodicImages<3>;

}  // namespace clatter
