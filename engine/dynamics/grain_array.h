#pragma once

#include <cstddef>
#include <vector>

#include "engine/dynamics/large_array.h"
#include "engine/physics/grain.h"

namespace clatter {

/// What the particles of a mixture are; empty if all particles are alike. A search for contacts
/// reads radii alone, so these have an array of their own.
class GrainArray {
 public:
  /// Takes the grains of all particles.
  void assign(const std::vector<Grain>& grains) {
    resize(grains.size());
    for (std::size_t i = 0; i < grains.size(); ++i) set(i, grains[i]);
  }
  /// Changes the number of particles. The grains of all become invalid.
  void resize(std::size_t count) {
    grains_.resize(count);
    radii_.resize(count);
  }
  /// Sets the grain of a particle.
  void set(std::size_t number, const Grain& grain) {
    grains_[number] = grain;
    radii_[number] = grain.radius;
  }

  /// Whether all particles are alike.
  bool empty() const { return grains_.empty(); }
  /// Number of particles; 0 if they are alike.
  std::size_t size() const { return grains_.size(); }
  /// The grains in the order of the particles' numbers.
  const Grain* begin() const { return grains_.data(); }
  const Grain* end() const { return grains_.data() + grains_.size(); }
  /// The grain of a particle.
  const Grain& operator[](std::size_t number) const { return grains_[number]; }
  /// [N] the radii.
  const double* radii() const { return radii_.data(); }

 private:
  LargeArray<Grain> grains_;
  LargeArray<double> radii_;
};

}  // namespace clatter
