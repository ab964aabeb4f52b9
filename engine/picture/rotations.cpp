#include "engine/picture/rotations.h"

#include <cmath>
#include <numbers>
#include <utility>

namespace clatter {

DiskRotation DiskRotation::after(const Spin<2>& spin, double duration) const {
  return {angle + spin[0] * duration};
}

// Normalised again, so that roundings do not grow with the number of events.
SphereRotation SphereRotation::after(const Spin<3>& spin, double duration) const {
  const double rate = spin.norm();
  if (!(rate > 0.0)) return *this;
  const Eigen::AngleAxisd turn(std::remainder(rate * duration, 4.0 * std::numbers::pi),
                               spin / rate);
  return {(Eigen::Quaterniond(turn) * quaternion()).normalized().coeffs()};
}

template <int D>
Rotations<D>::Rotations(Simulation<D>& simulation)
    : simulation_(simulation),
      turned_(simulation.particles().size(), {{}, simulation.base_time()}),
      observation_(simulation, *this) {}

template <int D>
Rotations<D>::Rotations(Simulation<D>& simulation, Rotations&& before)
    : simulation_(simulation),
      turned_(std::move(before.turned_)),
      observation_(simulation, *this) {}

// A puff adds particles.
template <int D>
void Rotations<D>::on_laws() {
  turned_.resize(simulation_.particles().size(), {{}, simulation_.base_time()});
}

template <int D>
void Rotations<D>::on_collision(const PairCollision<D>& collision) {
  for (const ParticleChange<D>& particle : collision.particles) turn(particle, collision.time);
}

template <int D>
void Rotations<D>::on_wall(const WallCollision<D>& collision) {
  turn(collision.particle, collision.time);
}

template <int D>
void Rotations<D>::on_kick(const Kick<D>& kick) {
  turn(kick.particle, kick.time);
}

template <int D>
void Rotations<D>::on_base_moved(double shift) {
  for (Turned& turned : turned_) turned.time -= shift;
}

template <int D>
void Rotations<D>::set_rotations(const std::vector<Rotation<D>>& rotations) {
  turned_.clear();
  for (const Rotation<D>& rotation : rotations) {
    turned_.push_back({rotation, simulation_.base_time()});
  }
}

template <int D>
std::vector<Rotation<D>> Rotations<D>::rotations() const {
  std::vector<Rotation<D>> rotations;
  rotations.reserve(turned_.size());
  for (std::size_t i = 0; i < turned_.size(); ++i) {
    const auto& [rotation, time] = turned_[i];
    rotations.push_back(rotation.after(simulation_.spins()[i], simulation_.base_time() - time));
  }
  return rotations;
}

template <int D>
void Rotations<D>::turn(const ParticleChange<D>& change, double time) {
  Turned& turned = turned_[change.particle];
  turned = {turned.rotation.after(change.spin, time - turned.time), time};
}

template class Rotations<2>;
template class Rotations<3>;

}  // namespace clatter
