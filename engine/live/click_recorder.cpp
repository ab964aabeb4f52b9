#include "engine/live/click_recorder.h"

#include <algorithm>
#include <cmath>
#include <utility>

#include "engine/physics/elementary.h"

namespace clatter {

template <int D>
std::vector<Click> ClickRecorder<D>::take() {
  stride_ = 1;
  skipped_ = 0;
  return std::exchange(clicks_, {});
}

template <int D>
void ClickRecorder<D>::on_collision(const PairCollision<D>& collision) {
  const ParticleChange<D>& first = collision.particles[0];
  const Grain &one = simulation_.grain(first.particle),
              &other = simulation_.grain(collision.particles[1].particle);
  const double reduced = one.mass * other.mass / (one.mass + other.mass);
  const double share = one.radius / (one.radius + other.radius);
  add(first.position - share * collision.separation, first.gain.momentum, 2.0 * reduced, reduced);
}

template <int D>
void ClickRecorder<D>::on_wall(const WallCollision<D>& collision) {
  const double mass = simulation_.grain(collision.particle.particle).mass;
  const auto& piston = simulation_.model().free_piston;
  const bool free = collision.at_piston() && !piston->pinned;
  add(collision.particle.position, collision.particle.gain.momentum, mass,
      free ? mass / (1.0 + mass / piston->mass) : mass);
}

template <int D>
void ClickRecorder<D>::add(const Vec<D>& contact, const Vec<D>& momentum, double mass,
                           double reduced_mass) {
  if (++skipped_ < stride_) return;
  skipped_ = 0;
  const Model<D>& model = simulation_.model();
  const double square = momentum.squaredNorm();
  const double place = simulation_.domain().wrapped(contact)[0] / model.box[0];
  double frequency = std::sqrt(square);
  if (simulation_.is_mixture()) frequency *= exponential(-(1.0 + 1.0 / D) * natural_log(mass));
  clicks_.push_back({simulation_.time(), std::clamp(place, 0.0, 1.0), frequency,
                     static_cast<double>(stride_) * square / (8.0 * reduced_mass)});
  if (clicks_.size() == most_) thin_out();
}

// Keeps every second click.
template <int D>
void ClickRecorder<D>::thin_out() {
  stride_ *= 2;
  for (std::size_t k = 0; 2 * k + 1 < clicks_.size(); ++k) {
    clicks_[k] = clicks_[2 * k + 1];
    clicks_[k].energy *= 2.0;
  }
  clicks_.resize(clicks_.size() / 2);
}

template class ClickRecorder<2>;
template class ClickRecorder<3>;

}  // namespace clatter
