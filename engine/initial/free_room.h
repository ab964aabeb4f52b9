#pragma once

#include <vector>

#include "engine/dynamics/near_particles.h"
#include "engine/laws/domain.h"
#include "engine/laws/fixture.h"
#include "engine/vec.h"

namespace clatter {

/// The room between particles at rest, walls and fixtures.
template <int D>
class FreeRoom {
 public:
  /// A box without particles. Along axes with walls surfaces stay between `low` and `high`.
  /// `diameter` is the largest of all particles.
  FreeRoom(const Domain<D>& domain, double diameter, const Vec<D>& low, const Vec<D>& high,
           const std::vector<Fixture<D>>& fixtures)
      : domain_(domain),
        near_(domain, diameter),
        low_(low),
        high_(high),
        fixtures_(fixtures, domain) {}

  /// Adds a particle, wherever it is.
  void insert(const Vec<D>& place, double radius) {
    near_.add(domain_.wrapped(place));
    radii_.push_back(radius);
  }
  /// Adds a particle of a species in the box, if it has room there.
  bool insert_if_free(const Vec<D>& place, double radius, std::uint32_t species) {
    for (int axis = 0; axis < D; ++axis) {
      if (domain_.periodic[axis]) continue;
      if (!(place[axis] >= low_[axis] + radius && place[axis] <= high_[axis] - radius))
        return false;
    }
    bool free = fixtures_.depth(place, radius, species) == 0.0;
    near_.visit(place, [&](std::uint32_t other, const Vec<D>& way) {
      free = free && way.norm() >= radius + radii_[other];
    });
    if (free) insert(place, radius);
    return free;
  }

 private:
  Domain<D> domain_;
  NearParticles<D> near_;
  std::vector<double> radii_;
  Vec<D> low_, high_;
  FixtureImages<D> fixtures_;
};

}  // namespace clatter
