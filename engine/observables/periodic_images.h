#pragma once

#include <vector>

#include "engine/dynamics/observer.h"
#include "engine/dynamics/simulation.h"

namespace clatter {

/// Periodic images of the particles: the whole box lengths that each has moved along periodic axes
/// since this observer was made. Position + Domain::shift(image) is the unwrapped position. In a
/// sheared box it is seen from the image in which the particle was then.
template <int D>
class PeriodicImages : public Observer<D> {
 public:
  /// Watches a simulation from now on. All images are 0.
  explicit PeriodicImages(Simulation<D>& simulation);
  void on_collision(const PairCollision<D>& collision) override;
  void on_wall(const WallCollision<D>& collision) override;
  void on_kick(const Kick<D>& kick) override;
  void on_base_moved(double shift) override;
  void before_laws(const Model<D>& next) override;
  void on_laws() override;

  /// [N] images of the positions in Simulation::state(), for the offset of Simulation::domain().
  std::vector<IntVec<D>> images() const;

  /// Visits the members that a checkpoint keeps. The continued simulation must be at the same time.
  template <class Archive>
  void visit(Archive& io) {
    double offset = simulation_.domain().offset;
    io(of_flights_, offset);
    follow_offset(offset, simulation_.domain().offset);
  }

 private:
  IntVec<D> image_in_flight(std::size_t particle) const;
  void move(const ParticleChange<D>& change);
  void follow_offset(double before, double after);

  const Simulation<D>& simulation_;
  std::vector<IntVec<D>> of_flights_;  // [N] image of the box in which the current flight began
  // At time 0 on the base; during a change of laws at its time, under the laws before.
  Domain<D> domain_;
  Observation<D> observation_;
};

extern template class PeriodicImages<2>;
extern template class PeriodicImages<3>;

}  // namespace clatter
