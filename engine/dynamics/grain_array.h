#pragma once

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <vector>

#include "engine/dynamics/large_array.h"
#include "engine/dynamics/packed_image.h"
#include "engine/physics/grain.h"

namespace clatter {

/// The radii of the particles of a mixture: of their kinds, or of each if the kinds are too many.
struct Radii {
  const double* of_kinds;      ///< by ParticleArray::kind(); null: too many kinds
  const double* of_particles;  ///< by number
};

/// What the particles of a mixture are; empty if all particles are alike. Particles of up to 128
/// kinds have a byte each. Otherwise each has a grain, and its radius once more in an array that
/// searches for contacts read. EventLoop::restart copies the number of a kind to the particle's
/// word.
class GrainArray {
 public:
  /// Takes the grains of all particles, and finds their kinds.
  void assign(const std::vector<Grain>& grains) {
    *this = {};
    if (!find_kinds(grains)) *this = {};
    resize(grains.size());
    for (std::size_t i = 0; i < grains.size(); ++i) set(i, grains[i]);
  }
  /// Has so many particles, which take() sets, of the kinds of another array.
  void prepare(const GrainArray& source, std::size_t count) {
    kinds_ = source.kinds_;
    radii_of_kinds_ = source.radii_of_kinds_;
    resize(source.empty() ? 0 : count);
  }
  /// Takes the grain of a particle of the other array.
  void take(std::size_t number, const GrainArray& source, std::size_t from) {
    if (!kinds_.empty()) {
      numbers_[number] = source.numbers_[from];
    } else {
      set(number, source.grains_[from]);
    }
  }

  /// Whether all particles are alike.
  bool empty() const { return size() == 0; }
  /// Number of particles; 0 if they are alike.
  std::size_t size() const { return kinds_.empty() ? grains_.size() : numbers_.size(); }
  /// The grain of a particle.
  const Grain& operator[](std::size_t number) const {
    return kinds_.empty() ? grains_[number] : kinds_[numbers_[number]];
  }
  /// The radius of a particle.
  double radius(std::size_t number) const {
    return kinds_.empty() ? radii_[number] : radii_of_kinds_[numbers_[number]];
  }
  /// Calls visit(grain) for each particle, in the order of their numbers.
  template <class Visit>
  void for_each(const Visit& visit) const {
    for (std::size_t i = 0; i < size(); ++i) visit((*this)[i]);
  }

  /// The different grains; empty if all particles are alike, or have more than 128 kinds.
  const std::vector<Grain>& kinds() const { return kinds_; }
  /// The number of a particle's kind; 0 if there are too many.
  std::uint32_t kind(std::size_t number) const { return kinds_.empty() ? 0 : numbers_[number]; }
  /// The radii that a search for contacts reads.
  Radii radii() const { return {kinds_.empty() ? nullptr : radii_of_kinds_.data(), radii_.data()}; }

 private:
  void resize(std::size_t count) {
    const bool few = !kinds_.empty();
    numbers_.resize(few ? count : 0);
    grains_.resize(few ? 0 : count);
    radii_.resize(few ? 0 : count);
  }
  void set(std::size_t number, const Grain& grain) {
    if (!kinds_.empty()) {
      numbers_[number] =
          static_cast<std::uint8_t>(std::ranges::find(kinds_, grain) - kinds_.begin());
    } else {
      grains_[number] = grain;
      radii_[number] = grain.radius;
    }
  }
  // Returns false if there are too many.
  bool find_kinds(const std::vector<Grain>& grains) {
    constexpr std::size_t kMost = std::size_t{1} << kKindBits;
    for (const Grain& grain : grains) {
      if (std::ranges::find(kinds_, grain) != kinds_.end()) continue;
      if (kinds_.size() == kMost) return false;
      kinds_.push_back(grain);
      radii_of_kinds_.push_back(grain.radius);
    }
    return true;
  }

  std::vector<Grain> kinds_;            // empty: too many, or all are alike
  std::vector<double> radii_of_kinds_;  // [kinds]
  LargeArray<std::uint8_t> numbers_;    // [N] of kinds
  LargeArray<Grain> grains_;            // [N] of too many kinds
  LargeArray<double> radii_;            // [N]
};

}  // namespace clatter
