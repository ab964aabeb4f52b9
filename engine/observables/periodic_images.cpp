#include "engine/observables/periodic_images.h"

#include <cmath>

namespace clatter {

template <int D>
PeriodicImages<D>::PeriodicImages(Simulation<D>& simulation)
    : simulation_(simulation), domain_(simulation.domain()), observation_(simulation, *this) {
  on_laws();
}

// The offset of a sheared box is kept small by whole boxes, which count as images along x.
template <int D>
void PeriodicImages<D>::follow_offset(double before, double after) {
  const auto boxes = static_cast<int>(std::lround((before - after) / domain_.box[0]));
  if (boxes == 0) return;
  for (IntVec<D>& image : of_flights_) image[0] += image[1] * boxes;
}

template <int D>
void PeriodicImages<D>::on_base_moved(double shift) {
  const double before = domain_.at(shift).offset;
  domain_ = simulation_.domain_at(0.0);
  follow_offset(before, domain_.offset);
}

template <int D>
void PeriodicImages<D>::before_laws(const Model<D>&) {
  domain_ = simulation_.domain();
}

// Particles that enter begin with image 0.
template <int D>
void PeriodicImages<D>::on_laws() {
  follow_offset(domain_.offset, simulation_.domain().offset);
  domain_ = simulation_.domain_at(0.0);
  while (of_flights_.size() < simulation_.particles().size()) {
    of_flights_.push_back(-image_in_flight(of_flights_.size()));
  }
}

// The next flight begins inside the box.
template <int D>
void PeriodicImages<D>::move(const ParticleChange<D>& change) {
  of_flights_[change.particle] +=
      simulation_.domain().image_at(change.position).template cast<int>();
}

template <int D>
void PeriodicImages<D>::on_collision(const PairCollision<D>& collision) {
  for (const ParticleChange<D>& change : collision.particles) move(change);
}

template <int D>
void PeriodicImages<D>::on_wall(const WallCollision<D>& collision) {
  move(collision.particle);
}

template <int D>
void PeriodicImages<D>::on_kick(const Kick<D>& kick) {
  move(kick.particle);
}

// The image of the position in state(), relative to the box in which the flight began.
template <int D>
IntVec<D> PeriodicImages<D>::image_in_flight(std::size_t particle) const {
  const Model<D>& model = simulation_.model();
  const Vec<D> r =
      simulation_.particles()[particle].flight.at(simulation_.base_time(), model.gravity);
  const Domain<D> domain = simulation_.domain();
  IntVec<D> image = domain.image_at(r).template cast<int>();
  const Vec<D> place = domain.wrapped(r);
  for (int axis = 0; axis < D; ++axis) {
    // state() wraps this position to 0.
    const bool at_end = domain.periodic[axis] && place[axis] == domain.box[axis];
    if (at_end && !(domain.sheared && axis == 1)) ++image[axis];
  }
  return image;
}

template <int D>
std::vector<IntVec<D>> PeriodicImages<D>::images() const {
  std::vector<IntVec<D>> images = of_flights_;
  for (std::size_t i = 0; i < images.size(); ++i) images[i] += image_in_flight(i);
  return images;
}

template class PeriodicImages<2>;
template class PeriodicImages<3>;

}  // namespace clatter
